//! Quadrature points for the curvature in vector lanes. The bending moment is an independent unknown (docs/theory.md, section 11).
//!
//! In a stiff beam, the rounding error of a bending moment computed from increments would exceed the tolerance of the residual forces.

use pulp::Simd;

use super::RotationIncrement;
use super::axis_point::{AxisPoints, Windows};
use super::block::SpanTangent;
use super::dynamics::{Collocation, Movement};
use super::force_maxima::ForceMaxima;
use super::moment_point::MomentPoint;
use super::simd::{LANES, LaneChunk, Lanes, Number, Vector};

#[derive(Debug, Clone)]
pub(super) struct MomentPoints<const N: usize> {
    axis: AxisPoints<N>,
    curvature: Lanes,
    moment: Lanes,
    last_moment: Lanes,
    mismatch: Lanes,
    linearised_at: CurvatureKinematics<Lanes>,
    linearised_stress: f64,
}

#[derive(Debug, Clone, Copy, Default)]
struct CurvatureKinematics<T> {
    slope: T,
    inverse_q: T,
    inverse_q_slope: T,
}

impl<T: Number> CurvatureKinematics<T> {
    #[inline(always)]
    fn curvature_by(&self) -> (T, T) {
        (self.inverse_q, self.slope * self.inverse_q_slope)
    }
}

impl CurvatureKinematics<Lanes> {
    #[inline(always)]
    fn get<V: Simd>(&self, part: LaneChunk<V>) -> CurvatureKinematics<Vector<V>> {
        CurvatureKinematics {
            slope: self.slope.get(part),
            inverse_q: self.inverse_q.get(part),
            inverse_q_slope: self.inverse_q_slope.get(part),
        }
    }

    #[inline(always)]
    fn put<V: Simd>(&mut self, part: LaneChunk<V>, now: CurvatureKinematics<Vector<V>>) {
        self.slope.put(part, now.slope);
        self.inverse_q.put(part, now.inverse_q);
        self.inverse_q_slope.put(part, now.inverse_q_slope);
    }
}

#[derive(Debug, Clone, Copy)]
pub(super) struct MomentTangent<const N: usize>([[Lanes; N]; N]);

impl<const N: usize> Default for MomentTangent<N> {
    fn default() -> Self {
        Self([[Lanes::default(); N]; N])
    }
}

impl<const N: usize> MomentPoints<N> {
    pub(super) fn side_by_side(points: [&MomentPoint<N>; LANES], first: [usize; LANES]) -> Self {
        let none = Lanes::default();
        let mut side_by_side = Self {
            axis: AxisPoints::side_by_side(points.map(|point| &point.axis), first),
            curvature: none,
            moment: none,
            last_moment: none,
            mismatch: none,
            linearised_at: CurvatureKinematics::default(),
            linearised_stress: 0.0,
        };
        points.iter().enumerate().for_each(|(lane, point)| side_by_side.set(lane, point));
        side_by_side
    }

    pub(super) fn point(&self, lane: usize) -> MomentPoint<N> {
        MomentPoint {
            axis: self.axis.point(lane),
            curvature: self.curvature.lane(lane),
            last_moment: self.last_moment.lane(lane),
        }
    }

    pub(super) fn set(&mut self, lane: usize, point: &MomentPoint<N>) {
        self.curvature.set_lane(lane, point.curvature);
        self.last_moment.set_lane(lane, point.last_moment);
    }

    pub(super) fn begin_step(&mut self) {
        self.moment = self.last_moment;
    }

    #[inline(always)]
    fn interpolate<V: Simd>(
        &self,
        part: LaneChunk<V>,
        moved: &Windows<'_, N>,
    ) -> (Vector<V>, Vector<V>) {
        let (mut slope, mut rotation) = (part.splat(0.0), part.splat(0.0));
        for a in 0..N {
            let omega = moved.component(a, 2).get(part);
            slope += self.axis.slope[a].get(part) * omega;
            rotation += self.axis.shape[a].get(part) * omega;
        }
        (slope, rotation)
    }

    #[inline(always)]
    fn bend<V: Simd>(
        &self,
        part: LaneChunk<V>,
        at: Collocation,
        moved: &Windows<'_, N>,
    ) -> (CurvatureKinematics<Vector<V>>, Vector<V>) {
        let (slope, rotation) = self.interpolate(part, moved);
        let (rate, rate_slope) = at.rotations.rates(rotation);
        let curvature = self.curvature.get(part) + part.splat(at.stress) * slope * rate;
        (CurvatureKinematics { slope, inverse_q: rate, inverse_q_slope: rate_slope }, curvature)
    }

    #[inline(always)]
    pub(super) fn distribute(&self, lane: usize, moment: &Lanes, forces: &mut [Movement; N]) {
        let moment = moment.lane(lane);
        for (slope, [_, _, omega]) in self.axis.slope.iter().zip(forces) {
            *omega += slope.lane(lane) * moment;
        }
    }

