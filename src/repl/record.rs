//! What worked in a session, as a script that does it again.

use std::fmt::Write;

use rhai::{Scope, Token};

use super::session::ANSWER;
use crate::script::lexing::tokens;
use crate::script::numbers::format_number;
use crate::script::packages::SimulationHandle;
use crate::script::program::Program;

/// The first line of every saved session.
pub const HEADER: &str = "//! A session of withy: what worked of it.";

/// Something that a script must do to come to the same end.
#[derive(Clone, Debug, PartialEq)]
enum Entry {
    /// An input that worked.
    Statements(String),
    /// An input that is an expression, whose value was kept as `ans`.
    Expression(String),
    /// How far an input that did not come to its end had moved a simulation.
    Moved(String),
}

/// Where a simulation that a variable holds is.
#[derive(Clone, Debug, PartialEq)]
pub struct Whereabouts {
    variable: String,
    time: f64,
    steps: usize,
}

/// The inputs that worked, in their order.
#[derive(Clone, Debug, Default)]
pub struct Record {
    entries: Vec<Entry>,
}

impl Record {
    /// Adds an input without a value.
    pub fn worked(&mut self, text: &str) {
        self.entries.push(Entry::Statements(text.trim().to_owned()));
    }

    /// Adds an input with a value.
    pub fn answered(&mut self, text: &str) {
        self.entries.push(Entry::Expression(text.trim().to_owned()));
    }

    /// Adds what an input that failed has done to the simulations of variables, given where they were before.
    pub fn failed(&mut self, before: &[Whereabouts], scope: &Scope) {
        let after = whereabouts(scope);
        for now in after {
            let was = before.iter().find(|was| was.variable == now.variable);
            let Some(was) = was.filter(|was| was.steps != now.steps) else { continue };
            let method = if now.time > was.time { "run_to" } else { "rewind" };
            let line = format!("{}.{method}({});", now.variable, format_number(now.time));
            self.entries.push(Entry::Moved(line));
        }
    }

    /// The script.
    pub fn script(&self) -> String {
        let asked = self.entries.iter().map(|entry| mentions_answer(entry.text()));
        let asked: Vec<bool> = asked.collect();
        let mut text = format!("{HEADER}\n\n");
        for (index, entry) in self.entries.iter().enumerate() {
            // A value is asked for until the next one takes its place.
            let later = || self.entries[index + 1..].iter().zip(&asked[index + 1..]);
            let next = later().position(|(entry, _)| matches!(entry, Entry::Expression(_)));
            let is_asked = || {
                let reach = next.map_or(usize::MAX, |next| next + 1);
                later().take(reach).any(|(_, asked)| *asked)
            };
            let line = match entry {
                Entry::Statements(statements) => terminated(statements),
                Entry::Expression(expression) if is_asked() => answering(expression),
                Entry::Expression(expression) => terminated(expression),
                Entry::Moved(line) => format!("// An input was stopped here.\n{line}"),
            };
            let line = self.without_redefined(index, line);
            // Writing to a text cannot fail.
            let _ = writeln!(text, "{line}");
        }
        text
    }

    /// Names of functions that were defined more than once: in a script only one of each can stand.
    pub fn redefined(&self) -> Vec<String> {
        let mut seen = Vec::new();
        let mut twice = Vec::new();
        for definition in self.entries.iter().flat_map(|entry| definitions(entry.text())) {
            if seen.contains(&definition.signature) && !twice.contains(&definition.signature.0) {
                twice.push(definition.signature.0.clone());
            }
            seen.push(definition.signature);
        }
        twice
    }

    /// A line of the script without the functions that a later input defines again.
    fn without_redefined(&self, index: usize, line: String) -> String {
        let later: Vec<(String, usize)> = self.entries[index + 1..]
            .iter()
            .flat_map(|entry| definitions(entry.text()))
            .map(|definition| definition.signature)
            .collect();
        let replaced = definitions(&line).into_iter().rev();
        let mut line = line;
        for definition in replaced.filter(|definition| later.contains(&definition.signature)) {
            let name = &definition.signature.0;
            let note = format!("/* {name} is defined anew below */");
            line.replace_range(definition.bytes, &note);
        }
        line
    }
}

impl Entry {
    fn text(&self) -> &str {
        match self {
            Self::Statements(text) | Self::Expression(text) | Self::Moved(text) => text,
        }
    }
}

/// Where the simulations are that variables hold.
pub fn whereabouts(scope: &Scope) -> Vec<Whereabouts> {
    let held = scope.iter_raw().filter_map(|(name, _, value)| {
        let handle = value.read_lock::<SimulationHandle>()?;
        let steps = handle.simulation().counts().steps;
        Some(Whereabouts { variable: name.to_owned(), time: handle.time(), steps })
    });
    held.collect()
}

