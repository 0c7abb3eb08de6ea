//! Of which type the value before a dot is, as far as can be told without running anything.

use super::input::Input;
use super::surroundings::Surroundings;
use crate::script::rows::table::{Form, Row};
use crate::script::source::keywords;
use crate::script::source::scanner::{Bracket, Kind};

/// Members and calls that are followed in `a.b().c[0].d`.
const LONGEST_CHAIN: usize = 32;

/// Parentheses and declarations that are followed into each other.
const DEEPEST: usize = 16;

/// Finds types of values before the cursor, from tokens, what the session holds, and what rows say that they return.
#[derive(Clone, Copy)]
pub struct Types<'a, 't> {
    /// The input before the cursor.
    pub input: &'a Input<'t>,
    /// The names that the session holds.
    pub surroundings: &'a Surroundings,
}

/// A value with its type, and the token at which it begins.
struct Typed {
    of: Option<String>,
    start: usize,
}

/// The type of the value that `text` ends with, in the words of the language.
pub fn type_before(text: &str, surroundings: &Surroundings) -> Option<String> {
    let input = Input::before(text, text.len());
    let last = input.tokens.len().checked_sub(1)?;
    Types { input: &input, surroundings }.of(last)
}

enum Step<'t> {
    Property(&'t str),
    Call(&'t str),
    Index,
}

impl<'t> Types<'_, 't> {
    /// The type of the value that ends with token `end`.
    pub fn of(&self, end: usize) -> Option<String> {
        self.value(end, 0)?.of
    }

    fn value(&self, end: usize, depth: usize) -> Option<Typed> {
        if depth > DEEPEST {
            return None;
        }
        let mut steps = Vec::new();
        let mut at = end;
        let first = loop {
            if steps.len() > LONGEST_CHAIN {
                return None;
            }
            match self.input.kind(at)? {
                Kind::Text => break Typed { of: Some("text".into()), start: at },
                Kind::Number => break Typed { of: Some("number".into()), start: at },
                Kind::Word => match self.receiver(at) {
                    Some(receiver) => {
                        steps.push(Step::Property(self.input.written(at)));
                        at = receiver;
                    }
                    None => break Typed { of: self.variable(at, depth), start: at },
                },
                Kind::Close(Bracket::Round) => {
                    let opener = self.input.partner(at)?;
                    match self.input.callee(opener) {
                        Some(callee) => match callee.receiver {
                            Some(receiver) => {
                                steps.push(Step::Call(callee.name));
                                at = receiver;
                            }
                            None => {
                                break Typed { of: self.called(callee.name), start: opener - 1 };
                            }
                        },
                        None => break Typed { of: self.group(opener, at, depth), start: opener },
                    }
                }
                Kind::Close(Bracket::Square) => {
                    let opener = self.input.partner(at)?;
                    match opener.checked_sub(1).filter(|before| self.is_value(*before)) {
                        Some(indexed) => {
                            steps.push(Step::Index);
                            at = indexed;
                        }
                        None => break Typed { of: Some("array".into()), start: opener },
                    }
                }
                Kind::Close(Bracket::Curly) => {
                    let opener = self.input.partner(at)?;
                    let is_map = self.input.kind(opener) == Some(Kind::Open(Bracket::Map));
                    break Typed { of: is_map.then(|| "map".into()), start: opener };
                }
                _ => return None,
            }
        };
        let of = steps.iter().rev().try_fold(first.of?, |of, step| self.after(&of, step));
        Some(Typed { of, start: first.start })
    }

    /// The last token of the value whose member is named at token `at`.
    fn receiver(&self, at: usize) -> Option<usize> {
        at.checked_sub(2).filter(|_| self.input.is_dot(at - 1))
    }

    fn is_value(&self, at: usize) -> bool {
        match self.input.kind(at) {
            Some(Kind::Word) => !keywords::is_keyword(self.input.written(at)),
            Some(Kind::Close(_) | Kind::Text) => true,
            _ => false,
        }
    }

    /// The type of `( … )`, if it is one chain of members.
    fn group(&self, opener: usize, closer: usize, depth: usize) -> Option<String> {
        let inside = self.value(closer.checked_sub(1)?, depth + 1)?;
        inside.of.filter(|_| inside.start == opener + 1)
    }

    /// A name: declared in this very input, a variable of the session, a constant of the language.
    fn variable(&self, at: usize, depth: usize) -> Option<String> {
        let name = self.input.written(at);
        if at.checked_sub(1).is_some_and(|before| self.input.written(before) == "::") {
            return None;
        }
        if let Some(declared) = self.declared(name, at, depth) {
            return declared;
        }
        let held = self.surroundings.variable(name).map(|variable| variable.of.clone());
        let mut constants = self.surroundings.catalog.constants();
        held.or_else(|| constants.any(|constant| constant == name).then(|| "number".into()))
    }

    /// What the last `let name = value;` before token `at` declares: `None` if there is none.
    fn declared(&self, name: &str, at: usize, depth: usize) -> Option<Option<String>> {
        let input = self.input;
        let is_declared = |place: &usize| {
            matches!(input.written(place - 1), "let" | "const") && input.written(*place) == name
        };
        let place = (1..at).rev().find(is_declared)?;
        let mut end = place + 2;
        while end < at && input.written(end) != ";" {
            let opens = matches!(input.kind(end), Some(Kind::Open(_)));
            end = input.partner(end).filter(|_| opens).unwrap_or(end) + 1;
        }
        let is_assigned = input.written(place + 1) == "=" && end < at;
        let value = is_assigned.then(|| self.value(end - 1, depth + 1)).flatten();
        Some(value.filter(|value| value.start == place + 2).and_then(|value| value.of))
    }

    fn called(&self, name: &str) -> Option<String> {
        let is_redefined = self.surroundings.functions.iter().any(|function| function.name == name);
        let mut rows = self.surroundings.catalog.named(name);
        let row = rows.find(|row| matches!(row.form, Form::Function)).filter(|_| !is_redefined)?;
        returned(row)
    }

    fn after(&self, of: &str, step: &Step<'t>) -> Option<String> {
        let (name, is_call) = match step {
            Step::Index => return element(of),
            Step::Property(name) => (*name, false),
            Step::Call(name) => (*name, true),
        };
        let members = self.surroundings.catalog.members(of).into_iter();
        let mut matching = members
            .filter(|row| row.name == name && matches!(row.form, Form::Method(_)) == is_call);
        match matching.next() {
            Some(row) => returned(row),
            None if is_call => self.called(name),
            None => None,
        }
    }
}

