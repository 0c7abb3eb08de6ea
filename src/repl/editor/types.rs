//! Types of values before a dot, derived from the text without evaluation.

use super::input::Input;
use super::surroundings::CompletionContext;
use crate::script::bindings::returns::{Returns, ValueKind};
use crate::script::bindings::table::CallSyntax;
use crate::script::source::keywords;
use crate::script::source::scanner::{Bracket, TokenKind};

/// Largest number of members and calls in a chain such as `a.b().c[0].d` whose type is derived.
const LONGEST_CHAIN: usize = 32;

const DEEPEST: usize = 16;

#[derive(Clone, Copy)]
pub struct Types<'a, 't> {
    pub input: &'a Input<'t>,
    pub context: &'a CompletionContext,
}

struct TypedValue {
    of: Option<ValueKind>,
    start: usize,
}

/// Type of the value at the end of `text`; `None` if unknown.
pub fn type_before(text: &str, surroundings: &CompletionContext) -> Option<ValueKind> {
    let input = Input::before(text, text.len());
    let last = input.tokens.len().checked_sub(1)?;
    Types { input: &input, context: surroundings }.of(last)
}

enum TypeStep<'t> {
    Property(&'t str),
    Call(&'t str),
    Index,
}

impl<'t> Types<'_, 't> {
    /// Type of the value that ends with the token `end`.
    pub fn of(&self, end: usize) -> Option<ValueKind> {
        self.value(end, 0)?.of
    }

    fn value(&self, end: usize, depth: usize) -> Option<TypedValue> {
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
                TokenKind::Text => break TypedValue { of: Some(ValueKind::Text), start: at },
                TokenKind::Number => break TypedValue { of: Some(ValueKind::Number), start: at },
                TokenKind::Word => match self.receiver(at) {
                    Some(receiver) => {
                        steps.push(TypeStep::Property(self.input.written(at)));
                        at = receiver;
                    }
                    None => break TypedValue { of: self.variable(at, depth), start: at },
                },
                TokenKind::Close(Bracket::Round) => {
                    let opener = self.input.partner(at)?;
                    match self.input.callee(opener) {
                        Some(callee) => match callee.receiver {
                            Some(receiver) => {
                                steps.push(TypeStep::Call(callee.name));
                                at = receiver;
                            }
                            None => {
                                break TypedValue {
                                    of: self.called(callee.name),
                                    start: opener - 1,
                                };
                            }
                        },
                        None => {
                            break TypedValue { of: self.group(opener, at, depth), start: opener };
                        }
                    }
                }
                TokenKind::Close(Bracket::Square) => {
                    let opener = self.input.partner(at)?;
                    match opener.checked_sub(1).filter(|before| self.is_value(*before)) {
                        Some(indexed) => {
                            steps.push(TypeStep::Index);
                            at = indexed;
                        }
                        None => break TypedValue { of: Some(ValueKind::ARRAY), start: opener },
                    }
                }
                TokenKind::Close(Bracket::Curly) => {
                    let opener = self.input.partner(at)?;
                    let is_map = self.input.kind(opener) == Some(TokenKind::Open(Bracket::Map));
                    break TypedValue { of: is_map.then_some(ValueKind::Map), start: opener };
                }
                _ => return None,
            }
        };
        let of = steps.iter().rev().try_fold(first.of?, |of, step| self.after(of, step));
        Some(TypedValue { of, start: first.start })
    }

    fn receiver(&self, at: usize) -> Option<usize> {
        at.checked_sub(2).filter(|_| self.input.is_dot(at - 1))
    }

    fn is_value(&self, at: usize) -> bool {
        match self.input.kind(at) {
            Some(TokenKind::Word) => !keywords::is_keyword(self.input.written(at)),
            Some(TokenKind::Close(_) | TokenKind::Text) => true,
            _ => false,
        }
    }

    fn group(&self, opener: usize, closer: usize, depth: usize) -> Option<ValueKind> {
        let inside = self.value(closer.checked_sub(1)?, depth + 1)?;
        inside.of.filter(|_| inside.start == opener + 1)
    }

    fn variable(&self, at: usize, depth: usize) -> Option<ValueKind> {
        let name = self.input.written(at);
        if at.checked_sub(1).is_some_and(|before| self.input.written(before) == "::") {
            return None;
        }
        if let Some(declared) = self.declared(name, at, depth) {
            return declared;
        }
        let catalog = &self.context.catalog;
        match self.context.variable(name) {
            Some(variable) => catalog.kind_named(&variable.of),
            None => catalog.constants().any(|known| known == name).then_some(ValueKind::Number),
        }
    }

    /// Type of the value in the last statement `let name = value;` before the token `at`.
    /// The outer option is `None` if `name` is not declared, and the inner option if the type of its value is unknown.
    fn declared(&self, name: &str, at: usize, depth: usize) -> Option<Option<ValueKind>> {
        let input = self.input;
        let is_declared = |place: &usize| {
            matches!(input.written(place - 1), "let" | "const") && input.written(*place) == name
        };
        let place = (1..at).rev().find(is_declared)?;
        let mut end = place + 2;
        while end < at && input.written(end) != ";" {
            let opens = matches!(input.kind(end), Some(TokenKind::Open(_)));
            end = input.partner(end).filter(|_| opens).unwrap_or(end) + 1;
        }
        let is_assigned = input.written(place + 1) == "=" && end < at;
        let value = is_assigned.then(|| self.value(end - 1, depth + 1)).flatten();
        Some(value.filter(|value| value.start == place + 2).and_then(|value| value.of))
    }

    fn called(&self, name: &str) -> Option<ValueKind> {
        if self.context.functions.iter().any(|function| function.name == name) {
            return None;
        }
        let catalog = &self.context.catalog;
        let mut rows = catalog.named(name).filter(|row| matches!(row.form, CallSyntax::Function));
        let mut built_ins = catalog.built_ins_named(name);
        let row = rows.next().map(|row| row.returns);
        known(row.or_else(|| built_ins.find(|of| of.is_function()).map(|of| of.returns))?)
    }

    fn after(&self, of: ValueKind, step: &TypeStep<'t>) -> Option<ValueKind> {
        let (name, is_call) = match step {
            TypeStep::Index => return known(Returns::of(of.element()?)),
            TypeStep::Property(name) => (*name, false),
            TypeStep::Call(name) => (*name, true),
        };
        let of = of.type_name()?;
        let catalog = &self.context.catalog;
        let members = catalog.members(of).into_iter();
        let mut matching = members
            .filter(|row| row.name == name && matches!(row.form, CallSyntax::Method(_)) == is_call);
        let mut built_ins = catalog.built_ins_named(name).filter(|known| known.is_of(of));
        let row = matching.next().map(|row| row.returns);
        match row.or_else(|| built_ins.next().map(|of| of.returns)) {
            Some(returns) => known(returns),
            None if is_call => self.called(name),
            None => None,
        }
    }
}

