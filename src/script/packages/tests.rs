//! Tests of all binding tables: every binding is documented, its name is valid, and its example runs.

use std::collections::HashSet;

use super::{TABLES, language};
use crate::script::bindings::kind::Kind;
use crate::script::bindings::parameter::Parameter;
use crate::script::bindings::table::{CallSyntax, FunctionBinding};
use crate::script::engine::runner::{Ending, run};
use crate::script::source::program::Program;
use crate::script::state::settings::{RunMode, RunSettings};

fn rows() -> impl Iterator<Item = &'static FunctionBinding> {
    TABLES.iter().flat_map(|table| table.rows)
}

#[test]
fn every_row_has_a_summary_and_an_example() {
    for row in rows() {
        assert!(row.summary.ends_with('.'), "{}: the summary is a sentence", row.signature());
        assert!(!row.example.is_empty(), "{}: an example is missing", row.signature());
    }
}

#[test]
fn every_row_example_runs() {
    for (table, row) in
        TABLES.iter().flat_map(|table| table.rows.iter().map(move |row| (table, row)))
    {
        let program =
            Program::named(&row.signature(), &format!("{}\n{}", table.setup, row.example));
        let outcome = run(&program, &language(), RunSettings::silent(RunMode::Run));
        assert!(matches!(outcome.ending, Ending::Finished), "{:?}", outcome.ending);
        assert_eq!(outcome.checks.failed(), [], "{}", row.signature());
    }
}

#[test]
fn optional_parameters_are_last() {
    for row in rows() {
        let required =
            row.parameters.iter().take_while(|parameter| parameter.is_required()).count();
        assert_eq!(required, row.required(), "{}", row.signature());
    }
}

#[test]
fn every_call_matches_at_most_one_row() {
    let mut seen = HashSet::new();
    for row in rows().filter(|row| !matches!(row.form, CallSyntax::Operator)) {
        for count in row.required()..=row.parameters.len() {
            let property = matches!(row.form, CallSyntax::Property(_));
            let owner = row.receiver().map(|of| of.name());
            assert!(seen.insert((row.name, owner, count, property)), "{}", row.signature());
        }
    }
}

#[test]
fn related_names_of_rows_exist() {
    let known: HashSet<_> = rows().map(|row| row.name).collect();
    for row in rows() {
        for name in row.see {
            assert!(known.contains(name), "{}: see {name}", row.signature());
        }
    }
}

#[test]
fn no_row_or_constant_name_is_reserved() {
    for row in rows().filter(|row| !matches!(row.form, CallSyntax::Operator)) {
        assert!(can_be_written(row.name), "{}", row.signature());
        for parameter in row.parameters {
            check_keys(parameter);
        }
    }
    for constant in TABLES.iter().flat_map(|table| table.constants) {
        assert!(can_be_written(constant.name), "{}", constant.name);
    }
}

fn check_keys(parameter: &Parameter) {
    check_kind(&parameter.kind);
}

fn check_kind(kind: &Kind) {
    match kind {
        Kind::Options(keys) => {
            for key in *keys {
                assert!(can_be_written(key.name), "the option {}", key.name);
                check_keys(key);
            }
        }
        Kind::Either(kinds) => kinds.iter().for_each(check_kind),
        _ => (),
    }
}

fn can_be_written(name: &str) -> bool {
    let script = format!("let x = #{{ {name}: 1 }}; x.{name}; x.{name}(); {name}(x);");
    rhai::Engine::new_raw().compile(script).is_ok()
}

#[test]
fn reserved_words_are_recognised() {
    for word in ["until", "with", "new", "default", "use", "is", "match"] {
        assert!(!can_be_written(word), "{word}");
    }
    assert!(can_be_written("hold_for"));
}

#[test]
fn domains_named_by_parameter_variants_exist() {
    for name in crate::script::bindings::parameter_variants::NAMED.into_iter().flatten() {
        assert!(TABLES.iter().any(|table| table.name == *name), "{name}");
    }
}
