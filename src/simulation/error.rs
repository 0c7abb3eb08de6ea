//! Why a run could not start or go on.

use crate::integrators::StepError;
use crate::model::ModelError;

/// A run that could not start or go on; its history up to the last good step is kept.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum SimulationError {
    /// The scene cannot be built.
    #[error(transparent)]
    Model(#[from] ModelError),
    /// A step size that is not positive.
    #[error("the step size dt is {dt}, but must be a positive finite number [time]")]
    StepSize {
        /// Its value.
        dt: f64,
    },
    /// An end of a run that has passed.
    #[error("the simulation is at t = {now} and cannot run to t = {end}; {advice}")]
    End {
        /// Where it is.
        now: f64,
        /// Where it should go.
        end: f64,
        /// What would be right.
        advice: &'static str,
    },
    /// No step of any size worked.
    #[error("no step from t = {time} works, down to dt/{divisions} (dt = {dt:e}): {source}")]
    Step {
        /// The end of the last good step.
        time: f64,
        /// The step of the grid.
        dt: f64,
        /// By what the step was divided at last.
        divisions: u64,
        /// Why the last try failed.
        source: StepError,
    },
    /// A load has no value; no smaller step helps.
    #[error("{source}")]
    Load {
        /// The load, the step and the reason.
        source: StepError,
    },
    /// The monitor asked to stop.
    #[error("interrupted at t = {time}; the history up to there is kept")]
    Interrupted {
        /// The end of the last step.
        time: f64,
    },
}
