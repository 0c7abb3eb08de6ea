//! Methods of arrays that call a function to search or transform elements.

use crate::script::bindings::built_in::{BuiltInTable, built_in};
use crate::script::bindings::returns::Returns;

pub const TABLE: BuiltInTable = BuiltInTable {
    name: "searches",
    doc: "Methods of arrays that take a function and do not change the array. The function may \
        take the index as its second argument: [5, 6].map(|x, i| x * i).",
    rows: &[
        built_in(
            &["array.map(function)"],
            "Returns the results of a function for all elements.",
            "check([1, 2, 3].map(|x| x^2) == [1, 4, 9]);",
        )
        .returns(Returns::ARRAY)
        .with_related(&["filter", "reduce", "for_each"]),
        built_in(
            &["array.filter(test)"],
            "Returns the elements that pass a test.",
            "check([1, -2, 3].filter(|x| x > 0) == [1, 3]);",
        )
        .returns(Returns::ARRAY)
        .with_related(&["map", "find", "retain"]),
        built_in(
            &["array.reduce(function, [start])"],
            "Combines all elements to one value by function(so_far, element), from start on; \
            default start: nothing.",
            "check([1, 2, 3].reduce(|total, x| total + x, 0) == 6);",
        )
        .returns(Returns::ANYTHING)
        .with_related(&["sum", "map", "reduce_rev"]),
        built_in(
            &["array.reduce_rev(function, [start])"],
            "Combines all elements to one value like reduce, from the last element to the \
            first.",
            "check([1, 2, 3].reduce_rev(|text, x| text + x, \"\") == \"321\");",
        )
        .returns(Returns::ANYTHING)
        .with_related(&["reduce"]),
        built_in(
            &["array.for_each(function)"],
            "Calls a function for each element, which it can change by the name this.",
            "let a = [1, 2];\na.for_each(|| this *= 10);\na.for_each(|x, i| check(x == 10 * (i + 1)));",
        )
        .with_related(&["map"]),
        built_in(
            &["array.zip(other, function)"],
            "Returns the results of a function of two arguments for the pairs of elements of \
            two arrays.",
            "check([1, 2].zip([10, 20], |a, b| a + b) == [11, 22]);",
        )
        .returns(Returns::ARRAY)
        .with_related(&["map"]),
        built_in(
            &["array.find(test, [start])"],
            "Returns the first element that passes a test; nothing if none does.",
            "check([1, -2, -3].find(|x| x < 0) == -2);",
        )
        .returns(Returns::ANYTHING_OR_NOTHING)
        .with_related(&["index_of", "filter", "find_map"]),
        built_in(
            &["array.find_map(function, [start])"],
            "Returns the first result of a function that is not nothing.",
            "check([1, 2, 3].find_map(|x| if x > 1 { x * 10 }) == 20);",
        )
        .returns(Returns::ANYTHING_OR_NOTHING)
        .with_related(&["find"]),
        built_in(
            &["array.index_of(value, [start])", "array.index_of(test, [start])"],
            "Returns the index of the first element that is equal to a value or passes a test; \
            -1 if there is none.",
            "check([5, 6, 7].index_of(6) == 1);\ncheck([5, 6, 7].index_of(|x| x > 6) == 2);\ncheck([5].index_of(1) == -1);",
        )
        .returns(Returns::INTEGER)
        .with_related(&["contains", "find"]),
        built_in(
            &["array.contains(value)"],
            "Returns true if a value is in the array; the same as value in array.",
            "check([1, 2].contains(2));\ncheck(3 !in [1, 2]);",
        )
        .returns(Returns::BOOLEAN)
        .with_related(&["index_of", "some"]),
        built_in(
            &["array.some(test)"],
            "Returns true if at least one element passes a test.",
            "check([1, -2].some(|x| x < 0));",
        )
        .returns(Returns::BOOLEAN)
        .with_related(&["all"]),
        built_in(
            &["array.all(test)"],
            "Returns true if every element passes a test.",
            "check([1, 2].all(|x| x > 0));",
        )
        .returns(Returns::BOOLEAN)
        .with_related(&["some"]),
        built_in(
            &["array.order([order])"],
            "Returns a sorted copy; order(a, b) may define the order, as for sort.",
            "let a = [3, 1, 2];\ncheck(a.order() == [1, 2, 3] && a == [3, 1, 2]);",
        )
        .returns(Returns::ARRAY)
        .with_related(&["sort", "order_desc"]),
        built_in(
            &["array.order_by(order)"],
            "Returns a copy sorted by a function; the same as order(order).",
            "check([1, 3, 2].order_by(|a, b| sign(b - a)) == [3, 2, 1]);",
        )
        .returns(Returns::ARRAY)
        .with_related(&["order"]),
        built_in(
            &["array.order_desc()"],
            "Returns a copy sorted in descending order.",
            "check([1, 3, 2].order_desc() == [3, 2, 1]);",
        )
        .returns(Returns::ARRAY)
        .with_related(&["order"]),
    ],
};
