//! Tokenisation of input that may be incomplete or incorrect. Every character belongs to exactly one token.
//!
//! The editor cannot use the lexer of the engine, which stops at the first error and drops comments and spaces.

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Token {
    pub kind: TokenKind,
    /// Start in the input [bytes].
    pub start: usize,
    /// End in the input [bytes].
    pub end: usize,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum TokenKind {
    Space,
    /// Line comment, or closed block comment.
    Comment,
    OpenComment,
    /// String or character literal, or raw string.
    Text,
    /// String literal in quotes that is not closed on its line.
    OpenText,
    /// String in backticks, or its piece before, between or after interpolations.
    Piece,
    /// Unclosed string in backticks, or unclosed raw string.
    OpenPiece,
    Word,
    Number,
    Open(Bracket),
    Close(Bracket),
    Symbol,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Bracket {
    Round,
    /// The brackets `[` or `?[` of arrays and indices.
    Square,
    Curly,
    Map,
    Interpolation,
}

impl Bracket {
    /// Returns true if the bracket `closer` closes this bracket. The bracket `}` also closes maps.
    pub fn is_closed_by(self, closer: Self) -> bool {
        match self {
            Self::Map => closer == Self::Curly,
            _ => self == closer,
        }
    }
}

impl Token {
    pub fn of<'t>(&self, text: &'t str) -> &'t str {
        text.get(self.start..self.end).unwrap_or_default()
    }

    pub fn is_significant(&self) -> bool {
        !matches!(self.kind, TokenKind::Space | TokenKind::Comment | TokenKind::OpenComment)
    }
}

const SIGNS: &[&str] = &[
    "..=", "...", "**=", "<<=", ">>=", "::", "?.", "??", "..", "=>", "==", "!=", "<=", ">=", "&&",
    "||", "+=", "-=", "*=", "/=", "%=", "^=", "&=", "|=", "**", "<<", ">>",
];

/// Tokens of `text` in their order, without gaps between them.
pub fn scan(text: &str) -> Vec<Token> {
    let mut scanner = Scanner { text, at: 0, open: Vec::new(), is_within_text: false };
    let mut tokens = Vec::new();
    while scanner.at < text.len() {
        let start = scanner.at;
        let kind = scanner.next();
        tokens.push(Token { kind, start, end: scanner.at });
    }
    tokens
}

/// Token index of the matching bracket for each bracket token, and the token indices of unclosed brackets.
pub fn pair(tokens: &[Token]) -> (Vec<Option<usize>>, Vec<usize>) {
    let mut partners = vec![None; tokens.len()];
    let mut open: Vec<(usize, Bracket)> = Vec::new();
    for (index, token) in tokens.iter().enumerate() {
        match token.kind {
            TokenKind::Open(bracket) => open.push((index, bracket)),
            TokenKind::Close(bracket) => {
                if open.last().is_some_and(|(_, opened)| opened.is_closed_by(bracket))
                    && let Some((opener, _)) = open.pop()
                {
                    (partners[index], partners[opener]) = (Some(opener), Some(index));
                }
            }
            _ => (),
        }
    }
    (partners, open.into_iter().map(|(index, _)| index).collect())
}

struct Scanner<'t> {
    text: &'t str,
    at: usize,
    open: Vec<Bracket>,
    is_within_text: bool,
}

