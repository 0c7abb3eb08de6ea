//! Why a run could not start or go on.

use super::{DerivativeError, StepSizeError};
use crate::integrators::{MethodError, StepError};
use crate::system::SystemError;

/// A run that could not start or go on; its history up to the last good step is kept.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum SimulationError {
    /// The scene of a run cannot be built.
    #[error(transparent)]
    Model(#[from] SystemError),
    /// The integrator of a run does not exist with its parameter.
    #[error(transparent)]
    Method(#[from] MethodError),
    /// The step size of a run is not positive, or its tolerance cannot be kept.
    #[error(transparent)]
    StepSize(#[from] StepSizeError),
    /// A run has no derivatives by parameters of its scene.
    #[error(transparent)]
    Derivative(#[from] DerivativeError),
    /// The mean of a step of a method that balances accelerations of its own.
    #[error(
        "'{sensor}' is the mean over a step, by which momenta change, and {method} balances accelerations of its own instead: it has none; record the force at the present moment, or take another method"
    )]
    NoMean {
        /// The column that cannot be had.
        sensor: String,
        /// The method that has no such mean.
        method: &'static str,
    },
    /// A controller that is asked so often that a step would never end.
    #[error("a controller is asked every {period:e}, more than {most} times in a step of {dt:e}")]
    ManySamples {
        /// The sampling period of the controller [time].
        period: f64,
        /// The size of a step [time].
        dt: f64,
        /// How often a controller may be asked in a step.
        most: f64,
    },
    /// A drive that an equilibrium has moved to where it is at no time.
    #[error(
        "the equilibrium holds what '{drive}' moves at {rests}, and at t = {time} its function has it at {wanted}: moved on from there it would be where no function has it"
    )]
    BeginsElsewhere {
        /// The name of the drive that rests elsewhere than where its function is.
        drive: String,
        /// Where the drive rests [length, rad].
        rests: f64,
        /// Where its function is [length, rad].
        wanted: f64,
        /// The time at which its function is there [time].
        time: f64,
    },
    /// An end of a run that has passed.
    #[error("the simulation is at t = {now} and cannot run to t = {end}")]
    End {
        /// The present time of the run that should end in its past [time].
        now: f64,
        /// The end asked for, which has passed [time].
        end: f64,
    },
    /// No step of any size was solved.
    #[error(
        "no step from t = {time} works, down to dt/{divisions} (dt = {dt:e}): {source}{plight}"
    )]
    Step {
        /// The end of the last good step before the one that was not solved [time].
        time: f64,
        /// The step of the grid that was not solved [time].
        dt: f64,
        /// The number of parts into which the step that was not solved was divided at last.
        divisions: u64,
        /// The reason why the last try of the step failed.
        source: Box<StepError>,
        /// What is extreme in the configuration before the step, as the end of a sentence; empty where nothing is.
        plight: String,
    },
    /// A tolerance asks for steps that are too short.
    #[error(
        "the tolerance {tolerance} asks for steps below the smallest one, {smallest:e}, at t = {time}: one of dt = {dt:e} errs {error:.3} times as much as is allowed"
    )]
    Tolerance {
        /// The end of the last good step before steps became too short [time].
        time: f64,
        /// The tolerance that asks for too short steps [-].
        tolerance: f64,
        /// The step that was tried last under the tolerance [time].
        dt: f64,
        /// The error of the step that was tried last, over that allowed [-].
        error: f64,
        /// The smallest step that the run allows [time].
        smallest: f64,
    },
    /// No step of varying size down to the smallest was solved.
    #[error(
        "no step from t = {time} works, down to the smallest one, {smallest:e} (dt = {dt:e}): {source}{plight}"
    )]
    Smallest {
        /// The end of the last good step before none was solved [time].
        time: f64,
        /// The step that was tried last and not solved [time].
        dt: f64,
        /// The smallest step that the run allows [time].
        smallest: f64,
        /// The reason why the last try of a step failed.
        source: Box<StepError>,
        /// What is extreme in the configuration before the step, as the end of a sentence; empty where nothing is.
        plight: String,
    },
    /// No step that ends with the arrival of a slider was found.
    #[error(
        "slider '{slider}' arrives at the {end} of its beam soon after t = {time}, but no step that ends there was found, down to dt/{divisions} (dt = {dt:e}); try a smaller dt or a finer mesh{plight}"
    )]
    Landing {
        /// The name of the slider whose arrival was not found.
        slider: String,
        /// The end of its master at which the slider should arrive: `start` or `end`.
        end: &'static str,
        /// The end of the last good step before the arrival [time].
        time: f64,
        /// The step of the grid in which the slider arrives [time].
        dt: f64,
        /// The number of parts into which the step with the arrival was divided at last.
        divisions: u64,
        /// What is extreme in the configuration before the step, as the end of a sentence; empty where nothing is.
        plight: String,
    },
    /// A load has no finite value, or a slider is too fast for its rule; no smaller step helps.
    #[error("{source}")]
    Load {
        /// The load without a value or the slider, the step and the reason.
        source: StepError,
    },
    /// A slider has reached an end of its master at which the run ends.
    #[error("the run has ended: {ending}")]
    Ended {
        /// The arrival that ended the run, in words.
        ending: String,
    },
    /// A slider that does not get away from an end of its master.
    #[error("{arrival}, {most} times within one step of the grid")]
    Rattles {
        /// The last arrival of the slider, in words.
        arrival: String,
        /// How often the slider arrived within one step.
        most: usize,
    },
    /// A way back that is longer than the way that was gone.
    #[error("cannot go back {steps} steps: only {taken} were taken")]
    FewerSteps {
        /// The number of steps to go back.
        steps: usize,
        /// The number of steps that the run has taken.
        taken: usize,
    },
    /// A way back to a time that is not behind.
    #[error("cannot go back to t = {time}: the simulation has been from t = {begun} to {now}")]
    NotBehind {
        /// The time to go back to, which is not behind [time].
        time: f64,
        /// The time at which the run began [time].
        begun: f64,
        /// The present time of the run [time].
        now: f64,
    },
    /// No state of the run is kept to go back to.
    #[error(
        "there is no way back: no states are kept{}",
        if *limit > 0.0 { format!(", one alone takes more than the limit of {limit} MB") } else { String::new() }
    )]
    NoSnapshots {
        /// The memory that snapshots may take [10⁶ bytes].
        limit: f64,
    },
    /// States were not kept yet.
    #[error("cannot go back to {target}: states are kept from t = {first} on")]
    BeforeFirst {
        /// The state to go back to, in words.
        target: String,
        /// The time of the first state that was kept [time].
        first: f64,
    },
    /// Going back to a state that was forgotten for want of memory.
    #[error(
        "cannot go back to {target}: with a limit of {limit} MB for snapshots only the last {steps} steps are kept, back to t = {oldest}, and the state at t = {first}"
    )]
    Forgotten {
        /// The forgotten state to go back to, in words.
        target: String,
        /// The number of steps that one can go back.
        steps: usize,
        /// The time of the oldest state that is kept [time].
        oldest: f64,
        /// The time of the first state that was kept [time].
        first: f64,
        /// The memory that snapshots may take [10⁶ bytes].
        limit: f64,
    },
    /// The monitor of a run asked to stop it.
    #[error("interrupted at t = {time}; the history up to there is kept")]
    Interrupted {
        /// The end of the last step before the run was stopped [time].
        time: f64,
    },
}
