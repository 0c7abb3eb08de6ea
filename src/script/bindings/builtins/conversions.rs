//! Conversions between kinds of values, and tests of numbers.

use crate::script::bindings::built_in::{BuiltInTable, built_in};
use crate::script::bindings::returns::Returns;

pub const TABLE: BuiltInTable = BuiltInTable {
    name: "conversions",
    doc: "Whole numbers become other numbers by themselves where they must; these functions are for the rest.",
    rows: &[
        built_in(
            &["parse_float(text)"],
            "The number that a text shows.",
            "check(parse_float(\"0.05\") == 0.05);",
        )
        .returns(Returns::NUMBER)
        .see(&["parse_int"]),
        built_in(
            &["parse_int(text, [radix])"],
            "The whole number that a text shows, to base 10 or another one up to 36.",
            "check(parse_int(\"42\") == 42);\ncheck(parse_int(\"ff\", 16) == 255);",
        )
        .returns(Returns::WHOLE)
        .see(&["parse_float"]),
        built_in(
            &["number.to_int()"],
            "The number as a whole number, without what stands after the point.",
            "check(2.7.to_int() == 2 && (-2.7).to_int() == -2);",
        )
        .returns(Returns::WHOLE)
        .see(&["floor", "round"]),
        built_in(
            &["number.to_float()"],
            "A whole number as one with a point; seldom needed.",
            "check(type_of(3.to_float()) == \"number\");",
        )
        .returns(Returns::NUMBER),
        built_in(
            &["value.to_string()"],
            "The value as it prints.",
            "check((1/20).to_string() == \"0.05\");\ncheck([1, 2].to_string() == \"[1, 2]\");",
        )
        .returns(Returns::TEXT)
        .see(&["to_debug", "sci", "fixed"]),
        built_in(
            &["value.to_debug()"],
            "The value as it would be written in a script: texts with their quotes.",
            "check(\"a\".to_debug() == \"\\\"a\\\"\");",
        )
        .returns(Returns::TEXT)
        .see(&["to_string"]),
        built_in(
            &["number.to_hex()"],
            "A whole number in hexadecimal digits.",
            "check(255.to_hex() == \"ff\");\ncheck(0xff == 255);",
        )
        .returns(Returns::TEXT),
        built_in(
            &["number.to_octal()"],
            "A whole number in octal digits.",
            "check(8.to_octal() == \"10\");",
        )
        .returns(Returns::TEXT),
        built_in(
            &["number.to_binary()"],
            "A whole number in binary digits.",
            "check(5.to_binary() == \"101\");",
        )
        .returns(Returns::TEXT),
        built_in(
            &["number.sign()"],
            "-1 for a negative number, 0 for zero, 1 for a positive one: the order of two numbers for sort.",
            "check(sign(-0.5) == -1 && sign(0) == 0 && sign(7) == 1);",
        )
        .returns(Returns::WHOLE)
        .see(&["abs", "sort"]),
        built_in(&["number.is_zero()"], "Whether a number is zero.", "check(0.is_zero() && !is_zero(1e-300));")
            .returns(Returns::TRUTH),
        built_in(&["number.is_even()"], "Whether a whole number is even.", "check(is_even(4));")
            .returns(Returns::TRUTH)
            .see(&["is_odd"]),
        built_in(&["number.is_odd()"], "Whether a whole number is odd.", "check(is_odd(3));")
            .returns(Returns::TRUTH)
            .see(&["is_even"]),
        built_in(
            &["number.bits([start], [count])", "number.bits(range)", "number.bits"],
            "The binary digits of a whole number, the last first, to be gone over by for.",
            "let set = 0;\nfor bit in bits(5) { if bit { set += 1; } }\ncheck(set == 2);",
        )
        .returns(Returns::ANYTHING.words("true or false for each digit"))
        .see(&["to_binary"]),
    ],
};