impl Scanner<'_> {
    fn rest(&self) -> &str {
        &self.text[self.at..]
    }

    fn skip(&mut self, belongs: impl Fn(char) -> bool) {
        let rest = self.rest();
        self.at += rest.find(|letter| !belongs(letter)).unwrap_or(rest.len());
    }

    fn next(&mut self) -> TokenKind {
        let rest = self.rest();
        let first = rest.chars().next().unwrap_or(' ');
        match first {
            _ if self.is_within_text => self.piece(0),
            _ if first.is_whitespace() => {
                self.skip(char::is_whitespace);
                TokenKind::Space
            }
            _ if rest.starts_with("//") => {
                self.skip(|letter| letter != '\n');
                TokenKind::Comment
            }
            _ if rest.starts_with("/*") => self.block_comment(),
            '"' | '\'' => self.quoted(first),
            '`' => self.piece(1),
            '#' if begins_marked(rest) => self.marked(),
            '#' if rest.starts_with("#{") => self.opened(Bracket::Map),
            '?' if rest.starts_with("?[") => self.opened(Bracket::Square),
            '(' => self.opened(Bracket::Round),
            '[' => self.opened(Bracket::Square),
            '{' => self.opened(Bracket::Curly),
            ')' => self.closed(Bracket::Round),
            ']' => self.closed(Bracket::Square),
            '}' => self.closed(Bracket::Curly),
            '0'..='9' => self.number(),
            _ if is_name(first) => {
                self.skip(is_name);
                TokenKind::Word
            }
            _ => {
                let sign = SIGNS.iter().find(|sign| rest.starts_with(**sign));
                self.at += sign.map_or(first.len_utf8(), |sign| sign.len());
                TokenKind::Symbol
            }
        }
    }

    fn opened(&mut self, bracket: Bracket) -> TokenKind {
        let is_wide = matches!(self.rest().as_bytes(), [b'#' | b'?' | b'$', ..]);
        self.at += if is_wide { 2 } else { 1 };
        self.open.push(bracket);
        TokenKind::Open(bracket)
    }

    fn closed(&mut self, bracket: Bracket) -> TokenKind {
        self.at += 1;
        let opened = self.open.last().copied();
        if bracket == Bracket::Curly && opened == Some(Bracket::Interpolation) {
            self.open.pop();
            self.is_within_text = true;
            return TokenKind::Close(Bracket::Interpolation);
        }
        if opened.is_some_and(|open| open.is_closed_by(bracket)) {
            self.open.pop();
        }
        TokenKind::Close(bracket)
    }

    fn piece(&mut self, known: usize) -> TokenKind {
        let rest = &self.rest()[known..];
        let (end, interpolation) = (rest.find('`'), rest.find("${"));
        self.is_within_text = false;
        match (end, interpolation) {
            (_, Some(0)) if known == 0 => self.opened(Bracket::Interpolation),
            (Some(end), interpolation) if interpolation.is_none_or(|other| end < other) => {
                self.at += known + end + 1;
                TokenKind::Piece
            }
            (_, Some(interpolation)) => {
                self.at += known + interpolation;
                self.is_within_text = true;
                TokenKind::Piece
            }
            _ => {
                self.at = self.text.len();
                TokenKind::OpenPiece
            }
        }
    }

    fn quoted(&mut self, quote: char) -> TokenKind {
        let mut is_escaped = false;
        for (at, letter) in self.rest().char_indices().skip(1) {
            match letter {
                _ if is_escaped => is_escaped = false,
                '\\' => is_escaped = true,
                '\n' => {
                    self.at += at;
                    return TokenKind::OpenText;
                }
                _ if letter == quote => {
                    self.at += at + 1;
                    return TokenKind::Text;
                }
                _ => (),
            }
        }
        self.at = self.text.len();
        TokenKind::OpenText
    }

    fn marked(&mut self) -> TokenKind {
        let rest = self.rest();
        let marks = rest.len() - rest.trim_start_matches('#').len();
        let closing = format!("\"{}", "#".repeat(marks));
        match rest[marks + 1..].find(&closing) {
            Some(end) => {
                self.at += marks + 1 + end + closing.len();
                TokenKind::Text
            }
            None => {
                self.at = self.text.len();
                TokenKind::OpenPiece
            }
        }
    }

    fn block_comment(&mut self) -> TokenKind {
        let mut depth = 0_usize;
        let bytes = self.text.as_bytes();
        while self.at < bytes.len() {
            match &bytes[self.at..] {
                [b'/', b'*', ..] => {
                    depth += 1;
                    self.at += 2;
                }
                [b'*', b'/', ..] => {
                    depth -= 1;
                    self.at += 2;
                    if depth == 0 {
                        return TokenKind::Comment;
                    }
                }
                _ => self.at += 1,
            }
        }
        TokenKind::OpenComment
    }

    /// Reads a number. The dots in `0..3` and `1.abs()` do not belong to the number.
    fn number(&mut self) -> TokenKind {
        let is_decimal = !self.rest().starts_with("0x");
        self.skip(is_name);
        if is_decimal && let Some(fraction) = self.rest().strip_prefix('.') {
            match fraction.chars().next() {
                Some('.') => return TokenKind::Number,
                Some(letter) if is_name(letter) && !letter.is_ascii_digit() => {
                    return TokenKind::Number;
                }
                _ => self.at += 1,
            }
            self.skip(is_name);
        }
        let is_exponent = is_decimal && self.text[..self.at].ends_with(['e', 'E']);
        if is_exponent && matches!(self.rest().as_bytes(), [b'+' | b'-', b'0'..=b'9', ..]) {
            self.at += 1;
            self.skip(is_name);
        }
        TokenKind::Number
    }
}

