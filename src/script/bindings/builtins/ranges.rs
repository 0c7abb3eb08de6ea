//! Methods of ranges.

use crate::script::bindings::built_in::{BuiltInTable, built_in};
use crate::script::bindings::returns::Returns;

pub const TABLE: BuiltInTable = BuiltInTable {
    name: "ranges",
    doc: "0..3 is 0, 1, 2; 0..=3 includes 3. Ranges have whole numbers; linspace(from, to, count) makes others.",
    rows: &[
        built_in(
            &["range(from, to, [step])", "range(range, step)"],
            "Numbers from one up to another, which is not included, to be gone over by for.",
            "let found = [];\nfor n in range(10, 0, -4) { found.push(n); }\ncheck(found == [10, 6, 2]);\n\
             for n in range(0..10, 5) { print(n); }",
        )
        .returns(Returns::ANYTHING.words("numbers for a loop"))
        .see(&["linspace"]),
        built_in(&["range.start"], "Where the range begins.", "check((2..5).start == 2);")
            .returns(Returns::WHOLE),
        built_in(&["range.end"], "Where the range ends.", "check((2..5).end == 5);")
            .returns(Returns::WHOLE),
        built_in(
            &["range.contains(n)"],
            "Whether a whole number is in the range; the same as n in range.",
            "check((0..3).contains(2));\ncheck(3 !in 0..3);",
        )
        .returns(Returns::TRUTH),
        built_in(&["range.is_empty"], "Whether nothing is in the range.", "check((3..3).is_empty);")
            .returns(Returns::TRUTH),
        built_in(
            &["range.is_inclusive"],
            "Whether the end belongs to the range.",
            "check((0..=3).is_inclusive && !(0..3).is_inclusive);",
        )
        .returns(Returns::TRUTH)
        .see(&["is_exclusive"]),
        built_in(
            &["range.is_exclusive"],
            "Whether the end does not belong to the range.",
            "check((0..3).is_exclusive);",
        )
        .returns(Returns::TRUTH)
        .see(&["is_inclusive"]),
    ],
};
