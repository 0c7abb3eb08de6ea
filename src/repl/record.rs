//! Record of the successful inputs of a session, as a script.

use std::fmt::Write;
use std::ops::Range;

use rhai::{Engine, Scope};

use super::session::ANSWER;
use super::statements;
use crate::script::handles::simulation::SimulationHandle;
use crate::script::messages::numbers::format_number;
use crate::script::source::definitions::{Definition, definitions};
use crate::script::source::text::Source;

const HEADER: &str = "//! A session of withy: its successful inputs.";

#[derive(Clone, Debug, PartialEq)]
enum RecordedInput {
    Statements(Source),
    Expression(Source),
    EarlyReturn(Source),
    Moved(Source),
}

#[derive(Clone)]
pub struct SimulationPositions {
    name: String,
    handle: SimulationHandle,
    time: f64,
    steps: usize,
}

#[derive(Clone, Debug, Default)]
pub struct SessionRecord {
    entries: Vec<RecordedInput>,
}

impl SessionRecord {
    pub fn worked(&mut self, text: &str) {
        self.entries.push(RecordedInput::Statements(text.trim().into()));
    }

    pub fn record_value(&mut self, text: &str) {
        self.entries.push(RecordedInput::Expression(text.trim().into()));
    }

    pub fn returned(&mut self, text: &str) {
        self.entries.push(RecordedInput::EarlyReturn(text.trim().into()));
    }

    pub fn record_movement(&mut self, before: &[SimulationPositions]) -> bool {
        let known = self.entries.len();
        for was in before {
            let (time, steps) = (was.handle.time(), was.handle.simulation().counts().steps);
            if steps != was.steps {
                let method = if time > was.time { "run_to" } else { "rewind" };
                // The saved script catches errors of this repeated call, because it may fail again.
                let call = format!("{}.{method}({});", was.name, format_number(time));
                self.entries
                    .push(RecordedInput::Moved(format!("try {{ {call} }} catch {{ }}").into()));
            }
        }
        self.entries.len() > known
    }

    /// Converts the record to a script. `engine` must not optimise, because that would remove statements.
    pub fn script(&self, engine: &Engine) -> String {
        let asked: Vec<bool> =
            self.sources().map(|source| source.is_some_and(uses_answer)).collect();
        let defined: Vec<Vec<FunctionText>> =
            self.sources().map(|source| source.map(written).unwrap_or_default()).collect();
        let mut script = format!("{HEADER}\n\n");
        for (index, entry) in self.entries.iter().enumerate() {
            let later = || self.entries[index + 1..].iter().zip(&asked[index + 1..]);
            let next = later().position(|(entry, _)| matches!(entry, RecordedInput::Expression(_)));
            let is_asked = || {
                let reach = next.map_or(usize::MAX, |next| next + 1);
                later().take(reach).any(|(_, asked)| *asked)
            };
            let line = match entry {
                RecordedInput::Statements(statements) => terminated(statements),
                RecordedInput::Expression(statements) if is_asked() => {
                    value_text(engine, statements)
                }
                RecordedInput::Expression(statements) => terminated(statements),
                RecordedInput::EarlyReturn(statements) => {
                    let lines = statements.lines().map(|line| format!("\n// {line}"));
                    format!(
                        "// Not run, because of its return statement:{}",
                        lines.collect::<String>()
                    )
                }
                RecordedInput::Moved(line) => {
                    format!("// A statement was stopped here.\n{}", &**line)
                }
            };
            let replaced = |definition: &FunctionText| {
                defined[index + 1..].iter().flatten().any(|later| later.name == definition.name)
            };
            let _ = writeln!(script, "{}", remove_replaced(&line.into(), replaced));
        }
        script
    }

    /// Names of functions that were defined more than once, which a script does not allow.
    pub fn redefined(&self) -> Vec<String> {
        let mut seen = Vec::new();
        let mut twice = Vec::new();
        for definition in self.sources().flatten().flat_map(written) {
            let shown = definition.name.0.clone();
            if seen.contains(&definition.name) && !twice.contains(&shown) {
                twice.push(shown);
            }
            seen.push(definition.name);
        }
        twice
    }

    pub fn definition(&self, name: &str) -> Option<String> {
        self.entries.iter().rev().filter_map(RecordedInput::source).find_map(|source| {
            let found = written(source).into_iter().rev();
            found.filter(|one| one.name.0 == name).map(|one| source[one.bytes].to_owned()).next()
        })
    }

    fn sources(&self) -> impl Iterator<Item = Option<&Source>> {
        self.entries.iter().map(RecordedInput::source)
    }

    pub fn has_returned(&self) -> bool {
        self.entries.iter().any(|entry| matches!(entry, RecordedInput::EarlyReturn(_)))
    }
}

impl RecordedInput {
    fn source(&self) -> Option<&Source> {
        match self {
            Self::Statements(text) | Self::Expression(text) => Some(text),
            Self::EarlyReturn(_) => None,
            Self::Moved(line) => Some(line),
        }
    }
}

pub fn simulation_positions(
    scope: &Scope,
    latest: Option<SimulationHandle>,
) -> Vec<SimulationPositions> {
    let mut found: Vec<SimulationPositions> = Vec::new();
    let held =
        scope.iter_raw().filter(|(name, ..)| *name != ANSWER).filter_map(|(name, _, value)| {
            Some((name.to_owned(), value.read_lock::<SimulationHandle>()?.clone()))
        });
    let latest = latest.map(|handle| ("latest_simulation()".to_owned(), handle));
    for (name, handle) in held.chain(latest) {
        if !found.iter().any(|other| other.handle.is_same(&handle)) {
            let (time, steps) = (handle.time(), handle.simulation().counts().steps);
            found.push(SimulationPositions { name, handle, time, steps });
        }
    }
    found
}

