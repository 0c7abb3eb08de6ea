//! Capabilities and size of a terminal.

use crate::output::printable::printable_line;
use crate::output::width::cut;

/// Character set of pictures in a terminal.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Glyphs {
    /// Braille characters with eight dots, line-drawing characters, and typographic minus signs, for terminals with UTF-8.
    Braille,
    /// ASCII characters only.
    Ascii,
}

/// Use of colours in a terminal.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Colours {
    /// Plain text.
    None,
    /// ANSI escape sequences.
    Ansi,
}

/// Style of a picture in a terminal: characters, colours and largest size.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct TerminalStyle {
    /// Character set of the picture.
    pub glyphs: Glyphs,
    /// Use of colours.
    pub colours: Colours,
    /// Maximum number of characters per line.
    pub width: usize,
    /// Maximum number of lines.
    pub height: usize,
}

impl TerminalStyle {
    /// Style with another size [characters, lines].
    #[must_use]
    pub fn sized(self, width: usize, height: usize) -> Self {
        Self { width, height, ..self }
    }
}

impl Glyphs {
    pub(super) fn choose<T>(self, braille: T, ascii: T) -> T {
        match self {
            Self::Braille => braille,
            Self::Ascii => ascii,
        }
    }

    /// Converts a text to one line in the character set. For example, in ASCII `10⁻¹²` becomes `1e-12`.
    pub fn typeset(self, text: &str) -> String {
        let line = printable_line(text);
        match self {
            Self::Braille => line,
            Self::Ascii => in_ascii(&line),
        }
    }

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
    fn typographic_characters_are_replaced_in_ascii() {
        let typeset = |text| Glyphs::Ascii.typeset(text);
        assert_eq!(typeset("drift (×10⁻⁷)"), "drift (x1e-7)");
        assert_eq!(typeset("≤ 10⁻¹²"), "<= 1e-12");
        assert_eq!(typeset("mass·length²/time"), "mass*length^2/time");
        assert_eq!(typeset("−0.5 …\nMüll"), "-0.5 ... M?ll");
        assert_eq!(Glyphs::Braille.typeset("−0.5\t²"), "−0.5 ²");
    }

    #[test]
    fn long_text_is_cut_with_a_visible_mark() {
        assert_eq!(Glyphs::Braille.fit("energy", 6), "energy");
        assert_eq!(Glyphs::Braille.fit("energy", 5), "ener…");
        assert_eq!(Glyphs::Ascii.fit("energy", 5), "ener~");
        assert_eq!(Glyphs::Ascii.fit("energy", 0), "");
    }
}
