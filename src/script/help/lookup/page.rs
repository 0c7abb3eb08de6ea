//! Help pages, and their conversion to plain or coloured text.

use crate::output::{columns, columns_of};

/// Default page width [columns].
pub const WIDTH: usize = 80;

const NARROWEST: usize = 24;

#[derive(Clone, Debug, Default, PartialEq)]
pub struct HelpPage {
    pub parts: Vec<HelpSection>,
}

#[derive(Clone, Debug, PartialEq)]
pub enum HelpSection {
    Gap,
    /// Text that is wrapped, with the first line indented by `indent` and the others by `hang`.
    Words {
        indent: usize,
        hang: usize,
        spans: Vec<StyledText>,
    },
    /// Script. Long lines are broken where this does not change the meaning.
    Code(String),
}

#[derive(Clone, Debug, PartialEq)]
pub struct StyledText {
    pub style: HelpStyle,
    pub text: String,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum HelpStyle {
    Plain,
    Name,
    Remark,
}

impl StyledText {
    pub fn plain(text: impl Into<String>) -> Self {
        Self { style: HelpStyle::Plain, text: text.into() }
    }

    pub fn name(text: impl Into<String>) -> Self {
        Self { style: HelpStyle::Name, text: text.into() }
    }

    pub fn remark(text: impl Into<String>) -> Self {
        Self { style: HelpStyle::Remark, text: text.into() }
    }
}

impl HelpPage {
    pub fn gap(&mut self) {
        self.parts.push(HelpSection::Gap);
    }

    pub fn heading(&mut self, text: impl Into<String>) {
        self.words(0, vec![StyledText::name(text)]);
    }

    pub fn words(&mut self, indent: usize, spans: Vec<StyledText>) {
        self.parts.push(HelpSection::Words { indent, hang: indent + 4, spans });
    }

    pub fn paragraph(&mut self, text: &str) {
        // Backquotes, which mark code in Markdown, are removed in a terminal.
        let spans = vec![StyledText::plain(text.replace('`', ""))];
        self.parts.push(HelpSection::Words { indent: 0, hang: 0, spans });
    }

    pub fn code(&mut self, script: impl Into<String>) {
        self.parts.push(HelpSection::Code(script.into()));
    }

    /// Page as plain text. Lines have at most `width` columns if they can be broken.
    pub fn plain(&self, width: usize) -> String {
        self.draw(width, |_, word| word.to_owned())
    }

    /// Page as text with ANSI sequences. Lines have at most `width` columns if they can be broken.
    pub fn ansi(&self, width: usize) -> String {
        self.draw(width, |style, word| match style {
            HelpStyle::Plain => word.to_owned(),
            HelpStyle::Name => format!("\u{1b}[1m{word}\u{1b}[0m"),
            HelpStyle::Remark => format!("\u{1b}[2m{word}\u{1b}[0m"),
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
                    for line in
                        script.lines().flat_map(|line| wrapped_code(line, width - CODE_INDENT))
                    {
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

/// Breaks a line of a script at `width`, at blanks outside strings after a comma, semicolon, opening brace, && or ||.
/// A line with a comment is not broken.
pub(super) fn wrapped_code(line: &str, width: usize) -> Vec<String> {
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
    fn help_text_is_wrapped_without_counting_style_codes() {
        let mut page = HelpPage::default();
        page.words(
            2,
            vec![
                StyledText::name("dt"),
                StyledText::plain(": a positive number "),
                StyledText::remark("[time]"),
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
    fn code_is_wrapped_only_between_tokens() {
        let line = "let s = section(#{ EA: 1, GA: 2, name: \"a, b, c, d\" });";
        assert_eq!(wrapped_code(line, 80), [line]);
        let pieces = wrapped_code(line, 35);
        assert_eq!(pieces, ["let s = section(#{ EA: 1, GA: 2,", "    name: \"a, b, c, d\" });"]);
        assert_eq!(wrapped_code("let a = 1; // a remark, and more", 10).len(), 1);
    }
}
