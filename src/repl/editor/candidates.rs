//! Completion candidates, compared with the typed text.

use crate::script::bindings::built_in::{BuiltIn, FunctionForm, NameSuffix};
use crate::script::bindings::parameter::Parameter;
use crate::script::bindings::table::{CallSyntax, FunctionBinding};

#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct Candidate {
    pub display: String,
    pub replacement: String,
    pub summary: String,
}

impl Candidate {
    pub fn word(word: &str, summary: &str) -> Self {
        Self { display: word.to_owned(), replacement: word.to_owned(), summary: summary.to_owned() }
    }

    /// Candidate for a function, displayed with its arguments, such as `(from, to)`.
    /// It inserts the opening parenthesis, and also the closing one for a function without arguments.
    pub fn call(name: &str, arguments: &str, summary: &str) -> Self {
        let brackets = if arguments == "()" { "()" } else { "(" };
        Self {
            display: format!("{name}{arguments}"),
            replacement: format!("{name}{brackets}"),
            summary: summary.to_owned(),
        }
    }

    /// Candidate for a function or property of the language. Its first `before_dot` parameters are before the dot of a method call.
    pub fn row(row: &'static FunctionBinding, before_dot: usize) -> Self {
        match row.form {
            CallSyntax::Property(_) | CallSyntax::Operator => Self::word(row.name, row.summary),
            CallSyntax::Function | CallSyntax::Method(_) => {
                let rest = row.parameters.get(before_dot..).unwrap_or_default();
                Self::call(row.name, &arguments(rest), row.summary)
            }
        }
    }

    pub fn built_in((known, form): (&'static BuiltIn, FunctionForm)) -> Self {
        match form.ending {
            NameSuffix::Property => Self::word(form.name, known.summary),
            NameSuffix::Arguments | NameSuffix::Repeated => {
                Self::call(form.name, form.arguments, known.summary)
            }
        }
    }

    pub fn key(key: &Parameter) -> Self {
        let summary = match key.doc {
            "" => key.expectation(),
            doc => format!("{}; {doc}", key.expectation()),
        };
        Self { display: key.name.to_owned(), replacement: format!("{}: ", key.name), summary }
    }

    pub fn option_candidate(name: &str, about: &str) -> Self {
        Self {
            display: name.to_owned(),
            replacement: format!("{name}: "),
            summary: about.to_owned(),
        }
    }

    fn name(&self) -> &str {
        self.replacement.trim_end_matches(['(', ')', ':', ' '])
    }
}

fn arguments(parameters: &[Parameter]) -> String {
    format!("({})", parameters.iter().map(written).collect::<Vec<_>>().join(", "))
}

/// Name of a parameter in a signature, in brackets if the parameter is optional.
pub fn written(parameter: &Parameter) -> String {
    match parameter.is_required() {
        true => parameter.name.to_owned(),
        false => format!("[{}]", parameter.name),
    }
}

/// Candidates that begin with `typed`, sorted and without duplicates.
/// If no candidate begins with `typed`, the candidates that contain its letters in the same order, in either case, are returned.
pub fn fitting(typed: &str, candidates: impl IntoIterator<Item = Candidate>) -> Vec<Candidate> {
    let mut all: Vec<Candidate> = candidates.into_iter().collect();
    all.sort_by_key(|candidate| (candidate.name().to_lowercase(), candidate.clone()));
    all.dedup_by(|later, earlier| later.replacement == earlier.replacement);
    let is_prefix = |candidate: &Candidate| candidate.name().starts_with(typed);
    match all.iter().any(is_prefix) {
        true => all.retain(is_prefix),
        false => all.retain(|candidate| is_subsequence(candidate.name(), typed)),
    }
    all
}

fn is_subsequence(name: &str, typed: &str) -> bool {
    let mut letters = name.chars().flat_map(char::to_lowercase);
    let mut wanted = typed.chars().flat_map(char::to_lowercase);
    match wanted.next() {
        Some(first) => {
            letters.next() == Some(first)
                && wanted.all(|letter| letters.any(|other| other == letter))
        }
        None => true,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn names(typed: &str) -> Vec<String> {
        let words = ["plot_motion", "plot_history", "polar", "EI", "plot_history"];
        let candidates = words.map(|word| Candidate::word(word, ""));
        fitting(typed, candidates).into_iter().map(|candidate| candidate.replacement).collect()
    }

    #[test]
    fn prefix_matches_precede_abbreviations() {
        assert_eq!(names("plot"), ["plot_history", "plot_motion"]);
        assert_eq!(names("ph"), ["plot_history"]);
        assert_eq!(names("ei"), ["EI"]);
        assert_eq!(names("motion"), Vec::<String>::new());
        assert_eq!(names(""), ["EI", "plot_history", "plot_motion", "polar"]);
    }

    #[test]
    fn completed_calls_include_their_brackets() {
        assert_eq!(Candidate::call("step", "([count])", "").replacement, "step(");
        assert_eq!(Candidate::call("energy_momentum", "()", "").replacement, "energy_momentum()");
    }
}
