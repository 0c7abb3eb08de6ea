//! Parameters that a call expects at the cursor.

use super::input::{CalleeName, Input, OpenBracket};
use super::surroundings::CompletionContext;
use super::types::Types;
use crate::script::bindings::built_in::{BuiltIn, FunctionForm, NameSuffix};
use crate::script::bindings::kind::Kind;
use crate::script::bindings::parameter::Parameter;
use crate::script::bindings::table::{CallSyntax, FunctionBinding};
use crate::script::source::scanner::Bracket;

/// Open brackets at the cursor, which determine the expected parameters.
pub struct Expected<'a, 't> {
    types: Types<'a, 't>,
    levels: Vec<OpenBracket<'t>>,
}

#[derive(Clone, Copy)]
pub struct ActiveCall {
    pub row: &'static FunctionBinding,
    /// Number of parameters before the dot: one for a function that is called like a method, otherwise zero.
    pub before_dot: usize,
}

impl<'a, 't> Expected<'a, 't> {
    pub fn new(input: &'a Input<'t>, surroundings: &'a CompletionContext) -> Self {
        Self { types: Types { input, context: surroundings }, levels: input.levels() }
    }

    pub fn innermost(&self) -> Option<&OpenBracket<'t>> {
        self.levels.last()
    }

    pub fn here(&self) -> Vec<&'static Parameter> {
        self.levels.len().checked_sub(1).map_or_else(Vec::new, |depth| self.at(depth))
    }

    /// Keys of an option map if its bracket is the innermost open bracket at the cursor, otherwise none.
    pub fn keys(&self) -> Vec<&'static Parameter> {
        match self.levels.len().checked_sub(2) {
            Some(outer) if self.levels[outer + 1].bracket == Bracket::Map => keys(&self.at(outer)),
            _ => Vec::new(),
        }
    }

    /// Option keys of a library function, with their descriptions; none unless the cursor is in the option map of such a function.
    pub fn library_keys(&self) -> &'a [(String, String)] {
        let [.., call, map] = self.levels.as_slice() else { return &[] };
        if map.bracket != Bracket::Map || call.bracket != Bracket::Round {
            return &[];
        }
        let modules = &self.types.context.modules;
        let of = self.types.input.callee(call.opener).and_then(|callee| {
            let module =
                modules.iter().find(|module| Some(module.alias.as_str()) == callee.module)?;
            module.functions.iter().find(|function| function.name == callee.name)
        });
        of.map(|function| function.keys.as_slice()).unwrap_or_default()
    }

    /// Innermost call with the cursor among its arguments. Arrays, maps and parentheses around the cursor are skipped.
    pub fn call(&self) -> Option<(OpenBracket<'t>, CalleeName<'t>)> {
        let transparent = |level: &&OpenBracket| {
            matches!(level.bracket, Bracket::Round | Bracket::Square | Bracket::Map)
        };
        let levels = self.levels.iter().rev().take_while(transparent);
        levels.filter_map(|level| Some((*level, self.types.input.callee(level.opener)?))).next()
    }

    pub fn rows(&self, callee: &CalleeName) -> Vec<ActiveCall> {
        if callee.module.is_some() {
            return Vec::new();
        }
        let receiver = callee.receiver.map(|end| self.types.of(end));
        let rows = self.types.context.catalog.named(callee.name);
        let fitting = rows.filter_map(|row| match (row.form, &receiver) {
            (CallSyntax::Function, None) => Some(ActiveCall { row, before_dot: 0 }),
            (CallSyntax::Function, Some(_)) => Some(ActiveCall { row, before_dot: 1 }),
            (CallSyntax::Method(_), Some(None)) => Some(ActiveCall { row, before_dot: 0 }),
            (CallSyntax::Method(of), Some(Some(known))) => {
                (known.type_name() == Some(of.name())).then_some(ActiveCall { row, before_dot: 0 })
            }
            _ => None,
        });
        fitting.collect()
    }

    pub fn built_ins(&self, callee: &CalleeName) -> Vec<(&'static BuiltIn, FunctionForm)> {
        if callee.module.is_some() {
            return Vec::new();
        }
        let receiver = callee.receiver.map(|end| self.types.of(end));
        let fits = |form: &FunctionForm| match (receiver, form.receiver) {
            (None, None) | (Some(None), Some(_)) => true,
            (Some(Some(kind)), Some(_)) => kind.type_name().is_some_and(|of| form.is_of(of)),
            _ => false,
        };
        let known = self.types.context.catalog.built_ins_named(callee.name);
        let forms = known.flat_map(|known| known.written().map(move |form| (known, form)));
        forms.filter(|(_, form)| form.ending != NameSuffix::Property && fits(form)).collect()
    }

    fn at(&self, depth: usize) -> Vec<&'static Parameter> {
        let level = &self.levels[depth];
        let outer = || depth.checked_sub(1).map_or_else(Vec::new, |outer| self.at(outer));
        match (level.bracket, level.key) {
            (Bracket::Round, _) => {
                let callee = self.types.input.callee(level.opener);
                let rows = callee.map(|callee| self.rows(&callee)).unwrap_or_default();
                let parameter = |called: ActiveCall| {
                    called.row.parameters.get(level.commas + called.before_dot)
                };
                rows.into_iter().filter_map(parameter).collect()
            }
            (Bracket::Map, Some(name)) => {
                keys(&outer()).into_iter().filter(|key| key.name == name).collect()
            }
            (Bracket::Square, _) => outer(),
            _ => Vec::new(),
        }
    }
}

fn keys(parameters: &[&'static Parameter]) -> Vec<&'static Parameter> {
    let options = |kind: &'static Kind| match kind {
        Kind::Options(keys) => *keys,
        _ => &[],
    };
    parameters.iter().flat_map(|parameter| kinds(&parameter.kind)).flat_map(options).collect()
}

/// Types that a value of type `kind` may have: the alternatives of a union, otherwise the type itself.
pub fn kinds(kind: &'static Kind) -> &'static [Kind] {
    match kind {
        Kind::Either(kinds) => kinds,
        kind => std::slice::from_ref(kind),
    }
}

#[cfg(test)]
mod tests {
    use super::super::samples::surroundings;
    use super::*;

    fn names(text: &str, read: fn(&Expected) -> Vec<&'static Parameter>) -> Vec<&'static str> {
        let (input, surroundings) = (Input::before(text, text.len()), surroundings());
        read(&Expected::new(&input, &surroundings))
            .into_iter()
            .map(|parameter| parameter.name)
            .collect()
    }

    #[test]
    fn the_parameter_at_the_cursor_is_found() {
        assert_eq!(names("line([0, 0], ", |at| at.here()), ["to"]);
        assert_eq!(names("sim.run_to(", |at| at.here()), ["t"]);
        assert_eq!(names("plot_history(sim, [\"t\", ", |at| at.here()), ["columns"]);
        assert_eq!(names("sim.plot_history([", |at| at.here()), ["columns"]);
        assert_eq!(
            names("scene.beam(#{ axis: line([0, 0], [1, 1]), basis: ", |at| at.here()),
            ["basis"]
        );
        assert!(names("swing(", |at| at.here()).is_empty());
        assert!(names("line([0, 0], [1, 1])", |at| at.here()).is_empty());
    }

    #[test]
    fn the_keys_of_an_option_map_are_those_of_its_call() {
        assert_eq!(
            names("scene.start(#{", |at| at.keys()),
            ["dt", "integrator", "name", "record", "snapshots", "notes"]
        );
        assert!(names("let m = #{", |at| at.keys()).is_empty());
        assert!(names("scene.start(", |at| at.keys()).is_empty());
    }
}
