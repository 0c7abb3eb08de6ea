//! Quadrature points for the axial and shear strain in vector lanes.
//! The section force is an independent unknown (docs/theory.md, section 11).
//!
//! The derivative of the position with respect to arc length is updated by increments.
//! Rounding errors of strains therefore do not depend on the distance from the origin.

use pulp::Simd;

use super::axis_point::{AxisPoints, Windows};
use super::block::{BlockRow, SpanTangent};
use super::dynamics::{Collocation, Movement};
use super::force_maxima::ForceMaxima;
use super::force_point::ForcePoint;
use super::pair::Pair;
use super::simd::{LANES, LaneChunk, Lanes, Number, Vector};
use super::{Rotation, RotationIncrement};

pub(super) type Stiffness<V> = Pair<Vector<V>>;

#[derive(Debug, Clone)]
pub(super) struct ForcePoints<const N: usize> {
    axis: AxisPoints<N>,
    gradient: Pair<Lanes>,
    rotation: Rotation<Lanes>,
    strain: Pair<Lanes>,
    force: Pair<Lanes>,
    /// Section force of the last step, with which the iteration of the next step starts.
    /// In fast vibration, the section force of the last step is closer to the solution than the force for the strain at the start of the step.
    last_force: Pair<Lanes>,
    mismatch: Pair<Lanes>,
    linearised_at: StrainKinematics<Lanes>,
    linearised_stress: f64,
}

#[derive(Debug, Clone, Copy)]
struct StrainKinematics<T> {
    end_rotation: Rotation<T>,
    end_strain: Pair<T>,
    collocated_rotation: Rotation<T>,
    collocated_gradient: Pair<T>,
    inverse_q: T,
}

#[derive(Debug, Clone, Copy, Default)]
pub(super) struct Resultant {
    force: Pair<Lanes>,
    torque: Lanes,
}

#[derive(Debug, Clone, Copy)]
pub(super) struct ForceTangent<const N: usize> {
    rows: [[Lanes; 3]; 3],
    weighted_slope: [Lanes; N],
    weighted_shape: [Lanes; N],
}

impl<const N: usize> Default for ForceTangent<N> {
    fn default() -> Self {
        let none = Lanes::default();
        Self { rows: [[none; 3]; 3], weighted_slope: [none; N], weighted_shape: [none; N] }
    }
}

impl<const N: usize> ForcePoints<N> {
    pub(super) fn side_by_side(points: [&ForcePoint<N>; LANES], first: [usize; LANES]) -> Self {
        let (none, rotation) = (Pair::default(), Rotation::default());
        let undeformed = StrainKinematics {
            end_rotation: rotation,
            end_strain: none,
            collocated_rotation: rotation,
            collocated_gradient: none,
            inverse_q: Lanes::default(),
        };
        let mut side_by_side = Self {
            axis: AxisPoints::side_by_side(points.map(|point| &point.axis), first),
            gradient: none,
            rotation,
            strain: none,
            force: none,
            last_force: none,
            mismatch: none,
            linearised_at: undeformed,
            linearised_stress: 0.0,
        };
        points.iter().enumerate().for_each(|(lane, point)| side_by_side.set(lane, point));
        side_by_side
    }

    pub(super) fn point(&self, lane: usize) -> ForcePoint<N> {
        ForcePoint {
            axis: self.axis.point(lane),
            gradient: self.gradient.lane(lane),
            rotation: self.rotation.lane(lane),
            strain: self.strain.lane(lane),
            last_force: self.last_force.lane(lane),
        }
    }

    pub(super) fn set(&mut self, lane: usize, point: &ForcePoint<N>) {
        self.gradient.set_lane(lane, point.gradient);
        self.rotation.set_lane(lane, point.rotation);
        self.strain.set_lane(lane, point.strain);
        self.last_force.set_lane(lane, point.last_force);
    }

    pub(super) fn begin_step(&mut self) {
        self.force = self.last_force;
    }

    #[inline(always)]
    fn interpolate<V: Simd>(
        &self,
        part: LaneChunk<V>,
        moved: &Windows<'_, N>,
    ) -> (Pair<Vector<V>>, Vector<V>) {
        let zero = part.splat(0.0);
        let (mut gradient, mut rotation) = (Pair { x: zero, y: zero }, zero);
        for a in 0..N {
            let (shape, slope) = (self.axis.shape[a].get(part), self.axis.slope[a].get(part));
            gradient.x += slope * moved.component(a, 0).get(part);
            gradient.y += slope * moved.component(a, 1).get(part);
            rotation += shape * moved.component(a, 2).get(part);
        }
        (gradient, rotation)
    }