const MOST_MARKS: usize = 16;

fn begins_marked(rest: &str) -> bool {
    rest.bytes().take(MOST_MARKS + 1).find(|byte| *byte != b'#') == Some(b'"')
}

pub fn is_name(letter: char) -> bool {
    letter.is_alphanumeric() || letter == '_'
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn written(text: &str) -> Vec<&str> {
        let significant = scan(text).into_iter().filter(Token::is_significant);
        significant.map(|token| token.of(text)).collect()
    }

    #[test]
    fn numbers_end_before_ranges_and_methods() {
        assert_eq!(
            written("0..3 1.5e-3+2. 1.abs() 0xe+1"),
            ["0", "..", "3", "1.5e-3", "+", "2.", "1", ".", "abs", "(", ")", "0xe", "+", "1"]
        );
    }

    #[test]
    fn string_and_comment_contents_are_not_tokens() {
        assert_eq!(written(r#"f("a\"(", '{') // ("#), ["f", "(", r#""a\"(""#, ",", "'{'", ")"]);
        assert_eq!(written("##\"a\"# \"## b"), ["##\"a\"# \"##", "b"]);
        assert_eq!(written("/* ( /* */ ( */ c"), ["c"]);
    }

    #[test]
    fn string_continues_after_an_interpolation() {
        let text = "`x ${ #{b: `}`}.b }${d} y` + e";
        let pieces = written(text);
        assert_eq!(
            pieces,
            [
                "`x ", "${", "#{", "b", ":", "`}`", "}", ".", "b", "}", "${", "d", "}", " y`", "+",
                "e"
            ]
        );
    }

    #[test]
    fn unfinished_tokens_have_their_own_kinds() {
        let last = |text: &str| scan(text).last().map(|token| token.kind);
        assert_eq!(last("\"abc"), Some(TokenKind::OpenText));
        assert_eq!(last("`abc"), Some(TokenKind::OpenPiece));
        assert_eq!(last("`"), Some(TokenKind::OpenPiece));
        assert_eq!(last("`${a} b"), Some(TokenKind::OpenPiece));
        assert_eq!(last("/* /* */"), Some(TokenKind::OpenComment));
        assert_eq!(last("`${a}"), Some(TokenKind::Close(Bracket::Interpolation)));
    }

    proptest! {
        #[test]
        fn every_character_belongs_to_one_token(text in "[ -~\n\"`'{}()#$/*äξ\\\\.]{0,60}") {
            let tokens = scan(&text);
            let together: String = tokens.iter().map(|token| token.of(&text)).collect();
            prop_assert_eq!(together, text);
            prop_assert!(tokens.iter().all(|token| token.start < token.end));
        }
    }
}
