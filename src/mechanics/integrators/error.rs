//! Why a step could not be taken.

use std::error::Error;
use std::fmt;
use std::rc::Rc;

use super::{Interval, Overshoot};
use crate::newton::NewtonError;

/// An error from outside of the mechanics of a step, as the one who caused it made it; it is told as that one, and may be taken apart
/// by who knows its type.
///
/// It stays on its thread: who caused it may be a function of a script, whose errors do.
#[derive(Debug, Clone)]
pub struct ExternalError(Rc<dyn Error>);

impl ExternalError {
    /// An error of any type.
    pub fn new(error: impl Error + 'static) -> Self {
        Self(Rc::new(error))
    }

    /// The wrapped error itself, if it is of type `E`.
    pub fn downcast_ref<E: Error + 'static>(&self) -> Option<&E> {
        self.0.downcast_ref()
    }
}

/// Causes are equal that are told alike.
impl PartialEq for ExternalError {
    fn eq(&self, other: &Self) -> bool {
        self.0.to_string() == other.0.to_string()
    }
}

impl fmt::Display for ExternalError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.0.fmt(f)
    }
}

impl Error for ExternalError {
    fn source(&self) -> Option<&(dyn Error + 'static)> {
        self.0.source()
    }
}

/// What of a mechanism a step fails at.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum FailureSource {
    /// The equation, or the matrix, of an unknown, by its number.
    Unknown(usize),
    /// Something with a name.
    Named(String),
}

/// The end of a message about a step that fails at something, if its name is known.
fn at(culprit: Option<&FailureSource>) -> String {
    match culprit {
        Some(FailureSource::Named(name)) => format!("; it fails at {name}"),
        _ => String::new(),
    }
}

/// A step that was refused; the mechanism is still at its start.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum StepError {
    /// The equations of the step were not solved.
    #[error("the step of {:.3e} from t = {} failed: {source}{}", interval.duration(), interval.start, at(culprit.as_deref()))]
    Newton {
        /// The interval of the step whose equations were not solved [time].
        interval: Interval,
        /// The solver's reason for finding no solution, with its residual history.
        source: Box<NewtonError>,
        /// The number of Newton iterations that parts of the refused step took before.
        before: usize,
        /// What the solver failed at, if that is known.
        culprit: Option<Box<FailureSource>>,
    },
    /// The mean rate of a section times the step reaches π: such a turn is not resolved.
    #[error(
        "the step of {:.3e} from t = {} would turn a section by {rotation:.2} rad at its mean rate; a step must stay below π",
        interval.duration(), interval.start
    )]
    Rotation {
        /// The interval of the step in which a section turns too far [time].
        interval: Interval,
        /// The rotation increment `Δω` of the section that turns too far, mean rate times step [rad].
        rotation: f64,
        /// Newton iterations that the refused step took.
        iterations: usize,
    },
    /// The mean configuration of the step folds up the way of a slider: the beam under it turns by about π.
    #[error(
        "in the step of {:.3e} from t = {} the beam under a slider turns so far that its mean has no direction (chord {chord:.1e} of the \
         way); steps must be smaller",
        interval.duration(), interval.start
    )]
    Chord {
        /// The interval of the step in which the way of a slider folds up [time].
        interval: Interval,
        /// The chord of the slider's way in the mean configuration, relative to the way [-].
        chord: f64,
        /// Newton iterations that the refused step took.
        iterations: usize,
    },
    /// A constraint ends within the step, which has to be cut there.
    #[error(
        "limit {} of a constraint is passed within the step of {:.3e} from t = {}",
        overshoot.limit, interval.duration(), interval.start
    )]
    Overshoot {
        /// The interval of the step in which a constraint ends [time].
        interval: Interval,
        /// Which limit of a constraint was passed, and how far beyond it the step went.
        overshoot: Overshoot,
        /// Newton iterations that the refused step took.
        iterations: usize,
    },
    /// A load has no finite value in the step.
    #[error("{load}: {source} (in the step from t = {} to {})", interval.start, interval.end)]
    Load {
        /// The interval of the step in which a load has no finite value [time].
        interval: Interval,
        /// The name of the load without a finite value.
        load: String,
        /// The schedule's reason for having no finite value.
        source: ExternalError,
    },
}

impl StepError {
    /// The number of matrices that the refused step has factorised, or tried to.
    pub fn factorisations(&self) -> usize {
        match self {
            Self::Newton { source, before, .. } => source.factorisations() + before,
            Self::Rotation { iterations, .. }
            | Self::Chord { iterations, .. }
            | Self::Overshoot { iterations, .. } => *iterations,
            Self::Load { .. } => 0,
        }
    }

    /// The error of a part of a step, told of the whole step, of which earlier parts took `before` Newton iterations.
    pub(super) fn of_whole(self, interval: Interval, before: usize) -> Self {
        match self {
            Self::Newton { source, culprit, .. } => {
                Self::Newton { interval, source, before, culprit }
            }
            Self::Rotation { rotation, iterations, .. } => {
                Self::Rotation { interval, rotation, iterations: iterations + before }
            }
            Self::Chord { chord, iterations, .. } => {
                Self::Chord { interval, chord, iterations: iterations + before }
            }
            Self::Overshoot { overshoot, iterations, .. } => {
                Self::Overshoot { interval, overshoot, iterations: iterations + before }
            }
            Self::Load { load, source, .. } => Self::Load { interval, load, source },
        }
    }

    /// Whether a smaller step may succeed where this one was refused.
    pub fn may_be_cured_by_a_smaller_step(&self) -> bool {
        !matches!(self, Self::Load { .. })
    }
}
