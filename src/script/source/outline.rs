//! Names declared by a script, used for suggestions.

use rhai::{Position, Token};

use super::definitions::{Definition, definitions};
use super::text::{Lexeme, Source, name_of};

#[derive(Debug, Default)]
pub struct ScriptOutline {
    /// Variables and constants declared outside functions and blocks, with the lines of their declarations.
    pub top_level: Vec<(String, usize)>,
    pub variables: Vec<String>,
    pub functions: Vec<(String, usize)>,
    pub keys: Vec<String>,
    pub imports: Vec<(String, String)>,
}

impl ScriptOutline {
    pub fn of(source: &Source) -> Self {
        let tokens = source.tokens();
        let mut outline = Self::default();
        let mut functions = definitions(tokens);
        let mut depth = 0_usize;
        for (index, (token, position)) in tokens.iter().enumerate() {
            let name = |ahead: usize| {
                tokens.get(index + ahead).and_then(|(token, _)| name_of(token)).map(str::to_owned)
            };
            match token {
                Token::LeftBrace | Token::MapStart => depth += 1,
                Token::RightBrace => depth = depth.saturating_sub(1),
                Token::Let | Token::Const | Token::For => {
                    outline.declare(token, name(1), depth, *position)
                }
                Token::As => outline.imported(&tokens[..index], name(1)),
                Token::Fn => functions.next().into_iter().for_each(|one| outline.define(&one)),
                Token::Identifier(key)
                    if matches!(tokens.get(index + 1), Some((Token::Colon, _))) =>
                {
                    outline.keys.push(key.to_string());
                }
                _ => (),
            }
        }
        outline
    }

    fn declare(&mut self, token: &Token, name: Option<String>, depth: usize, position: Position) {
        let Some(name) = name else { return };
        if depth == 0 && !matches!(token, Token::For) {
            self.top_level.push((name.clone(), position.line().unwrap_or(0)));
        }
        self.variables.push(name);
    }

    fn imported(&mut self, before: &[Lexeme], name: Option<String>) {
        if let (Some((Token::StringConstant(path), _)), Some(name)) = (before.last(), name) {
            self.imports.push((name, path.to_string()));
        }
    }

    fn define(&mut self, function: &Definition) {
        let parameters = || function.parameters().map(str::to_owned);
        if let Some((name, _)) = function.name() {
            self.functions.push((name.to_owned(), parameters().count()));
        }
        self.variables.extend(parameters());
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn outline(text: &str) -> ScriptOutline {
        ScriptOutline::of(&Source::from(text))
    }

    #[test]
    fn outline_lists_declarations_and_imports() {
        let found = outline("let a = 1;\nfn f(x, y) { let b = #{ key: x }; b }\nfor i in 0..3 { }");
        assert_eq!(found.top_level, [("a".to_owned(), 1)]);
        assert_eq!(found.functions, [("f".to_owned(), 2)]);
        assert_eq!(found.variables, ["a", "x", "y", "b", "i"]);
        assert_eq!(found.keys, ["key"]);
        let found = outline("import \"std/checks\" as c;");
        assert_eq!(found.imports, [("c".to_owned(), "std/checks".to_owned())]);
    }
}
