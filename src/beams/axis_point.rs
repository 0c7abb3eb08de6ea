//! A place of the undeformed axis as quadrature needs it.

#[derive(Debug, Clone)]
pub(super) struct AxisPoint<const N: usize> {
    /// The values of the basis functions at this point of the axis [-], one for each control point of the span.
    pub(super) shape: [f64; N],
    /// The derivatives of the basis functions by the arc length of the axis [1/length], one for each control point of the span.
    pub(super) slope: [f64; N],
    /// The weight of this point in integrals along the axis [length].
    pub(super) weight: f64,
}
