//! A quadrature point for the curvature `κ`.
//!
//! ```text
//! κ1 = κ0 + Δω'/q     1/q = dΔθ/dΔω     M = EI ((1-σ) κ0 + σ κ1)     S_a = w N_a' M/q
//! ```

use pulp::Simd;

use super::axis_point::AxisPoint;
use super::block::Block;
use super::dynamics::{Collocation, ForceSummary, Movement};
use super::{RotationIncrement, Section};

#[derive(Debug, Clone)]
pub(super) struct MomentPoint<const N: usize> {
    axis: AxisPoint<N>,
    /// `κ0`
    curvature: f64,
}

/// What increments lead to: `M/q` and its derivatives by `Δω'` and `Δω`.
struct Response {
    moment: f64,
    by_slope: f64,
    by_rotation: f64,
}

impl<const N: usize> MomentPoint<N> {
    /// A point of the undeformed axis.
    pub(super) fn new(axis: AxisPoint<N>) -> Self {
        Self { axis, curvature: 0.0 }
    }

    /// `(Δω', Δω)` of movements.
    #[inline(always)]
    fn interpolate(&self, moved: &[Movement; N]) -> (f64, f64) {
        let (mut slope, mut rotation) = (0.0, 0.0);
        for ((shape, derivative), [_, _, omega]) in
            self.axis.shape.iter().zip(&self.axis.slope).zip(moved)
        {
            slope += derivative * omega;
            rotation += shape * omega;
        }
        (slope, rotation)
    }

    #[inline(always)]
    fn response(&self, section: &Section, at: Collocation, moved: &[Movement; N]) -> Response {
        let (slope, rotation) = self.interpolate(moved);
        let turn = at.rotations.turn(rotation);
        let moment = section.bending_stiffness * (self.curvature + at.stress * slope * turn.rate);
        let stiffness = section.bending_stiffness * at.stress * turn.rate;
        Response {
            moment: moment * turn.rate,
            by_slope: stiffness * turn.rate,
            by_rotation: turn.rate_slope * (moment + stiffness * slope),
        }
    }

    #[inline(always)]
    fn distribute(&self, moment: f64, forces: &mut [Movement; N]) {
        for (slope, [_, _, omega]) in self.axis.slope.iter().zip(forces) {
            *omega += slope * moment;
        }
    }

    #[inline]
    pub(super) fn add_forces(
        &self,
        section: &Section,
        at: Collocation,
        moved: &[Movement; N],
        weight: f64,
        forces: &mut [Movement; N],
        summary: &mut ForceSummary,
    ) {
        let moment = self.response(section, at, moved).moment;
        self.distribute(weight * self.axis.weight * moment, forces);
        summary.join(&ForceSummary { moment: moment.abs(), ..ForceSummary::default() });
    }

    #[inline(always)]
    pub(super) fn add_linearised_forces<S: Simd>(
        &self,
        section: &Section,
        at: Collocation,
        moved: &[Movement; N],
        weight: f64,
        forces: &mut [Movement; N],
        block: &mut Block<S, N>,
    ) {
        let response = self.response(section, at, moved);
        let w = weight * self.axis.weight;
        self.distribute(w * response.moment, forces);
        for (slope_a, [_, _, row_omega]) in self.axis.slope.iter().zip(&mut block.rows) {
            let (by_slope, by_rotation) =
                (w * slope_a * response.by_slope, w * slope_a * response.by_rotation);
            for ((entry, slope_b), shape_b) in
                row_omega.iter_mut().zip(&self.axis.slope).zip(&self.axis.shape)
            {
                entry[2] += by_slope * slope_b + by_rotation * shape_b;
            }
        }
    }

    pub(super) fn advance(&mut self, moved: &[Movement; N], rotations: RotationIncrement) {
        let (slope, rotation) = self.interpolate(moved);
        self.curvature += slope * rotations.turn(rotation).rate;
    }

    pub(super) fn strain_energy(&self, section: &Section) -> f64 {
        0.5 * self.axis.weight * section.bending_stiffness * self.curvature * self.curvature
    }

    pub(super) fn curvature(&self) -> f64 {
        self.curvature
    }

    pub(super) fn set_curvature(&mut self, curvature: f64) {
        self.curvature = curvature;
    }
}
