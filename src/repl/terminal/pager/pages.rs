//! Built-in pager with movement in both directions and search.

use std::io::{self, Write};
use std::ops::Range;

use super::keyboard::{Keyboard, Pressed};
use crate::repl::pager::PagerOutcome;

const CLEAR: &str = "\r\x1b[K";
const KEYS: &str = "space: next page, b: back, /: search, q: exit";

enum PagerAction {
    Page,
    Line,
    PageBack,
    LineBack,
    Start,
    End,
    Search,
    SearchOn,
    Leave,
    Nothing,
}

pub fn rows(text: &str, columns: usize) -> usize {
    let width = |line: &str| crate::output::columns(&letters(line));
    text.lines().map(|line| width(line).div_ceil(columns).max(1)).sum()
}

fn letters(line: &str) -> String {
    let mut pieces = line.split("\x1b[");
    let first = pieces.next().unwrap_or_default().to_owned();
    pieces.fold(first, |text, piece| text + piece.split_once('m').map_or("", |(_, rest)| rest))
}

struct Pages<'t> {
    lines: Vec<&'t str>,
    height: usize,
    shown: Range<usize>,
    word: String,
}

impl Pages<'_> {
    fn scroll(&mut self, wish: &PagerAction) -> Range<usize> {
        let Range { start, end } = self.shown;
        match wish {
            PagerAction::Page => self.forward(end + self.height),
            PagerAction::Line => self.forward(end + 1),
            PagerAction::PageBack => self.from(start.saturating_sub(self.height)),
            PagerAction::LineBack => self.from(start.saturating_sub(1)),
            PagerAction::Start => self.from(0),
            PagerAction::End => self.from(self.lines.len().saturating_sub(self.height)),
            PagerAction::Search
            | PagerAction::SearchOn
            | PagerAction::Leave
            | PagerAction::Nothing => end..end,
        }
    }

    fn forward(&mut self, to: usize) -> Range<usize> {
        let new = self.shown.end..to.min(self.lines.len());
        self.shown = new.end.saturating_sub(self.height)..new.end;
        new
    }

    fn from(&mut self, start: usize) -> Range<usize> {
        self.shown = start..(start + self.height).min(self.lines.len());
        self.shown.clone()
    }

    fn search(&mut self) -> Option<Range<usize>> {
        let word = self.word.to_lowercase();
        let mut later = (self.shown.start + 1)..self.lines.len();
        let found = later.find(|at| letters(self.lines[*at]).to_lowercase().contains(&word))?;
        Some(self.from(found))
    }

    fn is_at_end(&self) -> bool {
        self.shown.end >= self.lines.len()
    }
}

pub fn show_pages(
    text: &str,
    lines: usize,
    keys: &mut dyn Keyboard,
    was_interrupted: &dyn Fn() -> bool,
    out: &mut dyn Write,
) -> io::Result<PagerOutcome> {
    let height = lines.saturating_sub(1).max(1);
    let mut pages =
        Pages { lines: text.lines().collect(), height, shown: 0..0, word: String::new() };
    let mut new = pages.forward(height);
    let mut note = KEYS.to_owned();
    loop {
        for line in &pages.lines[new] {
            writeln!(out, "{line}")?;
        }
        if pages.is_at_end() {
            return Ok(PagerOutcome::Shown);
        }
        let percent = 100 * pages.shown.end / pages.lines.len();
        write!(out, "-- {percent} % -- {note}")?;
        out.flush()?;
        let wish = key_action(keys, was_interrupted)?;
        let searched = match wish {
            Ok(PagerAction::Search) => read_action(&mut pages.word, keys, was_interrupted, out)?,
            _ => Some(()),
        };
        write!(out, "{CLEAR}")?;
        out.flush()?;
        note = KEYS.to_owned();
        new = match (wish, searched) {
            (Err(end), _) => return Ok(end),
            (Ok(PagerAction::Leave), _) => return Ok(PagerOutcome::Shown),
            (Ok(_), None) => return Ok(PagerOutcome::Interrupted),
            (Ok(PagerAction::Search | PagerAction::SearchOn), _) if !pages.word.is_empty() => {
                pages.search().unwrap_or_else(|| {
                    note = format!("'{}' was not found below", pages.word);
                    pages.shown.end..pages.shown.end
                })
            }
            (Ok(wish), _) => pages.scroll(&wish),
        };
    }
}

fn read_action(
    word: &mut String,
    keys: &mut dyn Keyboard,
    was_interrupted: &dyn Fn() -> bool,
    out: &mut dyn Write,
) -> io::Result<Option<()>> {
    let mut typed = Vec::new();
    loop {
        write!(out, "{CLEAR}/{}", String::from_utf8_lossy(&typed))?;
        out.flush()?;
        match keys.read(was_interrupted)? {
            Pressed::Byte(b'\r' | b'\n') => break,
            Pressed::Byte(8 | 127) => {
                let mut text = String::from_utf8_lossy(&typed).into_owned();
                text.pop();
                typed = text.into_bytes();
            }
            Pressed::Byte(27) => {
                word.clear();
                return Ok(Some(()));
            }
            Pressed::Byte(byte) => typed.push(byte),
            Pressed::Interrupt => return Ok(None),
            Pressed::End => break,
        }
    }
    if !typed.is_empty() {
        *word = String::from_utf8_lossy(&typed).into_owned();
    }
    Ok(Some(()))
}

