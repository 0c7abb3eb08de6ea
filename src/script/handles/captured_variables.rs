//! Detection of script functions that change variables of the script.

use rhai::Dynamic;

use super::function_of_time::FunctionOfTime;
use super::simulation::SimulationHandle;
use crate::script::bindings::stored::StoredFunction;
use crate::script::messages::error::ScriptError;
use crate::system::Scene;

/// Functions of time in the schedules of a scene.
pub fn functions_of_time(scene: &Scene) -> Vec<&StoredFunction> {
    let mut found = Vec::new();
    for (_, schedule) in scene.schedules() {
        schedule.visit_functions(&mut |function| {
            let function: &dyn std::any::Any = function;
            found.extend(function.downcast_ref::<FunctionOfTime>().map(FunctionOfTime::stored));
        });
    }
    found
}

/// Repeats a computation that calls script functions.
///
/// # Errors
/// Fails with the error of the computation, if a function reads a simulation of the script through a captured variable,
/// or if a function has changed a captured variable, whose value is then restored.
/// A repetition would start from the changed value and not be the same computation.
pub fn expect_no_side_effects<T>(
    functions: &[&StoredFunction],
    compute: impl FnOnce() -> Result<T, ScriptError>,
) -> Result<T, ScriptError> {
    let captured = CapturedVariables::of(functions)?;
    let result = compute();
    captured.expect_unchanged()?;
    result
}

struct CapturedVariables(Vec<CapturedVariable>);

struct CapturedVariable {
    role: String,
    shared: Dynamic,
    value: Dynamic,
}

impl CapturedVariables {
    fn of(functions: &[&StoredFunction]) -> Result<Self, ScriptError> {
        let mut values = Vec::new();
        for function in functions {
            for shared in function.captured() {
                let value = shared.flatten_clone();
                if value.is::<SimulationHandle>() {
                    let message = format!(
                        "{} reads a simulation of the script, and a companion run has another one",
                        function.role()
                    );
                    let hint = "read the simulation that the function receives as its argument";
                    return Err(ScriptError::new(message).hint(hint));
                }
                let role = function.role().to_owned();
                values.push(CapturedVariable { role, shared: shared.clone(), value });
            }
        }
        Ok(Self(values))
    }

    fn expect_unchanged(self) -> Result<(), ScriptError> {
        let mut changed = None;
        for CapturedVariable { role, mut shared, value } in self.0 {
            if format!("{:?}", shared.flatten_clone()) == format!("{value:?}") {
                continue;
            }
            changed = Some(role);
            if let Some(mut cell) = shared.write_lock::<Dynamic>() {
                *cell = value;
            }
        }
        changed.map_or(Ok(()), |role| {
            let message = format!(
                "{role} changes a variable of the script, so that a repetition has other results"
            );
            let hint = "compute the value from the time and the simulation alone, or estimate the error by a study";
            Err(ScriptError::new(message).hint(hint))
        })
    }
}
