//! Errors of a step.

use std::error::Error;
use std::fmt;
use std::rc::Rc;

use super::{Interval, Overshoot};
use crate::elementary::rounded_to;
use crate::newton::NewtonError;

/// Error from outside the solver, which is displayed unchanged and can be downcast to its type.
///
/// The type `ExternalError` is not `Send`, because errors of script functions are not `Send`.
#[derive(Debug, Clone)]
pub struct ExternalError(Rc<dyn Error>);

impl ExternalError {
    /// Wraps an error of any type.
    pub fn new(error: impl Error + 'static) -> Self {
        Self(Rc::new(error))
    }

    /// Returns the wrapped error if it is of type `E`.
    pub fn downcast_ref<E: Error + 'static>(&self) -> Option<&E> {
        self.0.downcast_ref()
    }
}

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

/// Object in a mechanism at which a step failed.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum FailureSource {
    /// Unknown of the equations, given by its index.
    Unknown(usize),
    /// Named object.
    Named(String),
}

fn at(failure_source: Option<&FailureSource>) -> String {
    match failure_source {
        Some(FailureSource::Named(name)) => format!("; location: {name}"),
        _ => String::new(),
    }
}

/// Error of a step that failed. The mechanism is in its state at the start of the step.
#[expect(missing_docs, reason = "the messages describe the variants and their fields")]
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum StepError {
    #[error("the step of {:.3e} from t = {} failed: {source}{}", interval.duration(), rounded_to(6, interval.start), at(failure_source.as_deref()))]
    Newton {
        interval: Interval,
        source: Box<NewtonError>,
        before: usize,
        failure_source: Option<Box<FailureSource>>,
    },
    #[error(
        "a section would rotate by {} rad in the step of {:.3e} from t = {}, but the rotation per step must be below π; use a smaller step",
        if *rotation < 1e7 { format!("{rotation:.2}") } else { format!("{rotation:.2e}") }, interval.duration(), rounded_to(6, interval.start)
    )]
    Rotation { interval: Interval, rotation: f64, iterations: usize },
    #[error(
        "in the step of {:.3e} from t = {} the beam under a slider rotates by about π (chord {chord:.1e} of the path); use a smaller step",
        interval.duration(), rounded_to(6, interval.start)
    )]
    Chord { interval: Interval, chord: f64, iterations: usize },
    #[error(
        "a body would pass through another body or obstacle of '{obstacle}' in the step of {:.3e} from t = {}; use a smaller step, or a larger stiffness or radius if the contact is too soft to stop the body",
        interval.duration(), rounded_to(6, interval.start)
    )]
    Crossing { interval: Interval, obstacle: String, iterations: usize },
    #[error(
        "limit {} of a constraint is exceeded within the step of {:.3e} from t = {}",
        overshoot.event, interval.duration(), rounded_to(6, interval.start)
    )]
    Overshoot { interval: Interval, overshoot: Overshoot, iterations: usize },
    #[error("{load}: {source} (in the step from t = {} to {})", interval.start, interval.end)]
    Load { interval: Interval, load: String, source: ExternalError },
}

impl StepError {
    /// Number of factorisations in the failed step.
    pub fn factorisations(&self) -> usize {
        match self {
            Self::Newton { source, before, .. } => source.factorisations() + before,
            Self::Rotation { iterations, .. }
            | Self::Chord { iterations, .. }
            | Self::Crossing { iterations, .. }
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
            Self::Crossing { obstacle, iterations, .. } => {
                Self::Crossing { interval, obstacle, iterations: iterations + before }
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
