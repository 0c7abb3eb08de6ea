//! Errors of the search for equilibria.

use std::fmt;

use crate::loads::LoadError;
use crate::newton::NewtonError;
use crate::system::{SystemError, rounded};

/// Time-dependent property of a drive or load that cannot be used in statics.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum InTime {
    /// Prescribed rate of a drive.
    Speed,
    /// Controller, which reacts to its sensors over time.
    Controller,
}

impl fmt::Display for InTime {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Speed => "a speed",
            Self::Controller => "a controller",
        })
    }
}

/// Error of a failed search for an equilibrium.
#[expect(missing_docs, reason = "the messages describe the variants and their fields")]
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum StaticsError {
    #[error(transparent)]
    Model(#[from] SystemError),
    #[error("load '{load}': {source}")]
    Load { load: String, source: LoadError },
    #[error("no load acts at t = {time}, so that the scene is in equilibrium as drawn")]
    NoLoad { time: f64 },
    #[error("no load acts at t = {time}: only prestress acts, and arc-length control needs a load")]
    NoScaledLoad { time: f64 },
    #[error(
        "'{name}' is given by {by}, which is undefined in an equilibrium, where no time passes"
    )]
    TimeDependent { name: String, by: InTime },
    #[error(
        "{brake} holds any moment up to its friction limit, so that the equilibrium is not unique"
    )]
    Brake { brake: String },
    #[error(
        "{drive}: prescribed motion can only be applied in load steps, not with arc-length control"
    )]
    Driven { drive: String },
    #[error("{name} is {value}, but must be {allowed}")]
    Value { name: &'static str, value: f64, allowed: &'static str },
    #[error(
        "scene '{scene}' is not restrained: {movements} of its degrees of freedom have no stiffness as drawn, and no equilibrium was found: {reason}"
    )]
    Unrestrained { scene: String, movements: usize, reason: Box<StepFailure> },
    #[error("no equilibrium of scene '{scene}' was found beyond load factor {}: {reason}", rounded(*reached))]
    NoEquilibrium { scene: String, reached: f64, reason: Box<StepFailure> },
    #[error(
        "the load path of scene '{scene}' ends at point {points}, at load factor {}: {reason}", rounded(*reached)
    )]
    PathLost { scene: String, points: usize, reached: f64, reason: Box<StepFailure> },
    #[error("interrupted at load factor {}", rounded(*reached))]
    Interrupted { reached: f64 },
}

/// Reason for the failure of a load step.
#[expect(missing_docs, reason = "the messages describe the variants and their fields")]
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum StepFailure {
    #[error(transparent)]
    Newton(#[from] NewtonError),
    #[error("the next equilibrium is far from the last one (limit point, snap-through)")]
    FarSolution,
    #[error("the motion under the loads does not end (a mechanism or a missing support)")]
    Mechanism,
    #[error("slider '{slider}' would leave its beam at its {end}")]
    LeavesMaster { slider: String, end: &'static str },
}
