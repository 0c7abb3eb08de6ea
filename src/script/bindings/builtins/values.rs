//! Printing, and functions for values of any type.

use crate::script::bindings::built_in::{BuiltInTable, built_in};
use crate::script::bindings::returns::Returns;

pub const TABLE: BuiltInTable = BuiltInTable {
    name: "values",
    doc: "Printing, properties of values and variables, and the clock.",
    rows: &[
        built_in(
            &["print([value])"],
            "Prints a value and ends the line.",
            "print(\"the tip\");\nprint(1/20);\nprint(`x = ${fixed(PI, 2)}`);",
        )
        .with_related(&["debug", "tabulate", "sci", "fixed"]),
        built_in(
            &["debug([value])"],
            "Prints a value as it is written in a script, with the line of the call, to the \
            error output.",
            "debug(#{ dt: 0.1 });\nprint(\"seen\");",
        )
        .with_related(&["print"]),
        built_in(
            &["type_of(value)", "value.type_of()"],
            "Returns the name of the type of a value.",
            "check(type_of(0.5) == \"number\" && type_of(2) == \"whole number\");\ncheck(type_of(vec(1, 2)) == \"vector\");",
        )
        .returns(Returns::TEXT),
        built_in(
            &["is_def_var(name)"],
            "Returns true if a variable with this name exists here.",
            "let dt = 0.1;\ncheck(is_def_var(\"dt\") && !is_def_var(\"tip\"));",
        )
        .returns(Returns::BOOLEAN)
        .with_related(&["is_def_fn"]),
        built_in(
            &["is_shared(variable)"],
            "Returns true if a closure shares the variable.",
            "let count = 0;\nlet add = || count += 1;\ncheck(is_shared(count));",
        )
        .returns(Returns::BOOLEAN),
        built_in(
            &["timestamp()"],
            "Returns the present time of the clock, to measure durations.",
            "let began = timestamp();\ncheck(began.elapsed >= 0);",
        )
        .returns(Returns::TIMESTAMP)
        .with_related(&["elapsed"]),
        built_in(
            &["timestamp.elapsed", "timestamp.elapsed()"],
            "Seconds of clock time since a timestamp was taken.",
            "let began = timestamp();\nfor i in 0..100 { sqrt(i); }\nprint(`${sci(began.elapsed)} s`);",
        )
        .returns(Returns::NUMBER)
        .with_related(&["timestamp"]),
    ],
};
