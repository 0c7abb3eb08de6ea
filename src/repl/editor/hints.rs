//! Hints that are shown after the cursor while a line is typed.

use std::ops::Range;

use super::candidates::written;
use super::commands::command_named;
use super::completeness::is_command;
use super::completion::complete;
use super::expected::{ActiveCall, Expected};
use super::input::{CalleeName, Input, OpenBracket};
use super::surroundings::{CommandOperand, CompletionContext, ScriptFunction};
use crate::script::bindings::built_in::{BuiltIn, FunctionForm};
use crate::script::bindings::parameter::{Parameter, Presence};
use crate::script::messages::numbers::format_number;
use crate::script::source::scanner::{Bracket, TokenKind};

/// Hint after the cursor.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Hint {
    /// Text of the hint.
    pub shown: String,
    /// Part of the hint that can be inserted into the line.
    pub insertable: Option<String>,
}

impl Hint {
    fn note(text: String) -> Option<Self> {
        (!text.is_empty()).then(|| Self { shown: format!("  {text}"), insertable: None })
    }

    /// Creates a hint whose text can be inserted.
    pub fn insertable(text: &str) -> Option<Self> {
        (!text.is_empty())
            .then(|| Self { shown: text.to_owned(), insertable: Some(text.to_owned()) })
    }
}

/// Hint after the cursor, if it is at the end of `line`: the rest of the only matching name, the signature or option keys of a call,
/// or the summary of a command.
pub fn hint(line: &str, position: usize, surroundings: &CompletionContext) -> Option<Hint> {
    if position != line.len() || line.trim().is_empty() {
        return None;
    }
    if is_command(line) {
        let name = line.trim();
        if let Some((word, operand)) = line.trim_start().split_once(char::is_whitespace)
            && let Some(command) = command_named(word, surroundings)
            && matches!(
                command.operand,
                CommandOperand::Expression | CommandOperand::Curves | CommandOperand::OptionsOf(_)
            )
        {
            return hint(operand, operand.len(), surroundings);
        }
        let command = command_named(name, surroundings).filter(|command| command.name == name)?;
        return Hint::note(command.summary.to_owned());
    }
    let input = Input::before(line, position);
    let expected = Expected::new(&input, surroundings);
    let is_member = input.count_before_name().checked_sub(1).is_some_and(|dot| input.is_dot(dot));
    let completes = !is_comment(&input) && (is_member || is_key(&expected));
    let only = completes.then(|| only_candidate(line, surroundings)).flatten();
    only.or_else(|| Hint::note(call_hint(line, surroundings)?.line()))
}

fn is_comment(input: &Input) -> bool {
    let last = input.last.map(|token| token.kind);
    matches!(last, Some(TokenKind::Comment | TokenKind::OpenComment))
}

fn is_key(expected: &Expected) -> bool {
    let innermost = expected.innermost();
    innermost.is_some_and(|level| level.bracket == Bracket::Map && level.key.is_none())
}

fn only_candidate(line: &str, surroundings: &CompletionContext) -> Option<Hint> {
    let (start, candidates) = complete(line, line.len(), surroundings);
    match candidates.as_slice() {
        [only] => Hint::insertable(only.replacement.strip_prefix(&line[start..])?),
        _ => None,
    }
}

/// Description of the call around the cursor, or of its options.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct CallHint {
    /// Signature of the function, keys of the options, or description of an option.
    pub label: String,
    /// Parameter at the cursor, as a part of the label [bytes].
    pub current: Option<Range<usize>>,
    /// Description of the parameter at the cursor; may be empty.
    pub about: String,
}

impl CallHint {
    fn note(label: String) -> Self {
        Self { label, current: None, about: String::new() }
    }

    fn signature(name: &str, parameters: &[String], current: usize, about: String) -> Self {
        let start =
            parameters.iter().take(current).fold(name.len() + 1, |at, of| at + of.len() + 2);
        Self {
            label: format!("{name}({})", parameters.join(", ")),
            current: parameters.get(current).map(|of| start..start + of.len()),
            about,
        }
    }

    fn line(self) -> String {
        let Self { mut label, current, about } = self;
        if let Some(Range { start, end }) = current {
            label.insert(end, '›');
            label.insert(start, '‹');
        }
        if about.is_empty() { label } else { format!("{label}  {about}") }
    }
}

/// Description of the call around the end of `line`, or of its options.
pub fn call_hint(line: &str, surroundings: &CompletionContext) -> Option<CallHint> {
    let input = Input::before(line, line.len());
    if is_comment(&input) {
        return None;
    }
    let expected = Expected::new(&input, surroundings);
    if is_key(&expected) && !(expected.keys().is_empty() && expected.library_keys().is_empty()) {
        let (_, free) = complete(line, line.len(), surroundings);
        let names: Vec<_> = free.into_iter().map(|key| key.display).collect();
        return Some(CallHint::note(names.join(", ")));
    }
    let (level, callee) = expected.call()?;
    if expected.innermost().is_some_and(|innermost| innermost.bracket == Bracket::Map) {
        return Some(CallHint::note(describe(expected.here().first()?)));
    }
    let rows = expected.rows(&callee);
    let is_long_enough =
        |called: &&ActiveCall| level.commas + called.before_dot < called.row.parameters.len();
    match rows.iter().find(is_long_enough).or(rows.first()) {
        Some(called) => Some(signature(called, &level)),
        None => match script_function(&callee, surroundings) {
            Some(function) => {
                let names = &function.parameters;
                Some(CallHint::signature(&function.name, names, level.commas, String::new()))
            }
            None => built_in_signature(&expected.built_ins(&callee), &level),
        },
    }
}

