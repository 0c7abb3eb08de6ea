//! Methods of texts.

use crate::script::bindings::built_in::{BuiltInTable, built_in};
use crate::script::bindings::returns::{Returns, ValueKind};

pub const TABLE: BuiltInTable = BuiltInTable {
    name: "texts",
    doc: "A text stands in double quotes, or between backquotes, where ${ } holds values. Characters, such as 'a', count from \
          0, and -1 is the last. Methods that change a text change the variable they are called on.",
    rows: &[
        built_in(&["text.len"], "How many characters the text has.", "check(\"spline\".len == 6);")
            .returns(Returns::WHOLE)
            .see(&["bytes"]),
        built_in(
            &["text.bytes"],
            "How many bytes the text takes as UTF-8.",
            "check(\"°\".bytes == 2 && \"°\".len == 1);",
        )
        .returns(Returns::WHOLE),
        built_in(&["text.is_empty"], "Whether the text has no characters.", "check(\"\".is_empty);")
            .returns(Returns::TRUTH),
        built_in(
            &["text.contains(part)"],
            "Whether a text or character occurs in the text; the same as part in text.",
            "check(\"flying spaghetti\".contains(\"spa\"));\ncheck(\"spa\" in \"spaghetti\");",
        )
        .returns(Returns::TRUTH)
        .see(&["index_of", "starts_with"]),
        built_in(
            &["text.starts_with(part)"],
            "Whether the text begins so.",
            "check(\"beam1\".starts_with(\"beam\"));",
        )
        .returns(Returns::TRUTH)
        .see(&["ends_with"]),
        built_in(
            &["text.ends_with(part)"],
            "Whether the text ends so.",
            "check(\"out.svg\".ends_with(\".svg\"));",
        )
        .returns(Returns::TRUTH)
        .see(&["starts_with"]),
        built_in(
            &["text.index_of(part, [start])"],
            "Where a text or character occurs first, from start on; -1 if it does not.",
            "check(\"a-b-c\".index_of(\"-\") == 1);\ncheck(\"a-b-c\".index_of(\"-\", 2) == 3);\n\
             check(\"abc\".index_of('x') == -1);",
        )
        .returns(Returns::WHOLE),
        built_in(
            &["text.sub_string(start, [count])", "text.sub_string(range)"],
            "A piece of the text; without a count, all from start on.",
            "check(\"spaghetti\".sub_string(0, 3) == \"spa\");\ncheck(\"spaghetti\".sub_string(3..6) == \"ghe\");",
        )
        .returns(Returns::TEXT)
        .see(&["crop", "split"]),
        built_in(
            &["text.split([separator], [count])", "text.split(index)"],
            "The pieces between separators, or between blanks; or the two pieces before and after an index.",
            "check(\"1, 2, 3\".split(\", \") == [\"1\", \"2\", \"3\"]);\ncheck(\"two words\".split().len == 2);\n\
             check(\"abcd\".split(1) == [\"a\", \"bcd\"]);",
        )
        .returns(Returns::array_of(&ValueKind::Text))
        .doc("With a count there are at most so many pieces, the last with all the rest.")
        .see(&["split_rev"]),
        built_in(
            &["text.split_rev(separator, [count])"],
            "The pieces between separators, the last one first.",
            "check(\"a.b.c\".split_rev(\".\", 2) == [\"c\", \"a.b\"]);",
        )
        .returns(Returns::array_of(&ValueKind::Text))
        .see(&["split"]),
        built_in(
            &["text.to_chars()"],
            "The characters as an array.",
            "check(\"abc\".to_chars() == ['a', 'b', 'c']);",
        )
        .returns(Returns::array_of(&ValueKind::Character))
        .see(&["chars"]),
        built_in(
            &["text.chars([start], [count])", "text.chars(range)", "text.chars"],
            "The characters, to be gone over by for.",
            "let letters = 0;\nfor letter in \"abc\".chars() { letters += 1; }\ncheck(letters == 3);",
        )
        .returns(Returns::ANYTHING.words("characters"))
        .see(&["to_chars"]),
        built_in(
            &["text.get(index)"],
            "The character at an index, or nothing if there is none; text[index] is an error then.",
            "check(\"abc\".get(-1) == 'c');\ncheck(\"abc\".get(7) == ());\ncheck(\"abc\"[0] == 'a');",
        )
        .returns(Returns::one_of(&[ValueKind::Character, ValueKind::Nothing])),
        built_in(
            &["text.set(index, character)"],
            "Changes the character at an index, if there is one.",
            "let word = \"cat\";\nword.set(0, 'b');\ncheck(word == \"bat\");",
        ),
        built_in(
            &["text.to_upper()", "character.to_upper()"],
            "The same in capital letters.",
            "check(\"beam\".to_upper() == \"BEAM\" && 'a'.to_upper() == 'A');",
        )
        .returns(Returns::TEXT.note(", or a character of a character"))
        .see(&["to_lower", "make_upper"]),
        built_in(
            &["text.to_lower()", "character.to_lower()"],
            "The same in small letters.",
            "check(\"BEAM\".to_lower() == \"beam\");",
        )
        .returns(Returns::TEXT.note(", or a character of a character"))
        .see(&["to_upper", "make_lower"]),
        built_in(
            &["text.make_upper()", "character.make_upper()"],
            "Changes to capital letters in place.",
            "let word = \"beam\";\nword.make_upper();\ncheck(word == \"BEAM\");",
        )
        .see(&["to_upper"]),
        built_in(
            &["text.make_lower()", "character.make_lower()"],
            "Changes to small letters in place.",
            "let word = \"BEAM\";\nword.make_lower();\ncheck(word == \"beam\");",
        )
        .see(&["to_lower"]),
        built_in(
            &["text.trim()"],
            "Takes blanks from both ends, in place.",
            "let word = \"  beam \";\nword.trim();\ncheck(word == \"beam\");",
        ),
        built_in(
            &["text.replace(old, new)"],
            "Replaces every occurrence of a text or character, in place.",
            "let name = \"a b c\";\nname.replace(\" \", \"-\");\ncheck(name == \"a-b-c\");",
        ),
        built_in(
            &["text.remove(part)"],
            "Takes every occurrence of a text or character out, in place.",
            "let name = \"a-b-c\";\nname.remove(\"-\");\ncheck(name == \"abc\");",
        ),
        built_in(
            &["text.crop(start, [count])", "text.crop(range)"],
            "Keeps only a piece, in place.",
            "let word = \"spaghetti\";\nword.crop(0, 3);\ncheck(word == \"spa\");",
        )
        .see(&["sub_string"]),
        built_in(
            &["text.truncate(count)"],
            "Keeps only so many characters from the beginning, in place.",
            "let word = \"spaghetti\";\nword.truncate(3);\ncheck(word == \"spa\");",
        ),
        built_in(
            &["text.pad(count, with)"],
            "Makes the text so long by adding a text or character at its end, in place.",
            "let word = \"t\";\nword.pad(4, '.');\ncheck(word == \"t...\");",
        ),
        built_in(
            &["text.append(value)"],
            "Adds a value, as it prints, to the end, in place; text += value does the same.",
            "let name = \"beam\";\nname.append(1);\ncheck(name == \"beam1\");",
        ),
        built_in(
            &["text.pop([count])"],
            "Takes the last character, or so many, off the end and gives them.",
            "let word = \"beams\";\ncheck(word.pop() == 's');\ncheck(word.pop(2) == \"am\" && word == \"be\");",
        )
        .returns(Returns::CHARACTER.note(", or a text if a count is given")),
        built_in(
            &["text.clear()"],
            "Makes the text empty.",
            "let word = \"beam\";\nword.clear();\ncheck(word == \"\");",
        ),
    ],
};
