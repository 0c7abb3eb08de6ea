//! Tests: every engine function has help, every help entry has a function, and every example runs.

use std::collections::HashSet;

use rhai::{Engine, FnAccess};

use super::TABLES;
use crate::script::bindings::built_in::{BuiltIn, NameSuffix};
use crate::script::bindings::table::{CallSyntax, getter_of};
use crate::script::bindings::topics::TOPICS;
use crate::script::dialect::foundation::REFUSED;
use crate::script::dialect::operators::written;
use crate::script::engine;
use crate::script::engine::runner::{self, run};
use crate::script::help::lookup;
use crate::script::packages::language;
use crate::script::source::program::Program;
use crate::script::state::context::Context;
use crate::script::state::settings::{RunMode, RunSettings};

struct EngineFunction {
    name: String,
    count: usize,
    types: Vec<String>,
}

fn standard_engine() -> Engine {
    let context = Context::new(RunSettings::silent(RunMode::Run));
    engine::build(&language(), &context).unwrap()
}

fn known() -> Vec<EngineFunction> {
    let engine = standard_engine();
    let mut known = engine.collect_fn_metadata(
        None,
        |info| {
            let data = info.metadata;
            let types = data.params_info.iter().map(|known| {
                known.split_once(':').map_or("", |(_, of)| of).trim().replace("&mut ", "")
            });
            (data.access == FnAccess::Public).then(|| EngineFunction {
                name: data.name.to_string(),
                count: data.num_params,
                types: types.collect(),
            })
        },
        true,
    );
    for line in engine.definitions().builtin_functions().lines() {
        let Some((name, rest)) = line.strip_prefix("fn ").and_then(|line| line.split_once('('))
        else {
            continue;
        };
        let parameters = rest.split(')').next().unwrap_or_default();
        let count = parameters.split(", ").filter(|name| !name.is_empty()).count();
        known.push(EngineFunction { name: name.into(), count, types: Vec::new() });
    }
    known.retain(|function| function.types.iter().all(|of| !is_out_of_reach(of)));
    known
}

fn is_out_of_reach(of: &str) -> bool {
    const NUMBERS: [&str; 10] =
        ["i8", "i16", "i32", "i128", "u8", "u16", "u32", "u64", "u128", "f32"];
    NUMBERS.iter().any(|name| of == *name || of.ends_with(&format!("Range<{name}>")))
        || of.contains("Blob")
}

fn built_ins() -> impl Iterator<Item = &'static BuiltIn> {
    TABLES.iter().flat_map(|table| table.rows)
}

fn is_documented(name: &str, count: usize) -> bool {
    let catalog = language();
    catalog.named(name).any(|row| {
        let given = match row.form {
            CallSyntax::Function => count..=count,
            CallSyntax::Method(_) | CallSyntax::Property(_) => {
                count.saturating_sub(1)..=count.saturating_sub(1)
            }
            CallSyntax::Operator => 2..=2,
        };
        (row.required()..=row.parameters.len()).contains(given.start())
    }) || catalog.built_ins_named(name).any(|known| known.written().any(|form| form.takes(count)))
}

#[test]
fn every_function_of_the_engine_has_help() {
    let mut missing = HashSet::new();
    for EngineFunction { name, count, .. } in known() {
        let shown = written(&name);
        let is_word = shown.starts_with(|letter: char| letter.is_alphabetic());
        let refused =
            REFUSED.iter().any(|refused| refused.name == name && refused.counts.contains(&count));
        let has_help = match name.split_once('$') {
            // The property `x.floor` equals `floor(x)`, because Rhai lets functions of one value be read as properties.
            Some(("get", property)) => is_documented(property, 1),
            Some(("set", property)) => language().named(property).any(|row| row.setter.is_some()),
            Some(("index", _)) => true,
            _ if !is_word => {
                TOPICS.iter().any(|topic| topic.name == "operators" && topic.words.contains(&shown))
            }
            _ if name == "eval" => standard_engine().compile("eval(\"1\")").is_err(),
            _ => refused || is_documented(&name, count),
        };
        if !has_help {
            missing.insert(format!("{name} of {count}"));
        }
    }
    assert!(missing.is_empty(), "without help: {missing:?}");
}

