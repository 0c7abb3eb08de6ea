//! Syntax highlighting of a text, which may be incomplete or invalid.

use std::collections::{HashMap, HashSet};

use crate::script::bindings::catalog::Catalog;
use crate::script::bindings::table::CallSyntax;
use crate::script::source::keywords::is_keyword;
use crate::script::source::scanner::{Token, TokenKind, pair, scan};

/// Style as ANSI colour codes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct HighlightStyle(pub &'static str);

/// Keywords.
pub const KEYWORD: HighlightStyle = HighlightStyle("35");
/// Numbers.
pub const NUMBER: HighlightStyle = HighlightStyle("36");
/// Texts.
pub const TEXT: HighlightStyle = HighlightStyle("32");
/// Comments.
pub const COMMENT: HighlightStyle = HighlightStyle("2");
/// Function names.
pub const FUNCTION: HighlightStyle = HighlightStyle("34");
/// Constants.
pub const CONSTANT: HighlightStyle = HighlightStyle("36");
/// Style of members that a value of the type cannot have, and of functions that a module does not have.
pub const UNKNOWN_MEMBER: HighlightStyle = HighlightStyle("4");
/// Style of the bracket at the cursor, and of its matching bracket.
pub const PARTNER: HighlightStyle = HighlightStyle("1;4");
/// Style of closing brackets without a matching bracket.
pub const UNMATCHED: HighlightStyle = HighlightStyle("31");

/// Known names, which determine the styles of words. They are collected once for many texts.
pub struct Vocabulary {
    functions: HashSet<String>,
    constants: HashSet<String>,
    variables: HashMap<String, &'static str>,
    members: HashMap<&'static str, HashSet<&'static str>>,
    modules: HashMap<String, HashSet<String>>,
}

impl Vocabulary {
    /// Names of the language, which are sufficient for files.
    pub fn of_language(catalog: &Catalog) -> Self {
        let built_in = catalog.built_ins().filter(|known| known.is_function());
        let built_in = built_in.map(|known| known.name().to_owned());
        let functions = catalog.function_names().map(str::to_owned).chain(built_in).collect();
        let mut members: HashMap<&str, HashSet<&str>> = HashMap::new();
        for row in catalog.rows() {
            if let Some(receiver) =
                row.receiver().filter(|_| !matches!(row.form, CallSyntax::Operator))
            {
                let of_rhai = || {
                    let known = catalog.built_in_members(receiver.name());
                    known.map(|(known, _)| known.name()).collect()
                };
                members.entry(receiver.name()).or_insert_with(of_rhai).insert(row.name);
            }
        }
        let constants = catalog.constants().map(str::to_owned).collect();
        Self { functions, constants, members, variables: HashMap::new(), modules: HashMap::new() }
    }

    /// Adds a function name.
    pub fn add_function(&mut self, name: &str) {
        self.functions.insert(name.to_owned());
    }

    /// Adds a variable and its type name.
    pub fn add_variable(&mut self, name: &str, of: &str) {
        if let Some((of, _)) = self.members.get_key_value(of) {
            self.variables.insert(name.to_owned(), *of);
        }
    }

    /// Adds the functions of a module under its alias.
    pub fn add_module<'n>(&mut self, alias: &str, functions: impl Iterator<Item = &'n str>) {
        self.modules.insert(alias.to_owned(), functions.map(str::to_owned).collect());
    }

    fn lacks(&self, variable: &str, name: &str) -> bool {
        let members = self.variables.get(variable).and_then(|of| self.members.get(of));
        members.is_some_and(|members| !members.contains(name)) && !self.functions.contains(name)
    }

    fn style_of_member(&self, value: &str, name: &str) -> Option<HighlightStyle> {
        self.lacks(value, name).then_some(UNKNOWN_MEMBER)
    }

    fn style_in_module(&self, alias: &str, name: &str) -> Option<HighlightStyle> {
        let functions = self.modules.get(alias)?;
        Some(if functions.contains(name) { FUNCTION } else { UNKNOWN_MEMBER })
    }

    fn style_of_word(&self, word: &str) -> Option<HighlightStyle> {
        match word {
            _ if is_keyword(word) => Some(KEYWORD),
            _ if self.functions.contains(word) => Some(FUNCTION),
            _ if self.constants.contains(word) => Some(CONSTANT),
            _ => None,
        }
    }
}

