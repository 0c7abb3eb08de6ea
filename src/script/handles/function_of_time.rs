//! Functions of time in a schedule.

use rhai::EvalAltResult;

use crate::loads::{FunctionError, TimeFunction};
use crate::script::bindings::sources::Sources;
use crate::script::bindings::stored::{NoNumber, StoredFunction};
use crate::script::diagnose::Explainer;
use crate::script::messages::raised::Raised;
use crate::script::source::program::Program;
use crate::script::state::context::Context;

/// Script function of time that a schedule evaluates.
pub struct FunctionOfTime(StoredFunction);

impl FunctionOfTime {
    pub fn new(function: StoredFunction) -> Self {
        Self(function)
    }

    pub fn stored(&self) -> &StoredFunction {
        &self.0
    }
}

impl TimeFunction for FunctionOfTime {
    fn value(&self, time: f64) -> Result<f64, FunctionError> {
        self.0.number_of(time).map_err(|error| match error {
            NoNumber::Other(words) => FunctionError::new(words),
            NoNumber::Failed(error) => {
                FunctionError::new(Raised::new(explanation(self.0.context(), &error), error))
            }
        })
    }
}

fn explanation(context: &Context, error: &EvalAltResult) -> String {
    let Some(engine) = context.engine() else { return error.to_string() };
    let Some(catalog) = Sources::of(&engine).catalog() else { return error.to_string() };
    let program = Program::named("", "");
    Explainer { program: &program, catalog: &catalog, engine: &engine }.explain(error).line()
}
