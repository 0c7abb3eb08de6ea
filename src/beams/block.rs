//! The dense tangent of one span.

/// Rows and columns are (function, component): `block[a][i][b][j]`, components x, y, ω.
pub(super) type Block<const N: usize> = [[[[f64; 3]; N]; 3]; N];

/// The block of zeros.
pub(super) const fn zero_block<const N: usize>() -> Block<N> {
    [[[[0.0; 3]; N]; 3]; N]
}
