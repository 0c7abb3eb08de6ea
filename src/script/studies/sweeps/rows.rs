//! One row of a sweep: the function of the script, called with its values.

use std::sync::Arc;

use rhai::{Dynamic, EvalAltResult, FnPtr, Map};

use super::function::RunFunction;
use super::portable::Portable;
use crate::script::engine::workers::Worker;
use crate::script::words::brief::brief;
use crate::script::words::error::Failure;
use crate::script::words::numbers::as_number;

/// The most characters of a reason.
const LONGEST_REASON: usize = 300;

/// What became of a row.
#[derive(Clone, Debug)]
pub enum Row {
    /// The function gave a map of numbers: their names, and the numbers.
    Found(Arc<[String]>, Vec<f64>),
    /// The function threw something, or gave a result that is not a number: the reason.
    Failed(String),
    /// The script itself is wrong, as it seems: the reason.
    Wrong(String),
}

/// A row with the steps that its simulations took.
pub struct Made {
    /// What became of the row.
    pub row: Row,
    /// Steps of simulations and failed tries.
    pub steps: u64,
}

/// Calls the function with the values of a row, in the engine of a worker. `wall` tells how long it may take, in words.
pub fn make(worker: &Worker, function: &RunFunction, values: Map, wall: &str) -> Made {
    let context = worker.context();
    let (steps, failed) =
        (context.meter().steps(), context.with_checks(|checks| checks.failed().len()));
    let function_of = |name: &str, parameters| worker.function(name, parameters);
    let row = row(worker, function, &function_of, values);
    let row =
        if worker.is_stopped() { Row::Failed(format!("it took more than {wall}")) } else { row };
    let told = context
        .with_checks(|checks| checks.failed().get(failed).map(|check| check.message.clone()));
    let row = match (told, row) {
        (Some(told), Row::Found(..)) => Row::Failed(shortened(&format!("a check failed: {told}"))),
        (_, row) => row,
    };
    let steps = context.meter().steps() - steps;
    // What a run leaves behind would fill the memory.
    context.forget_simulations();
    Made { row, steps }
}

fn row(
    worker: &Worker,
    function: &RunFunction,
    function_of: &dyn Fn(&str, usize) -> Option<FnPtr>,
    values: Map,
) -> Row {
    let shared = |(_, value): &(String, Portable)| Some(value.value(function_of)?.into_shared());
    let Some(captured) = function.captured.iter().map(shared).collect::<Option<Vec<_>>>() else {
        return Row::Wrong("a captured function is not found again".into());
    };
    let arguments = captured.iter().cloned().chain([values.into()]).collect();
    let given = match worker.call(&function.name, arguments) {
        Ok(given) => given,
        Err(error) => {
            return match thrown(&error) {
                Some(reason) => Row::Failed(shortened(&reason)),
                None => Row::Wrong(shortened(&worker.explain(&error).message)),
            };
        }
    };
    let changed = function.captured.iter().zip(&captured).find(|((_, was), is)| !was.is(is));
    match changed {
        Some(((name, _), _)) => Row::Wrong(changes(name)),
        None => found(&given, worker.engine().map_type_name(given.type_name())),
    }
}

/// Why a function that changes one of its captured variables is refused.
pub fn changes(name: &str) -> String {
    format!(
        "it changes the variable '{name}' from outside, which every run has for itself: give what is found in the map"
    )
}

/// What the function gave, as numbers.
pub fn found(given: &Dynamic, kind: &str) -> Row {
    let Some(map) = given.read_lock::<Map>() else {
        return Row::Wrong(format!(
            "it gives a value of the type '{kind}' and no map of numbers, such as #{{ peak: peak }}"
        ));
    };
    if map.is_empty() {
        return Row::Wrong("it gives an empty map".into());
    }
    let mut numbers = Vec::with_capacity(map.len());
    for (name, value) in map.iter() {
        let truth = || value.as_bool().ok().map(|truth| f64::from(u8::from(truth)));
        match as_number(value).or_else(truth) {
            Some(number) if number.is_finite() => numbers.push(number),
            Some(number) if number.is_nan() => {
                return Row::Failed(format!("'{name}' is not a number"));
            }
            Some(_) => return Row::Failed(format!("'{name}' is infinite")),
            None => {
                return Row::Wrong(format!(
                    "it gives '{name}', which is neither a number nor true or false"
                ));
            }
        }
    }
    Row::Found(map.keys().map(ToString::to_string).collect(), numbers)
}

/// What a script has thrown, or a function of ours has refused, in words; none for other errors.
pub fn thrown(error: &EvalAltResult) -> Option<String> {
    match error {
        EvalAltResult::ErrorInFunctionCall(_, _, inner, _) => thrown(inner),
        EvalAltResult::ErrorRuntime(value, _) => Some(match value.read_lock::<Failure>() {
            Some(failure) => failure.message.clone(),
            None => value.to_string(),
        }),
        _ => None,
    }
}

fn shortened(reason: &str) -> String {
    let line = brief(reason.replace(['\n', '\r'], " "));
    match line.char_indices().nth(LONGEST_REASON) {
        Some((end, _)) => format!("{} …", &line[..end]),
        None => line,
    }
}
