//! Names and help at a place of a script that is being written.
//! The script is evaluated in a dry run, in which statements with an error, such as the unfinished one, have no effect.

use std::ops::Range;
use std::time::Instant;

use super::commands::help_on;
use super::editor::surroundings::{CompletionContext, ScriptFunction, Variable};
use super::editor::type_before;
use super::session::Session;
use super::shell::{ReplyTarget, Shell};
use crate::script::diagnose::Diagnostic;
use crate::script::engine::stack::on_large_stack;
use crate::script::help::lookup::{self, WIDTH};
use crate::script::packages::language;
use crate::script::source::definitions::definitions;
use crate::script::source::outline::ScriptOutline;
use crate::script::source::program::Program;
use crate::script::source::scanner::{Bracket, Token, TokenKind, pair, scan};
use crate::script::state::limits::Limits;
use crate::script::state::settings::{RunMode, RunSettings};

/// Names that a script can use at byte `offset`. The type of a name is unknown if the evaluation does not reach it.
///
/// # Errors
/// Fails only because of internal errors.
pub fn names_at(
    program: &Program,
    offset: usize,
    limits: Limits,
) -> Result<CompletionContext, Diagnostic> {
    let text = program.text.get(..offset).unwrap_or(&program.text);
    let mut names = after_statements(program, text, limits, |shell| shell.surroundings())?;
    for name in ScriptOutline::of(&text.into()).variables {
        if names.variable(&name).is_none() {
            names.variables.push(Variable { name, of: String::new(), keys: Vec::new() });
        }
    }
    for function in definitions(program.text.tokens()) {
        let Some((name, _)) = function.name() else { continue };
        if names.functions.iter().all(|known| known.name != name) {
            names.functions.push(ScriptFunction {
                name: name.to_owned(),
                parameters: function.parameters().map(str::to_owned).collect(),
                summary: "a function of this script".into(),
                ..ScriptFunction::default()
            });
        }
    }
    Ok(names)
}

/// Help on the name at byte `offset` of a script, without its value, and the position of the name [bytes].
pub fn help_at(program: &Program, offset: usize, limits: Limits) -> Option<(Range<usize>, String)> {
    let text = &*program.text;
    let target = HelpTarget::at(text, offset)?;
    let explain = |shell: &mut Shell| {
        let pages =
            target.names(text, shell).into_iter().find_map(|name| help_on(shell, &name).ok())?;
        let pages: Vec<String> = pages.iter().map(|known| known.page.plain(WIDTH)).collect();
        Some(pages.join("\n"))
    };
    let help = match target.is_key {
        true => Some(lookup::page(&language(), target.word(text)).ok()?.plain(WIDTH)),
        false => after_statements(program, text, limits, explain).ok()?,
    };
    Some((target.place.clone(), help?))
}

fn after_statements<T: Send>(
    program: &Program,
    text: &str,
    limits: Limits,
    work: impl FnOnce(&mut Shell) -> T + Send,
) -> Result<T, Diagnostic> {
    let begun = Instant::now();
    let is_late = || limits.time.is_some_and(|most| begun.elapsed() > most);
    on_large_stack(&limits, || {
        let settings = RunSettings {
            limits,
            folder: program.folder.clone(),
            ..RunSettings::silent(RunMode::DryRun)
        };
        let mut shell = Shell::new(Session::new(language(), settings)?, ReplyTarget::Pipe);
        for statement in statements(text).into_iter().take_while(|_| !is_late()) {
            shell.session_mut().eval(statement);
        }
        Ok(work(&mut shell))
    })?
}

const CONTINUING: &[&str] = &["else", "catch", "while", "until"];

