//! Methods of function values: function pointers and closures.

use crate::script::bindings::built_in::{BuiltInTable, built_in};
use crate::script::bindings::returns::Returns;

pub const TABLE: BuiltInTable = BuiltInTable {
    name: "functions",
    doc: "|x| 2 * x is a function without a name, which can be stored in a variable. It can use \
        the variables around it.",
    rows: &[
        built_in(
            &["function.call(values…)"],
            "Calls the function that a variable holds.",
            "let twice = |x| 2 * x;\ncheck(twice.call(4) == 8);",
        )
        .returns(Returns::ANYTHING.with_description("the result of the function"))
        .with_related(&["curry", "Fn"]),
        built_in(
            &["function.curry(values…)"],
            "Returns a function of fewer arguments, with the first ones fixed.",
            "let power = |n, x| x^n;\nlet cube = power.curry(3);\ncheck(cube.call(2) == 8);",
        )
        .returns(Returns::FUNCTION)
        .with_related(&["call"]),
        built_in(
            &["Fn(name)"],
            "Returns the function with this name as a value.",
            "fn twice(x) { 2 * x }\ncheck([1, 2].map(Fn(\"twice\")) == [2, 4]);",
        )
        .returns(Returns::FUNCTION)
        .with_related(&["call"]),
        built_in(
            &["function.name"],
            "Name of the function.",
            "check(Fn(\"sin\").name == \"sin\");",
        )
        .returns(Returns::TEXT),
        built_in(
            &["function.is_anonymous"],
            "True if the function was written as |x| … .",
            "check((|x| x).is_anonymous);",
        )
        .returns(Returns::BOOLEAN),
        built_in(
            &["is_def_fn(name, count)", "is_def_fn(type, name, count)"],
            "Returns true if the script defines a function with this name and number of \
            parameters.",
            "fn twice(x) { 2 * x }\ncheck(is_def_fn(\"twice\", 1) && !is_def_fn(\"twice\", 2));",
        )
        .returns(Returns::BOOLEAN)
        .with_related(&["is_def_var"]),
    ],
};
