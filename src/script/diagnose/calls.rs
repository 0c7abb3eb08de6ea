//! Calls and properties that do not exist: what does, how it is written, and which name was meant.

use rhai::{Engine, Position};

use super::outline::Outline;
use super::translate::type_word;
use crate::script::catalog::Catalog;
use crate::script::kind::with_article;
use crate::script::operators;
use crate::script::program::Program;
use crate::script::suggest::nearest;
use crate::script::table::{Form, Row};

/// What is known, to be held against what was asked for.
pub struct Unknown<'a> {
    pub catalog: &'a Catalog,
    pub engine: &'a Engine,
    pub program: &'a Program,
    pub outline: &'a Outline,
}

type Words = (String, Option<String>);

impl Unknown<'_> {
    /// For the engine's "Function not found: name (types)".
    pub fn function(&self, signature: &str, at: Position) -> Words {
        let (name, types) = signature.split_once(" (").unwrap_or((signature, ")"));
        let types: Vec<&str> = types
            .trim_end_matches(')')
            .split(", ")
            .filter(|t| !t.is_empty())
            .map(type_word)
            .collect();
        if !name.starts_with(|c: char| c.is_alphabetic() || c == '_')
            || operators::written(name) != name
        {
            return self.operator(operators::written(name), &types);
        }
        let rows: Vec<_> = self.catalog.named(name).collect();
        let of_receiver = rows
            .iter()
            .find(|row| matches!(row.form, Form::Method(of) if types.first() == Some(&of.name())));
        if let Some(row) = of_receiver {
            return wrong_count(row, types.len() - 1);
        }
        if let Some(row) = rows.iter().find(|row| matches!(row.form, Form::Function)) {
            return wrong_count(row, types.len());
        }
        if let Some((_, count)) = self.outline.functions.iter().find(|(known, _)| known == name) {
            return (format!("{name} takes {}, got {}", arguments(*count), types.len()), None);
        }
        self.unknown_name(name, &types, &rows, self.is_dotted(at))
    }

    fn unknown_name(&self, name: &str, types: &[&str], rows: &[&Row], dotted: bool) -> Words {
        let receiver = types.first().filter(|_| dotted);
        let message = match receiver {
            Some(receiver) => format!("{} has no method '{name}'", with_article(receiver)),
            None => format!("there is no function '{name}'"),
        };
        if let Some(row) = rows.first() {
            let owner = row.receiver().map_or("an operand", |of| of.name());
            return (
                message,
                Some(format!("'{name}' belongs to {}: {}", with_article(owner), row.signature())),
            );
        }
        if self.built_in().any(|known| known == name) {
            let got = types.iter().map(|name| with_article(name)).collect::<Vec<_>>().join(", ");
            return (format!("{name} cannot be called with ({got})"), None);
        }
        if self.outline.variables.iter().any(|known| known == name) {
            return (
                message,
                Some(format!("the function in the variable '{name}' is called by {name}.call(…)")),
            );
        }
        let members = receiver.map(|of| self.catalog.members(of)).unwrap_or_default();
        let mut known: Vec<String> = members.iter().map(|row| row.name.to_owned()).collect();
        known.extend(self.catalog.function_names().map(str::to_owned));
        known.extend(self.outline.functions.iter().map(|(name, _)| name.clone()));
        known.extend(self.built_in());
        let hint = nearest(name, known.iter().map(String::as_str))
            .map(|near| self.did_you_mean(near, receiver));
        (message, hint.or_else(|| list(&members)))
    }

    fn did_you_mean(&self, near: &str, receiver: Option<&&str>) -> String {
        let mut rows = self.catalog.named(near);
        let row = match receiver {
            Some(of) => self
                .catalog
                .members(of)
                .into_iter()
                .find(|row| row.name == near)
                .or_else(|| rows.next()),
            None => rows.find(|row| matches!(row.form, Form::Function)),
        };
        match row {
            Some(row) => format!("did you mean '{near}'? {}", row.signature()),
            None => format!("did you mean '{near}'?"),
        }
    }

    /// For the engine's "Unknown property 'p' - … for type 't'" and "No writable property 'p' - …".
    pub fn property(&self, text: &str) -> Words {
        let mut quoted = text.split('\'').skip(1).step_by(2);
        let (Some(name), Some(of)) = (quoted.next(), quoted.next().map(type_word)) else {
            return (text.to_owned(), None);
        };
        let owner = with_article(of);
        let members = self.catalog.members(of);
        if text.starts_with("No writable") && members.iter().any(|row| row.name == name) {
            return (format!("'{name}' of {owner} cannot be assigned"), None);
        }
        let message = format!("{owner} has no property '{name}'");
        if let Some(row) =
            members.iter().copied().chain(self.catalog.named(name)).find(|row| row.name == name)
        {
            return (
                message,
                Some(format!("'{name}' is called with parentheses: {}", row.signature())),
            );
        }
        let near = nearest(name, members.iter().map(|row| row.name));
        (message, near.map(|near| self.did_you_mean(near, Some(&of))).or_else(|| list(&members)))
    }

    fn operator(&self, symbol: &str, types: &[&str]) -> Words {
        let words: Vec<_> = types.iter().map(|name| with_article(name)).collect();
        let message = match (symbol, words.as_slice()) {
            ("<" | ">" | "<=" | ">=" | "==" | "!=", [left, right]) => {
                format!("cannot compare {left} with {right} using {symbol}")
            }
            (_, [left, right]) => format!("{symbol} does not work on {left} and {right}"),
            (_, [operand]) => format!("{symbol} does not work on {operand}"),
            _ => format!("{symbol} does not work here"),
        };
        let needs_number =
            types.contains(&"text") && types.iter().any(|name| name.ends_with("number"));
        let hint = needs_number.then(|| "parse_float(text) makes a number of a text".to_owned());
        (message, hint)
    }

    /// Whether the name at this position stands after a dot.
    fn is_dotted(&self, at: Position) -> bool {
        let (Some(line), Some(column)) = (at.line(), at.position()) else { return false };
        self.program.text[..self.program.offset(line, column)].trim_end().ends_with('.')
    }

    /// Names of Rhai's own functions.
    fn built_in(&self) -> impl Iterator<Item = String> {
        let signatures = self.engine.gen_fn_signatures(true);
        signatures.into_iter().filter_map(|signature| {
            let name = signature.split('(').next()?.trim().to_owned();
            name.chars().all(|c| c.is_alphanumeric() || c == '_').then_some(name)
        })
    }
}

fn wrong_count(row: &Row, got: usize) -> Words {
    let (least, most) = (row.required(), row.parameters.len());
    let takes =
        if least == most { arguments(most) } else { format!("{least} to {}", arguments(most)) };
    let parameters = row
        .parameters
        .iter()
        .map(|parameter| format!("\n{}: {}", parameter.name, parameter.expectation()));
    let hint = format!("write {}{}", row.signature(), parameters.collect::<String>());
    (format!("{} takes {takes}, got {got}", row.name), Some(hint))
}

fn arguments(count: usize) -> String {
    match count {
        0 => "no arguments".into(),
        1 => "1 argument".into(),
        _ => format!("{count} arguments"),
    }
}

fn list(members: &[&'static Row]) -> Option<String> {
    let names: Vec<_> = members.iter().map(|row| row.name).collect();
    (!names.is_empty()).then(|| format!("it has {}", names.join(", ")))
}
