//! What a terminal can show, and how much room there is.

use crate::output::printable::printable_line;
use crate::output::width::cut;

/// The characters that pictures in a terminal are made of.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Glyphs {
    /// Pictures have eight braille dots a character, lines of boxes, true minus signs: for terminals that know UTF-8.
    Braille,
    /// Pictures have letters and signs of ASCII only.
    Ascii,
}

/// Whether text in a terminal has colours.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Colours {
    /// Text is plain, the same everywhere.
    None,
    /// Text has the colours of ANSI sequences, for a terminal.
    Ansi,
}

/// How a picture in a terminal is set: no line of it is wider than `width`, and it has no more than `height` lines.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct TerminalStyle {
    /// The characters that the picture is made of.
    pub glyphs: Glyphs,
    /// Whether the picture has colours.
    pub colours: Colours,
    /// The largest number of characters in a line of the picture.
    pub width: usize,
    /// The largest number of lines of the picture.
    pub height: usize,
}

impl TerminalStyle {
    /// The same style in another size, in characters and lines.
    #[must_use]
    pub fn sized(self, width: usize, height: usize) -> Self {
        Self { width, height, ..self }
    }
}

impl Glyphs {
    /// Of two choices, the one that is meant for these glyphs.
    pub(super) fn choose<T>(self, braille: T, ascii: T) -> T {
        match self {
            Self::Braille => braille,
            Self::Ascii => ascii,
        }
    }

    /// The text in the characters that may be used, on one line: `10⁻¹²` becomes `1e-12` in ASCII.
    pub fn typeset(self, text: &str) -> String {
        let line = printable_line(text);
        match self {
            Self::Braille => line,
            Self::Ascii => in_ascii(&line),
        }
    }

    /// The text typeset, and cut where it is wider than `width` characters.
    pub(super) fn fit(self, text: &str, width: usize) -> String {
        cut(&self.typeset(text), width, self.choose('…', '~'))
    }
}

fn in_ascii(text: &str) -> String {
    let mut plain = String::with_capacity(text.len());
    let mut raised = String::new();
    for letter in text.chars().chain(['\0']) {
        if let Some(lowered) = lowered(letter) {
            raised.push(lowered);
            continue;
        }
        if !raised.is_empty() {
            let power = std::mem::take(&mut raised);
            match plain.strip_suffix("10") {
                Some(before) => plain = format!("{before}1e{power}"),
                None => plain.push_str(&format!("^{power}")),
            }
        }
        match letter {
            '\0' => (),
            '−' | '–' => plain.push('-'),
            '×' => plain.push('x'),
            '·' => plain.push('*'),
            '≤' => plain.push_str("<="),
            '≥' => plain.push_str(">="),
            '…' => plain.push_str("..."),
            letter => plain.push(if letter.is_ascii() { letter } else { '?' }),
        }
    }
    plain
}

/// The digit or sign that a raised one stands for.
fn lowered(raised: char) -> Option<char> {
    let digits = ['⁰', '¹', '²', '³', '⁴', '⁵', '⁶', '⁷', '⁸', '⁹'];
    let digit = digits.iter().position(|&other| other == raised);
    match raised {
        '⁻' => Some('-'),
        _ => digit.and_then(|digit| char::from_digit(digit as u32, 10)),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ascii_has_a_word_for_every_sign_of_a_chart() {
        let typeset = |text| Glyphs::Ascii.typeset(text);
        assert_eq!(typeset("drift (×10⁻⁷)"), "drift (x1e-7)");
        assert_eq!(typeset("≤ 10⁻¹²"), "<= 1e-12");
        assert_eq!(typeset("mass·length²/time"), "mass*length^2/time");
        assert_eq!(typeset("−0.5 …\nMüll"), "-0.5 ... M?ll");
        assert_eq!(Glyphs::Braille.typeset("−0.5\t²"), "−0.5 ²");
    }

    #[test]
    fn a_long_text_is_cut_where_it_is_seen() {
        assert_eq!(Glyphs::Braille.fit("energy", 6), "energy");
        assert_eq!(Glyphs::Braille.fit("energy", 5), "ener…");
        assert_eq!(Glyphs::Ascii.fit("energy", 5), "ener~");
        assert_eq!(Glyphs::Ascii.fit("energy", 0), "");
    }
}
