//! Lines of styled text on the screen.

use std::borrow::Cow;
use std::fmt::Write;

use textwrap::{Options, WordSplitter};

use crate::output::{Colours, columns_of, printable_line};

pub type LineStyle = Cow<'static, str>;

pub const PLAIN: LineStyle = Cow::Borrowed("");
pub const STRONG: LineStyle = Cow::Borrowed("1");
pub const FAINT: LineStyle = Cow::Borrowed("2");
pub const GOOD: LineStyle = Cow::Borrowed("1;32");
pub const BAD: LineStyle = Cow::Borrowed("1;31");
pub const HEADING: LineStyle = Cow::Borrowed("1;36");
pub const WARNING: LineStyle = Cow::Borrowed("33");

/// Text segments with their styles, without control characters.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct ScreenLine(Vec<(String, LineStyle)>);

impl ScreenLine {
    pub fn of(text: &str, style: LineStyle) -> Self {
        Self::default().and(text, style)
    }

    #[must_use]
    pub fn and(mut self, text: &str, style: LineStyle) -> Self {
        self.0.push((clean(text), style));
        self
    }

    #[must_use]
    pub fn before(mut self, other: &Self) -> Self {
        self.0.extend(other.0.iter().cloned());
        self
    }

    pub fn text(&self) -> String {
        self.0.iter().map(|(text, _)| text.as_str()).collect()
    }

    pub fn width(&self) -> usize {
        self.0.iter().map(|(text, _)| crate::output::columns(text)).sum()
    }

    pub fn drawn(&self, colours: Colours) -> String {
        let mut drawn = String::new();
        for (text, style) in &self.0 {
            match colours {
                Colours::Ansi if !style.is_empty() => {
                    let _ = write!(drawn, "\x1b[{style}m{text}\x1b[0m");
                }
                _ => drawn.push_str(text),
            }
        }
        drawn
    }

    pub fn cut(self, columns: usize) -> Self {
        if self.width() <= columns {
            return self;
        }
        let characters = self.characters();
        let kept = fitting(&characters, columns.saturating_sub(1));
        Self::from_characters(&characters[..kept]).and("…", FAINT)
    }

    pub fn wrapped(self, columns: usize) -> Vec<Self> {
        let characters = self.characters();
        let margin = characters.iter().take_while(|(character, _)| !character.is_alphanumeric());
        let indent = margin.count() + 4;
        let indent = " ".repeat(if indent * 2 < columns { indent } else { 0 });
        let mut lines: Vec<Self> = Vec::new();
        let mut rest = characters.as_slice();
        while lines.is_empty() || !rest.is_empty() {
            let before = if lines.is_empty() { "" } else { &indent };
            let (line, behind) = rest.split_at(end_of_line(rest, columns - before.len()));
            lines.push(Self::of(before, PLAIN).before(&Self::from_characters(line)));
            rest = behind;
        }
        lines
    }

    fn characters(&self) -> Vec<(char, &LineStyle)> {
        let of_piece = |(text, style)| str::chars(text).map(move |character| (character, style));
        self.0.iter().map(|(text, style)| (text.as_str(), style)).flat_map(of_piece).collect()
    }

    fn from_characters(characters: &[(char, &LineStyle)]) -> Self {
        let runs = characters.chunk_by(|(_, a), (_, b)| a == b);
        let piece = |run: &[(char, &LineStyle)]| {
            (run.iter().map(|(character, _)| character).collect(), run[0].1.clone())
        };
        Self(runs.map(piece).collect())
    }
}

fn fitting(characters: &[(char, &LineStyle)], columns: usize) -> usize {
    let mut taken = 0;
    let is_beyond = |(character, _): &(char, &LineStyle)| {
        taken += columns_of(*character);
        taken > columns
    };
    characters.iter().position(is_beyond).unwrap_or(characters.len())
}

fn end_of_line(characters: &[(char, &LineStyle)], columns: usize) -> usize {
    let most = fitting(characters, columns);
    if most == characters.len() {
        return most;
    }
    let blank = characters[..most].iter().rposition(|(character, _)| *character == ' ');
    blank.filter(|at| *at * 2 > most).map_or(most, |at| at + 1).max(1)
}

fn push(lines: &mut [ScreenLine], piece: String, style: &LineStyle) {
    if let Some(ScreenLine(pieces)) = lines.last_mut().filter(|_| !piece.is_empty()) {
        pieces.push((piece, style.clone()));
    }
}

