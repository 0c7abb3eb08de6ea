//! Methods of maps.

use crate::script::bindings::built_in::{BuiltInTable, built_in};
use crate::script::bindings::returns::{Returns, ValueKind};

pub const TABLE: BuiltInTable = BuiltInTable {
    name: "maps",
    doc: "A map #{ key: value } holds values by name: map.key, or map[\"key\"]. Reading a \
        missing key is an error; assigning adds it. Options are given as maps. Methods are \
        written with parentheses: map.len().",
    rows: &[
        built_in(&["map.len()"], "Returns the number of keys.", "check(#{ a: 1, b: 2 }.len() == 2);")
            .returns(Returns::INTEGER),
        built_in(&["map.is_empty()"], "Returns true if the map has no keys.", "check(#{}.is_empty());")
            .returns(Returns::BOOLEAN),
        built_in(&["map.keys()"], "Returns the keys in alphabetical order.", "check(#{ b: 2, a: 1 }.keys() == [\"a\", \"b\"]);")
            .returns(Returns::array_of(&ValueKind::Text))
            .with_related(&["values"]),
        built_in(
            &["map.values()"],
            "Returns the values in the order of their keys.",
            "check(#{ b: 2, a: 1 }.values() == [1, 2]);",
        )
        .returns(Returns::ARRAY)
        .with_related(&["keys"]),
        built_in(
            &["map.contains(key)"],
            "Returns true if the map has a key; the same as key in map.",
            "let m = #{ dt: 0.1 };\ncheck(m.contains(\"dt\") && \"t\" !in m);",
        )
        .returns(Returns::BOOLEAN),
        built_in(
            &["map.get(key)"],
            "Returns the value of a key, or nothing if there is none.",
            "let m = #{ dt: 0.1 };\ncheck(m.get(\"dt\") == 0.1 && m.get(\"t\") == ());\ncheck((m.get(\"t\") ?? 5) == 5);",
        )
        .returns(Returns::ANYTHING_OR_NOTHING),
        built_in(
            &["map.set(key, value)"],
            "Adds a key or changes its value; map.key = value does the same.",
            "let m = #{};\nm.set(\"dt\", 0.1);\ncheck(m.dt == 0.1);",
        ),
        built_in(
            &["map.remove(key)"],
            "Removes a key and returns its value; nothing if there is none.",
            "let m = #{ a: 1, b: 2 };\ncheck(m.remove(\"a\") == 1 && m.len() == 1);",
        )
        .returns(Returns::ANYTHING_OR_NOTHING),
        built_in(
            &["map.clear()"],
            "Removes all keys.",
            "let m = #{ a: 1 };\nm.clear();\ncheck(m.is_empty());",
        ),
        built_in(
            &["map.mixin(other)"],
            "Adds all keys of another map, whose values replace existing ones; map += other \
            does the same.",
            "let options = #{ dt: 0.1, name: \"a\" };\noptions.mixin(#{ dt: 0.2 });\ncheck(options.dt == 0.2 && options.name == \"a\");",
        )
        .with_related(&["fill_with"]),
        built_in(
            &["map.fill_with(other)"],
            "Adds the missing keys of another map.",
            "let options = #{ dt: 0.1 };\noptions.fill_with(#{ dt: 1, name: \"a\" });\ncheck(options.dt == 0.1 && options.name == \"a\");",
        )
        .with_related(&["mixin"]),
        built_in(
            &["map.map(function)"],
            "Returns a map with the same keys and the results of function(key, value) as \
            values.",
            "check(#{ a: 1, b: 2 }.map(|key, value| value * 10).b == 20);",
        )
        .returns(Returns::MAP),
        built_in(
            &["map.filter(test)"],
            "Returns a map of the keys that pass test(key, value).",
            "check(#{ a: 1, b: 2 }.filter(|key, value| value > 1).keys() == [\"b\"]);",
        )
        .returns(Returns::MAP)
        .with_related(&["retain"]),
        built_in(
            &["map.drain(test)"],
            "Removes the keys that pass test(key, value), and returns them as a map.",
            "let m = #{ a: 1, b: 2 };\ncheck(m.drain(|key, value| value > 1).keys() == [\"b\"] && m.keys() == [\"a\"]);",
        )
        .returns(Returns::MAP)
        .with_related(&["retain"]),
        built_in(
            &["map.retain(test)"],
            "Keeps the keys that pass test(key, value), and returns the others as a map.",
            "let m = #{ a: 1, b: 2 };\ncheck(m.retain(|key, value| value > 1).keys() == [\"a\"] && m.keys() == [\"b\"]);",
        )
        .returns(Returns::MAP)
        .with_related(&["drain", "filter"]),
        built_in(
            &["map.to_json()"],
            "Returns the map as JSON text.",
            "check(#{ dt: 0.5 }.to_json() == \"{\\\"dt\\\":0.5}\");",
        )
        .returns(Returns::TEXT),
    ],
};
