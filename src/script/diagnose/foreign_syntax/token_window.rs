//! Tokens around the position of a syntax error.

use rhai::{ParseErrorType, Position, Token};

use super::fix::SyntaxFix;
use crate::script::bindings::catalog::Catalog;
use crate::script::source::program::Program;

const WINDOW: usize = 40;

struct Word {
    text: String,
    token: Token,
    at: Position,
    is_joined: bool,
}

pub struct TokenWindow<'s> {
    pub catalog: &'s Catalog,
    pub error: &'s ParseErrorType,
    words: Vec<Word>,
    here: usize,
    first: usize,
    place: Position,
    gap: String,
}

impl<'s> TokenWindow<'s> {
    pub fn of(
        program: &Program,
        catalog: &'s Catalog,
        error: &'s ParseErrorType,
        place: Position,
    ) -> Self {
        let order = |at: Position| (at.line().unwrap_or(0), at.position().unwrap_or(0));
        let all = program.text.tokens();
        let found = match place.is_none() {
            true => all.len(),
            false => all.partition_point(|(_, at)| order(*at) < order(place)),
        };
        let start = found.saturating_sub(WINDOW);
        let near = &all[start..all.len().min(found + WINDOW)];
        let ends: Vec<usize> = near
            .iter()
            .map(|(_, at)| program.offset(order(*at).0, order(*at).1))
            .chain([program.text.len()])
            .collect();
        let mut words: Vec<Word> = Vec::new();
        for ((token, at), place) in near.iter().zip(ends.windows(2)) {
            let (from, to) = (place[0], place[1].max(place[0]));
            let text = written(token, &program.text[from..to]);
            let is_joined = !program.text[..from].ends_with(char::is_whitespace);
            words.push(Word { text, token: token.clone(), at: *at, is_joined });
        }
        let here = found - start;
        let gap = here.checked_sub(1).and_then(|last| program.text.get(ends[last]..ends[last + 1]));
        let gap = gap.unwrap_or_default().to_owned();
        let first = first_of_statement(&words, here);
        Self { catalog, error, words, here, first, place, gap }
    }

    /// Token at an offset from the token with the error; empty if there is none.
    pub fn word(&self, from_here: isize) -> &str {
        self.find(from_here).map_or("", |word| word.text.as_str())
    }

    pub fn in_statement(&self, index: usize) -> &str {
        self.words.get(self.first + index).map_or("", |word| word.text.as_str())
    }

    pub fn count(&self) -> usize {
        self.here - self.first
    }

    pub fn is_joined(&self, from_here: isize) -> bool {
        self.find(from_here).is_some_and(|word| word.is_joined)
    }

    pub fn is_name(&self, from_here: isize) -> bool {
        matches!(self.find(from_here).map(|word| &word.token), Some(Token::Identifier(_)))
    }

    pub fn is_number(&self, from_here: isize) -> bool {
        self.word(from_here).starts_with(|letter: char| letter.is_ascii_digit())
    }

    pub fn is_value(&self, from_here: isize) -> bool {
        self.is_name(from_here) || self.is_number(from_here) || self.is_text(from_here)
    }

    pub fn is_text(&self, from_here: isize) -> bool {
        self.word(from_here).starts_with(['"', '`', '\''])
    }

    /// Searches the statement, from its start to two tokens after the error, for the first token that is one of the words `sought`.
    /// Returns the offset of this token from the error, and the word.
    pub fn find_word(&self, sought: &[&str]) -> Option<(isize, &str)> {
        let last = (self.here + 3).min(self.words.len());
        let mut words = self.words.get(self.first..last)?.iter().enumerate();
        let (index, word) = words.find(|(_, word)| sought.contains(&word.text.as_str()))?;
        Some(((self.first + index) as isize - self.here as isize, word.text.as_str()))
    }

    pub fn piece(&self, from: isize, to: isize) -> String {
        let mut piece = String::new();
        for index in from..to {
            let blank = !piece.is_empty() && !self.is_joined(index);
            piece.push_str(if blank { " " } else { "" });
            piece.push_str(self.word(index));
        }
        piece
    }

    pub fn has_comment_before(&self) -> bool {
        self.gap.contains("//")
    }

    pub fn first(&self) -> isize {
        self.first as isize - self.here as isize
    }

    pub fn missing(&self) -> (&str, &str) {
        match self.error {
            ParseErrorType::MissingToken(token, why) => (token, why),
            _ => ("", ""),
        }
    }

    pub fn is_at_end(&self) -> bool {
        self.here >= self.words.len()
    }

    pub fn explain(
        &self,
        from_here: isize,
        message: impl Into<String>,
        hint: impl Into<String>,
    ) -> Option<SyntaxFix> {
        let at = self.find(from_here).map_or(self.place, |word| word.at);
        Some(SyntaxFix { message: message.into(), hint: hint.into(), at })
    }

    fn find(&self, from_here: isize) -> Option<&Word> {
        self.words.get(self.here.checked_add_signed(from_here)?)
    }
}

fn written(token: &Token, rest: &str) -> String {
    match token {
        Token::Identifier(name) => name.to_string(),
        Token::StringConstant(_) | Token::InterpolatedString(_) | Token::CharConstant(_) => {
            rest.trim_end().to_owned()
        }
        _ => {
            let end = rest.find(|letter: char| letter.is_whitespace()).unwrap_or(rest.len());
            let end = rest[..end].find("//").unwrap_or(end);
            rest[..end].to_owned()
        }
    }
}

fn first_of_statement(words: &[Word], here: usize) -> usize {
    let Some(last) = here.checked_sub(1) else { return here };
    let line = words[last].at.line();
    let opens = |word: &Word| {
        matches!(
            word.token,
            Token::SemiColon | Token::LeftBrace | Token::RightBrace | Token::MapStart
        )
    };
    let mut first = here;
    while first > 0 && words[first - 1].at.line() == line && !opens(&words[first - 1]) {
        first -= 1;
    }
    first
}