fn uses_answer(source: &Source) -> bool {
    source.names().any(|name| name == ANSWER)
}

fn terminated(statements: &Source) -> String {
    let is_closed = statements.tokens().is_empty() || statements.ends_in_semicolon();
    match (is_closed, statements.lines().last().is_some_and(|last| last.contains("//"))) {
        (true, _) => statements.to_string(),
        (false, true) => format!("{}\n;", &**statements),
        (false, false) => format!("{};", &**statements),
    }
}

fn value_text(engine: &Engine, text: &str) -> String {
    let last = statements::count(engine, text).and_then(|all| all.checked_sub(1));
    let cut = last.and_then(|first| statements::boundary(engine, text, first)).unwrap_or(0);
    let (before, expression) = text.split_at(cut);
    let space = &expression[..expression.len() - expression.trim_start().len()];
    terminated(&format!("{before}{space}let {ANSWER} = {}", expression.trim_start()).into())
}

pub fn functions_of(source: &Source) -> impl Iterator<Item = &str> {
    written(source).into_iter().map(|definition| &source[definition.bytes])
}

struct FunctionText {
    name: (String, usize),
    bytes: Range<usize>,
}

fn written(source: &Source) -> Vec<FunctionText> {
    let tokens = source.tokens();
    let written = |definition: Definition| {
        let from = documented_from(source, source.offset_of(&tokens[definition.first]));
        let end = source.offset_of(tokens.get(definition.end.checked_sub(1)?)?) + 1;
        let name = (definition.full_name(), definition.parameters().count());
        Some(FunctionText { name, bytes: from..end })
    };
    definitions(tokens).filter_map(written).collect()
}

fn documented_from(text: &str, end: usize) -> usize {
    let mut from = end;
    while let Some(line) =
        text[..from].trim_end().lines().last().filter(|line| line.trim_start().starts_with("///"))
    {
        from = text[..from].trim_end().len() - line.trim_start().len();
    }
    from
}

fn remove_replaced(source: &Source, is_replaced: impl Fn(&FunctionText) -> bool) -> String {
    let mut text = source.to_string();
    for definition in written(source).into_iter().rev().filter(is_replaced) {
        let note = format!("/* {} is redefined below */", definition.name.0);
        text.replace_range(definition.bytes, &note);
    }
    text
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::script::engine::build;
    use crate::script::packages::language;
    use crate::script::state::context::Context;
    use crate::script::state::settings::{RunMode, RunSettings};

    fn script(record: &SessionRecord) -> String {
        let context = Context::new(RunSettings::silent(RunMode::Run));
        let engine = build(&language(), &context).expect("an engine");
        record.script(&engine).lines().skip(2).collect::<Vec<_>>().join("\n")
    }

    #[test]
    fn recorded_inputs_become_statements() {
        let mut record = SessionRecord::default();
        record.worked("let a = 1;");
        record.worked("let b = 2");
        record.record_value("a + b // three");
        record.worked("fn f(x) { x }");
        record.record_value("#{ a: 1 }");
        assert_eq!(
            script(&record),
            "let a = 1;\nlet b = 2;\na + b // three\n;\nfn f(x) { x };\n#{ a: 1 };"
        );
    }

    #[test]
    fn value_used_later_as_ans_is_named() {
        let mut record = SessionRecord::default();
        record.record_value("1 + 1");
        record.record_value("let c = 3; f(c, #{ a: 1 })");
        record.worked("let b = ans;");
        record.record_value("7");
        assert_eq!(
            script(&record),
            "1 + 1;\nlet c = 3; let ans = f(c, #{ a: 1 });\nlet b = ans;\n7;"
        );
    }

    #[test]
    fn only_the_last_definition_of_a_function_is_saved() {
        let mut record = SessionRecord::default();
        record.worked("fn f(x) { if x { 1 } else { 2 } } let a = 1;");
        record.worked("fn f(x, y) { 0 }");
        record.worked("fn f(z) { 3 }");
        assert_eq!(record.redefined(), ["f"]);
        assert_eq!(
            script(&record),
            "/* f is redefined below */ let a = 1;\nfn f(x, y) { 0 };\nfn f(z) { 3 };"
        );
    }

    #[test]
    fn methods_and_private_functions_are_recorded_separately() {
        let mut record = SessionRecord::default();
        record.worked("fn number.twice() { this * 2 } fn number.thrice() { this * 3 }");
        record.worked("/// Ten.\n/// Really.\nprivate fn ten() { 10 }");
        record.worked("fn ten() { 11 }");
        assert_eq!(record.redefined(), ["ten"]);
        let expected = "fn number.twice() { this * 2 } fn number.thrice() { this * 3 };\n\
            /* ten is redefined below */;\nfn ten() { 11 };";
        assert_eq!(script(&record), expected);
    }

    #[test]
    fn ans_is_assigned_after_functions_and_blocks() {
        let mut record = SessionRecord::default();
        record.record_value("fn q() { 3 } q()");
        record.record_value("let i = 0; while i < ans { i += 1 } i");
        record.record_value("ans + 1");
        let expected = "fn q() { 3 } let ans = q();\n\
            let i = 0; while i < ans { i += 1 } let ans = i;\nans + 1;";
        assert_eq!(script(&record), expected);
    }

    #[test]
    fn input_with_a_return_statement_is_commented_out() {
        let mut record = SessionRecord::default();
        record.returned("if true {\n  return 5; }");
        record.worked("let a = 1;");
        let expected = "// Not run, because of its return statement:\n// if true {\n//   return 5; }\nlet a = 1;";
        assert_eq!(script(&record), expected);
    }
}
