//! Quadrature point for the curvature `κ`, with its state between two steps and its static tangent stiffness.

use super::Section;
use super::axis_point::AxisPoint;
use super::span_stiffness::{SpanStiffness, StrainKind};

const SAME_TURN: f64 = 64.0 * f64::EPSILON;

#[derive(Debug, Clone)]
pub(super) struct MomentPoint<const N: usize> {
    pub(super) axis: AxisPoint<N>,
    pub(super) curvature: f64,
    pub(super) last_moment: f64,
}

impl<const N: usize> MomentPoint<N> {
    /// Quadrature point for an unused vector lane, with zero curvature for all increments.
    pub(super) const EMPTY: Self =
        Self { axis: AxisPoint::EMPTY, curvature: 0.0, last_moment: 0.0 };

    pub(super) fn new(axis: AxisPoint<N>) -> Self {
        Self { axis, ..Self::EMPTY }
    }

    pub(super) fn write_static_rows(&self, section: &Section, span: &mut SpanStiffness) {
        let row: [[f64; 3]; N] = std::array::from_fn(|a| [0.0, 0.0, self.axis.slope[a]]);
        span.add_strain(StrainKind::Bending, self.axis.weight * section.bending_stiffness, row);
    }

    pub(super) fn transmitted(&self, section: &Section) -> f64 {
        let missing = self.curvature - self.last_moment / section.bending_stiffness;
        let is_known = self.axis.weight * missing.abs() <= SAME_TURN;
        let moment = section.bending_stiffness * self.curvature;
        if is_known { self.last_moment } else { moment }
    }

    pub(super) fn strain_energy(&self, section: &Section) -> f64 {
        0.5 * self.axis.weight * section.bending_stiffness * self.curvature * self.curvature
    }

    pub(super) fn save(&self, state: &mut Vec<f64>) {
        state.extend([self.curvature, self.last_moment]);
    }

    pub(super) fn restore(&mut self, [curvature, moment]: [f64; 2]) {
        (self.curvature, self.last_moment) = (curvature, moment);
    }
}
