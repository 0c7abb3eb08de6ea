//! Errors of equilibria.

use std::fmt;

use crate::loads::LoadError;
use crate::newton::NewtonError;
use crate::system::{SystemError, rounded};

/// Time-dependent specification of a drive or a load.
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

/// Failed search for an equilibrium.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum StaticsError {
    /// Scene that cannot be built.
    #[error(transparent)]
    Model(#[from] SystemError),
    /// Load without a value at the time of the loading.
    #[error("load '{load}': {source}")]
    Load {
        /// Name of the load.
        load: String,
        /// Reason.
        source: LoadError,
    },
    /// Scene without loads.
    #[error("no load acts at t = {time}, so that the scene is in equilibrium as drawn")]
    NoLoad {
        /// Time of the loading [time].
        time: f64,
    },
    /// Path of given length for a scene that has only initial strains, which the load factor does not scale.
    #[error("no load acts at t = {time}: only prestress acts, and arc-length control needs a load")]
    NoScaledLoad {
        /// Time of the loading [time].
        time: f64,
    },
    /// Drive or load that depends on the course of time.
    #[error(
        "'{name}' is given by {by}, which is undefined in an equilibrium, where no time passes"
    )]
    TimeDependent {
        /// Name of the drive or load.
        name: String,
        /// Kind of the specification.
        by: InTime,
    },
    /// Prescribed motion under arc-length control.
    #[error(
        "{drive}: prescribed motion can only be applied in load steps, not with arc-length control"
    )]
    Driven {
        /// Name of the drive.
        drive: String,
    },
    /// Setting outside its range.
    #[error("{name} is {value}, but must be {allowed}")]
    Value {
        /// Name of the setting.
        name: &'static str,
        /// Rejected value.
        value: f64,
        /// Allowed values.
        allowed: &'static str,
    },
    /// Unrestrained scene for which no equilibrium under its loads was found.
    #[error(
        "scene '{scene}' is not restrained: {movements} of its degrees of freedom have no stiffness as drawn, and no equilibrium was found: {reason}"
    )]
    Unrestrained {
        /// Name of the scene.
        scene: String,
        /// Number of unrestrained degrees of freedom.
        movements: usize,
        /// Reason.
        reason: Box<StepFailure>,
    },
    /// No equilibrium near the last one.
    #[error("no equilibrium of scene '{scene}' was found beyond load factor {}: {reason}", rounded(*reached))]
    NoEquilibrium {
        /// Name of the scene.
        scene: String,
        /// Last load factor with an equilibrium [-].
        reached: f64,
        /// Reason.
        reason: Box<StepFailure>,
    },
    /// No equilibrium beyond the last point of a path.
    #[error(
        "the load path of scene '{scene}' ends at point {points}, at load factor {}: {reason}", rounded(*reached)
    )]
    PathLost {
        /// Name of the scene.
        scene: String,
        /// Number of points of the path.
        points: usize,
        /// Load factor of the last point [-].
        reached: f64,
        /// Reason.
        reason: Box<StepFailure>,
    },
    /// Search stopped by the caller.
    #[error("interrupted at load factor {}", rounded(*reached))]
    Interrupted {
        /// Last load factor with an equilibrium [-].
        reached: f64,
    },
}

/// Reason why a step found no equilibrium.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum StepFailure {
    /// Newton's method did not converge.
    #[error(transparent)]
    Newton(#[from] NewtonError),
    /// The solution is far from the last equilibrium.
    #[error("the next equilibrium is far from the last one (limit point, snap-through)")]
    FarSolution,
    /// Endless motion of an unrestrained scene.
    #[error("the motion under the loads does not end (a mechanism or a missing support)")]
    Mechanism,
    /// Slider that would leave its master.
    #[error("slider '{slider}' would leave its beam at its {end}")]
    LeavesMaster {
        /// Name of the slider.
        slider: String,
        /// End of its master, such as `start`.
        end: &'static str,
    },
}
