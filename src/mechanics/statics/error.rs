//! Why no equilibrium was found.

use std::fmt;

use crate::loads::LoadError;
use crate::newton::NewtonError;
use crate::system::SystemError;

/// What says something of a drive or a load only where time passes.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum InTime {
    /// A speed that is given to a drive.
    Speed,
    /// A controller, which answers to what it senses in time.
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

/// An equilibrium that was not found.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum StaticsError {
    /// The scene of an equilibrium cannot be built.
    #[error(transparent)]
    Model(#[from] SystemError),
    /// A load has no value at the time at which loads are taken.
    #[error("load '{load}': {source}")]
    Load {
        /// The name of the load without a value.
        load: String,
        /// The schedule's reason for having no value.
        source: LoadError,
    },
    /// Nothing acts.
    #[error("no load acts at t = {time}: with nothing to carry, the scene rests as it is drawn")]
    NoLoad {
        /// The time at which loads were taken from their schedules [time].
        time: f64,
    },
    /// A path of given length where nothing acts but what was not at ease as drawn, which no load factor scales.
    #[error(
        "no load acts at t = {time}: what is not at ease as drawn pulls by itself, and there is no load to follow along a path of given length"
    )]
    NothingGrows {
        /// The time at which loads were taken from their schedules [time].
        time: f64,
    },
    /// Something that only time makes what it is.
    #[error("'{name}' is given by {by}, which says nothing at rest, where no time passes")]
    InTime {
        /// The name of the drive or the load.
        name: String,
        /// What gives it.
        by: InTime,
    },
    /// A given motion where the load factor is found by the way along a path.
    #[error(
        "{drive}: a motion that is given is put on by load steps alone, not along a path of given length"
    )]
    Driven {
        /// The name of the drive.
        drive: String,
    },
    /// A setting of the equilibrium is out of its range.
    #[error("{name} is {value}, but must be {allowed}")]
    Value {
        /// The name of the refused setting.
        name: &'static str,
        /// The value of the refused setting, in its unit.
        value: f64,
        /// The values that the refused setting may have, in words.
        allowed: &'static str,
    },
    /// A scene that can move without resistance, and that its loads lead to no rest.
    #[error(
        "'{scene}' is not held: {movements} of its movements meet no resistance as it is drawn, and it sinks to no rest under its loads: {reason}"
    )]
    Loose {
        /// The name of the scene that can move.
        scene: String,
        /// The number of movements without resistance.
        movements: usize,
        /// The reason why no rest was found.
        reason: Box<StepFailure>,
    },
    /// No equilibrium was found near the last one.
    #[error("no equilibrium of '{scene}' was found near that at load factor {reached}: {reason}")]
    Lost {
        /// The name of the scene without an equilibrium.
        scene: String,
        /// The last load factor with an equilibrium before the path was lost [-].
        reached: f64,
        /// The reason why the next equilibrium was missed.
        reason: Box<StepFailure>,
    },
    /// No equilibrium was found beyond the last point of a path.
    #[error(
        "the path of '{scene}' leads no further than its point {points}, at load factor {reached}: {reason}"
    )]
    PathLost {
        /// The name of the scene whose path ends.
        scene: String,
        /// The number of points of the path.
        points: usize,
        /// The load factor at the last of them [-].
        reached: f64,
        /// The reason why the next point was missed.
        reason: Box<StepFailure>,
    },
    /// The search for an equilibrium was stopped from outside.
    #[error("stopped at load factor {reached}")]
    Interrupted {
        /// The last load factor with an equilibrium before the search was stopped [-].
        reached: f64,
    },
}

/// Why a step found no equilibrium.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum StepFailure {
    /// Newton's method found no equilibrium.
    #[error(transparent)]
    Newton(#[from] NewtonError),
    /// Newton's method found an equilibrium that is far from the last one.
    #[error("the next one is far away, as where a structure snaps through")]
    Far,
    /// What nothing holds moves on without end.
    #[error("it moves on and on")]
    Endless,
    /// A slider would leave its master.
    #[error("slider '{slider}' would leave its beam at its {end}")]
    Leaves {
        /// The name of the slider.
        slider: String,
        /// The end of its master, such as `start`.
        end: &'static str,
    },
}
