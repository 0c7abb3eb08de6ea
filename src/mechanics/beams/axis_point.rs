//! Quadrature point on the undeformed axis.

use super::BeamError;
use super::dynamics::Movement;
use super::simd::{LANES, Lanes};
use super::span_points::window;
use crate::geometry::{Basis, Span, Vec2};

/// Largest parametric speed `|dx/dξ|` at which the axis counts as having no tangent, as a fraction of the mean parametric speed [-].
const STANDSTILL: f64 = 1e-9;

#[derive(Debug, Clone)]
pub(super) struct AxisPoint<const N: usize> {
    /// Values of the basis functions [-], one for each control point of the span.
    pub(super) shape: [f64; N],
    /// Derivatives of the basis functions with respect to arc length [1/length], one for each control point of the span.
    pub(super) slope: [f64; N],
    /// Weight in integrals along the axis [length].
    pub(super) weight: f64,
}

impl<const N: usize> AxisPoint<N> {
    pub(super) const EMPTY: Self = Self { shape: [0.0; N], slope: [0.0; N], weight: 0.0 };
}

#[derive(Debug, Clone)]
pub(super) struct AxisPoints<const N: usize> {
    pub(super) shape: [Lanes; N],
    pub(super) slope: [Lanes; N],
    pub(super) weight: Lanes,
    pub(super) first: [usize; LANES],
}

impl<const N: usize> AxisPoints<N> {
    pub(super) fn side_by_side(points: [&AxisPoint<N>; LANES], first: [usize; LANES]) -> Self {
        let none = Lanes::default();
        let mut axis = Self { shape: [none; N], slope: [none; N], weight: none, first };
        for (lane, point) in points.into_iter().enumerate() {
            for function in 0..N {
                axis.shape[function].set_lane(lane, point.shape[function]);
                axis.slope[function].set_lane(lane, point.slope[function]);
            }
            axis.weight.set_lane(lane, point.weight);
        }
        axis
    }

    pub(super) fn point(&self, lane: usize) -> AxisPoint<N> {
        AxisPoint {
            shape: self.shape.map(|value| value.lane(lane)),
            slope: self.slope.map(|slope| slope.lane(lane)),
            weight: self.weight.lane(lane),
        }
    }

    #[inline(always)]
    pub(super) fn windows<'a>(&self, movements: &'a [Movement]) -> Windows<'a, N> {
        let mut windows = [window(movements, self.first[0]); LANES];
        for (window_of_lane, first) in windows.iter_mut().zip(self.first).skip(1) {
            *window_of_lane = window(movements, first);
        }
        Windows(windows)
    }
}

pub(super) struct Windows<'a, const N: usize>([&'a [Movement; N]; LANES]);

impl<const N: usize> Windows<'_, N> {
    #[inline(always)]
    pub(super) fn component(&self, function: usize, component: usize) -> Lanes {
        let mut lanes = Lanes::default();
        for (lane, window) in self.0.iter().enumerate() {
            lanes.set_lane(lane, window[function][component]);
        }
        lanes
    }
}

pub(super) struct BeamAxis<'a> {
    basis: &'a Basis,
    control_points: &'a [Vec2],
    least_speed: f64,
}

impl<'a> BeamAxis<'a> {
    pub(super) fn new(basis: &'a Basis, control_points: &'a [Vec2], length: f64) -> Self {
        let (start, end) = basis.domain();
        Self { basis, control_points, least_speed: STANDSTILL * length / (end - start) }
    }

    pub(super) fn points<const N: usize>(
        &self,
        span: Span,
        rule: impl IntoIterator<Item = (f64, f64)>,
    ) -> Result<Vec<(AxisPoint<N>, Vec2)>, BeamError> {
        let place = |(xi, weight): (f64, f64)| {
            let values = self.basis.evaluate_in(&span, xi);
            let derivative = values.combine(1, self.control_points);
            let speed = derivative.norm();
            if speed.is_nan() || speed <= self.least_speed {
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
