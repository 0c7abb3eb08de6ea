//! What can go wrong when a linear system is solved.

/// A linear system that has no unique solution in floating-point numbers.
#[derive(Debug, Clone, Copy, PartialEq, thiserror::Error)]
pub enum LinearError {
    /// No usable pivot is left in a column of the matrix: it is singular, or nearly.
    #[error("the matrix is singular: no pivot for unknown {unknown} of {size}")]
    Singular {
        /// The index of the column in which elimination stopped, from 0.
        unknown: usize,
        /// The number of rows of the singular matrix.
        size: usize,
    },
    /// An entry of the matrix is infinite or not a number.
    #[error(
        "the matrix has an entry that is not a finite number, met at unknown {unknown} of {size}"
    )]
    NotFinite {
        /// The index of the column in which the entry was met, from 0.
        unknown: usize,
        /// The number of rows of the matrix with the entry that is not finite.
        size: usize,
    },
}

impl LinearError {
    /// The index of the column of which the error tells, from 0.
    pub fn unknown(self) -> usize {
        let (Self::Singular { unknown, .. } | Self::NotFinite { unknown, .. }) = self;
        unknown
    }

    /// The same error, told of another column of a matrix with so many rows.
    pub(super) fn at(self, unknown: usize, size: usize) -> Self {
        match self {
            Self::Singular { .. } => Self::Singular { unknown, size },
            Self::NotFinite { .. } => Self::NotFinite { unknown, size },
        }
    }

    /// The same error, told of a matrix in which this one is a block that stands behind `rows` other rows.
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