/// The type that a row gives back, without article, unit and explanation.
fn returned(row: &Row) -> Option<String> {
    let words = row.returns.split(['[', ',', '#']).next()?.trim();
    let of = words.strip_prefix("a ").or_else(|| words.strip_prefix("an ")).unwrap_or(words);
    let of = match of {
        _ if row.returns.starts_with("an array [") => "array",
        "true or false" => "truth value",
        // Of whatever type.
        "value" => return None,
        _ if of.starts_with("map ") => "map",
        _ if of.starts_with("angle ") => "number",
        of => of,
    };
    (!of.is_empty()).then(|| of.to_owned())
}

/// The type of the elements of an array.
fn element(of: &str) -> Option<String> {
    let elements = of.strip_prefix("array of ")?;
    Some(elements.strip_suffix('s').unwrap_or(elements).to_owned())
}

/// The name of the type of arrays when their elements do not matter; of any other type, its name.
pub fn family(of: &str) -> &str {
    if of.starts_with("array") { "array" } else { of }
}

#[cfg(test)]
mod tests {
    use super::super::samples::surroundings;
    use super::*;

    fn type_of(text: &str) -> Option<String> {
        type_before(text, &surroundings())
    }

    #[test]
    fn chains_are_followed_by_what_rows_return() {
        for (text, of) in [
            ("rod", "beam"),
            ("rod.end", "station"),
            ("sim.history", "history"),
            ("sim.history.after(0.5)", "history"),
            ("1 + sim.position(rod.end)", "vector"),
            ("sim.position(rod.end).x", "number"),
            ("line([0, 0], [1, 1])", "curve"),
            ("f(scene.beam(#{ axis: a }))", ""),
            ("(rod.start)", "station"),
            ("sim.history.column(\"t\")", "array of numbers"),
            ("sim.history.column(\"t\")[0]", "number"),
            ("sim.events[0]", "map"),
            ("[1, 2]", "array"),
            ("\"text\"", "text"),
            ("#{ a: 1 }", "map"),
            ("unknown", ""),
            ("lib::f(1)", ""),
            ("PI", "number"),
        ] {
            assert_eq!(type_of(text).unwrap_or_default(), of, "{text}");
        }
    }

    #[test]
    fn what_the_input_itself_declares_comes_first() {
        assert_eq!(type_of("let arm = scene.beam(#{ }); arm").as_deref(), Some("beam"));
        assert_eq!(type_of("let rod = 1; rod").as_deref(), Some("number"));
        assert_eq!(type_of("let rod = 1 + x; rod"), None);
        assert_eq!(type_of("let a = line([0, 0], [1, 1]); let b = a; b").as_deref(), Some("curve"));
        assert_eq!(type_of("let a = a; a"), None);
    }

    #[test]
    fn deep_nesting_is_given_up() {
        let deep = |count: usize| format!("{}rod{}", "(".repeat(count), ")".repeat(count));
        assert_eq!(type_of(&deep(10)).as_deref(), Some("beam"));
        assert_eq!(type_of(&deep(100_000)), None);
        assert_eq!(type_of(&format!("{}a", "let a = a; ".repeat(10_000))), None);
        assert_eq!(type_of(&format!("rod{}", ".end".repeat(10_000))), None);
    }

    #[test]
    fn every_type_that_rows_return_is_known_or_has_no_members() {
        let surroundings = surroundings();
        let catalog = &surroundings.catalog;
        for row in catalog.rows() {
            let Some(of) = returned(row) else { continue };
            let family = family(&of);
            let plain = ["number", "whole number", "truth value", "text", "map", "array"];
            assert!(
                plain.contains(&family) || catalog.type_named(&of).is_some(),
                "{}: {of}",
                row.name
            );
        }
    }
}
