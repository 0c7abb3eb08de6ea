//! Conversions between types of values, and tests of numbers.

use crate::script::bindings::built_in::{BuiltInTable, built_in};
use crate::script::bindings::returns::Returns;

pub const TABLE: BuiltInTable = BuiltInTable {
    name: "conversions",
    doc: "Conversions of values. Whole numbers are converted to other numbers automatically \
        where required.",
    rows: &[
        built_in(
            &["parse_float(text)"],
            "Converts a text to a number.",
            "check(parse_float(\"0.05\") == 0.05);",
        )
        .returns(Returns::NUMBER)
        .with_related(&["parse_int"]),
        built_in(
            &["parse_int(text, [radix])"],
            "Converts a text to a whole number, to base 10 or another base up to 36.",
            "check(parse_int(\"42\") == 42);\ncheck(parse_int(\"ff\", 16) == 255);",
        )
        .returns(Returns::INTEGER)
        .with_related(&["parse_float"]),
        built_in(
            &["number.to_int()"],
            "Converts a number to a whole number, without the digits after the decimal point.",
            "check(2.7.to_int() == 2 && (-2.7).to_int() == -2);",
        )
        .returns(Returns::INTEGER)
        .with_related(&["floor", "round"]),
        built_in(
            &["number.to_float()"],
            "Converts a whole number to a number with a decimal point; rarely needed.",
            "check(type_of(3.to_float()) == \"number\");",
        )
        .returns(Returns::NUMBER),
        built_in(
            &["value.to_string()"],
            "Returns the printed form of the value.",
            "check((1/20).to_string() == \"0.05\");\ncheck([1, 2].to_string() == \"[1, 2]\");",
        )
        .returns(Returns::TEXT)
        .with_related(&["to_debug", "sci", "fixed"]),
        built_in(
            &["value.to_debug()"],
            "Returns the value as it is written in a script: texts with their quotes.",
            "check(\"a\".to_debug() == \"\\\"a\\\"\");",
        )
        .returns(Returns::TEXT)
        .with_related(&["to_string"]),
        built_in(
            &["number.to_hex()"],
            "Returns a whole number in hexadecimal digits.",
            "check(255.to_hex() == \"ff\");\ncheck(0xff == 255);",
        )
        .returns(Returns::TEXT),
        built_in(
            &["number.to_octal()"],
            "Returns a whole number in octal digits.",
            "check(8.to_octal() == \"10\");",
        )
        .returns(Returns::TEXT),
        built_in(
            &["number.to_binary()"],
            "Returns a whole number in binary digits.",
            "check(5.to_binary() == \"101\");",
        )
        .returns(Returns::TEXT),
        built_in(
            &["number.sign()"],
            "Returns -1 for a negative number, 0 for zero, 1 for a positive one: the order of \
            two numbers for sort.",
            "check(sign(-0.5) == -1 && sign(0) == 0 && sign(7) == 1);",
        )
        .returns(Returns::INTEGER)
        .with_related(&["abs", "sort"]),
        built_in(
            &["number.is_zero()"],
            "Returns true if a number is zero.",
            "check(0.is_zero() && !is_zero(1e-300));",
        )
        .returns(Returns::BOOLEAN),
        built_in(
            &["number.is_even()"],
            "Returns true if a whole number is even.",
            "check(is_even(4));",
        )
        .returns(Returns::BOOLEAN)
        .with_related(&["is_odd"]),
        built_in(
            &["number.is_odd()"],
            "Returns true if a whole number is odd.",
            "check(is_odd(3));",
        )
        .returns(Returns::BOOLEAN)
        .with_related(&["is_even"]),
        built_in(
            &["number.bits([start], [count])", "number.bits(range)", "number.bits"],
            "Returns the binary digits of a whole number for a for loop, the last digit first.",
            "let set = 0;\nfor bit in bits(5) { if bit { set += 1; } }\ncheck(set == 2);",
        )
        .returns(Returns::ANYTHING.with_description("true or false for each digit"))
        .with_related(&["to_binary"]),
    ],
};