    #[inline(always)]
    fn configuration<V: Simd>(
        &self,
        part: LaneChunk<V>,
        at: Collocation,
        moved: &Windows<'_, N>,
    ) -> (StrainKinematics<Vector<V>>, Pair<Vector<V>>, Vector<V>) {
        let (change, increment) = self.interpolate(part, moved);
        let (gradient, rotation) = (self.gradient.get(part), self.rotation.get(part));
        let turn = at.rotations.turn(increment);
        let end_rotation = rotation.times(&turn);
        let end_strain = strain_of(end_rotation, gradient + change);
        let (tau, sigma) = (part.splat(at.configuration), part.splat(at.stress));
        let strain = self.strain.get(part);
        let configuration = StrainKinematics {
            end_rotation,
            end_strain,
            collocated_rotation: rotation.mixed(end_rotation, tau),
            collocated_gradient: gradient + change * tau,
            inverse_q: turn.rate,
        };
        (configuration, strain + (end_strain - strain) * sigma, increment)
    }

    #[inline(always)]
    fn apply_weights<V: Simd>(
        &self,
        part: LaneChunk<V>,
        weight: f64,
        (gradient, force): (Pair<Vector<V>>, Pair<Vector<V>>),
        resultant: &mut Resultant,
    ) {
        let weight = part.splat(weight) * self.axis.weight.get(part);
        resultant.force.put(part, force * weight);
        resultant.torque.put(part, gradient.cross(force) * weight);
    }

    #[inline(always)]
    pub(super) fn distribute(
        &self,
        lane: usize,
        resultant: &Resultant,
        forces: &mut [Movement; N],
    ) {
        let (force, torque) = (resultant.force.lane(lane), resultant.torque.lane(lane));
        for ((shape, slope), [x, y, omega]) in
            self.axis.shape.iter().zip(&self.axis.slope).zip(forces)
        {
            *x += slope.lane(lane) * force.x;
            *y += slope.lane(lane) * force.y;
            *omega -= shape.lane(lane) * torque;
        }
    }

    #[inline(always)]
    pub(super) fn take_forces<V: Simd>(
        &mut self,
        part: LaneChunk<V>,
        (stiffness, weight): (Stiffness<V>, f64),
        at: Collocation,
        moved: &Windows<'_, N>,
        resultant: &mut Resultant,
        maxima: &mut ForceMaxima<Lanes>,
    ) {
        let (now, collocated_strain, increment) = self.configuration(part, at, moved);
        let force = if at.stress == 0.0 {
            stiffness.by_component(self.strain.get(part))
        } else {
            self.force.get(part)
        };
        let spatial = now.collocated_rotation.to_space(force);
        self.apply_weights(part, weight, (now.collocated_gradient, spatial), resultant);
        let mismatch = collocated_strain - force.over_component(stiffness);
        self.mismatch.put(part, mismatch);
        let force = force.larger_magnitude();
        maxima.join(
            part,
            ForceMaxima {
                strain_mismatch: mismatch.larger_magnitude(),
                force,
                moment: self.axis.weight.get(part) * force,
                rotation: increment.abs(),
            },
        );
    }

    #[inline(always)]
    pub(super) fn linearise<V: Simd>(
        &mut self,
        part: LaneChunk<V>,
        (stiffness, weight): (Stiffness<V>, f64),
        at: Collocation,
        moved: &Windows<'_, N>,
        (resultant, tangent): (&mut Resultant, &mut ForceTangent<N>),
    ) {
        let (now, collocated_strain, _) = self.configuration(part, at, moved);
        let (tau, sigma) = (part.splat(at.configuration), part.splat(at.stress));
        let (rotation, gradient) = (now.collocated_rotation, now.collocated_gradient);
        let condensed = force_in_space(rotation, stiffness, collocated_strain);
        self.apply_weights(part, weight, (gradient, condensed), resultant);

        // Derivatives of the section force and of its moment. The geometric terms contain the section force of the present iterate.
        let (end, force) = (now.end_rotation, self.force.get(part));
        let (e1, e2) = (Pair::first_axis(tau), Pair::second_axis(tau));
        let a1 = force_in_space(rotation, stiffness, end.to_section(e1)) * sigma;
        let a2 = force_in_space(rotation, stiffness, end.to_section(e2)) * sigma;
        let turned_strain = (now.end_strain + e1).perpendicular();
        let b = (end.to_space(force.perpendicular()) * tau
            - force_in_space(rotation, stiffness, turned_strain) * sigma)
            * now.inverse_q;
        let lever = gradient.perpendicular();
        let geometric = rotation.to_space(force).perpendicular() * tau;
        let e = Pair { x: a1.dot(lever), y: a2.dot(lever) } - geometric;
        let f = lever.dot(b);

        let rows = [[a1.x, a2.x, b.x], [a1.y, a2.y, b.y], [e.x, e.y, f]];
        for (to, row) in tangent.rows.as_flattened_mut().iter_mut().zip(rows.as_flattened()) {
            to.put(part, *row);
        }
        let w = part.splat(weight) * self.axis.weight.get(part);
        for a in 0..N {
            tangent.weighted_slope[a].put(part, w * self.axis.slope[a].get(part));
            tangent.weighted_shape[a].put(part, -w * self.axis.shape[a].get(part));
        }
        self.mismatch.put(part, collocated_strain - force.over_component(stiffness));
        self.linearised_at.put(part, now);
        self.linearised_stress = at.stress;
    }

