//! Methods of ranges.

use crate::script::bindings::built_in::{BuiltInTable, built_in};
use crate::script::bindings::returns::Returns;

pub const TABLE: BuiltInTable = BuiltInTable {
    name: "ranges",
    doc: "0..3 is 0, 1, 2; 0..=3 includes 3. Ranges have whole numbers; use linspace(from, to, \
        count) for other numbers.",
    rows: &[
        built_in(
            &["range(from, to, [step])", "range(range, step)"],
            "Returns numbers for a for loop, from one up to another, which is not included.",
            "let found = [];\nfor n in range(10, 0, -4) { found.push(n); }\ncheck(found == [10, 6, 2]);\n\
             for n in range(0..10, 5) { print(n); }",
        )
        .returns(Returns::ANYTHING.with_description("numbers for a loop"))
        .with_related(&["linspace"]),
        built_in(&["range.start"], "Start of the range.", "check((2..5).start == 2);")
            .returns(Returns::INTEGER),
        built_in(&["range.end"], "End of the range.", "check((2..5).end == 5);")
            .returns(Returns::INTEGER),
        built_in(
            &["range.contains(n)"],
            "Returns true if a whole number is in the range; the same as n in range.",
            "check((0..3).contains(2));\ncheck(3 !in 0..3);",
        )
        .returns(Returns::BOOLEAN),
        built_in(&["range.is_empty"], "True if the range is empty.", "check((3..3).is_empty);")
            .returns(Returns::BOOLEAN),
        built_in(
            &["range.is_inclusive"],
            "True if the end belongs to the range.",
            "check((0..=3).is_inclusive && !(0..3).is_inclusive);",
        )
        .returns(Returns::BOOLEAN)
        .with_related(&["is_exclusive"]),
        built_in(
            &["range.is_exclusive"],
            "True if the end does not belong to the range.",
            "check((0..3).is_exclusive);",
        )
        .returns(Returns::BOOLEAN)
        .with_related(&["is_inclusive"]),
    ],
};
