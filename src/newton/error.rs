//! Why a Newton solve gave up.

use super::Imbalance;
use crate::linalg::LinearError;

/// A Newton solve that found no solution.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum NewtonError {
    /// The iteration limit was reached.
    #[error("Newton's method did not converge in {} iterations (relative force imbalance {})", history.len(), describe(history))]
    NotConverged {
        /// The imbalance after each iteration.
        history: Vec<Imbalance>,
    },
    /// The iteration left the finite numbers.
    #[error("Newton's method met a number that is not finite after {} iterations (relative force imbalance {})", history.len(), describe(history))]
    NotFinite {
        /// The imbalance after each iteration.
        history: Vec<Imbalance>,
    },
    /// The tangent could not be factorised.
    #[error("{source} (after {} Newton iterations)", history.len())]
    Linear {
        /// What the linear solver says.
        source: LinearError,
        /// The imbalance after each iteration.
        history: Vec<Imbalance>,
    },
}

impl NewtonError {
    /// Matrices that were factorised, or could not be.
    pub fn factorisations(&self) -> usize {
        self.history().len() + usize::from(matches!(self, Self::Linear { .. }))
    }

    /// The imbalance after each iteration, oldest first.
    pub fn history(&self) -> &[Imbalance] {
        match self {
            Self::NotConverged { history }
            | Self::NotFinite { history }
            | Self::Linear { history, .. } => history,
        }
    }
}

fn describe(history: &[Imbalance]) -> String {
    history
        .iter()
        .map(|imbalance| format!("{:.1e}", imbalance.force))
        .collect::<Vec<_>>()
        .join(", ")
}