/// Statements of a text, with the comments before them. An unclosed bracket does not hide the statements after it.
fn statements(text: &str) -> Vec<&str> {
    let tokens: Vec<Token> = scan(text).into_iter().filter(Token::is_significant).collect();
    let (partners, _) = pair(&tokens);
    let (mut found, mut start, mut index) = (Vec::new(), 0, 0);
    while let Some(token) = tokens.get(index) {
        let closer = partners[index].unwrap_or(index).max(index);
        let next = tokens.get(closer + 1);
        let begins =
            |next: &Token| next.kind == TokenKind::Word && !CONTINUING.contains(&next.of(text));
        let is_block = token.kind == TokenKind::Open(Bracket::Curly);
        if token.of(text) == ";" || is_block && next.is_some_and(begins) {
            found.push(&text[start..tokens[closer].end]);
            start = tokens[closer].end;
        }
        index = closer + 1;
    }
    found.push(&text[start..]);
    found
}

struct HelpTarget {
    place: Range<usize>,
    /// Start of the path that ends with the name, as in `sim.history` or `sections::pipe` [bytes].
    path: usize,
    /// End of the value before the dot, as of `sim` in `sim.history` [bytes]; `None` if no dot precedes the name.
    owner: Option<usize>,
    is_key: bool,
}

impl HelpTarget {
    fn at(text: &str, offset: usize) -> Option<Self> {
        let tokens: Vec<Token> = scan(text).into_iter().filter(Token::is_significant).collect();
        let is_here = |token: &Token| {
            token.kind == TokenKind::Word && (token.start..=token.end).contains(&offset)
        };
        let index = tokens.iter().position(is_here)?;
        let written = |at: usize| tokens.get(at).map_or("", |token| token.of(text));
        let is_joined = |at: usize| matches!(written(at), "." | "?." | "::");
        let mut first = index;
        while first >= 2 && is_joined(first - 1) && tokens[first - 2].kind == TokenKind::Word {
            first -= 2;
        }
        let dot = index.checked_sub(1).filter(|before| matches!(written(*before), "." | "?."));
        Some(Self {
            place: tokens[index].start..tokens[index].end,
            path: tokens[first].start,
            owner: dot.map(|dot| tokens[dot].start),
            is_key: written(index + 1) == ":" && !is_joined(index.wrapping_sub(1)),
        })
    }

    fn word<'t>(&self, text: &'t str) -> &'t str {
        &text[self.place.clone()]
    }

    fn names(&self, text: &str, shell: &Shell) -> Vec<String> {
        let word = self.word(text);
        let path: String = text[self.path..self.place.end].split_whitespace().collect();
        let Some(owner) = self.owner else { return vec![path] };
        let of = type_before(&text[..owner], &shell.surroundings());
        let member = of.and_then(|kind| kind.type_name()).map(|of| format!("{of}.{word}"));
        let catalog = shell.session().catalog();
        let member = member.filter(|member| !lookup::find(catalog, member).is_empty());
        let is_function = shell.session().functions().any(|function| function.name == word);
        let function = is_function.then(|| word.to_owned());
        member.into_iter().chain([path]).chain(function).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn known(text: &str) -> Vec<(String, String)> {
        let program = Program::named("draft.rhai", text);
        let names = names_at(&program, text.len(), Limits::default()).expect("names");
        names.variables.into_iter().map(|known| (known.name, known.of)).collect()
    }

    #[test]
    fn session_text_is_divided_into_statements() {
        let text = "let a = 1; // one\nif a { 1; } else { 2; } fn f(x) { x; }\nlet g = |x| { x } ; g(#{ a: 1 })";
        assert_eq!(
            statements(text),
            [
                "let a = 1;",
                " // one\nif a { 1; } else { 2; }",
                " fn f(x) { x; }",
                "\nlet g = |x| { x } ;",
                " g(#{ a: 1 })",
            ]
        );
        assert_eq!(statements("let a = [1; let b = 2; }"), ["let a = [1;", " let b = 2;", " }"]);
        assert_eq!(statements(""), [""]);
    }

    #[test]
    fn names_after_erroneous_statements_are_known() {
        let found = known("let a = [1, 2;\nlet b = sqr(1);\nlet c = line([0, 0], [1, 1]);\nc.");
        let of =
            |name: &str| found.iter().find(|(known, _)| known == name).map(|(_, of)| of.as_str());
        assert_eq!((of("a"), of("b"), of("c")), (Some(""), Some(""), Some("curve")));
    }
}