    #[inline(always)]
    pub(super) fn take_forces<V: Simd>(
        &mut self,
        part: LaneChunk<V>,
        (stiffness, weight): (Vector<V>, f64),
        at: Collocation,
        moved: &Windows<'_, N>,
        weighted_moment: &mut Lanes,
        maxima: &mut ForceMaxima<Lanes>,
    ) {
        let (now, collocated_curvature) = self.bend(part, at, moved);
        let known = stiffness * self.curvature.get(part);
        let moment = if at.stress == 0.0 { known } else { self.moment.get(part) };
        let length = self.axis.weight.get(part);
        weighted_moment.put(part, part.splat(weight) * length * moment * now.inverse_q);
        let mismatch = collocated_curvature - moment / stiffness;
        self.mismatch.put(part, mismatch);
        maxima.join_moment(part, length * mismatch.abs(), moment.abs());
    }

    #[inline(always)]
    pub(super) fn linearise<V: Simd>(
        &mut self,
        part: LaneChunk<V>,
        (stiffness, weight): (Vector<V>, f64),
        at: Collocation,
        moved: &Windows<'_, N>,
        (weighted_moment, tangent): (&mut Lanes, &mut MomentTangent<N>),
    ) {
        let (now, collocated_curvature) = self.bend(part, at, moved);
        let w = part.splat(weight) * self.axis.weight.get(part);
        weighted_moment.put(part, w * stiffness * collocated_curvature * now.inverse_q);

        // Derivatives of the nodal forces due to the bending moment. The geometric term contains the bending moment of the present iterate.
        let moment = self.moment.get(part);
        let (curvature_by_slope, curvature_by_rotation) = now.curvature_by();
        let resistance = stiffness * part.splat(at.stress) * now.inverse_q;
        let moment_by_slope = resistance * curvature_by_slope;
        let moment_by_rotation = resistance * curvature_by_rotation + moment * now.inverse_q_slope;
        for (slope_a, row) in self.axis.slope.iter().zip(&mut tangent.0) {
            let weighted = w * slope_a.get(part);
            let (by_slope, by_rotation) =
                (weighted * moment_by_slope, weighted * moment_by_rotation);
            for ((entry, slope_b), shape_b) in
                row.iter_mut().zip(&self.axis.slope).zip(&self.axis.shape)
            {
                entry.put(part, by_slope * slope_b.get(part) + by_rotation * shape_b.get(part));
            }
        }
        self.mismatch.put(part, collocated_curvature - moment / stiffness);
        self.linearised_at.put(part, now);
        self.linearised_stress = at.stress;
    }

    #[inline(always)]
    pub(super) fn add_tangent<V: Simd>(
        &self,
        lane: usize,
        tangent: &MomentTangent<N>,
        block: &mut SpanTangent<V, N>,
    ) {
        for (row, [_, _, row_omega]) in tangent.0.iter().zip(&mut block.rows) {
            for (entry, [_, _, by_omega]) in row.iter().zip(row_omega) {
                *by_omega += entry.lane(lane);
            }
        }
    }

    #[inline(always)]
    pub(super) fn take_mismatch_forces<V: Simd>(
        &self,
        part: LaneChunk<V>,
        (stiffness, weight): (Vector<V>, f64),
        weighted_moment: &mut Lanes,
    ) {
        let inverse_q = self.linearised_at.inverse_q.get(part);
        let moment = stiffness * self.mismatch.get(part) * inverse_q;
        let w = part.splat(weight) * self.axis.weight.get(part);
        weighted_moment.put(part, w * moment);
    }

    /// Corrects the bending moments after a correction of the increments (docs/theory.md, section 11).
    #[inline(always)]
    pub(super) fn correct_moments<V: Simd>(
        &mut self,
        part: LaneChunk<V>,
        stiffness: Vector<V>,
        correction: &Windows<'_, N>,
    ) {
        let (slope, rotation) = self.interpolate(part, correction);
        let (by_slope, by_rotation) = self.linearised_at.get(part).curvature_by();
        let sigma = part.splat(self.linearised_stress);
        let change = sigma * (by_slope * slope + by_rotation * rotation);
        let missing = self.mismatch.get(part) + change;
        self.moment.put(part, self.moment.get(part) + stiffness * missing);
    }

    #[inline(always)]
    pub(super) fn advance<V: Simd>(
        &mut self,
        part: LaneChunk<V>,
        moved: &Windows<'_, N>,
        rotations: RotationIncrement,
    ) {
        let (slope, rotation) = self.interpolate(part, moved);
        self.last_moment.put(part, self.moment.get(part));
        let change = slope * rotations.rate(rotation);
        self.curvature.put(part, self.curvature.get(part) + change);
    }

    #[inline(always)]
    pub(super) fn windows<'a>(&self, movements: &'a [Movement]) -> Windows<'a, N> {
        self.axis.windows(movements)
    }
}
