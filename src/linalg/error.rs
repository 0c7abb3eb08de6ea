//! What can go wrong when a linear system is solved.

/// A linear system that has no unique solution in floating-point numbers.
#[derive(Debug, Clone, Copy, PartialEq, thiserror::Error)]
pub enum LinearError {
    /// No usable pivot is left in a column.
    #[error("the matrix is singular: no pivot for unknown {unknown} of {size}")]
    Singular {
        /// The column in which elimination stopped.
        unknown: usize,
        /// The size of the matrix.
        size: usize,
    },
    /// An entry is infinite or not a number.
    #[error(
        "the matrix has an entry that is not a finite number, met at unknown {unknown} of {size}"
    )]
    NotFinite {
        /// The column in which it was met.
        unknown: usize,
        /// The size of the matrix.
        size: usize,
    },
}

impl LinearError {
    /// The same error of a block that stands behind `rows` other rows.
    pub(super) fn behind(self, rows: usize) -> Self {
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