pub fn wrapped(text: &str, indent: &str, columns: usize) -> Vec<String> {
    let options = Options::new(columns.max(1))
        .subsequent_indent(if crate::output::columns(indent) * 2 < columns { indent } else { "" })
        .word_splitter(WordSplitter::NoHyphenation);
    let wrap = |line: &str| {
        let line = clean(line);
        textwrap::wrap(&line, &options).into_iter().map(Cow::into_owned).collect::<Vec<_>>()
    };
    text.lines().flat_map(wrap).collect()
}

pub fn paragraph(text: &str, indent: &str, columns: usize, style: &LineStyle) -> Vec<ScreenLine> {
    wrapped(text, indent, columns).iter().map(|line| ScreenLine::of(line, style.clone())).collect()
}

pub fn labelled(
    label: (&str, LineStyle),
    text: &str,
    indent: &str,
    columns: usize,
) -> Vec<ScreenLine> {
    let (word, style) = label;
    let whole = format!("{word} {text}");
    let mut lines = paragraph(&whole, indent, columns, &PLAIN);
    if let Some(first) = lines.first_mut()
        && let Some(rest) = first.text().strip_prefix(word)
    {
        *first = ScreenLine::of(word, style).and(rest, PLAIN);
    }
    lines
}

/// Converts text with ANSI colour codes to lines, without other escape sequences.
pub fn coloured(text: &str) -> Vec<ScreenLine> {
    let mut style = PLAIN;
    let mut lines = vec![ScreenLine::default()];
    let mut pieces = text.split("\x1b[");
    let mut write = |piece: &str, style: &LineStyle| {
        for (index, part) in piece.split('\n').enumerate() {
            if index > 0 {
                lines.push(ScreenLine::default());
            }
            push(&mut lines, clean(part), style);
        }
    };
    write(pieces.next().unwrap_or_default(), &style);
    for piece in pieces {
        let is_of_colour = |numbers: &str| numbers.chars().all(|c| c.is_ascii_digit() || c == ';');
        match piece.split_once('m').filter(|(numbers, _)| is_of_colour(numbers)) {
            Some((numbers, piece)) => {
                style = if numbers == "0" { PLAIN } else { Cow::Owned(numbers.to_owned()) };
                write(piece, &style);
            }
            None => write(piece, &style),
        }
    }
    lines
}

fn clean(text: &str) -> String {
    printable_line(&text.replace('\t', "    "))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn text_and_code_are_wrapped_between_words() {
        let text = "A strip of length 1 is clamped at its left end.";
        let lines = wrapped(text, "  ", 20);
        assert_eq!(lines, ["A strip of length 1", "  is clamped at its", "  left end."]);
        let code =
            ScreenLine::of("  let", HEADING).and(" a = f(123, 45678901234567890123456789);", PLAIN);
        let code: Vec<String> = code.wrapped(20).iter().map(ScreenLine::text).collect();
        let expected = ["  let a = f(123, ", "      45678901234567", "      890123456789);"];
        assert_eq!(code, expected);
        let empty = ScreenLine::default().wrapped(20);
        assert_eq!(empty.iter().map(ScreenLine::text).collect::<Vec<_>>(), [""]);
        assert_eq!(wrapped("", "", 20), Vec::<String>::new());
    }

    #[test]
    fn truncated_lines_end_with_an_ellipsis() {
        assert_eq!(ScreenLine::of("abcdef", PLAIN).cut(4).text(), "abc…");
        assert_eq!(ScreenLine::of("abcd", PLAIN).cut(4).text(), "abcd");
        assert_eq!(ScreenLine::of("日本語", PLAIN).cut(5).width(), 5);
    }

    #[test]
    fn colour_codes_are_kept_and_other_control_sequences_are_removed() {
        let lines = coloured("\x1b[35mlet\x1b[0m a\n\x1b[2J// \x07b");
        assert_eq!(lines[0].text(), "let a");
        assert_eq!(lines[0].drawn(Colours::Ansi), "\x1b[35mlet\x1b[0m a");
        assert_eq!(lines[0].drawn(Colours::None), "let a");
        assert_eq!(lines[1].text(), "2J// \u{fffd}b");
    }

    #[test]
    fn label_of_a_wrapped_text_has_its_own_style() {
        let lines = labelled(("Hint 1:", HEADING), "look twice at it", "  ", 16);
        assert_eq!(lines[0].drawn(Colours::Ansi), "\x1b[1;36mHint 1:\x1b[0m look");
        assert_eq!(lines[1].text(), "  twice at it");
    }
}
