//! Methods of arrays for access to elements and for changes of the array.

use crate::script::bindings::built_in::{BuiltInTable, built_in};
use crate::script::bindings::returns::Returns;

pub const TABLE: BuiltInTable = BuiltInTable {
    name: "arrays",
    doc: "An array [a, b, c] holds values of any kind. Indices count from 0; -1 is the last. \
        Methods that change an array change the variable they are called on; a + b creates a \
        new array of both.",
    rows: &[
        built_in(&["array.len"], "Number of elements.", "check([1, 2, 3].len == 3);")
            .returns(Returns::INTEGER),
        built_in(&["array.is_empty"], "True if the array has no elements.", "check([].is_empty);")
            .returns(Returns::BOOLEAN),
        built_in(
            &["array.get(index)"],
            "Returns the element at an index, or nothing if there is none; array[index] is then \
            an error.",
            "check([5, 6].get(1) == 6);\ncheck([5, 6].get(9) == ());",
        )
        .returns(Returns::ANYTHING_OR_NOTHING),
        built_in(
            &["array.set(index, value)"],
            "Sets the element at an index, if there is one; array[index] = value does the same.",
            "let a = [1, 2];\na.set(0, 7);\ncheck(a == [7, 2]);",
        ),
        built_in(
            &["array.push(value)"],
            "Appends a value.",
            "let a = [1];\na.push(2);\ncheck(a == [1, 2]);",
        )
        .with_related(&["append", "insert", "pop"]),
        built_in(
            &["array.append(other)"],
            "Appends all elements of another array.",
            "let a = [1];\na.append([2, 3]);\ncheck(a == [1, 2, 3]);",
        )
        .with_related(&["push"]),
        built_in(
            &["array.insert(index, value)"],
            "Inserts a value before the element at an index.",
            "let a = [1, 3];\na.insert(1, 2);\ncheck(a == [1, 2, 3]);",
        )
        .with_related(&["push", "splice"]),
        built_in(
            &["array.pop()"],
            "Removes the last element and returns it; nothing if there is none.",
            "let a = [1, 2];\ncheck(a.pop() == 2 && a == [1]);",
        )
        .returns(Returns::ANYTHING_OR_NOTHING)
        .with_related(&["shift", "push"]),
        built_in(
            &["array.shift()"],
            "Removes the first element and returns it; nothing if there is none.",
            "let a = [1, 2];\ncheck(a.shift() == 1 && a == [2]);",
        )
        .returns(Returns::ANYTHING_OR_NOTHING)
        .with_related(&["pop"]),
        built_in(
            &["array.remove(index)"],
            "Removes the element at an index and returns it; nothing if there is none.",
            "let a = [1, 2, 3];\ncheck(a.remove(1) == 2 && a == [1, 3]);",
        )
        .returns(Returns::ANYTHING_OR_NOTHING),
        built_in(
            &["array.clear()"],
            "Removes all elements.",
            "let a = [1, 2];\na.clear();\ncheck(a == []);",
        ),
        built_in(
            &["array.truncate(count)"],
            "Keeps only the given number of elements from the beginning.",
            "let a = [1, 2, 3];\na.truncate(2);\ncheck(a == [1, 2]);",
        )
        .with_related(&["chop"]),
        built_in(
            &["array.chop(count)"],
            "Keeps only the given number of elements from the end.",
            "let a = [1, 2, 3];\na.chop(2);\ncheck(a == [2, 3]);",
        )
        .with_related(&["truncate"]),
        built_in(
            &["array.pad(count, value)"],
            "Extends the array to a length by appending a value.",
            "let a = [1];\na.pad(3, 0);\ncheck(a == [1, 0, 0]);",
        ),
        built_in(
            &["array.reverse()"],
            "Reverses the order in place.",
            "let a = [1, 2, 3];\na.reverse();\ncheck(a == [3, 2, 1]);",
        ),
        built_in(
            &["array.extract(start, [count])", "array.extract(range)"],
            "Returns a part as a new array; without a count, all elements from start on.",
            "check([1, 2, 3, 4].extract(1, 2) == [2, 3]);\ncheck([1, 2, 3, 4].extract(2..4) == [3, 4]);",
        )
        .returns(Returns::ARRAY)
        .with_related(&["drain", "split"]),
        built_in(
            &["array.split(index)"],
            "Splits the array at an index: keeps the elements before it, and returns the rest.",
            "let a = [1, 2, 3];\ncheck(a.split(1) == [2, 3] && a == [1]);",
        )
        .returns(Returns::ARRAY),
        built_in(
            &["array.splice(start, count, other)", "array.splice(range, other)"],
            "Replaces a part by the elements of another array.",
            "let a = [1, 2, 3, 4];\na.splice(1, 2, [9]);\ncheck(a == [1, 9, 4]);",
        )
        .with_related(&["insert"]),
        built_in(
            &["array.drain(test)", "array.drain(start, count)", "array.drain(range)"],
            "Removes the elements that pass a test, or a part, and returns them.",
            "let a = [1, 2, 3, 4];\ncheck(a.drain(|x| x > 2) == [3, 4] && a == [1, 2]);",
        )
        .returns(Returns::ARRAY)
        .with_related(&["retain", "filter"]),
        built_in(
            &["array.retain(test)", "array.retain(start, count)", "array.retain(range)"],
            "Keeps the elements that pass a test, or a part, and returns the others.",
            "let a = [1, 2, 3, 4];\ncheck(a.retain(|x| x > 2) == [1, 2] && a == [3, 4]);",
        )
        .returns(Returns::ARRAY)
        .with_related(&["drain", "filter"]),
        built_in(
            &["array.dedup([same])"],
            "Removes elements equal to the one before; same(a, b) may define equality.",
            "let a = [1, 1, 2, 1];\na.dedup();\ncheck(a == [1, 2, 1]);",
        ),
        built_in(
            &["array.sort([order])"],
            "Sorts in place; order(a, b) is negative if a comes first, positive if b comes \
            first.",
            "let a = [3, 1, 2];\na.sort();\ncheck(a == [1, 2, 3]);\na.sort(|a, b| sign(b - a));\ncheck(a == [3, 2, 1]);",
        )
        .with_related(&["order", "sort_desc"]),
        built_in(
            &["array.sort_by(order)"],
            "Sorts in place by a function; the same as sort(order).",
            "let a = [[2, \"b\"], [1, \"a\"]];\na.sort_by(|a, b| sign(a[0] - b[0]));\ncheck(a[0][1] == \"a\");",
        )
        .with_related(&["sort"]),
        built_in(
            &["array.sort_desc()"],
            "Sorts in place in descending order.",
            "let a = [3, 1, 2];\na.sort_desc();\ncheck(a == [3, 2, 1]);",
        )
        .with_related(&["sort"]),
    ],
};