/// Text with colours. A bracket at the cursor and its matching bracket are emphasised.
pub fn highlight(text: &str, cursor: Option<usize>, vocabulary: &Vocabulary) -> String {
    // An escape character in the input would interfere with the colour sequences.
    if text.contains('\x1b') {
        return text.to_owned();
    }
    let tokens = scan(text);
    let (partners, _) = pair(&tokens);
    let touched = cursor.and_then(|cursor| bracket_at(&tokens, cursor));
    let marked = touched.and_then(|at| partners[at].map(|partner| [at, partner]));
    // A parameter or local variable may have the name of a session variable of another type, so its members are not checked.
    let has_parameters =
        tokens.iter().any(|token| matches!(token.of(text), "fn" | "|" | "let" | "for"));
    let mut drawn = String::with_capacity(text.len() * 2);
    let mut before = [0; 2];
    for (index, token) in tokens.iter().enumerate() {
        let written = token.of(text);
        let style = match token.kind {
            _ if marked.is_some_and(|marked| marked.contains(&index)) => Some(PARTNER),
            TokenKind::Comment | TokenKind::OpenComment => Some(COMMENT),
            TokenKind::Text | TokenKind::OpenText | TokenKind::Piece | TokenKind::OpenPiece => {
                Some(TEXT)
            }
            TokenKind::Number => Some(NUMBER),
            TokenKind::Close(_) if partners[index].is_none() => Some(UNMATCHED),
            TokenKind::Word => {
                let [value, sign] = before.map(|at: usize| tokens[at].of(text));
                let style = match sign {
                    "." | "?." if index > 1 && has_parameters => None,
                    "." | "?." if index > 1 => vocabulary.style_of_member(value, written),
                    "::" if index > 1 => vocabulary.style_in_module(value, written),
                    _ => vocabulary.style_of_word(written),
                };
                let is_last = index + 1 == tokens.len();
                style.filter(|style| !is_last || *style != UNKNOWN_MEMBER)
            }
            TokenKind::Space | TokenKind::Open(_) | TokenKind::Close(_) | TokenKind::Symbol => None,
        };
        draw(&mut drawn, written, style);
        if token.is_significant() {
            before = [before[1], index];
        }
    }
    drawn
}

fn bracket_at(tokens: &[Token], cursor: usize) -> Option<usize> {
    let is_bracket = |token: &Token| matches!(token.kind, TokenKind::Open(_) | TokenKind::Close(_));
    let under = tokens.iter().position(|token| token.start == cursor && is_bracket(token));
    under.or_else(|| tokens.iter().position(|token| token.end == cursor && is_bracket(token)))
}

/// Appends a text with a style.
pub fn draw(drawn: &mut String, text: &str, style: Option<HighlightStyle>) {
    match style.filter(|_| !text.is_empty()) {
        Some(HighlightStyle(numbers)) => {
            for part in ["\x1b[", numbers, "m", text, "\x1b[0m"] {
                drawn.push_str(part);
            }
        }
        None => drawn.push_str(text),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::script::packages::language;

    #[test]
    fn files_are_highlighted_without_a_session() {
        let mut vocabulary = Vocabulary::of_language(&language());
        let drawn = highlight("let a = line(1); // b", None, &vocabulary);
        let expected =
            "\x1b[35mlet\x1b[0m a = \x1b[34mline\x1b[0m(\x1b[36m1\x1b[0m); \x1b[2m// b\x1b[0m";
        assert_eq!(drawn, expected);
        assert_eq!(highlight("parts::half(x)", None, &vocabulary), "parts::half(x)");
        vocabulary.add_module("parts", ["half"].into_iter());
        let drawn = highlight("parts::half(parts::third(x))", None, &vocabulary);
        assert_eq!(drawn, "parts::\x1b[34mhalf\x1b[0m(parts::\x1b[4mthird\x1b[0m(x))");
    }
}
