//! Why a Newton solve gave up.

use super::ResidualNorms;
use crate::linalg::LinearError;

/// A Newton solve that found no solution.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum NewtonError {
    /// The iteration limit of a Newton solve was reached.
    #[error("Newton's method did not converge in {} iterations ({})", history.len(), describe(history))]
    NotConverged {
        /// The imbalance after each iteration of the solve that did not converge, oldest first.
        history: Vec<ResidualNorms>,
    },
    /// The iteration of a Newton solve left the finite numbers.
    #[error("Newton's method met a number that is not finite after {} iterations ({})", history.len(), describe(history))]
    NotFinite {
        /// The imbalance after each iteration of the solve that left the finite numbers, oldest first.
        history: Vec<ResidualNorms>,
    },
    /// The tangent of a Newton solve could not be factorised.
    #[error("{source} (after {} Newton iterations)", history.len())]
    Linear {
        /// The linear solver's reason why the tangent has no factors.
        source: LinearError,
        /// The imbalance after each iteration before the tangent could not be factorised, oldest first.
        history: Vec<ResidualNorms>,
    },
}

impl NewtonError {
    /// The number of tangents that the failed solve has factorised, or tried to.
    pub fn factorisations(&self) -> usize {
        self.history().len() + usize::from(matches!(self, Self::Linear { .. }))
    }

    /// The imbalance after each iteration of the failed solve, oldest first.
    pub fn history(&self) -> &[ResidualNorms] {
        match self {
            Self::NotConverged { history }
            | Self::NotFinite { history }
            | Self::Linear { history, .. } => history,
        }
    }
}

/// A part of an imbalance, and its name.
type NamedResidualPart = (&'static str, fn(&ResidualNorms) -> f64);

/// The part that is left at the end, iteration by iteration.
fn describe(history: &[ResidualNorms]) -> String {
    let last = history.last().copied().unwrap_or_default();
    let parts: [NamedResidualPart; 3] = [
        ("relative force imbalance", |imbalance| imbalance.force),
        ("strain mismatch", |imbalance| imbalance.strain),
        ("relative violation of a constraint", |imbalance| imbalance.constraint),
    ];
    let [force, others @ ..] = parts;
    let (name, part) = others
        .into_iter()
        .fold(force, |worst, other| if other.1(&last) > worst.1(&last) { other } else { worst });
    let numbers: Vec<String> = history.iter().map(|row| format!("{:.1e}", part(row))).collect();
    format!("{name} {}", numbers.join(", "))
}
