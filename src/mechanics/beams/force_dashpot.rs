//! Dashpot for axial and shear strain at a quadrature point. Equations: docs/theory.md, section 9.2.

use super::dashpots::{Functions, RateCollocation, larger_missing};
use super::dynamics::{ForceSummary, Movement};
use super::present_rates::{DashpotRates, RateMismatch};
use super::{Rotation, RotationIncrement};
use crate::geometry::{Vec2, cross, larger, perpendicular};

#[derive(Debug, Clone)]
pub(super) struct ForceDashpot {
    functions: Functions,
    damping: Vec2,
    gradient: Vec2,
    rotation: Rotation,
    last_rate: Vec2,
    rate_before: Vec2,
    start_rate: Vec2,
    force: Vec2,
    last_force: Vec2,
    mismatch: Vec2,
    linearised_at: DashpotKinematics,
}

#[derive(Debug, Clone, Copy)]
struct DashpotKinematics {
    end_rotation: Rotation,
    end_stretch: Vec2,
    change: Vec2,
    rotation: Rotation,
    gradient: Vec2,
    inverse_q: f64,
    resistance: Vec2,
}

impl ForceDashpot {
    pub(super) fn new(functions: Functions, tangent: Vec2, damping: Vec2) -> Self {
        let rotation = Rotation { cos: tangent.x, sin: tangent.y };
        Self {
            functions,
            damping,
            gradient: tangent,
            rotation,
            last_rate: Vec2::zeros(),
            rate_before: Vec2::zeros(),
            start_rate: Vec2::zeros(),
            force: Vec2::zeros(),
            last_force: Vec2::zeros(),
            mismatch: Vec2::zeros(),
            linearised_at: DashpotKinematics {
                end_rotation: rotation,
                end_stretch: Vec2::x(),
                change: Vec2::zeros(),
                rotation,
                gradient: tangent,
                inverse_q: 1.0,
                resistance: Vec2::zeros(),
            },
        }
    }

    pub(super) fn begin_step(&mut self, rates: &[Movement]) {
        self.force = self.last_force;
        self.start_rate = self.rate(rates);
    }

    pub(super) fn rest_without_damping(&mut self) {
        self.force = Vec2::zeros();
    }

    fn carried(&self, late: f64) -> Vec2 {
        self.last_rate + (self.last_rate - self.rate_before) * late
    }

    pub(super) fn last_rate_mismatch(&self, share: f64) -> [RateMismatch; 2] {
        let of = |axis: usize| {
            let means = [self.rate_before[axis], self.last_rate[axis]];
            let damping = self.functions.weight * self.damping[axis];
            RateMismatch::of(damping, self.start_rate[axis], means, share)
        };
        [of(0), of(1)]
    }

    fn configuration(&self, at: RateCollocation, moved: &[Movement]) -> DashpotKinematics {
        let (by, increment, _) = self.functions.interpolate(moved);
        let end_rotation = self.rotation.turned(at.rotations, increment);
        DashpotKinematics {
            end_rotation,
            end_stretch: end_rotation.to_section(self.gradient + by),
            change: self.change(by, at.rotations, increment),
            rotation: self.rotation.mixed(end_rotation, at.fraction),
            gradient: self.gradient + by * at.fraction,
            inverse_q: at.rotations.rate(increment),
            resistance: self.damping * at.by_change,
        }
    }

    /// Strain change in the step, computed from the increments.
    /// The difference of the strains at the end and at the start would be less accurate, because each strain is a small difference of numbers close to one.
    fn change(&self, by: Vec2, rotations: RotationIncrement, increment: f64) -> Vec2 {
        let mean = self.rotation.mixed(self.rotation.turned(rotations, increment), 0.5);
        let turned = perpendicular(self.gradient + by * 0.5) * rotations.tangent_scaled(increment);
        mean.to_section(by - turned)
    }

    fn target_force(&self, at: RateCollocation, now: &DashpotKinematics) -> Vec2 {
        let carried = self.last_rate * at.by_last;
        now.resistance.component_mul(&now.change) - self.damping.component_mul(&carried)
    }

    fn distribute(
        &self,
        (rotation, gradient): (Rotation, Vec2),
        force: Vec2,
        first: usize,
        give: &mut dyn FnMut(usize, Movement),
    ) {
        let force = rotation.to_space(force) * self.functions.weight;
        let torque = cross(gradient, force);
        let functions = self.functions.shape.iter().zip(&self.functions.slope);
        for (point, (shape, slope)) in functions.enumerate() {
            give(first + point, [slope * force.x, slope * force.y, -shape * torque]);
        }
    }

    pub(super) fn add_forces(
        &mut self,
        at: RateCollocation,
        moved: &[Movement],
        first: usize,
        give: &mut dyn FnMut(usize, Movement),
        summary: &mut ForceSummary,
    ) {
        let now = self.configuration(at, moved);
        self.mismatch = self.target_force(at, &now) - self.force;
        self.distribute((now.rotation, now.gradient), self.force, first, give);
        let force = larger(self.force.x.abs(), self.force.y.abs());
        summary.join(&ForceSummary {
            strain_mismatch: larger_missing(self.mismatch, now.resistance),
            force,
            moment: self.functions.weight * force,
            rotation: 0.0,
        });
    }

