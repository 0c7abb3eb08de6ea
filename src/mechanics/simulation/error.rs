//! Errors of a run.

use super::{DerivativeError, StepSizeError};
use crate::integrators::{MethodError, StepError};
use crate::system::{SystemError, rounded};

/// Error of a run that cannot start or continue. The history up to the last successful step is kept.
#[expect(missing_docs, reason = "the messages describe the variants and their fields")]
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum SimulationError {
    /// The scene cannot be built.
    #[error(transparent)]
    Model(#[from] SystemError),
    /// The integrator or its parameter is invalid.
    #[error(transparent)]
    Method(#[from] MethodError),
    /// The step size or the tolerance is invalid.
    #[error(transparent)]
    StepSize(#[from] StepSizeError),
    /// Derivatives with respect to parameters are not available.
    #[error(transparent)]
    Derivative(#[from] DerivativeError),
    /// A sensor of a mean force is recorded with a method that does not provide mean forces.
    #[error(
        "'{sensor}' is a mean force over a step, which the method {method} does not provide; record the present force, or use energy_momentum"
    )]
    NoMeanForces { sensor: String, method: &'static str },
    /// A scene contains an object with friction, which the method does not support.
    #[error(
        "{object} has friction, which the method {method} does not support; use the method energy_momentum"
    )]
    FrictionMethod { object: String, method: &'static str },
    /// A scene contains a slider that only pushes, which the method does not support.
    #[error(
        "slider '{slider}' has a side, which the method {method} does not support; use the method energy_momentum"
    )]
    SideMethod { slider: String, method: &'static str },
    #[error(
        "a controller with a sampling period of {period:e} would be sampled more than {most} times in a step of dt = {dt:e}"
    )]
    TooManySamples {
        /// Sampling period of a controller [time].
        period: f64,
        /// Step size [time].
        dt: f64,
        most: f64,
    },
    #[error(
        "the equilibrium has the prescribed motion '{drive}' at {}, but its function gives {} at t = {time}: the motion would jump", rounded(*rest_position), rounded(*function_value)
    )]
    StartMismatch {
        drive: String,
        /// Position in the equilibrium [length, rad].
        rest_position: f64,
        /// Value of the function [length, rad].
        function_value: f64,
        /// Time at which the function has the value `function_value` [time].
        time: f64,
    },
    #[error("the simulation is already at t = {now} and cannot run to t = {end}")]
    End {
        /// Present time [time].
        now: f64,
        /// Requested end [time].
        end: f64,
    },
    #[error(
        "no step from t = {} converges, down to dt/{divisions} (dt = {}): {source}{conditions}", rounded(*time), step_size(*dt)
    )]
    Step {
        /// End of the last successful step [time].
        time: f64,
        /// Size of the failed step of the time grid [time].
        dt: f64,
        /// Largest number of parts into which the step was divided.
        divisions: u64,
        source: Box<StepError>,
        /// Text about extreme conditions before the step, appended to the message; may be empty.
        conditions: String,
    },
    #[error(
        "the tolerance {tolerance} requires steps below the smallest allowed one ({}) at t = {}: the error of a step of dt = {} is {error:.3} times the allowed one", step_size(*smallest), rounded(*time), step_size(*dt)
    )]
    Tolerance {
        /// End of the last successful step [time].
        time: f64,
        /// Tolerance [-].
        tolerance: f64,
        /// Size of the last attempted step [time].
        dt: f64,
        /// Error of the last attempted step, as a fraction of the allowed error [-].
        error: f64,
        /// Smallest allowed step [time].
        smallest: f64,
    },
    #[error(
        "no step from t = {} converges, down to the smallest allowed one, {} (dt = {}): {source}{conditions}", rounded(*time), step_size(*smallest), step_size(*dt)
    )]
    Smallest {
        /// End of the last successful step [time].
        time: f64,
        /// Size of the last attempted step [time].
        dt: f64,
        /// Smallest allowed step [time].
        smallest: f64,
        source: Box<StepError>,
        /// Text about extreme conditions before the step, appended to the message; may be empty.
        conditions: String,
    },
    #[error(
        "slider '{slider}' {event} shortly after t = {}, but no step that ends there converges, down to dt/{divisions} (dt = {}); use a smaller dt or a finer mesh{conditions}", rounded(*time), step_size(*dt)
    )]
    EventLocation {
        slider: String,
        /// Description of the event, such as `reaches the end of its beam`.
        event: String,
        /// End of the last successful step [time].
        time: f64,
        /// Size of the failed step of the time grid [time].
        dt: f64,
        /// Largest number of parts into which the step was divided.
        divisions: u64,
        /// Text about extreme conditions before the step, appended to the message; may be empty.
        conditions: String,
    },
    /// A load has no finite value, or a slider is too fast for its sliding rule. Smaller steps do not help.
    #[error("{source}")]
    Load { source: StepError },
    #[error("the run has ended: {ending}")]
    Ended { ending: String },
    #[error("{arrival}, the last of {most} arrivals within one step")]
    TooManyArrivals {
        arrival: String,
        /// Number of arrivals within one step.
        most: usize,
    },
    #[error("cannot go back {steps} steps: only {steps_taken} were taken")]
    TooFewSteps { steps: usize, steps_taken: usize },
    #[error("cannot go back to t = {time}: the simulation covers t = {} to {}", rounded(*start), rounded(*now))]
    OutsideRun {
        /// Requested time [time].
        time: f64,
        /// Start of the run [time].
        start: f64,
        /// Present time [time].
        now: f64,
    },
    #[error(
        "cannot go back: this simulation stores no snapshots{}",
        if *limit > 0.0 { format!(", because a single one exceeds the memory limit of {limit} MB") } else { String::new() }
    )]
    NoSnapshots {
        /// Memory limit of snapshots [10⁶ bytes].
        limit: f64,
    },
    #[error("cannot go back to {target}: snapshots are stored from t = {} on", rounded(*first))]
    BeforeFirst {
        target: String,
        /// Time of the first snapshot [time].
        first: f64,
    },
    #[error(
        "cannot go back to {target}: within the memory limit of {limit} MB only snapshots of the last {steps} steps (from t = {}) and of t = {} are stored", rounded(*oldest), rounded(*first)
    )]
    NoSnapshot {
        target: String,
        /// Number of steps that can be undone.
        steps: usize,
        /// Time of the oldest recent snapshot [time].
        oldest: f64,
        /// Time of the first snapshot [time].
        first: f64,
        /// Memory limit of snapshots [10⁶ bytes].
        limit: f64,
    },
    #[error("interrupted at t = {}; the history up to this time is kept", rounded(*time))]
    Interrupted {
        /// End of the last step [time].
        time: f64,
    },
}

/// Formats a step size with at most six significant digits.
fn step_size(dt: f64) -> String {
    let rounded: f64 = format!("{dt:.5e}").parse().unwrap_or(dt);
    format!("{rounded:e}")
}
