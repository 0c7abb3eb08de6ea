//! A place of the undeformed axis as quadrature needs it.

#[derive(Debug, Clone)]
pub(super) struct AxisPoint<const N: usize> {
    /// Basis functions.
    pub(super) shape: [f64; N],
    /// Their derivatives by arc length [1/length].
    pub(super) slope: [f64; N],
    /// Weight of the quadrature, as a length.
    pub(super) weight: f64,
}