fn key_action(
    keys: &mut dyn Keyboard,
    was_interrupted: &dyn Fn() -> bool,
) -> io::Result<Result<PagerAction, PagerOutcome>> {
    let wish = match keys.read(was_interrupted)? {
        Pressed::Interrupt => return Ok(Err(PagerOutcome::Interrupted)),
        Pressed::End => PagerAction::Leave,
        Pressed::Byte(b' ' | b'f' | 6) => PagerAction::Page,
        Pressed::Byte(b'\r' | b'\n' | b'j') => PagerAction::Line,
        Pressed::Byte(b'b' | 2) => PagerAction::PageBack,
        Pressed::Byte(b'k' | b'y') => PagerAction::LineBack,
        Pressed::Byte(b'g' | b'<') => PagerAction::Start,
        Pressed::Byte(b'G' | b'>') => PagerAction::End,
        Pressed::Byte(b'/') => PagerAction::Search,
        Pressed::Byte(b'n') => PagerAction::SearchOn,
        Pressed::Byte(b'q' | b'Q' | 4) => PagerAction::Leave,
        Pressed::Byte(27) => of_sequence(&keys.rest_of_sequence()?),
        Pressed::Byte(_) => PagerAction::Nothing,
    };
    Ok(Ok(wish))
}

fn of_sequence(rest: &[u8]) -> PagerAction {
    match rest {
        [] => PagerAction::Leave,
        b"[A" | b"OA" => PagerAction::LineBack,
        b"[B" | b"OB" => PagerAction::Line,
        b"[5~" => PagerAction::PageBack,
        b"[6~" => PagerAction::Page,
        b"[H" | b"OH" | b"[1~" => PagerAction::Start,
        b"[F" | b"OF" | b"[4~" => PagerAction::End,
        _ => PagerAction::Nothing,
    }
}

#[cfg(test)]
mod tests {
    use std::collections::VecDeque;

    use super::*;

    struct Decided(VecDeque<u8>);

    impl Keyboard for Decided {
        fn read(&mut self, _: &dyn Fn() -> bool) -> io::Result<Pressed> {
            Ok(match self.0.pop_front() {
                Some(b'^') => Pressed::Interrupt,
                Some(byte) => Pressed::Byte(byte),
                None => Pressed::End,
            })
        }

        fn rest_of_sequence(&mut self) -> io::Result<Vec<u8>> {
            Ok(self.0.drain(..2.min(self.0.len())).collect())
        }
    }

    fn walked(keys: &str) -> (String, PagerOutcome) {
        let text: Vec<String> = (0..10).map(|line| format!("\x1b[1mline\x1b[0m {line}")).collect();
        let mut out = Vec::new();
        let mut keys = Decided(keys.bytes().collect());
        let shown =
            show_pages(&text.join("\n"), 4, &mut keys, &|| false, &mut out).expect("a terminal");
        let written = String::from_utf8(out).expect("text");
        let lines = written.lines().filter_map(|line| line.rsplit_once("line\x1b[0m "));
        (lines.map(|(_, number)| number).collect(), shown)
    }

    #[test]
    fn pager_moves_forward_and_back_within_the_text() {
        assert_eq!(walked("q"), ("012".into(), PagerOutcome::Shown));
        assert_eq!(walked("   q"), ("0123456789".into(), PagerOutcome::Shown));
        assert_eq!(walked(" \rbq"), ("0123456123".into(), PagerOutcome::Shown));
        assert_eq!(walked("\x1b[B\x1b[Aq"), ("0123012".into(), PagerOutcome::Shown));
        assert_eq!(walked("G"), ("012789".into(), PagerOutcome::Shown));
        assert_eq!(walked(""), ("012".into(), PagerOutcome::Shown));
        assert_eq!(walked("xq"), ("012".into(), PagerOutcome::Shown));
    }

    #[test]
    fn pager_search_ignores_case_and_colour_codes() {
        assert_eq!(walked("/LINE 4\rq"), ("012456".into(), PagerOutcome::Shown));
        assert_eq!(walked("/line\rnnq"), ("012123234345".into(), PagerOutcome::Shown));
        assert_eq!(walked("/1m\rq"), ("012".into(), PagerOutcome::Shown), "colours are no letters");
        assert_eq!(walked("/5x\x7f\rq"), ("012567".into(), PagerOutcome::Shown));
    }

    #[test]
    fn interrupt_quits_the_pager() {
        assert_eq!(walked(" ^  "), ("012345".into(), PagerOutcome::Interrupted));
        assert_eq!(walked("/a^"), ("012".into(), PagerOutcome::Interrupted));
    }
}