fn signature(called: &ActiveCall, level: &OpenBracket) -> CallHint {
    let parameters = called.row.parameters.get(called.before_dot..).unwrap_or_default();
    let names: Vec<String> = parameters.iter().map(written).collect();
    let about = parameters.get(level.commas).map(describe).unwrap_or_default();
    CallHint::signature(called.row.name, &names, level.commas, about)
}

fn built_in_signature(known: &[(&BuiltIn, FunctionForm)], level: &OpenBracket) -> Option<CallHint> {
    let is_long_enough = |(_, form): &&(&BuiltIn, FunctionForm)| level.commas < form.listed().len();
    let (known, form) = known.iter().find(is_long_enough).or(known.first())?;
    let about = known.summary.to_owned();
    Some(CallHint::signature(form.name, &form.listed(), level.commas, about))
}

/// Description of a parameter, such as `t: a number [time]; default: 0; doc`.
fn describe(parameter: &Parameter) -> String {
    let default = match parameter.presence {
        Presence::Required | Presence::Optional => None,
        Presence::Number(x) => Some(format_number(x)),
        Presence::Integer(n) => Some(n.to_string()),
        Presence::Text(text) => Some(format!("\"{text}\"")),
        Presence::Boolean(value) => Some(value.to_string()),
    };
    let mut text = format!("{}: {}", parameter.name, parameter.expectation());
    if let Some(default) = default {
        text.push_str(&format!("; default: {default}"));
    }
    if !parameter.doc.is_empty() {
        text.push_str(&format!("; {}", parameter.doc));
    }
    text
}

fn script_function<'s>(
    callee: &CalleeName,
    surroundings: &'s CompletionContext,
) -> Option<&'s ScriptFunction> {
    let named = |function: &&ScriptFunction| function.name == callee.name;
    match callee.module {
        None => surroundings.functions.iter().find(named),
        Some(alias) => {
            let modules = surroundings.modules.iter().filter(|module| module.alias == alias);
            modules.flat_map(|module| &module.functions).find(named)
        }
    }
}

#[cfg(test)]
mod tests {
    use super::super::samples::surroundings;
    use super::*;

    fn shown(line: &str) -> String {
        hint(line, line.len(), &surroundings())
            .map(|hint| hint.shown.trim().to_owned())
            .unwrap_or_default()
    }

    #[test]
    fn call_hint_shows_the_signature_with_the_current_parameter() {
        assert!(
            shown("line(").starts_with("line(‹from›, to)  from: a point [x, y]"),
            "{}",
            shown("line(")
        );
        assert!(shown("line([0, 0], ").starts_with("line(from, ‹to›)  to: a point [x, y]"));
        assert!(shown("line([0, ").starts_with("line(‹from›, to)"));
        assert_eq!(
            shown("sim.step("),
            "step(‹[count]›)  count: a whole number of zero or more; default: 1"
        );
        assert_eq!(shown("sim.step(1, 2, "), "step([count])");
        assert!(shown("sim.plot_motion(").starts_with("plot_motion(‹file›, [options])"));
        assert_eq!(shown("swing(1, "), "swing(angle, ‹speed›)");
        assert_eq!(shown("shapes::arch("), "arch(‹rise›)");
        assert!(shown("print(\"a\"); sim.run_to(2 * (1 + ").starts_with("run_to(‹t›)"));
        assert_eq!(shown("sim.run_to(1)"), "");
        assert_eq!(shown("unknown("), "");
        assert_eq!(
            shown("values.insert(1, "),
            "insert(index, ‹value›)  Inserts a value before the element at an index."
        );
        assert!(shown("\"a b\".split(").starts_with("split(‹[separator]›, [count])"));
        assert!(shown("parse_int(").starts_with("parse_int(‹text›, [radix])"));
    }

    #[test]
    fn option_map_hint_shows_keys_and_allowed_values() {
        assert_eq!(shown("scene.start(#{ "), "dt, integrator, name, notes, record, snapshots");
        assert_eq!(
            shown("scene.start(#{ dt: "),
            "dt: a positive number or a step control [time]; step size, or adaptive(#{ tolerance: 1e-4 }); default: adaptive steps with the tolerance 1e-3"
        );
        assert_eq!(shown("scene.start(#{ dt: 0.1, in"), "tegrator:");
    }

    #[test]
    fn only_matching_member_is_hinted() {
        let hint = hint("rod.e", 5, &surroundings()).expect("a hint");
        assert_eq!((hint.shown.as_str(), hint.insertable.as_deref()), ("nd", Some("nd")));
        assert_eq!(shown("rod.st"), "art");
        assert_eq!(shown("sim."), "");
        assert_eq!(shown(":step"), "Takes steps.");
        assert!(shown(":plot energy, sim.position(").starts_with("position(‹station›)"));
        assert_eq!(shown(":time rod.e"), "nd");
    }

    #[test]
    fn no_hints_are_shown_inside_lines_and_comments() {
        assert_eq!(hint("line(", 3, &surroundings()), None);
        assert_eq!(shown("line( // x"), "");
        assert_eq!(shown("ro"), "");
    }

    #[test]
    fn hint_does_not_depend_on_long_preceding_input() {
        for part in ["(", "f(", "#{ a: ", "a.", "let a = a; ", "[", "sim.history.", "line(1, "] {
            let text = format!("{}; line(", part.repeat(10_000 / part.len()));
            assert!(shown(&text).starts_with("line(‹from›, to)"), "{part}: {}", shown(&text));
        }
    }
}
