//! Completion of words at the cursor.

use super::candidates::{Candidate, fitting};
use super::commands::complete_command;
use super::completeness::is_command;
use super::expected::{Expected, kinds};
use super::input::Input;
use super::members::members;
use super::paths::{FileFilter, complete_path};
use super::surroundings::{CompletionContext, ScriptFunction};
use super::types::Types;
use crate::script::bindings::kind;
use crate::script::bindings::table::CallSyntax;
use crate::script::source::keywords::KEYWORDS;
use crate::script::source::scanner::{Bracket, Token, TokenKind, scan};

/// Completion candidates for the word at `position` in `line`, and the index of the first byte of this word.
pub fn complete(
    line: &str,
    position: usize,
    surroundings: &CompletionContext,
) -> (usize, Vec<Candidate>) {
    let Some(after) = line.get(position..) else { return (position, Vec::new()) };
    let (start, mut candidates) = match is_command(line) {
        true => complete_command(&line[..position], surroundings),
        false => complete_language(line, position, surroundings),
    };
    // If the text after the cursor is already the end of a candidate, this end is not inserted again.
    for candidate in &mut candidates {
        for mark in ["(", "\"", "\"]", "::", ": "] {
            if after.starts_with(mark.trim_end()) && candidate.replacement.ends_with(mark) {
                let kept = candidate.replacement.len() - mark.len();
                candidate.replacement.truncate(kept);
            }
        }
    }
    (start, candidates)
}

const DECLARING: &[&str] = &["let", "const", "fn", "for", "as"];

fn complete_language(
    line: &str,
    position: usize,
    surroundings: &CompletionContext,
) -> (usize, Vec<Candidate>) {
    let nothing = (position, Vec::new());
    let input = Input::before(line, position);
    match input.last.map(|token| token.kind) {
        Some(TokenKind::OpenText) => return complete_text(&input, surroundings),
        Some(TokenKind::Comment) if !input.text.ends_with("*/") => return nothing,
        Some(
            TokenKind::Comment
            | TokenKind::OpenComment
            | TokenKind::OpenPiece
            | TokenKind::Text
            | TokenKind::Number,
        ) => {
            return nothing;
        }
        Some(TokenKind::Piece | TokenKind::Close(Bracket::Interpolation)) => return nothing,
        _ => (),
    }
    let (start, typed) = input.name();
    let count = input.count_before_name();
    let before = |back: usize| count.checked_sub(back).map_or("", |index| input.written(index));
    let candidates = match before(1) {
        "." | "?." => {
            let of = count
                .checked_sub(2)
                .and_then(|end| Types { input: &input, context: surroundings }.of(end));
            let variable =
                surroundings.variable(before(2)).filter(|_| !matches!(before(3), "." | "?."));
            members(of, variable, typed, surroundings)
        }
        "::" => module_members(before(2), surroundings),
        word if DECLARING.contains(&word) => Vec::new(),
        _ if is_indentation(&input) => vec![Candidate::word(INDENTATION, "")],
        _ => keys(&input, line, surroundings).unwrap_or_else(|| names(surroundings)),
    };
    (start, fitting(typed, candidates))
}

/// Blanks that the TAB key inserts at the start of a continuation line.
pub const INDENTATION: &str = "    ";

fn is_indentation(input: &Input) -> bool {
    let line = input.text.rfind('\n').map(|end| &input.text[end..]);
    line.is_some_and(|line| line.trim().is_empty())
}

fn names(surroundings: &CompletionContext) -> Vec<Candidate> {
    let catalog = &surroundings.catalog;
    let own =
        surroundings.variables.iter().map(|variable| Candidate::word(&variable.name, &variable.of));
    let functions = catalog.rows().filter(|row| matches!(row.form, CallSyntax::Function));
    let built_ins =
        catalog.built_ins().filter_map(|known| Some((known, known.form_of_function()?)));
    let constants = catalog.tables().flat_map(|table| table.constants);
    let modules = surroundings
        .modules
        .iter()
        .map(|module| Candidate::word(&format!("{}::", module.alias), "a module"));
    own.chain(surroundings.functions.iter().map(script_function))
        .chain(modules)
        .chain(functions.map(|row| Candidate::row(row, 0)))
        .chain(constants.map(|constant| Candidate::word(constant.name, constant.summary)))
        .chain(built_ins.map(Candidate::built_in))
        .chain(KEYWORDS.iter().map(|word| Candidate::word(word, "")))
        .collect()
}

