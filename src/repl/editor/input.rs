//! Tokens of an input before the cursor, and its open brackets.

use crate::script::source::scanner::{Bracket, Token, TokenKind, pair, scan};

const MOST_LEVELS: usize = 64;

pub struct Input<'t> {
    pub text: &'t str,
    pub tokens: Vec<Token>,
    /// Token that ends at the cursor. It may be white space or a comment.
    pub last: Option<Token>,
    partners: Vec<Option<usize>>,
    open: Vec<usize>,
}

#[derive(Clone, Copy, Debug)]
pub struct OpenBracket<'t> {
    pub bracket: Bracket,
    pub opener: usize,
    pub commas: usize,
    pub key: Option<&'t str>,
}

#[derive(Clone, Copy, Debug)]
pub struct CalleeName<'t> {
    pub name: &'t str,
    /// Index of the last token of the value before the dot of a method call.
    pub receiver: Option<usize>,
    pub module: Option<&'t str>,
}

impl<'t> Input<'t> {
    pub fn before(text: &'t str, position: usize) -> Self {
        let text = text.get(..position).unwrap_or(text);
        let all = scan(text);
        let last = all.last().copied();
        let tokens: Vec<Token> = all.into_iter().filter(Token::is_significant).collect();
        let (partners, open) = pair(&tokens);
        Self { text, tokens, last, partners, open }
    }

    pub fn written(&self, index: usize) -> &'t str {
        self.tokens.get(index).map_or("", |token| token.of(self.text))
    }

    pub fn kind(&self, index: usize) -> Option<TokenKind> {
        self.tokens.get(index).map(|token| token.kind)
    }

    pub fn partner(&self, index: usize) -> Option<usize> {
        self.partners.get(index).copied().flatten()
    }

    pub fn is_dot(&self, index: usize) -> bool {
        matches!(self.written(index), "." | "?.")
    }

    /// Start [bytes] and text of the name before the cursor; empty if there is none.
    pub fn name(&self) -> (usize, &'t str) {
        match self.last {
            Some(token) if token.kind == TokenKind::Word => (token.start, token.of(self.text)),
            _ => (self.text.len(), ""),
        }
    }

    pub fn count_before_name(&self) -> usize {
        self.tokens.len() - usize::from(!self.name().1.is_empty())
    }

    /// Brackets that are open at the cursor, from the outside to the inside. If there are more than `MOST_LEVELS`, only the innermost are returned.
    pub fn levels(&self) -> Vec<OpenBracket<'t>> {
        let first = self.open.len().saturating_sub(MOST_LEVELS);
        self.open[first..].iter().map(|opener| self.level(*opener)).collect()
    }

    fn level(&self, opener: usize) -> OpenBracket<'t> {
        let bracket = match self.kind(opener) {
            Some(TokenKind::Open(bracket)) => bracket,
            _ => Bracket::Curly,
        };
        let mut level = OpenBracket { bracket, opener, commas: 0, key: None };
        let mut index = opener + 1;
        while index < self.tokens.len() {
            match self.written(index) {
                "," => (level.commas, level.key) = (level.commas + 1, None),
                ":" if bracket == Bracket::Map => {
                    level.key = Some(unquoted(self.written(index - 1)))
                }
                _ => (),
            }
            let opens = matches!(self.kind(index), Some(TokenKind::Open(_)));
            index = match self.partner(index) {
                Some(closer) if opens => closer + 1,
                None if opens => break,
                _ => index + 1,
            };
        }
        level
    }

    /// Function with its argument list at the bracket token `opener`; `None` if the bracket does not belong to a call.
    pub fn callee(&self, opener: usize) -> Option<CalleeName<'t>> {
        let at = opener.checked_sub(1)?;
        let is_call = self.kind(opener) == Some(TokenKind::Open(Bracket::Round))
            && self.kind(at) == Some(TokenKind::Word)
            && !crate::script::source::keywords::is_keyword(self.written(at));
        if !is_call {
            return None;
        }
        let name = self.written(at);
        let before = at.checked_sub(2);
        let receiver = before.filter(|_| self.is_dot(at - 1));
        let module = before.filter(|_| self.written(at - 1) == "::").map(|at| self.written(at));
        Some(CalleeName { name, receiver, module })
    }
}

fn unquoted(key: &str) -> &str {
    key.trim_matches('"')
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn open_brackets_are_assigned_calls_arguments_and_keys() {
        let text = "f(g(1, 2), [3], scene.beam(#{ a: h(1), \"b\": [1, ";
        let input = Input::before(text, text.len());
        let levels = input.levels();
        let seen: Vec<_> =
            levels.iter().map(|level| (level.bracket, level.commas, level.key)).collect();
        assert_eq!(
            seen,
            [
                (Bracket::Round, 2, None),
                (Bracket::Round, 0, None),
                (Bracket::Map, 1, Some("b")),
                (Bracket::Square, 1, None),
            ]
        );
        assert_eq!(input.callee(levels[0].opener).map(|callee| callee.name), Some("f"));
        let beam = input.callee(levels[1].opener).expect("a call");
        assert_eq!((beam.name, beam.receiver.map(|at| input.written(at))), ("beam", Some("scene")));
        assert!(input.callee(levels[2].opener).is_none());
    }
}
