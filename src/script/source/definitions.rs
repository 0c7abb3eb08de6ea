//! Function definitions in a sequence of tokens.

use rhai::Token;

use super::text::{Lexeme, name_of};

#[derive(Clone, Copy, Debug)]
pub struct Definition<'t> {
    tokens: &'t [Lexeme],
    /// Index of the first token: `fn`, or `private` before `fn`.
    pub first: usize,
    start: usize,
    opening: usize,
    body: usize,
    pub end: usize,
}

/// All function definitions in the given tokens, which may contain errors.
pub fn definitions(tokens: &[Lexeme]) -> impl DoubleEndedIterator<Item = Definition<'_>> {
    let starts = tokens.iter().enumerate().filter(|(_, (token, _))| matches!(token, Token::Fn));
    starts.map(|(start, _)| Definition::at(tokens, start))
}

impl<'t> Definition<'t> {
    fn at(tokens: &'t [Lexeme], start: usize) -> Self {
        let find = |from: usize, wanted: fn(&Token) -> bool| {
            let found = tokens[from..].iter().position(|(token, _)| wanted(token));
            found.map_or(tokens.len(), |ahead| from + ahead)
        };
        let opens =
            |token: &Token| matches!(token, Token::LeftParen | Token::Unit | Token::LeftBrace);
        let opening = find(start + 1, opens);
        let body = find(opening, |token| matches!(token, Token::LeftBrace));
        let is_private =
            start.checked_sub(1).is_some_and(|before| matches!(tokens[before].0, Token::Private));
        let first = start - usize::from(is_private);
        Self { tokens, first, start, opening, body, end: closing(tokens, body) }
    }

    /// Name of the function, and the token of the name; `None` for a method of a type.
    pub fn name(&self) -> Option<(&'t str, &'t Lexeme)> {
        match &self.tokens[self.start + 1..self.opening] {
            [lexeme] => Some((name_of(&lexeme.0)?, lexeme)),
            _ => None,
        }
    }

    /// Name of the function; for a method with its type, as in `number.twice`.
    pub fn full_name(&self) -> String {
        let words =
            self.tokens[self.start + 1..self.opening].iter().filter_map(|(token, _)| match token {
                Token::StringConstant(of) => Some(of.as_str()),
                other => name_of(other),
            });
        words.collect::<Vec<_>>().join(".")
    }

    pub fn parameters(&self) -> impl Iterator<Item = &'t str> + use<'t> {
        self.tokens[self.opening..self.body].iter().filter_map(|(token, _)| name_of(token))
    }

    /// Tokens from the bracket before the parameters to the end of the body.
    pub fn inside(&self) -> &'t [Lexeme] {
        &self.tokens[self.opening..self.end]
    }
}

pub fn nesting(token: &Token) -> isize {
    match token {
        Token::LeftBrace
        | Token::MapStart
        | Token::LeftParen
        | Token::LeftBracket
        | Token::QuestionBracket => 1,
        Token::RightBrace | Token::RightParen | Token::RightBracket => -1,
        _ => 0,
    }
}

/// Index of the token after the bracket that closes the bracket at `open`, or the number of tokens if there is none.
pub fn closing(tokens: &[Lexeme], open: usize) -> usize {
    let mut depth = 0;
    for (index, (token, _)) in tokens.iter().enumerate().skip(open) {
        depth += nesting(token);
        if depth == 0 {
            return index + 1;
        }
    }
    tokens.len()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::script::source::text::Source;

    #[test]
    fn function_definitions_are_found_with_names_and_parameters() {
        let source = Source::from(
            "fn a() { f(1) } private fn b(x, y) { |z| #{ k: x } } fn \"whole number\".c(x) { x }",
        );
        let found: Vec<_> = definitions(source.tokens())
            .map(|f| (f.full_name(), f.name().is_some(), f.parameters().count()))
            .collect();
        let expected = [("a", true, 0), ("b", true, 2), ("whole number.c", false, 1)];
        assert_eq!(found, expected.map(|(name, plain, count)| (name.to_owned(), plain, count)));
        let second = definitions(source.tokens()).nth(1).expect("two functions");
        assert_eq!(source.tokens()[second.first].0, Token::Private);
        assert_eq!(source.tokens()[second.end].0, Token::Fn);
    }

    #[test]
    fn unfinished_function_definitions_are_found() {
        for text in ["fn", "fn f", "fn f(", "fn f(x", "fn f(x)", "fn f(x) {", "private fn f() { {"]
        {
            let source = Source::from(text);
            let counts: Vec<_> =
                definitions(source.tokens()).map(|f| f.parameters().count()).collect();
            assert_eq!(counts, [usize::from(text.contains('x'))], "{text}");
        }
    }
}
