//! Construction of the script engine.

use std::ops::{Range, RangeInclusive};

use rhai::{Dynamic, Engine, FnPtr, INT, ImmutableString, Map, OptimizationLevel};

use crate::analysis::is_past_deadline;
use crate::script::bindings::catalog::Catalog;
use crate::script::bindings::members;
use crate::script::bindings::register::register;
use crate::script::bindings::sources::Sources;
use crate::script::dialect::{
    constants, derivatives, elements, foundation, json, operators, repetitions, replacing, sizes,
    sorting, switch_values,
};
use crate::script::messages::numbers::format_number;
use crate::script::source::syntax;
use crate::script::state::context::Context;
use crate::script::state::limits::DEEPEST;

const EXPRESSION_DEPTH: usize = 256;
const EXPRESSION_DEPTH_IN_FUNCTION: usize = 64;
const PULSE: u64 = 256;

/// Creates an engine for the language of `catalog` that reports to `context`.
///
/// Fails if Rhai rejects a custom operator of the language.
pub fn build(catalog: &Catalog, context: &Context) -> Result<Engine, String> {
    let mut engine = foundation::engine();
    // The optimiser of Rhai is off, because it would replace shadowed names by constants and drop statements with side effects.
    engine.set_optimization_level(OptimizationLevel::None);
    limit(&mut engine, context);
    name_types(&mut engine);
    let asked = context.clone();
    let reader = syntax::install(&mut engine, move || asked.stopped_by())?;
    operators::install(&mut engine);
    derivatives::install(&mut engine);
    sorting::install(&mut engine, context);
    repetitions::install(&mut engine, context);
    replacing::install(&mut engine);
    sizes::install(&mut engine);
    switch_values::install(&mut engine);
    json::install(&mut engine);
    elements::install(&mut engine);
    print_numbers(&mut engine);
    Sources::install(&mut engine, catalog, reader);
    for table in catalog.tables() {
        register(&mut engine, table, context);
    }
    members::install(&mut engine, catalog, context);
    constants::install(&mut engine, catalog);
    connect(&mut engine, context);
    Ok(engine)
}

fn limit(engine: &mut Engine, context: &Context) {
    engine
        .set_max_call_levels(context.meter().limits().depth.min(DEEPEST))
        .set_max_expr_depths(EXPRESSION_DEPTH, EXPRESSION_DEPTH_IN_FUNCTION)
        .set_fail_on_invalid_map_property(true);
}

fn name_types(engine: &mut Engine) {
    engine
        .register_type_with_name::<INT>("whole number")
        .register_type_with_name::<f64>("number")
        .register_type_with_name::<bool>("truth value")
        .register_type_with_name::<char>("character")
        .register_type_with_name::<ImmutableString>("text")
        .register_type_with_name::<rhai::Array>("array")
        .register_type_with_name::<Map>("map")
        .register_type_with_name::<FnPtr>("function")
        .register_type_with_name::<Range<INT>>("range")
        .register_type_with_name::<RangeInclusive<INT>>("range")
        .register_type_with_name::<()>("nothing");
}

fn print_numbers(engine: &mut Engine) {
    for name in ["to_string", "to_debug", "print", "debug"] {
        engine.register_fn(name, |x: f64| ImmutableString::from(format_number(x)));
    }
    engine.register_fn("+", |text: ImmutableString, x: f64| format!("{text}{}", format_number(x)));
    engine.register_fn("+", |x: f64, text: ImmutableString| format!("{}{text}", format_number(x)));
}

fn connect(engine: &mut Engine, context: &Context) {
    let printer = context.clone();
    engine.on_print(move |text| printer.print(text));
    let teller = context.clone();
    engine.on_debug(move |text, _, position| match position.line() {
        Some(line) => teller.print_debug(&format!("line {line}: {text}")),
        None => teller.print_debug(text),
    });
    let watched = context.clone();
    engine.on_progress(move |operations| {
        let late = || operations.is_multiple_of(PULSE) && is_past_deadline();
        let stop = watched.stopped_by().map(Dynamic::from);
        stop.or_else(|| late().then(|| Dynamic::from("the study exceeded its time limit")))
    });
}
