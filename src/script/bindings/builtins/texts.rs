//! Methods of texts.

use crate::script::bindings::built_in::{BuiltInTable, built_in};
use crate::script::bindings::returns::{Returns, ValueKind};

pub const TABLE: BuiltInTable = BuiltInTable {
    name: "texts",
    doc: "A text is written in double quotes, or between backquotes, where ${ } contains values. \
        Characters, such as 'a', count from 0; -1 is the last. Methods that change a text \
        change the variable they are called on.",
    rows: &[
        built_in(&["text.len"], "Number of characters.", "check(\"spline\".len == 6);")
            .returns(Returns::INTEGER)
            .with_related(&["bytes"]),
        built_in(
            &["text.bytes"],
            "Number of bytes of the text in UTF-8.",
            "check(\"°\".bytes == 2 && \"°\".len == 1);",
        )
        .returns(Returns::INTEGER),
        built_in(&["text.is_empty"], "True if the text has no characters.", "check(\"\".is_empty);")
            .returns(Returns::BOOLEAN),
        built_in(
            &["text.contains(part)"],
            "Returns true if the text contains a text or character; the same as part in text.",
            "check(\"flying spaghetti\".contains(\"spa\"));\ncheck(\"spa\" in \"spaghetti\");",
        )
        .returns(Returns::BOOLEAN)
        .with_related(&["index_of", "starts_with"]),
        built_in(
            &["text.starts_with(part)"],
            "Returns true if the text starts with a text.",
            "check(\"beam1\".starts_with(\"beam\"));",
        )
        .returns(Returns::BOOLEAN)
        .with_related(&["ends_with"]),
        built_in(
            &["text.ends_with(part)"],
            "Returns true if the text ends with a text.",
            "check(\"out.svg\".ends_with(\".svg\"));",
        )
        .returns(Returns::BOOLEAN)
        .with_related(&["starts_with"]),
        built_in(
            &["text.index_of(part, [start])"],
            "Returns the index of the first occurrence of a text or character, from start on; \
            -1 if there is none.",
            "check(\"a-b-c\".index_of(\"-\") == 1);\ncheck(\"a-b-c\".index_of(\"-\", 2) == 3);\n\
             check(\"abc\".index_of('x') == -1);",
        )
        .returns(Returns::INTEGER),
        built_in(
            &["text.sub_string(start, [count])", "text.sub_string(range)"],
            "Returns a part of the text; without a count, everything from start on.",
            "check(\"spaghetti\".sub_string(0, 3) == \"spa\");\ncheck(\"spaghetti\".sub_string(3..6) == \"ghe\");",
        )
        .returns(Returns::TEXT)
        .with_related(&["crop", "split"]),
        built_in(
            &["text.split([separator], [count])", "text.split(index)"],
            "Splits the text at separators, or at white space, into an array; with an index \
            into the parts before and after it.",
            "check(\"1, 2, 3\".split(\", \") == [\"1\", \"2\", \"3\"]);\ncheck(\"two words\".split().len == 2);\n\
             check(\"abcd\".split(1) == [\"a\", \"bcd\"]);",
        )
        .returns(Returns::array_of(&ValueKind::Text))
        .doc("With a count there are at most that many parts; the last one contains the rest.")
        .with_related(&["split_rev"]),
        built_in(
            &["text.split_rev(separator, [count])"],
            "Splits the text at separators into an array, the last part first.",
            "check(\"a.b.c\".split_rev(\".\", 2) == [\"c\", \"a.b\"]);",
        )
        .returns(Returns::array_of(&ValueKind::Text))
        .with_related(&["split"]),
        built_in(
            &["text.to_chars()"],
            "Returns the characters as an array.",
            "check(\"abc\".to_chars() == ['a', 'b', 'c']);",
        )
        .returns(Returns::array_of(&ValueKind::Character))
        .with_related(&["chars"]),
        built_in(
            &["text.chars([start], [count])", "text.chars(range)", "text.chars"],
            "Returns the characters for a for loop.",
            "let letters = 0;\nfor letter in \"abc\".chars() { letters += 1; }\ncheck(letters == 3);",
        )
        .returns(Returns::ANYTHING.with_description("characters"))
        .with_related(&["to_chars"]),
        built_in(
            &["text.get(index)"],
            "Returns the character at an index, or nothing if there is none; text[index] is \
            then an error.",
            "check(\"abc\".get(-1) == 'c');\ncheck(\"abc\".get(7) == ());\ncheck(\"abc\"[0] == 'a');",
        )
        .returns(Returns::one_of(&[ValueKind::Character, ValueKind::Nothing])),
        built_in(
            &["text.set(index, character)"],
            "Sets the character at an index, if there is one.",
            "let word = \"cat\";\nword.set(0, 'b');\ncheck(word == \"bat\");",
        ),
        built_in(
            &["text.to_upper()", "character.to_upper()"],
            "Returns the text in upper case.",
            "check(\"beam\".to_upper() == \"BEAM\" && 'a'.to_upper() == 'A');",
        )
        .returns(Returns::TEXT.with_remark(", or a character for a character"))
        .with_related(&["to_lower", "make_upper"]),
        built_in(
            &["text.to_lower()", "character.to_lower()"],
            "Returns the text in lower case.",
            "check(\"BEAM\".to_lower() == \"beam\");",
        )
        .returns(Returns::TEXT.with_remark(", or a character for a character"))
        .with_related(&["to_upper", "make_lower"]),
        built_in(
            &["text.make_upper()", "character.make_upper()"],
            "Converts to upper case in place.",
            "let word = \"beam\";\nword.make_upper();\ncheck(word == \"BEAM\");",
        )
        .with_related(&["to_upper"]),
        built_in(
            &["text.make_lower()", "character.make_lower()"],
            "Converts to lower case in place.",
            "let word = \"BEAM\";\nword.make_lower();\ncheck(word == \"beam\");",
        )
        .with_related(&["to_lower"]),
        built_in(
            &["text.trim()"],
            "Removes white space at both ends, in place.",
            "let word = \"  beam \";\nword.trim();\ncheck(word == \"beam\");",
        ),
        built_in(
            &["text.replace(old, new)"],
            "Replaces every occurrence of a text or character, in place.",
            "let name = \"a b c\";\nname.replace(\" \", \"-\");\ncheck(name == \"a-b-c\");",
        ),
        built_in(
            &["text.remove(part)"],
            "Removes every occurrence of a text or character, in place.",
            "let name = \"a-b-c\";\nname.remove(\"-\");\ncheck(name == \"abc\");",
        ),
        built_in(
            &["text.crop(start, [count])", "text.crop(range)"],
            "Keeps only a part, in place.",
            "let word = \"spaghetti\";\nword.crop(0, 3);\ncheck(word == \"spa\");",
        )
        .with_related(&["sub_string"]),
        built_in(
            &["text.truncate(count)"],
            "Keeps only the given number of characters from the beginning, in place.",
            "let word = \"spaghetti\";\nword.truncate(3);\ncheck(word == \"spa\");",
        ),
        built_in(
            &["text.pad(count, with)"],
            "Extends the text to a length by appending a text or character, in place.",
            "let word = \"t\";\nword.pad(4, '.');\ncheck(word == \"t...\");",
        ),
        built_in(
            &["text.append(value)"],
            "Appends the printed form of a value, in place; text += value does the same.",
            "let name = \"beam\";\nname.append(1);\ncheck(name == \"beam1\");",
        ),
        built_in(
            &["text.pop([count])"],
            "Removes one or the given number of characters at the end and returns them.",
            "let word = \"beams\";\ncheck(word.pop() == 's');\ncheck(word.pop(2) == \"am\" && word == \"be\");",
        )
        .returns(Returns::CHARACTER.with_remark(", or a text if a count is given")),
        built_in(
            &["text.clear()"],
            "Makes the text empty.",
            "let word = \"beam\";\nword.clear();\ncheck(word == \"\");",
        ),
    ],
};
