//! Errors of script functions called by native code, which pass through the lower layers unchanged.

use std::cell::RefCell;
use std::error::Error;
use std::fmt;

use rhai::EvalAltResult;

/// Error of a script function, wrapped for lower layers, which use only its message.
/// On return to the script, the original error is unwrapped with its position, trace and thrown value.
#[derive(Debug)]
pub struct Raised {
    words: String,
    /// Original error; `None` after unwrapping, because the engine needs it by value and cannot clone it.
    error: RefCell<Option<Box<EvalAltResult>>>,
}

impl Raised {
    /// Wraps an error of a script function. `words` is the message of the error on one line.
    pub fn new(words: String, error: Box<EvalAltResult>) -> Self {
        Self { words, error: RefCell::new(Some(error)) }
    }

    /// Unwraps the script error in `error` or in one of its causes; `None` if there is none.
    pub fn script_error_in(error: &(dyn Error + 'static)) -> Option<Box<EvalAltResult>> {
        let mut cause = Some(error);
        while let Some(error) = cause {
            match error.downcast_ref::<Self>() {
                Some(raised) => return raised.error.take(),
                None => cause = error.source(),
            }
        }
        None
    }
}

impl fmt::Display for Raised {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.words)
    }
}

impl Error for Raised {}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::integrators::{ExternalError, Interval, StepError};
    use crate::loads::{FunctionError, LoadError};
    use crate::simulation::SimulationError;

    #[test]
    fn script_error_is_recovered_from_all_layers() {
        let thrown = EvalAltResult::ErrorRuntime(42.into(), rhai::Position::NONE);
        let raised = Raised::new("thrown".to_owned(), thrown.into());
        let load = LoadError::Function(FunctionError::new(raised));
        let (interval, load) = (Interval::between(0.0, 1.0), ExternalError::new(load));
        let step = StepError::Load { interval, load: "force".to_owned(), source: load };
        let error = SimulationError::Load { source: step };
        assert_eq!(error.to_string(), "force: thrown (in the step from t = 0 to 1)");
        let back = Raised::script_error_in(&error).expect("the error of the script");
        assert!(matches!(*back, EvalAltResult::ErrorRuntime(value, _) if value.as_int() == Ok(42)));
        assert!(
            Raised::script_error_in(&error).is_none()
                && Raised::script_error_in(&fmt::Error).is_none()
        );
    }
}