fn script_function(function: &ScriptFunction) -> Candidate {
    Candidate::call(
        &function.name,
        &format!("({})", function.parameters.join(", ")),
        &function.summary,
    )
}

fn module_members(alias: &str, surroundings: &CompletionContext) -> Vec<Candidate> {
    let modules = surroundings.modules.iter().filter(|module| module.alias == alias);
    modules.flat_map(|module| &module.functions).map(script_function).collect()
}

fn keys(input: &Input, line: &str, surroundings: &CompletionContext) -> Option<Vec<Candidate>> {
    let expected = Expected::new(input, surroundings);
    let level = expected
        .innermost()
        .filter(|level| level.bracket == Bracket::Map && level.key.is_none())?;
    let own = (level.opener..input.tokens.len()).filter(|index| input.written(index + 1) == ":");
    let mut given: Vec<&str> = own.map(|index| input.written(index)).collect();
    given.extend(keys_after(&line[input.text.len()..]));
    let free = expected.keys().into_iter().filter(|key| !given.contains(&key.name));
    let of_library = expected.library_keys().iter();
    let of_library = of_library.filter(|(name, _)| !given.contains(&name.as_str()));
    let of_library = of_library.map(|(name, about)| Candidate::option_candidate(name, about));
    Some(free.map(Candidate::key).chain(of_library).collect())
}

fn keys_after(rest: &str) -> Vec<&str> {
    let tokens: Vec<Token> = scan(rest).into_iter().filter(Token::is_significant).collect();
    let mut depth = 0_usize;
    let mut found = Vec::new();
    for (index, token) in tokens.iter().enumerate() {
        match token.kind {
            TokenKind::Open(_) => depth += 1,
            TokenKind::Close(_) if depth == 0 => break,
            TokenKind::Close(_) => depth -= 1,
            _ if depth == 0 && tokens.get(index + 1).is_some_and(|next| next.of(rest) == ":") => {
                found.push(token.of(rest));
            }
            _ => (),
        }
    }
    found
}

fn complete_text(input: &Input, surroundings: &CompletionContext) -> (usize, Vec<Candidate>) {
    let nothing = (input.text.len(), Vec::new());
    let Some(text) = input.tokens.last().filter(|text| text.of(input.text).starts_with('"')) else {
        return nothing;
    };
    let (start, typed) = (text.start + 1, &input.text[text.start + 1..]);
    let count = input.tokens.len() - 1;
    let before = |back: usize| count.checked_sub(back).map_or("", |index| input.written(index));
    if before(1) == "import" {
        return complete_path_at(start, typed, surroundings, FileFilter::Modules);
    }
    let expected = Expected::new(input, surroundings);
    if before(1) == "["
        && let Some(map) = surroundings.variable(before(2))
    {
        return (start, fitting(typed, map.keys.iter().map(|key| quoted(key, "\"]"))));
    }
    let parameters = expected.here();
    if parameters.iter().any(|parameter| parameter.name == "file") {
        return complete_path_at(start, typed, surroundings, FileFilter::Any);
    }
    let mut candidates = Vec::new();
    for parameter in parameters {
        if matches!(parameter.name, "column" | "columns") {
            candidates.extend(surroundings.columns.iter().map(|column| quoted(column, "\"")));
        }
        for kind in kinds(&parameter.kind) {
            if let kind::Kind::Choice(allowed) = kind {
                candidates.extend(allowed.iter().map(|choice| quoted(choice, "\"")));
            }
        }
    }
    (start, fitting(typed, candidates))
}

fn quoted(word: &str, end: &str) -> Candidate {
    Candidate { replacement: format!("{word}{end}"), ..Candidate::word(word, "") }
}

fn complete_path_at(
    start: usize,
    typed: &str,
    surroundings: &CompletionContext,
    files: FileFilter,
) -> (usize, Vec<Candidate>) {
    let (offset, mut candidates) = complete_path(typed, &surroundings.folder, files);
    for candidate in candidates.iter_mut().filter(|candidate| !candidate.replacement.ends_with('/'))
    {
        candidate.replacement.push('"');
    }
    (start + offset, candidates)
}

#[cfg(test)]
mod tests;
