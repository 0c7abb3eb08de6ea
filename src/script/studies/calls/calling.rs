//! A function of a study, called in the engine of a worker.

use rhai::{Dynamic, EvalAltResult, FnPtr, Map};

use super::function::{RunFunction, changes};
use crate::script::engine::workers::Worker;
use crate::script::messages::brief::brief;
use crate::script::messages::error::Failure;

/// The most characters of a reason.
const LONGEST_REASON: usize = 300;

/// What came of a call.
pub enum CallOutcome {
    /// The function gave this.
    Given(Dynamic),
    /// The function threw something, took too long, or a check of it failed: the reason.
    Failed(String),
    /// The script itself is wrong, as it seems: the reason.
    Wrong(String),
}

/// What was made of a call, with the steps that its simulations took.
pub struct CallWork<R> {
    /// What was made of it.
    pub result: R,
    /// Steps of simulations and failed tries.
    pub steps: u64,
}

/// Calls the function with values by their names, in the engine of a worker, and makes something of what it gives. `wall` tells how long it may take, in words.
pub fn call<R>(
    worker: &Worker,
    function: &RunFunction,
    values: impl FnOnce(&dyn Fn(&str, usize) -> Option<FnPtr>) -> Map,
    wall: &str,
    read: impl FnOnce(CallOutcome) -> R,
) -> CallWork<R> {
    let context = worker.context();
    let failed_checks = || context.with_checks(|checks| checks.failed().len());
    let (before, failed) = (context.meter().steps(), failed_checks());
    let function_of = |name: &str, parameters| worker.function(name, parameters);
    let called = called(worker, function, &function_of, values(&function_of));
    let told =
        context.with_checks(|checks| checks.failed().get(failed).map(|of| of.message.clone()));
    let called = match (told, called) {
        _ if worker.is_stopped() => CallOutcome::Failed(format!("it took more than {wall}")),
        (Some(told), CallOutcome::Given(_)) => {
            CallOutcome::Failed(shortened(&format!("a check failed: {told}")))
        }
        (_, called) => called,
    };
    let result = read(called);
    // What a run leaves behind would fill the memory.
    context.forget_simulations();
    CallWork { result, steps: context.meter().steps() - before }
}

fn called(
    worker: &Worker,
    function: &RunFunction,
    function_of: &dyn Fn(&str, usize) -> Option<FnPtr>,
    values: Map,
) -> CallOutcome {
    let Some((captured, given)) = function.arguments(values, function_of) else {
        return CallOutcome::Wrong("a captured function is not found again".into());
    };
    let arguments = captured.iter().cloned().chain(given).collect();
    match worker.call(&function.name, arguments) {
        Ok(given) => match function.changed(&captured) {
            Some(name) => CallOutcome::Wrong(changes(name)),
            None => CallOutcome::Given(given),
        },
        Err(error) => match thrown(&error) {
            Some(reason) => CallOutcome::Failed(shortened(&reason)),
            None => CallOutcome::Wrong(shortened(&worker.explain(&error).message)),
        },
    }
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

/// A reason in one line of a length that a table has room for.
pub fn shortened(reason: &str) -> String {
    let line = brief(reason.replace(['\n', '\r'], " "));
    match line.char_indices().nth(LONGEST_REASON) {
        Some((end, _)) => format!("{} …", &line[..end]),
        None => line,
    }
}
