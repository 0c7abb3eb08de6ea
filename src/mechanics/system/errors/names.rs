//! Rules for names of objects, which appear in messages and column heads and are typed by users.

use std::ops::RangeInclusive;

use unicode_normalization::is_nfc;

use super::SystemError;

const LONGEST: usize = 100;

/// Initial characters with which spreadsheets recognise formulas. A name must not begin with such a character.
const FORMULA: [char; 4] = ['=', '+', '-', '@'];

/// Characters that are invisible or look like ordinary letters (Unicode 16).
const INVISIBLE_OR_COPIES: [RangeInclusive<u32>; 14] = [
    0xAD..=0xAD,
    0x34F..=0x34F,
    0x61C..=0x61C,
    0x115F..=0x1160,
    0x17B4..=0x17B5,
    0x180B..=0x180F,
    0x200B..=0x200F,
    0x202A..=0x202E,
    0x2060..=0x206F,
    0x3164..=0x3164,
    0xFE00..=0xFE0F,
    0xFEFF..=0xFFFF,
    0x1D400..=0x1D7FF,
    0xE0000..=0x10_FFFF,
];

#[derive(Clone, Copy, PartialEq)]
enum Alphabet {
    Latin,
    Greek,
    Cyrillic,
    Armenian,
    Cherokee,
}

/// Returns the reason for rejecting a name; `None` if the name is accepted.
pub fn refusal(name: &str) -> Option<&'static str> {
    let code = |letter: char| u32::from(letter);
    let is_hidden = |letter: char| {
        letter.is_control()
            || (letter.is_whitespace() && letter != ' ')
            || INVISIBLE_OR_COPIES.iter().any(|range| range.contains(&code(letter)))
    };
    if name.trim().is_empty() {
        return Some("it is empty");
    }
    if name.trim() != name {
        return Some("it begins or ends with a blank");
    }
    if name.chars().count() > LONGEST {
        return Some("it has more than 100 characters");
    }
    if name.starts_with(FORMULA) {
        return Some(
            "it begins with a character by which spreadsheets recognise a formula (=, +, -, @)",
        );
    }
    if name.chars().any(is_hidden) {
        return Some("it has invisible or ambiguous characters");
    }
    if !is_nfc(name) {
        return Some(
            "a letter of it is written in parts that look like one character; write that character",
        );
    }
    let mut words = name.split(|letter: char| !letter.is_alphabetic());
    words
        .any(mixes_scripts)
        .then_some("one of its words mixes letters of two alphabets that look alike")
}

/// Checks the name of a scene, of one of its objects, or of a simulation.
///
/// # Errors
/// Fails if the name is empty or too long, begins or ends with a blank, begins like a formula, or has invisible or ambiguous characters.
pub fn check_name(kind: &'static str, name: &str) -> Result<(), SystemError> {
    match refusal(name) {
        Some(why) => Err(SystemError::Unnamed { kind, name: name.to_owned(), reason: why }),
        None => Ok(()),
    }
}

fn mixes_scripts(word: &str) -> bool {
    let mut alphabets = word.chars().filter_map(alphabet);
    let first = alphabets.next();
    alphabets.any(|other| Some(other) != first)
}

fn alphabet(letter: char) -> Option<Alphabet> {
    const SYMBOLS: &str = "αβγδεζηθλμξπρστφχψωΓΔΘΛΞΠΣΦΨΩ";
    match u32::from(letter) {
        _ if SYMBOLS.contains(letter) => None,
        0x41..=0x24F | 0x1E00..=0x1EFF => Some(Alphabet::Latin),
        0x370..=0x3FF | 0x1F00..=0x1FFF => Some(Alphabet::Greek),
        0x400..=0x52F => Some(Alphabet::Cyrillic),
        0x530..=0x58F => Some(Alphabet::Armenian),
        0x13A0..=0x13FF | 0xAB70..=0xABBF => Some(Alphabet::Cherokee),
        _ => None,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn letters_of_all_languages_are_accepted_in_names() {
        for name in [
            "mast",
            "beam 1",
            "Träger",
            "балка",
            "梁",
            "Δx",
            "EI_ξ",
            "a-b",
            "joint (left)",
            "caf\u{e9}",
            "q\u{307}",
        ] {
            assert_eq!(refusal(name), None, "{name}");
        }
    }

    #[test]
    fn misleading_names_are_rejected() {
        let long = "a".repeat(LONGEST + 1);
        for name in [
            "",
            "  ",
            "=1+1",
            "@a",
            "-b",
            "a\nb",
            "be\u{200B}am",
            "m\u{430}st",
            "ｂｅａｍ",
            "a\u{A0}b",
            "mast ",
            " mast",
            "cafe\u{301}",
            "\u{2126}",
            &long,
        ] {
            assert!(refusal(name).is_some(), "{name:?}");
        }
    }
}
