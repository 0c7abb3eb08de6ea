//! What can stand after the dot of a value.

use super::candidates::Candidate;
use super::surroundings::{Surroundings, Variable};
use super::types::family;
use crate::script::rows::kind::Kind;
use crate::script::rows::table::{Form, Row};
use crate::script::source::keywords::built_in;

/// The members of a value of type `of`, as candidates. Of an unknown type all members of all types are offered once something is typed; of a
/// map held by a variable its keys.
pub fn members(
    of: Option<&str>,
    variable: Option<&Variable>,
    typed: &str,
    surroundings: &Surroundings,
) -> Vec<Candidate> {
    let catalog = &surroundings.catalog;
    let Some(of) = of else {
        let all = catalog.rows().filter(|row| !typed.is_empty() && row.receiver().is_some());
        return all.map(|row| Candidate::row(row, 0)).collect();
    };
    let own = catalog.members(of).into_iter().map(|row| Candidate::row(row, 0));
    let functions =
        catalog.rows().filter(|row| takes_first(row, of)).map(|row| Candidate::row(row, 1));
    let engine = built_in(family(of)).iter();
    let keys = variable.map_or(&[][..], |map| &map.keys);
    own.chain(functions)
        .chain(engine.map(|(name, arguments, summary)| Candidate::call(name, arguments, summary)))
        .chain(keys.iter().filter(|key| is_plain(key)).map(|key| Candidate::word(key, "a key")))
        .collect()
}

/// Whether a function is about values of a type, so that it may be written as a method of them.
fn takes_first(row: &Row, of: &str) -> bool {
    let first = row.parameters.first().filter(|_| matches!(row.form, Form::Function));
    first.is_some_and(|parameter| match parameter.kind {
        Kind::Object(first) => first.name() == of,
        Kind::Point => of == "vector",
        _ => false,
    })
}

/// Whether a key can be written after a dot.
fn is_plain(key: &str) -> bool {
    key.chars().all(crate::script::source::scanner::is_name)
        && !key.starts_with(|letter: char| letter.is_numeric())
}
