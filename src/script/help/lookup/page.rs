//! A page of help as data, and its two drawings: plain, and with the colours of a terminal.

use crate::output::{columns, columns_of};

/// The number of columns of a page when nothing is known of the terminal.
pub const WIDTH: usize = 80;

/// No page is drawn narrower, so that there is always room for a word.
const NARROWEST: usize = 24;

/// A page of help.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct HelpPage {
    /// The parts of the page, from top to bottom.
    pub parts: Vec<HelpSection>,
}

/// A part of a page of help.
#[derive(Clone, Debug, PartialEq)]
pub enum HelpSection {
    /// The part is an empty line.
    Gap,
    /// The part is words that are wrapped: the first line begins at `indent`, the others at `hang`.
    Words {
        /// The number of blanks before the first line.
        indent: usize,
        /// The number of blanks before further lines.
        hang: usize,
        /// The words of the part, in their styles.
        spans: Vec<StyledText>,
    },
    /// The part is a script; lines that are too long are broken where it does no harm.
    Code(String),
}

/// Words of one style on a page of help.
#[derive(Clone, Debug, PartialEq)]
pub struct StyledText {
    /// The style of the words.
    pub style: HelpStyle,
    /// The text of the words.
    pub text: String,
}

/// How words on a page of help are drawn.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum HelpStyle {
    /// Words are drawn as any other.
    Plain,
    /// Words are drawn as a heading, or a name: bold.
    Name,
    /// Words are drawn as a dimension or a remark: dim.
    Aside,
}

impl StyledText {
    /// Words that are drawn as any other.
    pub fn plain(text: impl Into<String>) -> Self {
        Self { style: HelpStyle::Plain, text: text.into() }
    }

    /// Words that are drawn as a heading or a name.
    pub fn name(text: impl Into<String>) -> Self {
        Self { style: HelpStyle::Name, text: text.into() }
    }

    /// Words that are drawn as a dimension or a remark.
    pub fn aside(text: impl Into<String>) -> Self {
        Self { style: HelpStyle::Aside, text: text.into() }
    }
}

impl HelpPage {
    /// Adds an empty line to the page.
    pub fn gap(&mut self) {
        self.parts.push(HelpSection::Gap);
    }

    /// Adds a line that stands out to the page.
    pub fn heading(&mut self, text: impl Into<String>) {
        self.words(0, vec![StyledText::name(text)]);
    }

    /// Adds words that begin at a column to the page; further lines begin a little to the right.
    pub fn words(&mut self, indent: usize, spans: Vec<StyledText>) {
        self.parts.push(HelpSection::Words { indent, hang: indent + 4, spans });
    }

    /// Adds a paragraph to the page.
    pub fn paragraph(&mut self, text: &str) {
        // Backquotes mark code in Markdown; on a terminal the words stand for themselves.
        let spans = vec![StyledText::plain(text.replace('`', ""))];
        self.parts.push(HelpSection::Words { indent: 0, hang: 0, spans });
    }

    /// Adds a script to the page.
    pub fn code(&mut self, script: impl Into<String>) {
        self.parts.push(HelpSection::Code(script.into()));
    }

    /// The page as text without any colours, no line of which is wider than `width`, but for what cannot be broken.
    pub fn plain(&self, width: usize) -> String {
        self.draw(width, |_, word| word.to_owned())
    }

    /// The page as text with bold names and dim dimensions, for a terminal that understands ANSI codes, no line of which is wider than `width`.
    pub fn ansi(&self, width: usize) -> String {
        self.draw(width, |style, word| match style {
            HelpStyle::Plain => word.to_owned(),
            HelpStyle::Name => format!("\u{1b}[1m{word}\u{1b}[0m"),
            HelpStyle::Aside => format!("\u{1b}[2m{word}\u{1b}[0m"),
        })
    }

    fn draw(&self, width: usize, paint: impl Fn(HelpStyle, &str) -> String) -> String {
        let width = width.max(NARROWEST);
        let mut text = String::new();
        for part in &self.parts {
            match part {
                HelpSection::Gap => text.push('\n'),
                HelpSection::Words { indent, hang, spans } => {
                    wrap(&mut text, width, (*indent, *hang), spans, &paint);
                }
                HelpSection::Code(script) => {
                    for line in script.lines().flat_map(|line| broken(line, width - CODE_INDENT)) {
                        text += &format!("{:CODE_INDENT$}{line}\n", "");
                    }
                }
            }
        }
        text
    }
}

