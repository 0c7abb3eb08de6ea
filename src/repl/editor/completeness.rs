//! Test for completeness of an input.

use crate::script::source::scanner::{Bracket, Token, TokenKind, scan};

/// Completeness of an input.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Completeness {
    /// The input can be evaluated, or has an error that further lines cannot correct.
    Complete,
    /// The input is incomplete. The number is the indentation level of the next line.
    Open(usize),
}

use Completeness::{Complete, Open};

const EMPTY_LINES: usize = 2;

/// Completeness of a text at a prompt. Commands, and inputs that end with two empty lines, are always complete.
pub fn completeness(text: &str) -> Completeness {
    let tail = &text[text.trim_end().len()..];
    let is_forced = tail.matches('\n').count() >= EMPTY_LINES;
    match is_forced || is_command(text) {
        true => Complete,
        false => completeness_of_script(text),
    }
}

/// Returns true if `text` is a command such as `:step`, or a help request such as `?slider`.
pub fn is_command(text: &str) -> bool {
    text.trim_start().starts_with([':', '?'])
}

/// Completeness of a text from a file or a pipe, in which empty lines have no effect.
///
/// A text that further lines cannot correct, such as one with a wrong closing bracket, counts as complete, so that its error is reported.
pub fn completeness_of_script(text: &str) -> Completeness {
    let tokens = scan(text);
    // A doc comment is incomplete, because a function must follow it.
    let last = tokens.iter().rev().find(|token| token.kind != TokenKind::Space);
    let last = last.filter(|token| token.kind == TokenKind::Comment).map(|token| token.of(text));
    if last.is_some_and(|comment| comment.starts_with("///") && !comment.starts_with("////")) {
        return Open(0);
    }
    let mut reader = InputReader::default();
    for token in &tokens {
        if let ParseOutcome::Final(complete) = reader.read(token, text) {
            return complete;
        }
    }
    reader.conclude()
}

/// Operators that make an input incomplete at its end, because an operand must follow.
const GO_ON: &[&str] = &[
    "+", "-", "*", "/", "%", "**", "^", "=", "+=", "-=", "*=", "/=", "%=", "**=", "^=", "&=", "|=",
    "<<=", ">>=", "==", "!=", "<", ">", "<=", ">=", "&&", "||", "&", "|", "<<", ">>", "??", "!",
    ",", ".", "?.", "..", "..=", ":", "::", "=>",
];

/// Keywords that something other than a block must follow.
const INTRODUCE: &[&str] = &["let", "const", "in", "import", "as", "private", "export"];

/// Keywords that a block must follow, possibly after a condition.
const HEADS: &[&str] =
    &["fn", "if", "else", "while", "until", "for", "loop", "switch", "do", "try", "catch"];

enum ParseOutcome {
    Incomplete,
    Final(Completeness),
}

#[derive(Default)]
struct BracketLevel<'t> {
    bracket: Option<Bracket>,
    line: usize,
    owner: Option<&'t str>,
    keyword: Option<&'t str>,
    closed: Option<&'t str>,
    /// True between the bars of a closure such as `|x, y| x + y`.
    is_between_bars: bool,
}

#[derive(Default)]
struct InputReader<'t> {
    outer: Vec<BracketLevel<'t>>,
    level: BracketLevel<'t>,
    line: usize,
    is_incomplete: bool,
    /// True if the last token ends a value. A bar after a value is an operator, not the start of a closure.
    is_value: bool,
    /// True within a string literal or comment, which must not be indented.
    is_literal: bool,
}

