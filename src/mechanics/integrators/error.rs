//! Errors of a step.

use std::error::Error;
use std::fmt;
use std::rc::Rc;

use super::{Interval, Overshoot};
use crate::newton::NewtonError;

/// Error from outside the mechanics of a step. It is displayed unchanged, and can be downcast to its type.
///
/// It is not `Send`, because it may come from a script function whose errors are not.
#[derive(Debug, Clone)]
pub struct ExternalError(Rc<dyn Error>);

impl ExternalError {
    /// Wraps an error of any type.
    pub fn new(error: impl Error + 'static) -> Self {
        Self(Rc::new(error))
    }

    /// The wrapped error if it is of type `E`.
    pub fn downcast_ref<E: Error + 'static>(&self) -> Option<&E> {
        self.0.downcast_ref()
    }
}

/// Errors with equal messages are equal.
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

/// Location of a failed step in a mechanism.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum FailureSource {
    /// Equation or matrix row of an unknown.
    Unknown(usize),
    /// Named object.
    Named(String),
}

fn at(culprit: Option<&FailureSource>) -> String {
    match culprit {
        Some(FailureSource::Named(name)) => format!("; location: {name}"),
        _ => String::new(),
    }
}

/// Rejected step. The mechanism is in its state at the start of the step.
#[expect(missing_docs, reason = "the messages describe the variants and their fields")]
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum StepError {
    #[error("the step of {:.3e} from t = {} failed: {source}{}", interval.duration(), interval.start, at(failure_source.as_deref()))]
    Newton {
        /// Interval of the step [time].
        interval: Interval,
        /// Reason, with the residual history.
        source: Box<NewtonError>,
        /// Newton iterations of earlier substeps.
        before: usize,
        /// Location of the failure, if known.
        failure_source: Option<Box<FailureSource>>,
    },
    #[error(
        "a section would rotate by {} rad in the step of {:.3e} from t = {}, but the rotation per step must be below π; use a smaller step",
        if *rotation < 1e7 { format!("{rotation:.2}") } else { format!("{rotation:.2e}") }, interval.duration(), interval.start
    )]
    Rotation {
        /// Interval of the step [time].
        interval: Interval,
        /// Rotation increment `Δω` of the section, mean rate times step [rad].
        rotation: f64,
        iterations: usize,
    },
    #[error(
        "in the step of {:.3e} from t = {} the beam under a slider rotates by about π (chord {chord:.1e} of the path); use a smaller step",
        interval.duration(), interval.start
    )]
    Chord {
        /// Interval of the step [time].
        interval: Interval,
        /// Ratio of the chord to the length of the path of the slider, in the mean configuration [-].
        chord: f64,
        iterations: usize,
    },
    /// Constraint limit that is passed within the step, so that the step must end at the limit.
    #[error(
        "limit {} of a constraint is exceeded within the step of {:.3e} from t = {}",
        overshoot.limit, interval.duration(), interval.start
    )]
    Overshoot {
        /// Interval of the step [time].
        interval: Interval,
        /// Passed limit, and the overshoot.
        overshoot: Overshoot,
        iterations: usize,
    },
    #[error("{load}: {source} (in the step from t = {} to {})", interval.start, interval.end)]
    Load {
        /// Interval of the step [time].
        interval: Interval,
        load: String,
        source: ExternalError,
    },
}

impl StepError {
    /// Number of factorisations tried in the step.
    pub fn factorisations(&self) -> usize {
        match self {
            Self::Newton { source, before, .. } => source.factorisations() + before,
            Self::Rotation { iterations, .. }
            | Self::Chord { iterations, .. }
            | Self::Overshoot { iterations, .. } => *iterations,
            Self::Load { .. } => 0,
        }
    }

    pub(super) fn for_whole_step(self, interval: Interval, before: usize) -> Self {
        match self {
            Self::Newton { source, failure_source, .. } => {
                Self::Newton { interval, source, before, failure_source }
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

    /// Returns true if a smaller step may succeed.
    pub fn is_step_size_dependent(&self) -> bool {
        !matches!(self, Self::Load { .. })
    }
}