#[test]
fn every_documented_form_exists() {
    let known = known();
    for built_in in built_ins() {
        for form in built_in.written() {
            let exists = known.iter().any(|function| match form.ending {
                NameSuffix::Property => function.name == getter_of(form.name),
                _ => function.name == form.name && form.takes(function.count),
            });
            assert!(exists, "there is no {form:?}");
        }
    }
}

#[test]
fn every_documented_number_of_arguments_is_callable() {
    let known = known();
    for built_in in built_ins() {
        for form in built_in.written().filter(|form| form.ending == NameSuffix::Arguments) {
            let least = form.required.len() + usize::from(form.receiver.is_some());
            for count in least..=least + form.optional.len() {
                let exists = known
                    .iter()
                    .any(|function| function.name == form.name && function.count == count)
                    || ["print", "debug", "type_of"].contains(&form.name);
                assert!(exists, "there is no {} of {count}", form.name);
            }
        }
    }
}

#[test]
fn every_form_of_a_function_has_the_same_name() {
    for built_in in built_ins() {
        assert!(
            built_in.written().all(|form| form.name == built_in.name()),
            "{:?}",
            built_in.forms
        );
        assert!(built_in.summary.ends_with('.'), "{}: the summary is a sentence", built_in.name());
    }
}

#[test]
fn related_names_have_help() {
    let names = lookup::names(&language());
    let related = built_ins().map(|known| (known.name(), known.related));
    for (name, see) in related.chain(TOPICS.iter().map(|topic| (topic.name, topic.see))) {
        for other in see {
            assert!(names.contains(other), "{name}: see {other}");
        }
    }
}

#[test]
fn every_built_in_example_runs_and_has_output_or_a_check() {
    let built_ins = built_ins().map(|known| (known.name(), known.example));
    for (name, example) in built_ins.chain(TOPICS.iter().map(|topic| (topic.name, topic.example))) {
        let program = Program::named(name, example);
        let outcome = run(&program, &language(), RunSettings::silent(RunMode::Run));
        assert!(matches!(outcome.ending, runner::Ending::Finished), "{:?}", outcome.ending);
        assert_eq!(outcome.checks.failed(), [], "{name}");
        assert!(example.contains("check") || example.contains("print("), "{name} shows nothing");
    }
}

#[test]
fn rejected_functions_state_their_replacement() {
    for refused in REFUSED {
        for count in refused.counts {
            for value in ["0.5", "1", "\"a\""] {
                let script = format!("{}({})", refused.name, vec![value; *count].join(", "));
                let outcome = run(
                    &Program::named("refused", &script),
                    &language(),
                    RunSettings::silent(RunMode::Run),
                );
                let runner::Ending::Failed(error) = outcome.ending else {
                    panic!("{script}: {:?}", outcome.ending)
                };
                assert_eq!(error.message, refused.reason, "{script}");
                assert_eq!(error.hint.as_deref(), Some(refused.instead), "{script}");
            }
        }
    }
}

#[test]
fn unneeded_engine_functions_are_removed() {
    for name in ["blob", "get_bit", "set_bits", "get_fn_metadata_list", "take", "parse_json"] {
        assert!(known().iter().all(|function| function.name != name), "{name}");
    }
}

#[test]
fn documented_reserved_words_are_reserved_by_the_engine() {
    let topic = TOPICS.iter().find(|topic| topic.name == "reserved words").unwrap();
    let (used, rest) = topic.doc.split_once(". Kept for later: ").unwrap();
    let kept = rest.split(". ").next().unwrap();
    let words = used.trim_start_matches("In use: ").split(", ").chain(kept.split(", "));
    let (reserved, free): (Vec<_>, Vec<_>) =
        words.partition(|word| standard_engine().compile(format!("let {word} = 1;")).is_err());
    assert_eq!(free, Vec::<&str>::new());
    assert!(reserved.len() > 50);
}