impl<'t> InputReader<'t> {
    fn read(&mut self, token: &Token, text: &'t str) -> ParseOutcome {
        let written = token.of(text);
        if token.is_significant() {
            (self.is_incomplete, self.is_literal) = (false, false);
        }
        let just_closed = match token.is_significant() {
            true => self.level.closed.take(),
            false => None,
        };
        match token.kind {
            TokenKind::OpenText => return self.read_open_text(written),
            TokenKind::OpenPiece | TokenKind::OpenComment => self.is_literal = true,
            TokenKind::Close(Bracket::Interpolation) => {
                self.close();
                self.is_literal = true;
            }
            TokenKind::Open(bracket) => self.open(bracket),
            TokenKind::Close(bracket) => {
                if !self.level.bracket.is_some_and(|open| open.is_closed_by(bracket)) {
                    return ParseOutcome::Final(Complete);
                }
                self.close();
            }
            TokenKind::Word => self.read_word(written, just_closed),
            TokenKind::Symbol => {
                if written == "|" {
                    self.level.is_between_bars = !self.level.is_between_bars && !self.is_value;
                }
                if written == ":" && self.level.bracket != Some(Bracket::Map) {
                    return ParseOutcome::Final(Complete);
                }
                self.is_incomplete = GO_ON.contains(&written);
                if matches!(written, ";" | "=>") {
                    self.level.keyword = None;
                }
            }
            TokenKind::Space
            | TokenKind::Comment
            | TokenKind::Text
            | TokenKind::Piece
            | TokenKind::Number => (),
        }
        if token.is_significant() {
            self.is_value = !matches!(token.kind, TokenKind::Symbol | TokenKind::Open(_))
                && !self.is_incomplete;
        }
        self.line += written.matches('\n').count();
        ParseOutcome::Incomplete
    }

    fn read_open_text(&mut self, written: &str) -> ParseOutcome {
        let backslashes = written.len() - written.trim_end_matches('\\').len();
        ParseOutcome::Final(if backslashes % 2 == 1 { Open(0) } else { Complete })
    }

    fn read_word(&mut self, word: &'t str, just_closed: Option<&str>) {
        let ends_do = just_closed == Some("do") && matches!(word, "while" | "until");
        if HEADS.contains(&word) && !ends_do {
            self.level.keyword = Some(word);
        }
        self.is_incomplete = ends_do || INTRODUCE.contains(&word);
    }

    fn open(&mut self, bracket: Bracket) {
        let owner = match bracket {
            Bracket::Curly => self.level.keyword.take(),
            _ => None,
        };
        let level = BracketLevel {
            bracket: Some(bracket),
            line: self.line,
            owner,
            ..BracketLevel::default()
        };
        self.outer.push(std::mem::replace(&mut self.level, level));
    }

    fn close(&mut self) {
        let outer = self.outer.pop().unwrap_or_default();
        let inner = std::mem::replace(&mut self.level, outer);
        self.level.closed = inner.owner;
    }

