//! Call of a study function in a worker.

use rhai::{Dynamic, EvalAltResult, FnPtr, Map};

use super::function::{RunFunction, changes};
use crate::script::engine::workers::Worker;
use crate::script::messages::brief::brief;
use crate::script::messages::error::Failure;

const LONGEST_REASON: usize = 300;

pub enum CallOutcome {
    Returned(Dynamic),
    Failed(String),
    Wrong(String),
}

pub struct CallWork<R> {
    pub result: R,
    pub steps: u64,
}

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
    let message =
        context.with_checks(|checks| checks.failed().get(failed).map(|of| of.message.clone()));
    let called = match (message, called) {
        _ if worker.is_stopped() => CallOutcome::Failed(format!("it took more than {wall}")),
        (Some(message), CallOutcome::Returned(_)) => {
            CallOutcome::Failed(shortened(&format!("a check failed: {message}")))
        }
        (_, called) => called,
    };
    let result = read(called);
    context.clear_simulations();
    CallWork { result, steps: context.meter().steps() - before }
}

fn called(
    worker: &Worker,
    function: &RunFunction,
    function_of: &dyn Fn(&str, usize) -> Option<FnPtr>,
    values: Map,
) -> CallOutcome {
    let Some((captured, given)) = function.arguments(values.clone(), function_of) else {
        return CallOutcome::Wrong("a captured function is not found again".into());
    };
    let arguments = captured.iter().cloned().chain(given).collect();
    let called = || worker.call(&function.name, arguments);
    match worker.context().with_parameters(&values, called) {
        Ok(given) => match function.changed(&captured) {
            Some(name) => CallOutcome::Wrong(changes(name)),
            None => CallOutcome::Returned(given),
        },
        Err(error) => match thrown(&error) {
            Some(reason) => CallOutcome::Failed(shortened(&reason)),
            None => CallOutcome::Wrong(shortened(&worker.explain(&error).message)),
        },
    }
}

/// Message of a thrown value or a native error; `None` for other errors.
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

pub fn shortened(reason: &str) -> String {
    let line = brief(reason.replace(['\n', '\r'], " "));
    match line.char_indices().nth(LONGEST_REASON) {
        Some((end, _)) => format!("{} …", &line[..end]),
        None => line,
    }
}
