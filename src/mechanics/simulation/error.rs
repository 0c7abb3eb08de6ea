//! Errors of a run.

use super::{DerivativeError, StepSizeError};
use crate::integrators::{MethodError, StepError};
use crate::statics::StaticsError;
use crate::system::{SystemError, rounded};

/// Error of a run that cannot start or continue. The history up to the last successful step is kept.
#[expect(missing_docs, reason = "the messages describe the variants and their fields")]
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum SimulationError {
    #[error(transparent)]
    Model(#[from] SystemError),
    #[error(transparent)]
    Method(#[from] MethodError),
    #[error(transparent)]
    StepSize(#[from] StepSizeError),
    #[error(transparent)]
    Derivative(#[from] DerivativeError),
    #[error(
        "'{sensor}' is a mean force over a step, which the method {method} does not provide; record the present force, or use energy_momentum"
    )]
    NoMeanForces { sensor: String, method: &'static str },
    #[error(
        "{object} has friction, which the method {method} does not support; use the method energy_momentum"
    )]
    FrictionMethod { object: String, method: &'static str },
    #[error(
        "slider '{slider}' has a side, which the method {method} does not support; use the method energy_momentum"
    )]
    SideMethod { slider: String, method: &'static str },
    #[error(
        "a controller with a sampling period of {} would be sampled more than {most} times in a step of dt = {}", rounded(*period), rounded(*dt)
    )]
    TooManySamples { period: f64, dt: f64, most: f64 },
    #[error(
        "the equilibrium has '{name}' at {}, but its function of time gives {} at t = {time}: it would jump", rounded(*at_rest), rounded(*prescribed)
    )]
    StartMismatch { name: String, at_rest: f64, prescribed: f64, time: f64 },
    #[error(
        "scene '{scene}' has no equilibrium near the given one without the compliance at its sleeves that its mesh does not represent, from which a motion starts: {source}"
    )]
    SleevesAtRest { scene: String, source: Box<StaticsError> },
    #[error("the simulation is already at t = {now} and cannot run to t = {end}")]
    End { now: f64, end: f64 },
    #[error(
        "no step from t = {} converges, down to dt/{divisions} (dt = {}): {source}{conditions}", rounded(*time), rounded(*dt)
    )]
    Step { time: f64, dt: f64, divisions: u64, source: Box<StepError>, conditions: String },
    #[error(
        "the tolerance {tolerance} requires steps below the smallest allowed one ({}) at t = {}: the error of a step of dt = {} is {error:.3} times the allowed one", rounded(*smallest), rounded(*time), rounded(*dt)
    )]
    Tolerance { time: f64, tolerance: f64, dt: f64, error: f64, smallest: f64 },
    #[error(
        "no step from t = {} converges, down to the smallest allowed one, {} (dt = {}): {source}{conditions}", rounded(*time), rounded(*smallest), rounded(*dt)
    )]
    Smallest { time: f64, dt: f64, smallest: f64, source: Box<StepError>, conditions: String },
    #[error(
        "slider '{slider}' {event} shortly after t = {}, but no step that ends there converges, down to dt/{divisions} (dt = {}); use a smaller dt or a finer mesh{conditions}", rounded(*time), rounded(*dt)
    )]
    EventLocation {
        slider: String,
        event: String,
        time: f64,
        dt: f64,
        divisions: u64,
        conditions: String,
    },
    #[error("{source}")]
    Load { source: StepError },
    #[error("the run has ended: {ending}")]
    Ended { ending: String },
    #[error("{arrival}, the last of {most} arrivals within one step")]
    TooManyArrivals { arrival: String, most: usize },
    #[error("cannot go back {steps} steps: only {steps_taken} were taken")]
    TooFewSteps { steps: usize, steps_taken: usize },
    #[error("cannot go back to t = {time}: the simulation covers t = {} to {}", rounded(*start), rounded(*now))]
    OutsideRun { time: f64, start: f64, now: f64 },
    #[error(
        "cannot go back: this simulation stores no snapshots{}",
        if *limit > 0.0 { format!(", because a single one exceeds the memory limit of {limit} MB") } else { String::new() }
    )]
    NoSnapshots { limit: f64 },
    #[error("cannot go back to {target}: snapshots are stored from t = {} on", rounded(*first))]
    BeforeFirst { target: String, first: f64 },
    #[error(
        "cannot go back to {target}: within the memory limit of {limit} MB only snapshots of the last {steps} steps (from t = {}) and of t = {} are stored", rounded(*oldest), rounded(*first)
    )]
    NoSnapshot { target: String, steps: usize, oldest: f64, first: f64, limit: f64 },
    #[error("interrupted at t = {}; the history up to this time is kept", rounded(*time))]
    Interrupted { time: f64 },
}
