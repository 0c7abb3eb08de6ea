//! Replacement of control characters and invisible characters in texts from scripts and files.

use std::borrow::Cow;

const REPLACEMENT: char = '\u{fffd}';

/// Replaces control characters except line breaks and tabs, bidirectional characters, and characters of zero width, one by one.
pub fn printable(text: &str) -> Cow<'_, str> {
    let is_harmful = |(at, letter): (usize, char)| is_harmful(letter) && !is_line_break(text, at);
    if !text.char_indices().any(is_harmful) {
        return Cow::Borrowed(text);
    }
    let safe = |at: (usize, char)| if is_harmful(at) { REPLACEMENT } else { at.1 };
    Cow::Owned(text.char_indices().map(safe).collect())
}

pub fn printable_in_colours(text: &str) -> Cow<'_, str> {
    let mut pieces = text.split("\x1b[");
    let Some(first) = pieces.next().filter(|first| first.len() < text.len()) else {
        return printable(text);
    };
    let mut safe = printable(first).into_owned();
    for piece in pieces {
        let numbers = piece.find(|letter: char| !letter.is_ascii_digit() && letter != ';');
        let is_colour = numbers.is_some_and(|end| piece[end..].starts_with('m'));
        safe.push(if is_colour { '\x1b' } else { REPLACEMENT });
        safe.push('[');
        safe.push_str(&printable(piece));
    }
    Cow::Owned(safe)
}

pub fn printable_line(text: &str) -> String {
    printable(&text.replace(['\n', '\r', '\t'], " ")).into_owned()
}

fn is_harmful(letter: char) -> bool {
    match letter {
        '\n' | '\t' => false,
        '\u{ad}' | '\u{61c}' | '\u{180e}' | '\u{feff}' => true,
        '\u{200b}'..='\u{200f}' | '\u{2028}'..='\u{202e}' | '\u{2060}'..='\u{206f}' => true,
        '\u{fff9}'..='\u{fffb}' | '\u{e0000}'..='\u{e007f}' => true,
        letter => letter.is_control(),
    }
}

fn is_line_break(text: &str, at: usize) -> bool {
    text[at..].starts_with("\r\n")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn terminal_control_and_invisible_characters_are_replaced() {
        assert_eq!(printable("a\x1b]0;title\x07b"), "a\u{fffd}]0;title\u{fffd}b");
        assert_eq!(printable("good\rbad\u{9b}2J"), "good\u{fffd}bad\u{fffd}2J");
        assert_eq!(printable("x\u{202e}y\u{200b}z"), "x\u{fffd}y\u{fffd}z");
        assert_eq!(printable("a\x1b[31mb"), "a\u{fffd}[31mb");
        for text in ["Träger\t梁\n", "two\r\nlines", ""] {
            assert_eq!(printable(text), text);
        }
        assert_eq!(printable_line("a\nb\tc\x1b"), "a b c\u{fffd}");
    }

    #[test]
    fn colour_codes_are_kept_and_other_control_sequences_are_replaced() {
        let text = "\x1b[1;31merror\x1b[0m: \x1b[2J\x1b]0;t\x07\x1b[";
        let safe = "\x1b[1;31merror\x1b[0m: \u{fffd}[2J\u{fffd}]0;t\u{fffd}\u{fffd}[";
        assert_eq!(printable_in_colours(text), safe);
        assert_eq!(printable_in_colours("plain\r"), "plain\u{fffd}");
    }
}