fn mentions_answer(text: &str) -> bool {
    tokens(text)
        .iter()
        .any(|(token, _)| matches!(token, Token::Identifier(name) if name.as_str() == ANSWER))
}

/// The statements with a semicolon at their end, which comments may follow.
fn terminated(statements: &str) -> String {
    let tokens = tokens(statements);
    let is_closed = match tokens.last() {
        None | Some((Token::SemiColon, _)) => true,
        Some((Token::RightBrace, _)) => {
            matches!(
                tokens[0].0,
                Token::Fn | Token::If | Token::For | Token::While | Token::Loop | Token::Private
            )
        }
        Some(_) => false,
    };
    match (is_closed, statements.lines().last().is_some_and(|last| last.contains("//"))) {
        (true, _) => statements.to_owned(),
        (false, true) => format!("{statements}\n;"),
        (false, false) => format!("{statements};"),
    }
}

/// The statements, the last of them an expression whose value becomes a variable.
fn answering(statements: &str) -> String {
    let program = Program::named("", statements);
    let mut depth = 0_usize;
    let mut last = 0;
    let mut is_start = true;
    for (token, position) in tokens(statements) {
        let at = program.offset(position.line().unwrap_or(1), position.position().unwrap_or(1));
        if is_start && depth == 0 {
            last = at;
        }
        is_start = matches!(token, Token::SemiColon);
        match token {
            Token::LeftBrace | Token::MapStart | Token::LeftParen | Token::LeftBracket => {
                depth += 1
            }
            Token::RightBrace | Token::RightParen | Token::RightBracket => {
                depth = depth.saturating_sub(1)
            }
            _ => (),
        }
    }
    let (before, expression) = statements.split_at(last);
    terminated(&format!("{before}let {ANSWER} = {expression}"))
}

/// A function definition in a text.
struct Definition {
    /// Name and number of parameters.
    signature: (String, usize),
    bytes: std::ops::Range<usize>,
}

fn definitions(text: &str) -> Vec<Definition> {
    let program = Program::named("", text);
    let tokens = tokens(text);
    let offset = |index: usize| {
        let position = tokens[index].1;
        program.offset(position.line().unwrap_or(1), position.position().unwrap_or(1))
    };
    let starts = (0..tokens.len()).filter(|index| matches!(tokens[*index].0, Token::Fn));
    let definition = |start: usize| {
        let Some((Token::Identifier(name), _)) = tokens.get(start + 1) else { return None };
        let body =
            (start..tokens.len()).find(|index| matches!(tokens[*index].0, Token::LeftBrace))?;
        let identifiers = tokens[start + 2..body].iter();
        let parameters =
            identifiers.filter(|(token, _)| matches!(token, Token::Identifier(_))).count();
        let mut depth = 0_usize;
        let end = (body..tokens.len()).find(|index| {
            match tokens[*index].0 {
                Token::LeftBrace | Token::MapStart => depth += 1,
                Token::RightBrace => depth -= 1,
                _ => (),
            }
            depth == 0
        })?;
        let bytes = offset(start)..offset(end) + 1;
        Some(Definition { signature: (name.to_string(), parameters), bytes })
    };
    starts.filter_map(definition).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn script(record: &Record) -> String {
        record.script().lines().skip(2).collect::<Vec<_>>().join("\n")
    }

    #[test]
    fn inputs_become_statements() {
        let mut record = Record::default();
        record.worked("let a = 1;");
        record.worked("let b = 2");
        record.answered("a + b // three");
        record.worked("fn f(x) { x }");
        record.answered("#{ a: 1 }");
        assert_eq!(
            script(&record),
            "let a = 1;\nlet b = 2;\na + b // three\n;\nfn f(x) { x }\n#{ a: 1 };"
        );
    }

    #[test]
    fn a_value_gets_its_name_where_it_is_asked_for_later() {
        let mut record = Record::default();
        record.answered("1 + 1");
        record.answered("let c = 3; f(c, #{ a: 1; })");
        record.worked("let b = ans;");
        record.answered("7");
        assert_eq!(
            script(&record),
            "1 + 1;\nlet c = 3; let ans = f(c, #{ a: 1; });\nlet b = ans;\n7;"
        );
    }

    #[test]
    fn only_the_last_definition_of_a_function_stands() {
        let mut record = Record::default();
        record.worked("fn f(x) { if x { 1 } else { 2 } } let a = 1;");
        record.worked("fn f(x, y) { 0 }");
        record.worked("fn f(z) { 3 }");
        assert_eq!(record.redefined(), ["f"]);
        assert_eq!(
            script(&record),
            "/* f is defined anew below */ let a = 1;\nfn f(x, y) { 0 }\nfn f(z) { 3 }"
        );
    }
}
