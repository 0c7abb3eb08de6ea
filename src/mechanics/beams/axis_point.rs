//! A place of the undeformed axis as quadrature needs it.

use super::BeamError;
use crate::geometry::{Basis, Span, Vec2};

/// The slowest an axis may run along its parameter, relative to its mean.
const STANDSTILL: f64 = 1e-9;

#[derive(Debug, Clone)]
pub(super) struct AxisPoint<const N: usize> {
    /// The values of the basis functions at this point of the axis [-], one for each control point of the span.
    pub(super) shape: [f64; N],
    /// The derivatives of the basis functions by the arc length of the axis [1/length], one for each control point of the span.
    pub(super) slope: [f64; N],
    /// The weight of this point in integrals along the axis [length].
    pub(super) weight: f64,
}

/// The axis that control points draw, of about a given length.
pub(super) struct Axis<'a> {
    basis: &'a Basis,
    control_points: &'a [Vec2],
    /// Derivatives by the parameter below this are rounding, not a direction.
    standstill: f64,
}

impl<'a> Axis<'a> {
    /// The axis of such a length [length] that control points draw on a basis.
    pub(super) fn new(basis: &'a Basis, control_points: &'a [Vec2], length: f64) -> Self {
        let (start, end) = basis.domain();
        Self { basis, control_points, standstill: STANDSTILL * length / (end - start) }
    }

    /// The points of a rule on a span, with the unit tangents there.
    pub(super) fn points<const N: usize>(
        &self,
        span: Span,
        rule: impl IntoIterator<Item = (f64, f64)>,
    ) -> Result<Vec<(AxisPoint<N>, Vec2)>, BeamError> {
        let place = |(xi, weight): (f64, f64)| {
            let values = self.basis.evaluate_in(&span, xi);
            let derivative = values.combine(1, self.control_points);
            let speed = derivative.norm();
            if speed.is_nan() || speed <= self.standstill {
                return Err(BeamError::NoTangent { parameter: xi });
            }
            let (mut shape, mut slope) = ([0.0; N], [0.0; N]);
            shape.copy_from_slice(values.values());
            slope.iter_mut().zip(values.slopes()).for_each(|(to, from)| *to = from / speed);
            Ok((AxisPoint { shape, slope, weight: weight * speed }, derivative / speed))
        };
        rule.into_iter().map(place).collect()
    }
}
