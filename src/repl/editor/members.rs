//! Completion of members after a dot.

use super::candidates::Candidate;
use super::surroundings::{CompletionContext, Variable};
use crate::script::bindings::kind::Kind;
use crate::script::bindings::returns::ValueKind;
use crate::script::bindings::table::{CallSyntax, FunctionBinding};
use crate::script::source::scanner::is_name;

/// Completion candidates for the members of a value, and for the keys of a map in a variable.
/// For a value of unknown type, members of all types are returned that match the typed part of a name.
pub fn members(
    of: Option<ValueKind>,
    variable: Option<&Variable>,
    typed: &str,
    surroundings: &CompletionContext,
) -> Vec<Candidate> {
    let catalog = &surroundings.catalog;
    let Some(of) = of.and_then(|kind| kind.type_name()) else {
        return if typed.is_empty() { Vec::new() } else { all_members(surroundings) };
    };
    let own = catalog.members(of).into_iter().map(|row| Candidate::row(row, 0));
    let functions =
        catalog.rows().filter(|row| takes_first(row, of)).map(|row| Candidate::row(row, 1));
    let built_ins = catalog.built_in_members(of).map(Candidate::built_in);
    let keys = variable.map_or(&[][..], |map| &map.keys);
    own.chain(functions)
        .chain(built_ins)
        .chain(keys.iter().filter(|key| is_plain(key)).map(|key| Candidate::word(key, "a key")))
        .collect()
}

fn all_members(surroundings: &CompletionContext) -> Vec<Candidate> {
    let catalog = &surroundings.catalog;
    let own = catalog.rows().filter(|row| row.receiver().is_some());
    let built_ins = catalog.built_ins().filter_map(|known| {
        let form = known.written().find(|form| form.receiver.is_some())?;
        Some((known, form))
    });
    own.map(|row| Candidate::row(row, 0)).chain(built_ins.map(Candidate::built_in)).collect()
}

fn takes_first(row: &FunctionBinding, of: &str) -> bool {
    let first = row.parameters.first().filter(|_| matches!(row.form, CallSyntax::Function));
    first.is_some_and(|parameter| match parameter.kind {
        Kind::Object(first) => first.name() == of,
        Kind::Point => of == "vector",
        Kind::Array | Kind::Numbers | Kind::Points => of == "array",
        _ => false,
    })
}

fn is_plain(key: &str) -> bool {
    key.chars().all(is_name) && !key.starts_with(|letter: char| letter.is_numeric())
}

#[cfg(test)]
mod tests {
    use std::collections::BTreeSet;

    use super::super::samples::surroundings;
    use super::*;

    fn offered_and_known(of: &str) -> (BTreeSet<String>, BTreeSet<String>) {
        let surroundings = surroundings();
        let catalog = &surroundings.catalog;
        let kind = catalog.kind_named(of).expect("a kind");
        let bare = |name: &str| name.trim_end_matches(['(', ')']).to_owned();
        let offered = members(Some(kind), None, "", &surroundings);
        let offered = offered.iter().map(|candidate| bare(&candidate.replacement)).collect();
        let rows = catalog.members(of).into_iter().map(|row| row.name.to_owned());
        let functions = catalog.rows().filter(|row| takes_first(row, of));
        let built_ins = catalog.built_ins().filter(|known| known.is_of(of));
        let known = rows
            .chain(functions.map(|row| row.name.to_owned()))
            .chain(built_ins.map(|known| known.name().to_owned()));
        (offered, known.collect())
    }

    #[test]
    fn offered_members_equal_those_of_the_catalogue() {
        let surroundings = surroundings();
        let ours = surroundings.catalog.tables().flat_map(|table| table.types);
        let plain = ["number", "whole number", "text", "character", "function", "map", "array"];
        for of in ours.map(|of| of.name()).chain(plain).chain(["timestamp", "truth value", "range"])
        {
            let (offered, known) = offered_and_known(of);
            assert_eq!(offered, known, "{of}");
        }
        let count = |of| offered_and_known(of).0.len();
        assert!(count("array") > 39 && count("text") > 27 && count("map") > 14);
    }

    #[test]
    fn offered_built_in_members_exist_in_the_engine() {
        let engine = crate::script::dialect::foundation::engine();
        let signatures = engine.gen_fn_signatures(true);
        let has = |opening: &str| signatures.iter().any(|known| known.starts_with(opening));
        for of in ["array", "text", "map"] {
            for (known, _) in surroundings().catalog.built_in_members(of) {
                let name = known.name();
                let is_known = has(&format!("{name}(")) || has(&format!("get {name}("));
                assert!(is_known || known.is_of("beam"), "{of}.{name}");
            }
        }
    }
}
