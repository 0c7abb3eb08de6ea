//! Errors of Newton's method.

use super::ResidualNorms;
use crate::linalg::LinearError;

/// Error of a failed solution by Newton's method.
#[expect(missing_docs, reason = "the messages describe the variants and their fields")]
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum NewtonError {
    #[error("Newton's method did not converge in {} iterations ({})", history.len(), describe(history))]
    NotConverged { history: Vec<ResidualNorms> },
    #[error("Newton's method produced a number that is not finite after {} iterations ({})", history.len(), describe(history))]
    NotFinite { history: Vec<ResidualNorms> },
    #[error("{source} (after {} Newton iterations)", history.len())]
    Linear { source: LinearError, history: Vec<ResidualNorms> },
    #[error("interrupted after {} Newton iterations", history.len())]
    Interrupted { history: Vec<ResidualNorms> },
}

impl NewtonError {
    /// Number of tangents that were factorised, including failed factorisations.
    pub fn factorisations(&self) -> usize {
        self.history().len() + usize::from(matches!(self, Self::Linear { .. }))
    }

    /// Residual norms after each iteration.
    pub fn history(&self) -> &[ResidualNorms] {
        match self {
            Self::NotConverged { history }
            | Self::NotFinite { history }
            | Self::Interrupted { history }
            | Self::Linear { history, .. } => history,
        }
    }
}

type NamedResidualPart = (&'static str, fn(&ResidualNorms) -> f64);

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