fn known(returns: Returns) -> Option<ValueKind> {
    Some(returns.kind.likely()).filter(|kind| kind.type_name().is_some())
}

#[cfg(test)]
mod tests {
    use super::super::samples::surroundings;
    use super::*;

    fn type_of(text: &str) -> Option<&'static str> {
        type_before(text, &surroundings()).and_then(|kind| kind.type_name())
    }

    #[test]
    fn types_of_member_chains_follow_declared_return_types() {
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
            ("sim.history.column(\"t\")", "array"),
            ("sim.history.column(\"t\")[0]", "number"),
            ("sim.events[0]", "map"),
            ("[1, 2]", "array"),
            ("[1, 2].len", "whole number"),
            ("\"a b\".split(\" \")", "array"),
            ("sim.history.column(\"t\").map(|t| 2 * t)", "array"),
            ("parse_int(\"3\")", "whole number"),
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
    fn declarations_in_the_input_precede_session_variables() {
        assert_eq!(type_of("let arm = scene.beam(#{ }); arm"), Some("beam"));
        assert_eq!(type_of("let rod = 1; rod"), Some("number"));
        assert_eq!(type_of("let rod = 1 + x; rod"), None);
        assert_eq!(type_of("let a = line([0, 0], [1, 1]); let b = a; b"), Some("curve"));
        assert_eq!(type_of("let a = a; a"), None);
    }

    #[test]
    fn types_of_deeply_nested_expressions_are_unknown() {
        let deep = |count: usize| format!("{}rod{}", "(".repeat(count), ")".repeat(count));
        assert_eq!(type_of(&deep(10)), Some("beam"));
        assert_eq!(type_of(&deep(100_000)), None);
        assert_eq!(type_of(&format!("{}a", "let a = a; ".repeat(10_000))), None);
        assert_eq!(type_of(&format!("rod{}", ".end".repeat(10_000))), None);
    }

    #[test]
    fn every_return_type_of_the_catalogue_is_known() {
        let catalog = surroundings().catalog;
        let built_ins = catalog.built_ins().map(|known| (known.name(), known.returns));
        for (name, returns) in catalog.rows().map(|row| (row.name, row.returns)).chain(built_ins) {
            let Some(of) = known(returns).and_then(|kind| kind.type_name()) else { continue };
            assert!(catalog.kind_named(of).is_some(), "{name}: {of}");
        }
    }
}