    fn conclude(&self) -> Completeness {
        if self.is_literal {
            return Open(0);
        }
        let lacks_partner = matches!(self.level.closed, Some("do" | "try"));
        let waits = self.is_incomplete
            || lacks_partner
            || self.level.is_between_bars
            || self.level.keyword.is_some();
        if self.level.bracket.is_none() {
            // The next line is indented after an incomplete expression, but not after `fn f()` or `try { }`.
            return if waits { Open(usize::from(self.is_incomplete)) } else { Complete };
        }
        // All brackets opened on one line together indent the next line by one level.
        let levels = self.outer.iter().skip(1).chain(std::iter::once(&self.level));
        let mut lines: Vec<usize> = levels.map(|level| level.line).collect();
        lines.dedup();
        Open(lines.len())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::script::dialect::reading::read;
    use crate::script::engine;
    use crate::script::packages::language;
    use crate::script::state::context::Context;
    use crate::script::state::settings::{RunMode, RunSettings};

    #[test]
    fn open_brackets_strings_and_comments_make_input_incomplete() {
        for open in [
            "f(",
            "[1, 2",
            "let m = #{ a: 1,",
            "fn f() {",
            "`abc",
            "`a ${",
            "`a ${b}",
            "`a ${b} c",
            "/* a /* b */",
            "let t = \"a \\",
            "#\"a\"",
            "f(g(1)",
            "`${ `",
            "x?[1",
        ] {
            assert_ne!(completeness(open), Complete, "{open}");
        }
        for complete in [
            "",
            "  ",
            "f(1)",
            "\"(\"",
            "'('",
            "`(`",
            "`${a}`",
            "// (",
            "/* ( */",
            "1 // +",
            "#\"(\"#",
            "let t = \"a \\\\",
        ] {
            assert_eq!(completeness(complete), Complete, "{complete}");
        }
    }

    #[test]
    fn trailing_operator_makes_input_incomplete() {
        for open in [
            "1 +",
            "let x =",
            "a,",
            "rod.",
            "|x|",
            "||",
            "|x, y",
            "0..",
            "!",
            "1 + // why",
            "a ??",
            "f(1) -\n",
        ] {
            assert_ne!(completeness(open), Complete, "{open}");
        }
        assert_eq!(completeness("x = 1;"), Complete);
        assert_eq!(completeness("return"), Complete);
    }

    #[test]
    fn keywords_without_their_block_make_input_incomplete() {
        for open in [
            "if a",
            "if a { } else",
            "else if b",
            "fn f(x)",
            "while x < 3",
            "for i in",
            "for i in 0..3",
            "let",
            "do { x } ",
            "do { x } while",
            "try { f() }",
            "loop",
            "switch x",
            "let y = if a",
        ] {
            assert_ne!(completeness(open), Complete, "{open}");
        }
        for complete in [
            "if a { 1 }",
            "if a { 1 } else { 2 }",
            "fn f(x) { x }",
            "do { x } while x < 3",
            "do { } until f(x)",
            "try { f() } catch { }",
            "try { f() } catch (e) { g(e) }",
            "switch x { 1 if y => 2, _ => 3 }",
            "let x",
            "let f = |x| if x { 1 } else { 2 };",
            "import \"a\" as b",
        ] {
            assert_eq!(completeness(complete), Complete, "{complete}");
        }
    }

    #[test]
    fn input_with_an_unrecoverable_error_is_complete() {
        for wrong in ["f(]", "}", "(}", "f(\"abc", "f(\"abc\n", "`${ ) "] {
            assert_eq!(completeness(wrong), Complete, "{wrong}");
        }
    }

    #[test]
    fn commands_and_two_empty_lines_are_complete() {
        assert_eq!(completeness(":plot ("), Complete);
        assert_eq!(completeness("  ?line("), Complete);
        assert_eq!(completeness("f(\n\n"), Complete);
        assert_eq!(completeness("f(\n    \n  "), Complete);
        assert_ne!(completeness("f(\n"), Complete);
        assert_ne!(completeness_of_script("f(\n\n\n"), Complete);
    }

    #[test]
    fn indentation_equals_the_number_of_open_brackets() {
        for (text, levels) in [
            ("fn f() {", 1),
            ("fn f() {\n    if a {", 2),
            ("scene.beam(#{", 1),
            ("f(\n    #{", 2),
            ("let x =", 1),
            ("`a {", 0),
            ("{ /* b", 0),
            ("fn f()", 0),
        ] {
            assert_eq!(completeness(text), Open(levels), "{text}");
        }
    }

    fn chunks(script: &str) -> Vec<String> {
        let mut chunks = vec![String::new()];
        for line in script.lines() {
            let Some(chunk) = chunks.last_mut() else { continue };
            chunk.push_str(line);
            match completeness_of_script(chunk) {
                Complete => chunks.push(String::new()),
                Open(_) => chunk.push('\n'),
            }
        }
        chunks
    }

    #[test]
    fn python_blocks_with_a_colon_are_complete_input() {
        for habit in ["def f(x):", "for i in range(3):", "if a == 1:", "let o = {a:"] {
            assert_eq!(completeness(habit), Complete, "{habit}");
        }
        assert_eq!(completeness("let o = #{ a:"), Open(1));
    }

    #[test]
    fn repository_scripts_can_be_entered_line_by_line() {
        let context = Context::new(RunSettings::silent(RunMode::DryRun));
        let engine = engine::build(&language(), &context).expect("an engine");
        let scripts = concat!(env!("CARGO_MANIFEST_DIR"), "/scripts");
        let mut count = 0;
        let files = std::fs::read_dir(scripts).expect("a folder").flatten();
        for file in files.filter(|file| file.path().is_file()) {
            let script = std::fs::read_to_string(file.path()).expect("a script");
            let chunks = chunks(&script);
            assert_eq!(chunks.last().map(String::as_str), Some(""), "{file:?} ends open");
            for chunk in chunks {
                let compiled = read(&engine, &rhai::Scope::new(), &chunk.as_str().into(), 0);
                compiled.unwrap_or_else(|error| panic!("{file:?}: {error} in\n{chunk}"));
                count += 1;
            }
        }
        assert!(count > 100, "{count} chunks");
    }
}
