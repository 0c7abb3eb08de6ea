//! Search for definitions of a name in the text of a script, which may be incomplete.

use std::ops::Range;

use crate::script::source::scanner::{Bracket, Token, TokenKind, scan};

/// Place where a name is defined [bytes of the text].
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Definition<'t> {
    /// Definitions in the same text; functions of one name may have several.
    Here(Vec<Range<usize>>),
    /// Definition in an imported file, or the file itself if no name is given.
    Imported {
        /// Path in the import.
        path: &'t str,
        /// Name in the imported file.
        name: Option<&'t str>,
    },
}

/// Definition of the name, or file of the import, at byte `offset`.
pub fn definition(text: &str, offset: usize) -> Option<Definition<'_>> {
    let code = TokenizedText::of(text);
    let is_here = |token: &Token| (token.start..=token.end).contains(&offset);
    let is_word = |token: &Token| token.kind == TokenKind::Word && is_here(token);
    let mut tokens = code.tokens.iter();
    let index = tokens.position(is_word).or_else(|| code.tokens.iter().position(is_here))?;
    if let Some(path) = code.imported_path(index) {
        return Some(Definition::Imported { path, name: None });
    }
    if code.tokens[index].kind != TokenKind::Word {
        return None;
    }
    let name = code.written(index);
    match index.checked_sub(1).map_or("", |before| code.written(before)) {
        "::" => match code.written(index.checked_sub(2)?) {
            "global" => Some(Definition::Here(code.exported(name))),
            alias => Some(Definition::Imported { path: code.path_of(alias)?, name: Some(name) }),
        },
        "." | "?." => Some(Definition::Here(code.functions(name))),
        _ if code.written(index + 1) == "(" => match code.functions(name) {
            functions if functions.is_empty() => Some(Definition::Here(code.variable(index))),
            functions => Some(Definition::Here(functions)),
        },
        _ => match code.variable(index) {
            variable if variable.is_empty() => Some(Definition::Here(code.functions(name))),
            variable => Some(Definition::Here(variable)),
        },
    }
}

/// Definitions of a name that other scripts can use: a function, or a variable outside functions and blocks.
pub fn exported(text: &str, name: &str) -> Vec<Range<usize>> {
    TokenizedText::of(text).exported(name)
}

const MOST_PARAMETERS: usize = 100;

const LONGEST_NAME: usize = 3;

struct TokenizedText<'t> {
    text: &'t str,
    tokens: Vec<Token>,
}

#[derive(Default)]
struct Scope {
    is_closure: bool,
    /// True for the body of a function, where outer variables are not visible.
    is_function: bool,
    declared: Vec<usize>,
    /// Token index of the name in a declaration whose value is not complete.
    pending: Option<usize>,
    next_block: Vec<usize>,
    next_is_function: bool,
}

impl<'t> TokenizedText<'t> {
    fn of(text: &'t str) -> Self {
        Self { text, tokens: scan(text).into_iter().filter(Token::is_significant).collect() }
    }

