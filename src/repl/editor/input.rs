//! An input up to the cursor: its tokens, which brackets are open there, and whose they are.

use crate::script::source::scanner::{Bracket, Token, TokenKind, pair, scan};

/// Open brackets that are looked at: what stands further outside does not matter at the cursor.
const MOST_LEVELS: usize = 64;

/// What stands before the cursor of an input, as tokens.
pub struct Input<'t> {
    /// The text of the input up to the cursor.
    pub text: &'t str,
    /// The tokens of the text, spaces and comments left out.
    pub tokens: Vec<Token>,
    /// The token that ends at the cursor, also a space or a comment.
    pub last: Option<Token>,
    /// For each token the bracket that it opens or closes with.
    partners: Vec<Option<usize>>,
    /// Brackets that are open at the cursor, as numbers of tokens, the innermost last.
    open: Vec<usize>,
}

/// A bracket that is open at the cursor.
#[derive(Clone, Copy, Debug)]
pub struct OpenBracket<'t> {
    /// The kind of the bracket.
    pub bracket: Bracket,
    /// The index of the bracket's token.
    pub opener: usize,
    /// The number of commas that stand in the bracket so far.
    pub commas: usize,
    /// The key whose value is being written, where the bracket is that of a map.
    pub key: Option<&'t str>,
}

/// The name that a bracket calls.
#[derive(Clone, Copy, Debug)]
pub struct CalleeName<'t> {
    /// The name of the function that is called.
    pub name: &'t str,
    /// The index of the last token of the value whose method is called.
    pub receiver: Option<usize>,
    /// The module that the called function belongs to.
    pub module: Option<&'t str>,
}

impl<'t> Input<'t> {
    /// The input before `position` of `text`, as tokens.
    pub fn before(text: &'t str, position: usize) -> Self {
        let text = text.get(..position).unwrap_or(text);
        let all = scan(text);
        let last = all.last().copied();
        let tokens: Vec<Token> = all.into_iter().filter(Token::is_significant).collect();
        let (partners, open) = pair(&tokens);
        Self { text, tokens, last, partners, open }
    }

    /// The text of a token of the input, by the token's index.
    pub fn written(&self, index: usize) -> &'t str {
        self.tokens.get(index).map_or("", |token| token.of(self.text))
    }

    /// The kind of a token of the input, by the token's index; none where there is no token.
    pub fn kind(&self, index: usize) -> Option<TokenKind> {
        self.tokens.get(index).map(|token| token.kind)
    }

    /// The index of the bracket that closes or opens what a bracket, by its index, opens or closes.
    pub fn partner(&self, index: usize) -> Option<usize> {
        self.partners.get(index).copied().flatten()
    }

    /// Whether the token of an index is a dot.
    pub fn is_dot(&self, index: usize) -> bool {
        matches!(self.written(index), "." | "?.")
    }

    /// The name that is being written at the cursor, and where it begins in the input [bytes]; empty between names.
    pub fn name(&self) -> (usize, &'t str) {
        match self.last {
            Some(token) if token.kind == TokenKind::Word => (token.start, token.of(self.text)),
            _ => (self.text.len(), ""),
        }
    }

    /// How many tokens stand before the name at the cursor.
    pub fn count_before_name(&self) -> usize {
        self.tokens.len() - usize::from(!self.name().1.is_empty())
    }

    /// The brackets that are open at the cursor, the innermost last; of very many the innermost.
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
            // Brackets inside are passed over, unless they are open too.
            let opens = matches!(self.kind(index), Some(TokenKind::Open(_)));
            index = match self.partner(index) {
                Some(closer) if opens => closer + 1,
                None if opens => break,
                _ => index + 1,
            };
        }
        level
    }

    /// What is called by the bracket at token `opener`, if it opens the arguments of a call.
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

/// A key without its quotes.
fn unquoted(key: &str) -> &str {
    key.trim_matches('"')
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn open_brackets_know_their_calls_arguments_and_keys() {
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