    #[inline(always)]
    pub(super) fn add_tangent<V: Simd>(
        &self,
        lane: usize,
        tangent: &ForceTangent<N>,
        block: &mut SpanTangent<V, N>,
    ) {
        let mut rows: [BlockRow<N>; 3] = [[[0.0; 3]; N]; 3];
        for (row, [by_x, by_y, by_rotation]) in rows.iter_mut().zip(&tangent.rows) {
            let functions = self.axis.slope.iter().zip(&self.axis.shape);
            for (entry, (slope, shape)) in row.iter_mut().zip(functions) {
                let (slope, shape) = (slope.lane(lane), shape.lane(lane));
                *entry = [
                    by_x.lane(lane) * slope,
                    by_y.lane(lane) * slope,
                    by_rotation.lane(lane) * shape,
                ];
            }
        }
        let functions = tangent.weighted_slope.iter().zip(&tangent.weighted_shape);
        for (function, (slope, shape)) in functions.enumerate() {
            let factors = [slope.lane(lane), slope.lane(lane), shape.lane(lane)];
            for (component, (factor, row)) in factors.into_iter().zip(&rows).enumerate() {
                block.add_multiple((function, component), factor, row);
            }
        }
    }

    #[inline(always)]
    pub(super) fn take_mismatch_forces<V: Simd>(
        &self,
        part: LaneChunk<V>,
        (stiffness, weight): (Stiffness<V>, f64),
        resultant: &mut Resultant,
    ) {
        let StrainKinematics { collocated_rotation, collocated_gradient, .. } = self.linearised_at;
        let rotation = collocated_rotation.get(part);
        let force = force_in_space(rotation, stiffness, self.mismatch.get(part));
        self.apply_weights(part, weight, (collocated_gradient.get(part), force), resultant);
    }

    #[inline(always)]
    pub(super) fn correct_section_forces<V: Simd>(
        &mut self,
        part: LaneChunk<V>,
        stiffness: Stiffness<V>,
        correction: &Windows<'_, N>,
    ) {
        let (gradient, rotation) = self.interpolate(part, correction);
        let StrainKinematics { end_rotation, end_strain, inverse_q, .. } = self.linearised_at;
        let stretched = end_strain.get(part) + Pair::first_axis(rotation);
        let turned = stretched.perpendicular() * (rotation * inverse_q.get(part));
        let change = end_rotation.get(part).to_section(gradient) - turned;
        let missing = self.mismatch.get(part) + change * part.splat(self.linearised_stress);
        self.force.put(part, self.force.get(part) + stiffness.by_component(missing));
    }

    #[inline(always)]
    pub(super) fn advance<V: Simd>(
        &mut self,
        part: LaneChunk<V>,
        moved: &Windows<'_, N>,
        rotations: RotationIncrement,
    ) {
        let (change, increment) = self.interpolate(part, moved);
        let gradient = self.gradient.get(part) + change;
        let rotation = self.rotation.get(part).turned(rotations, increment).normalised();
        self.last_force.put(part, self.force.get(part));
        self.gradient.put(part, gradient);
        self.rotation.put(part, rotation);
        self.strain.put(part, strain_of(rotation, gradient));
    }

    #[inline(always)]
    pub(super) fn windows<'a>(&self, movements: &'a [Movement]) -> Windows<'a, N> {
        self.axis.windows(movements)
    }
}

impl StrainKinematics<Lanes> {
    #[inline(always)]
    fn put<V: Simd>(&mut self, part: LaneChunk<V>, now: StrainKinematics<Vector<V>>) {
        self.end_rotation.put(part, now.end_rotation);
        self.end_strain.put(part, now.end_strain);
        self.collocated_rotation.put(part, now.collocated_rotation);
        self.collocated_gradient.put(part, now.collocated_gradient);
        self.inverse_q.put(part, now.inverse_q);
    }
}

#[inline(always)]
fn strain_of<T: Number>(rotation: Rotation<T>, gradient: Pair<T>) -> Pair<T> {
    rotation.to_section(gradient) - Pair::first_axis(gradient.x)
}

#[inline(always)]
fn force_in_space<T: Number>(
    rotation: Rotation<T>,
    stiffness: Pair<T>,
    strain: Pair<T>,
) -> Pair<T> {
    rotation.to_space(stiffness.by_component(strain))
}