    fn written(&self, index: usize) -> &'t str {
        self.tokens.get(index).map_or("", |token| token.of(self.text))
    }

    fn range(&self, index: usize) -> Range<usize> {
        self.tokens[index].start..self.tokens[index].end
    }

    fn is_word(&self, index: usize) -> bool {
        self.tokens.get(index).is_some_and(|token| token.kind == TokenKind::Word)
    }

    fn imported_path(&self, index: usize) -> Option<&'t str> {
        let is_import = index.checked_sub(1).is_some_and(|before| self.written(before) == "import");
        self.written(index).strip_prefix('"').filter(|_| is_import)?.strip_suffix('"')
    }

    fn path_of(&self, alias: &str) -> Option<&'t str> {
        let is_alias = |at: &usize| self.written(*at) == alias && self.written(at - 1) == "as";
        let mut aliases = (2..self.tokens.len()).filter(is_alias);
        aliases.find_map(|at| self.imported_path(at - 2))
    }

    fn functions(&self, name: &str) -> Vec<Range<usize>> {
        let names = (0..self.tokens.len()).filter_map(|at| self.name_of_function(at));
        names.filter(|at| self.written(*at) == name).map(|at| self.range(at)).collect()
    }

    fn name_of_function(&self, start: usize) -> Option<usize> {
        let head = start + 1..self.tokens.len().min(start + 1 + LONGEST_NAME);
        let name = head.take_while(|at| self.written(*at) != "(").last();
        name.filter(|name| self.written(start) == "fn" && self.is_word(*name))
    }

    fn exported(&self, name: &str) -> Vec<Range<usize>> {
        let found = self.functions(name);
        if !found.is_empty() {
            return found;
        }
        let mut depth = 0_usize;
        let at = (0..self.tokens.len()).find(|at| {
            match self.tokens[*at].kind {
                TokenKind::Open(_) => depth += 1,
                TokenKind::Close(_) => depth = depth.saturating_sub(1),
                _ => (),
            }
            let is_declared = matches!(self.written(at.wrapping_sub(1)), "let" | "const");
            depth == 0 && is_declared && self.written(*at) == name
        });
        at.map(|at| self.range(at)).into_iter().collect()
    }

    fn variable(&self, of: usize) -> Vec<Range<usize>> {
        let mut scopes = vec![Scope::default()];
        for at in 0..=of {
            self.read(at, &mut scopes);
        }
        let mut visible = Vec::new();
        for scope in scopes.iter().rev() {
            let next_block = scope.next_block.iter().rev();
            let own = scope.pending.iter().filter(|at| **at == of).chain(next_block);
            visible.extend(own.chain(scope.declared.iter().rev()).copied());
            if scope.is_function {
                break;
            }
        }
        let name = self.written(of);
        let found = visible.into_iter().find(|at| self.written(*at) == name);
        found.map(|at| self.range(at)).into_iter().collect()
    }

    fn read(&self, at: usize, scopes: &mut Vec<Scope>) {
        let token = self.tokens[at];
        if matches!(token.kind, TokenKind::Close(_)) || matches!(self.written(at), "," | ";") {
            while scopes.len() > 1 && scopes.last().is_some_and(|scope| scope.is_closure) {
                scopes.pop();
            }
        }
        match token.kind {
            TokenKind::Open(bracket) => self.open(bracket, scopes),
            TokenKind::Close(_) if scopes.len() > 1 => _ = scopes.pop(),
            _ => (),
        }
        let starts_closure = self.written(at) == "|" && !self.ends_value(at.wrapping_sub(1));
        if starts_closure {
            scopes.push(Scope { is_closure: true, ..Scope::default() });
        }
        let Some(scope) = scopes.last_mut() else { return };
        match self.written(at) {
            "let" | "const" => scope.pending = Some(at + 1),
            "as" => scope.declared.push(at + 1),
            ";" => scope.declared.extend(scope.pending.take()),
            "|" if starts_closure => scope.declared.extend(self.words_until(at, "|")),
            "for" => scope.next_block = self.words_until(at, "in"),
            "catch" => scope.next_block = self.words_until(at, ")"),
            "fn" => {
                let name = self.name_of_function(at).unwrap_or(at);
                scope.next_block = self.words_until(name, ")");
                scope.next_is_function = true;
            }
            _ => (),
        }
    }

    fn open(&self, bracket: Bracket, scopes: &mut Vec<Scope>) {
        let mut inner = Scope::default();
        if let Some(outer) = scopes.last_mut().filter(|_| bracket == Bracket::Curly) {
            inner.declared = std::mem::take(&mut outer.next_block);
            inner.is_function = std::mem::take(&mut outer.next_is_function);
        }
        scopes.push(inner);
    }

    fn ends_value(&self, index: usize) -> bool {
        let Some(token) = self.tokens.get(index) else { return false };
        match token.kind {
            TokenKind::Word => !matches!(token.of(self.text), "return" | "in" | "if" | "while"),
            TokenKind::Number | TokenKind::Text | TokenKind::Close(_) => true,
            _ => false,
        }
    }

    fn words_until(&self, start: usize, end: &str) -> Vec<usize> {
        let rest = start + 1..self.tokens.len();
        let rest = rest.take(2 * MOST_PARAMETERS);
        let inside = rest.take_while(|at| self.written(*at) != end && self.written(*at) != "{");
        inside.filter(|at| self.is_word(*at)).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn find(text: &str, part: &str, number: usize) -> usize {
        text.match_indices(part).nth(number).expect("the part occurs").0
    }

    fn defining(text: &str, name: &str, of: usize) -> Vec<usize> {
        let Some(Definition::Here(found)) = definition(text, find(text, name, of)) else {
            panic!("{text}")
        };
        let number = |range: Range<usize>| text[..range.start].matches(name).count();
        found.into_iter().map(number).collect()
    }

    #[test]
    fn definitions_of_names_are_found() {
        for (text, name, of, expected) in [
            ("let älter = 1; älter + 2", "älter", 1, Some(0)),
            ("let n = 1; let n = n + 1; n", "n", 2, Some(0)),
            ("let n = 1; let n = n + 1; n", "n", 3, Some(1)),
            ("const N = 3; { let N = 4; } print(N)", "N", 2, Some(0)),
            ("let x = 1; fn g(x) { x } g(x)", "x", 2, Some(1)),
            ("let x = 1; fn g(x) { x } g(x)", "x", 3, Some(0)),
            ("let y = 1; fn g(x) { y }", "y", 1, None),
            ("let k = 1; [1].map(|k| 2 * k); k", "k", 2, Some(1)),
            ("let k = 1; [1].map(|k| 2 * k); k", "k", 3, Some(0)),
            ("for q in 0..3 { q } q", "q", 1, Some(0)),
            ("for q in 0..3 { q } q", "q", 2, None),
            ("try { 1 } catch (why) { why }", "why", 1, Some(0)),
            ("import \"std/x\" as lib; lib::f(1)", "lib", 1, Some(0)),
            ("half(2); fn half(x) { x / 2 }", "half", 0, Some(1)),
            ("2.half(); fn half() { this / 2 }", "half", 0, Some(1)),
            ("fn number.twice() { 2 * this } 3.twice()", "twice", 1, Some(0)),
            ("let g = |x| x; g(1)", "g", 1, Some(0)),
            ("const G = 1; fn h() { global::G }", "G", 1, Some(0)),
        ] {
            assert_eq!(defining(text, name, of), Vec::from_iter(expected), "{text}");
        }
        assert_eq!(defining("fn f(x) { } fn f(x, y) { } f(1)", "f(", 2), [0, 1]);
        assert_eq!(definition("1 + 2", 0), None);
        assert_eq!(definition("", 0), None);
    }

    #[test]
    fn definitions_of_imported_names_are_in_their_files() {
        let text = "import \"std/sections\" as s; s::pipe(1, 2)";
        let in_file = |name| Some(Definition::Imported { path: "std/sections", name });
        assert_eq!(definition(text, find(text, "pipe", 0)), in_file(Some("pipe")));
        assert_eq!(definition(text, find(text, "std", 0)), in_file(None));
        assert_eq!(definition("x::pipe(1)", 4), None);
        let file = "let depth = 2; fn pipe(a) { let inner = 1; }\nfn pipe(a, b) { depth }";
        assert_eq!(exported(file, "pipe").len(), 2);
        assert_eq!(exported(file, "depth").first(), Some(&(4..9)));
        assert_eq!(exported(file, "inner"), []);
    }

    #[test]
    fn definition_search_accepts_unfinished_text() {
        let text =
            "import \"a\" as b; fn f(x, |y| { for (i, j) in `${x}` { let z = #{ a: b::c.d(\"";
        for end in (0..=text.len()).filter(|end| text.is_char_boundary(*end)) {
            for at in 0..=end {
                definition(&text[..end], at);
            }
        }
    }
}
