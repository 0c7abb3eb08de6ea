//! Errors of linear systems.

/// Error for a linear system without a unique solution in floating-point arithmetic.
/// The index of the column is approximate for unknowns that are renumbered or eliminated in blocks.
#[derive(Debug, Clone, Copy, PartialEq, thiserror::Error)]
pub enum LinearError {
    /// Singular or nearly singular matrix: a column has no usable pivot.
    #[error("the matrix is singular: no pivot for unknown {unknown} of {size}")]
    Singular {
        /// Index of the column without a pivot, counted from 0.
        unknown: usize,
        /// Number of rows of the matrix.
        size: usize,
    },
    /// Entry of the matrix or of its factors that is infinite or NaN.
    #[error("the matrix has an entry that is not a finite number, at unknown {unknown} of {size}")]
    NotFinite {
        /// Index of the column with the entry, counted from 0.
        unknown: usize,
        /// Number of rows of the matrix.
        size: usize,
    },
}

impl LinearError {
    /// Index of the column in which the error occurred, counted from 0.
    pub fn unknown(self) -> usize {
        let (Self::Singular { unknown, .. } | Self::NotFinite { unknown, .. }) = self;
        unknown
    }

    pub(super) fn at(self, unknown: usize, size: usize) -> Self {
        match self {
            Self::Singular { .. } => Self::Singular { unknown, size },
            Self::NotFinite { .. } => Self::NotFinite { unknown, size },
        }
    }

    pub(super) fn offset_by_rows(self, rows: usize) -> Self {
        match self {
            Self::Singular { unknown, size } => {
                Self::Singular { unknown: unknown + rows, size: size + rows }
            }
            Self::NotFinite { unknown, size } => {
                Self::NotFinite { unknown: unknown + rows, size: size + rows }
            }
        }
    }
}