const CODE_INDENT: usize = 4;

fn wrap(
    text: &mut String,
    width: usize,
    (indent, hang): (usize, usize),
    spans: &[StyledText],
    paint: &impl Fn(HelpStyle, &str) -> String,
) {
    let mut column = indent;
    *text += &" ".repeat(indent);
    for (number, word) in words(spans).into_iter().enumerate() {
        let length: usize = word.iter().map(|span| columns(&span.text)).sum();
        if number > 0 && column + 1 + length > width {
            *text += &format!("\n{}", " ".repeat(hang));
            column = hang;
        } else if number > 0 {
            text.push(' ');
            column += 1;
        }
        word.iter().for_each(|span| *text += &paint(span.style, &span.text));
        column += length;
    }
    text.push('\n');
}

/// The words of `spans`, each in its pieces: spans follow each other without a blank unless they hold one.
fn words(spans: &[StyledText]) -> Vec<Vec<StyledText>> {
    let mut words = vec![Vec::new()];
    for span in spans {
        for (number, piece) in span.text.split(' ').enumerate() {
            if number > 0 {
                words.push(Vec::new());
            }
            if let Some(word) = words.last_mut()
                && !piece.is_empty()
            {
                word.push(StyledText { style: span.style, text: piece.to_owned() });
            }
        }
    }
    words.retain(|word| !word.is_empty());
    words
}

/// A line of a script in pieces of at most `width`: broken after a comma, semicolon, brace, && or || that is followed by
/// a blank outside of texts, where a new line means nothing. A line with a comment is left as it is.
pub(super) fn broken(line: &str, width: usize) -> Vec<String> {
    let mut pieces = Vec::new();
    let mut rest = line.to_owned();
    while columns(&rest) > width && !line.contains("//") {
        let Some(at) = last_break(&rest, width) else { break };
        let tail = format!("    {}", rest[at..].trim_start());
        pieces.push(rest[..at].trim_end().to_owned());
        rest = tail;
    }
    pieces.push(rest);
    pieces
}

/// The byte after which to break, at most `width` characters from the beginning.
fn last_break(line: &str, width: usize) -> Option<usize> {
    let mut quote = None;
    let mut previous = ' ';
    let mut found = None;
    let mut count = 0;
    for (at, letter) in line.char_indices() {
        if count > width {
            break;
        }
        count += columns_of(letter);
        match (quote, letter) {
            (None, '"' | '`') => quote = Some(letter),
            (Some(open), _) if open == letter && previous != '\\' => quote = None,
            (None, ' ') if ",;{&|".contains(previous) && !line[..at].trim().is_empty() => {
                found = Some(at);
            }
            _ => (),
        }
        previous = letter;
    }
    found
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn words_are_wrapped_and_styles_take_no_room() {
        let mut page = HelpPage::default();
        page.words(
            2,
            vec![
                StyledText::name("dt"),
                StyledText::plain(": a positive number "),
                StyledText::aside("[time]"),
            ],
        );
        assert_eq!(page.plain(80), "  dt: a positive number [time]\n");
        assert_eq!(page.plain(24), "  dt: a positive number\n      [time]\n");
        assert_eq!(
            page.ansi(80),
            "  \u{1b}[1mdt\u{1b}[0m: a positive number \u{1b}[2m[time]\u{1b}[0m\n"
        );
    }

    #[test]
    fn scripts_are_broken_where_it_means_nothing() {
        let line = "let s = section(#{ EA: 1, GA: 2, name: \"a, b, c, d\" });";
        assert_eq!(broken(line, 80), [line]);
        let pieces = broken(line, 35);
        assert_eq!(pieces, ["let s = section(#{ EA: 1, GA: 2,", "    name: \"a, b, c, d\" });"]);
        assert_eq!(broken("let a = 1; // a remark, and more", 10).len(), 1);
    }
}
