//! A quadrature point for the curvature `κ`, and the moment as an unknown of its own.
//!
//! ```text
//! κ1 = κ0 + Δω'/q     1/q = dΔθ/dΔω     M = EI ((1-σ) κ0 + σ κ1)     S_a = w N_a' M/q
//! ```
//!
//! The moment is linear in the curvature, so that Newton's method gains nothing by the unknown; but a moment computed from
//! increments of a configuration rounds like `EI` times these, which in a stiff beam is more than what is to be balanced.

use pulp::Simd;

use super::at_rest::SpanAtRest;
use super::axis_point::AxisPoint;
use super::block::Block;
use super::dynamics::{Collocation, ForceSummary, Movement};
use super::{RotationIncrement, Section};

/// Curvatures that turn a section less, over the length they stand for, are the same but for rounding [rad].
const SAME_TURN: f64 = 64.0 * f64::EPSILON;

#[derive(Debug, Clone)]
pub(super) struct MomentPoint<const N: usize> {
    axis: AxisPoint<N>,
    /// `κ0`
    curvature: f64,
    /// The moment `M` of the iterate.
    moment: f64,
    /// That of the last step, from which the next one starts.
    last_moment: f64,
    /// `m = κσ - M/EI`, where forces were taken last.
    mismatch: f64,
    linearised_at: Bend,
}

/// What increments lead to.
#[derive(Debug, Clone, Copy, Default)]
struct Bend {
    /// `κσ`
    collocated_curvature: f64,
    /// `σ`
    stress: f64,
    /// `Δω'`
    slope: f64,
    /// `1/q`, and its derivative by `Δω`.
    inverse_q: f64,
    inverse_q_slope: f64,
}

impl Bend {
    /// `δκ1 = δω'/q + Δω' δ(1/q)`, by `δω'` and `δω`.
    fn curvature_by(&self) -> (f64, f64) {
        (self.inverse_q, self.slope * self.inverse_q_slope)
    }
}

impl<const N: usize> MomentPoint<N> {
    /// A quadrature point for the curvature at a point of the undeformed axis.
    pub(super) fn new(axis: AxisPoint<N>) -> Self {
        Self {
            axis,
            curvature: 0.0,
            moment: 0.0,
            last_moment: 0.0,
            mismatch: 0.0,
            linearised_at: Bend::default(),
        }
    }

    pub(super) fn begin_step(&mut self) {
        self.moment = self.last_moment;
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
    fn bend(&self, at: Collocation, moved: &[Movement; N]) -> Bend {
        let (slope, rotation) = self.interpolate(moved);
        let (rate, rate_slope) = at.rotations.rates(rotation);
        Bend {
            collocated_curvature: self.curvature + at.stress * slope * rate,
            stress: at.stress,
            slope,
            inverse_q: rate,
            inverse_q_slope: rate_slope,
        }
    }

    #[inline(always)]
    fn distribute(&self, moment: f64, forces: &mut [Movement; N]) {
        for (slope, [_, _, omega]) in self.axis.slope.iter().zip(forces) {
            *omega += slope * moment;
        }
    }

    #[inline(always)]
    pub(super) fn add_forces(
        &mut self,
        section: &Section,
        at: Collocation,
        moved: &[Movement; N],
        weight: f64,
        forces: &mut [Movement; N],
        summary: &mut ForceSummary,
    ) {
        let now = self.bend(at, moved);
        // Where the curvature of the start alone counts, the moment is known.
        let known = section.bending_stiffness * self.curvature;
        let moment = if at.stress == 0.0 { known } else { self.moment };
        self.distribute(weight * self.axis.weight * moment * now.inverse_q, forces);
        self.mismatch = now.collocated_curvature - moment / section.bending_stiffness;
        summary.join(&ForceSummary {
            strain_mismatch: self.axis.weight * self.mismatch.abs(),
            moment: moment.abs(),
            ..ForceSummary::default()
        });
    }

    #[inline(always)]
    pub(super) fn add_linearised_forces<S: Simd>(
        &mut self,
        section: &Section,
        at: Collocation,
        moved: &[Movement; N],
        weight: f64,
        forces: &mut [Movement; N],
        block: &mut Block<S, N>,
    ) {
        let now = self.bend(at, moved);
        let (w, stiffness) = (weight * self.axis.weight, section.bending_stiffness);
        self.distribute(w * stiffness * now.collocated_curvature * now.inverse_q, forces);

        // δ(M/q) with the moment of the iterate in the geometric term.
        let (curvature_by_slope, curvature_by_rotation) = now.curvature_by();
        let resistance = stiffness * now.stress * now.inverse_q;
        let moment_by_slope = resistance * curvature_by_slope;
        let moment_by_rotation =
            resistance * curvature_by_rotation + self.moment * now.inverse_q_slope;
        for (slope_a, [_, _, row_omega]) in self.axis.slope.iter().zip(&mut block.rows) {
            let (by_slope, by_rotation) =
                (w * slope_a * moment_by_slope, w * slope_a * moment_by_rotation);
            for ((entry, slope_b), shape_b) in
                row_omega.iter_mut().zip(&self.axis.slope).zip(&self.axis.shape)
            {
                entry[2] += by_slope * slope_b + by_rotation * shape_b;
            }
        }
        self.mismatch = now.collocated_curvature - self.moment / stiffness;
        self.linearised_at = now;
    }

    /// Adds the moments `EI m` of the curvature mismatch `m` at this point, in the directions of the last linearisation.
    #[inline(always)]
    pub(super) fn add_mismatch_forces(
        &self,
        section: &Section,
        weight: f64,
        forces: &mut [Movement; N],
    ) {
        let moment = section.bending_stiffness * self.mismatch * self.linearised_at.inverse_q;
        self.distribute(weight * self.axis.weight * moment, forces);
    }

    /// Corrects the moment at this point for a correction of the movements: `M ← M + EI (m + σ δκ1)`.
    #[inline(always)]
    pub(super) fn correct_moment(&mut self, section: &Section, correction: &[Movement; N]) {
        let (slope, rotation) = self.interpolate(correction);
        let (by_slope, by_rotation) = self.linearised_at.curvature_by();
        let change = self.linearised_at.stress * (by_slope * slope + by_rotation * rotation);
        self.moment += section.bending_stiffness * (self.mismatch + change);
    }

    /// Adds the row of the curvature at rest at this point.
    pub(super) fn write_at_rest(&self, section: &Section, span: &mut SpanAtRest) {
        let row: [[f64; 3]; N] = std::array::from_fn(|a| [0.0, 0.0, self.axis.slope[a]]);
        span.add_strain(self.axis.weight * section.bending_stiffness, row);
    }

    #[inline(always)]
    pub(super) fn advance(&mut self, moved: &[Movement; N], rotations: RotationIncrement) {
        let (slope, rotation) = self.interpolate(moved);
        self.last_moment = self.moment;
        self.curvature += slope * rotations.rate(rotation);
    }

    /// The moment `M` of this point at the start of the step [force·length]: the one that was an unknown of the last solution, where it is
    /// that of the curvature but for rounding.
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