    pub(super) fn add_linearised_forces(
        &mut self,
        at: RateCollocation,
        moved: &[Movement],
        first: usize,
        give: &mut dyn FnMut(usize, Movement),
        block: &mut [f64],
    ) {
        let now = self.configuration(at, moved);
        let wanted = self.target_force(at, &now);
        self.mismatch = wanted - self.force;
        self.distribute((now.rotation, now.gradient), wanted, first, give);

        // Derivatives of the dashpot force and of its moment. The geometric terms contain the dashpot force of the present iterate.
        let (end, share) = (now.end_rotation, at.fraction);
        let resist = |strain: Vec2| now.rotation.to_space(now.resistance.component_mul(&strain));
        let (a1, a2) = (resist(end.to_section(Vec2::x())), resist(end.to_section(Vec2::y())));
        let b = (end.to_space(perpendicular(self.force)) * share
            - resist(perpendicular(now.end_stretch)))
            * now.inverse_q;
        let lever = perpendicular(now.gradient);
        let geometric = perpendicular(now.rotation.to_space(self.force)) * share;
        let e = Vec2::new(a1.dot(&lever), a2.dot(&lever)) - geometric;
        let by = [[a1.x, a2.x, b.x], [a1.y, a2.y, b.y], [e.x, e.y, lever.dot(&b)]];

        let Functions { shape, slope, weight } = &self.functions;
        let width = 3 * shape.len();
        for (row, (shape_a, slope_a)) in shape.iter().zip(slope).enumerate() {
            let factors = [weight * slope_a, weight * slope_a, -weight * shape_a];
            for (component, (factor, by)) in factors.into_iter().zip(by).enumerate() {
                let entries = &mut block[(3 * row + component) * width..][..width];
                for (entry, (shape_b, slope_b)) in
                    entries.chunks_exact_mut(3).zip(shape.iter().zip(slope))
                {
                    entry[0] += factor * by[0] * slope_b;
                    entry[1] += factor * by[1] * slope_b;
                    entry[2] += factor * by[2] * shape_b;
                }
            }
        }
        self.linearised_at = now;
    }

    pub(super) fn add_mismatch_forces(&self, first: usize, give: &mut dyn FnMut(usize, Movement)) {
        let DashpotKinematics { rotation, gradient, .. } = self.linearised_at;
        self.distribute((rotation, gradient), self.mismatch, first, give);
    }

    pub(super) fn correct(&mut self, correction: &[Movement]) {
        let (gradient, rotation, _) = self.functions.interpolate(correction);
        let DashpotKinematics { end_rotation, end_stretch, inverse_q, resistance, .. } =
            self.linearised_at;
        let turned = perpendicular(end_stretch) * (rotation * inverse_q);
        let change = end_rotation.to_section(gradient) - turned;
        self.force += self.mismatch + resistance.component_mul(&change);
    }

    pub(super) fn advance(
        &mut self,
        moved: &[Movement],
        rotations: RotationIncrement,
        duration: f64,
    ) -> f64 {
        let (by, increment, _) = self.functions.interpolate(moved);
        let change = self.change(by, rotations, increment);
        self.gradient += by;
        self.rotation = self.rotation.turned(rotations, increment).normalised();
        (self.rate_before, self.last_rate) = (self.last_rate, change / duration);
        self.last_force = self.force;
        self.functions.weight * self.force.dot(&change)
    }

    fn rate(&self, rates: &[Movement]) -> Vec2 {
        let (gradient, spin, _) = self.functions.interpolate(rates);
        self.rotation.to_section(gradient - perpendicular(self.gradient) * spin)
    }

    fn selected_rates(&self, selected: DashpotRates<'_>) -> Vec2 {
        let (present, carried) =
            (self.rate(selected.present), self.carried(selected.extrapolation));
        let [axial, shear, _] = selected.is_extrapolated;
        Vec2::new(
            if axial { carried.x } else { present.x },
            if shear { carried.y } else { present.y },
        )
    }

    pub(super) fn transmitted(&self, rates: DashpotRates<'_>) -> (Vec2, f64) {
        let force = self.rotation.to_space(self.damping.component_mul(&self.selected_rates(rates)));
        (force, self.functions.weight * cross(self.gradient, force))
    }

    pub(super) fn emit_dashpot_forces(
        &self,
        rates: DashpotRates<'_>,
        first: usize,
        give: &mut dyn FnMut(usize, Movement),
    ) {
        let force = self.damping.component_mul(&self.selected_rates(rates));
        self.distribute((self.rotation, self.gradient), force, first, give);
    }

    pub(super) fn each_damped_rate(&self, rates: &[Movement], take: &mut dyn FnMut(f64, f64)) {
        for (damping, rate) in self.damping.iter().zip(self.rate(rates).iter()) {
            take(self.functions.weight * damping, *rate);
        }
    }

    pub(super) fn save(&self, state: &mut Vec<f64>) {
        state.extend([self.gradient.x, self.gradient.y, self.rotation.cos, self.rotation.sin]);
        state.extend([self.last_rate.x, self.last_rate.y, self.last_force.x, self.last_force.y]);
        state.extend([self.rate_before.x, self.rate_before.y]);
    }

    pub(super) fn restore(&mut self, next: &mut dyn FnMut() -> f64) {
        self.gradient = Vec2::new(next(), next());
        self.rotation = Rotation { cos: next(), sin: next() };
        self.last_rate = Vec2::new(next(), next());
        self.last_force = Vec2::new(next(), next());
        self.rate_before = Vec2::new(next(), next());
    }
}
