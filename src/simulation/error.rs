//! Why a run could not start or go on.

use super::StepSizeError;
use crate::integrators::{MethodError, StepError};
use crate::model::ModelError;

/// A run that could not start or go on; its history up to the last good step is kept.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum SimulationError {
    /// The scene cannot be built.
    #[error(transparent)]
    Model(#[from] ModelError),
    /// A method that does not exist with its parameter.
    #[error(transparent)]
    Method(#[from] MethodError),
    /// A step size that is none, or a tolerance that cannot be kept.
    #[error(transparent)]
    StepSize(#[from] StepSizeError),
    /// An end of a run that has passed.
    #[error("the simulation is at t = {now} and cannot run to t = {end}")]
    End {
        /// Where it is.
        now: f64,
        /// Where it should go.
        end: f64,
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
    /// A tolerance asks for steps that are too short.
    #[error(
        "the tolerance {tolerance} asks for steps below the smallest one, {smallest:e}, at t = {time}: one of dt = {dt:e} errs {error:.3} times as much as is allowed"
    )]
    Tolerance {
        /// The end of the last good step.
        time: f64,
        /// The tolerance.
        tolerance: f64,
        /// The step that was tried last.
        dt: f64,
        /// Its error over that allowed.
        error: f64,
        /// The smallest step.
        smallest: f64,
    },
    /// No step down to the smallest worked.
    #[error(
        "no step from t = {time} works, down to the smallest one, {smallest:e} (dt = {dt:e}): {source}"
    )]
    Smallest {
        /// The end of the last good step.
        time: f64,
        /// The step that was tried last.
        dt: f64,
        /// The smallest step.
        smallest: f64,
        /// Why the last try failed.
        source: StepError,
    },
    /// No step that ends with the arrival of a slider was found.
    #[error(
        "slider '{slider}' arrives at the {end} of its beam soon after t = {time}, but no step that ends there was found, down to dt/{divisions} (dt = {dt:e}); try a smaller dt or a finer mesh"
    )]
    Landing {
        /// The slider.
        slider: String,
        /// The end of its master.
        end: &'static str,
        /// The end of the last good step.
        time: f64,
        /// The step of the grid.
        dt: f64,
        /// By what the step was divided at last.
        divisions: u64,
    },
    /// A load has no value; no smaller step helps.
    #[error("{source}")]
    Load {
        /// The load, the step and the reason.
        source: StepError,
    },
    /// A slider has reached an end of its master at which the run ends.
    #[error("the run has ended: {ending}")]
    Ended {
        /// What ended it.
        ending: String,
    },
    /// A slider that does not get away from an end of its master.
    #[error("{arrival}, {most} times within one step of the grid")]
    Rattles {
        /// The last arrival.
        arrival: String,
        /// How often it came there.
        most: usize,
    },
    /// A way back that is longer than the way that was gone.
    #[error("cannot go back {steps} steps: only {taken} were taken")]
    FewerSteps {
        /// Steps to go back.
        steps: usize,
        /// Steps taken.
        taken: usize,
    },
    /// A way back to a time that is not behind.
    #[error("cannot go back to t = {time}: the simulation has been from t = 0 to {now}")]
    NotBehind {
        /// Where it should go.
        time: f64,
        /// Where it is.
        now: f64,
    },
    /// No state is kept.
    #[error(
        "there is no way back: no states are kept{}",
        if *limit > 0.0 { format!(", one alone takes more than the limit of {limit} MB") } else { String::new() }
    )]
    NoSnapshots {
        /// The memory that they may take [10⁶ bytes].
        limit: f64,
    },
    /// States were not kept yet.
    #[error("cannot go back to {target}: states are kept from t = {first} on")]
    BeforeFirst {
        /// Where it should go, in words.
        target: String,
        /// When the first state was kept.
        first: f64,
    },
    /// The state there was forgotten for want of memory.
    #[error(
        "cannot go back to {target}: with a limit of {limit} MB for snapshots only the last {steps} steps are kept, back to t = {oldest}, and the state at t = {first}"
    )]
    Forgotten {
        /// Where it should go, in words.
        target: String,
        /// How many steps one can go back.
        steps: usize,
        /// Where these lead.
        oldest: f64,
        /// When the first state was kept.
        first: f64,
        /// The memory that snapshots may take [10⁶ bytes].
        limit: f64,
    },
    /// The monitor asked to stop.
    #[error("interrupted at t = {time}; the history up to there is kept")]
    Interrupted {
        /// The end of the last step.
        time: f64,
    },
}
