//! Errors of equilibria.

use std::fmt;

use crate::loads::LoadError;
use crate::newton::NewtonError;
use crate::system::SystemError;

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
    #[error("no load acts at t = {time}: with nothing to carry, the scene rests as it is drawn")]
    NoLoad {
        /// Time of the loading [time].
        time: f64,
    },
    /// Path of given length for a scene with initial strains only, which no load factor scales.
    #[error(
        "no load acts at t = {time}: what is not at ease as drawn pulls by itself, and there is no load to follow along a path of given length"
    )]
    NothingGrows {
        /// Time of the loading [time].
        time: f64,
    },
    /// Drive or load that needs time.
    #[error("'{name}' is given by {by}, which says nothing at rest, where no time passes")]
    InTime {
        /// Name of the drive or load.
        name: String,
        /// Kind of the specification.
        by: InTime,
    },
    /// Prescribed motion under arc-length control.
    #[error(
        "{drive}: a motion that is given is put on by load steps alone, not along a path of given length"
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
    /// Unrestrained scene whose loads lead to no equilibrium.
    #[error(
        "'{scene}' is not held: {movements} of its movements meet no resistance as it is drawn, and it sinks to no rest under its loads: {reason}"
    )]
    Loose {
        /// Name of the scene.
        scene: String,
        /// Number of unrestrained movements.
        movements: usize,
        /// Reason.
        reason: Box<StepFailure>,
    },
    /// No equilibrium near the last one.
    #[error("no equilibrium of '{scene}' was found near that at load factor {reached}: {reason}")]
    Lost {
        /// Name of the scene.
        scene: String,
        /// Last load factor with an equilibrium [-].
        reached: f64,
        /// Reason.
        reason: Box<StepFailure>,
    },
    /// No equilibrium beyond the last point of a path.
    #[error(
        "the path of '{scene}' leads no further than its point {points}, at load factor {reached}: {reason}"
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
    #[error("stopped at load factor {reached}")]
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
    #[error("the next one is far away, as where a structure snaps through")]
    Far,
    /// Endless movement of an unrestrained scene.
    #[error("it moves on and on")]
    Endless,
    /// Slider that would leave its master.
    #[error("slider '{slider}' would leave its beam at its {end}")]
    Leaves {
        /// Name of the slider.
        slider: String,
        /// End of its master, such as `start`.
        end: &'static str,
    },
}
