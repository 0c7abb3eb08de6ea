//! Dashpot for the curvature at a quadrature point. Equations: docs/theory.md, section 9.2.

use super::RotationIncrement;
use super::dashpots::{Functions, RateCollocation, strain_missing};
use super::dynamics::{ForceSummary, Movement};
use super::present_rates::{DashpotRates, RateMismatch};

#[derive(Debug, Clone)]
pub(super) struct MomentDashpot {
    functions: Functions,
    damping: f64,
    last_rate: f64,
    rate_before: f64,
    start_rate: f64,
    moment: f64,
    last_moment: f64,
    mismatch: f64,
    linearised_at: RotationKinematics,
}

#[derive(Debug, Clone, Copy, Default)]
struct RotationKinematics {
    slope: f64,
    inverse_q: f64,
    inverse_q_slope: f64,
    resistance: f64,
}

impl RotationKinematics {
    fn change(&self) -> f64 {
        self.slope * self.inverse_q
    }
}

impl MomentDashpot {
    pub(super) fn new(functions: Functions, damping: f64) -> Self {
        Self {
            functions,
            damping,
            last_rate: 0.0,
            rate_before: 0.0,
            start_rate: 0.0,
            moment: 0.0,
            last_moment: 0.0,
            mismatch: 0.0,
            linearised_at: RotationKinematics::default(),
        }
    }

    pub(super) fn begin_step(&mut self, rates: &[Movement]) {
        self.moment = self.last_moment;
        (_, _, self.start_rate) = self.functions.interpolate(rates);
    }

    pub(super) fn rest_without_damping(&mut self) {
        self.moment = 0.0;
    }

    fn carried(&self, late: f64) -> f64 {
        self.last_rate + (self.last_rate - self.rate_before) * late
    }

    pub(super) fn last_rate_mismatch(&self, fraction: f64) -> RateMismatch {
        let damping = self.functions.weight * self.damping;
        RateMismatch::of(damping, self.start_rate, [self.rate_before, self.last_rate], fraction)
    }

    fn bend(&self, at: RateCollocation, moved: &[Movement]) -> RotationKinematics {
        let (_, rotation, slope) = self.functions.interpolate(moved);
        let (inverse_q, inverse_q_slope) = at.rotations.rates(rotation);
        RotationKinematics {
            slope,
            inverse_q,
            inverse_q_slope,
            resistance: self.damping * at.by_change,
        }
    }

    fn target_moment(&self, at: RateCollocation, now: &RotationKinematics) -> f64 {
        now.resistance * now.change() - self.damping * at.by_last * self.last_rate
    }

    fn distribute(&self, moment: f64, first: usize, give: &mut dyn FnMut(usize, Movement)) {
        let moment = self.functions.weight * moment;
        for (point, slope) in self.functions.slope.iter().enumerate() {
            give(first + point, [0.0, 0.0, slope * moment]);
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
        let now = self.bend(at, moved);
        self.mismatch = self.target_moment(at, &now) - self.moment;
        self.distribute(self.moment * now.inverse_q, first, give);
        summary.join(&ForceSummary {
            strain_mismatch: self.functions.weight * strain_missing(self.mismatch, now.resistance),
            moment: self.moment.abs(),
            ..ForceSummary::default()
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
        let now = self.bend(at, moved);
        let wanted = self.target_moment(at, &now);
        self.mismatch = wanted - self.moment;
        self.distribute(wanted * now.inverse_q, first, give);

        // Derivatives of the nodal forces due to the viscous moment. The geometric term contains the viscous moment of the present iterate.
        let resistance = now.resistance * now.inverse_q;
        let by_slope = resistance * now.inverse_q;
        let by_rotation =
            resistance * now.slope * now.inverse_q_slope + self.moment * now.inverse_q_slope;
        let Functions { shape, slope, weight } = &self.functions;
        let width = 3 * shape.len();
        for (row, slope_a) in slope.iter().enumerate() {
            let entries = &mut block[(3 * row + 2) * width..][..width];
            for (entry, (shape_b, slope_b)) in
                entries.chunks_exact_mut(3).zip(shape.iter().zip(slope))
            {
                entry[2] += weight * slope_a * (by_slope * slope_b + by_rotation * shape_b);
            }
        }
        self.linearised_at = now;
    }

    pub(super) fn add_mismatch_forces(&self, first: usize, give: &mut dyn FnMut(usize, Movement)) {
        self.distribute(self.mismatch * self.linearised_at.inverse_q, first, give);
    }

    pub(super) fn correct(&mut self, correction: &[Movement]) {
        let (_, rotation, slope) = self.functions.interpolate(correction);
        let RotationKinematics { slope: turned, inverse_q, inverse_q_slope, resistance } =
            self.linearised_at;
        let change = inverse_q * slope + turned * inverse_q_slope * rotation;
        self.moment += self.mismatch + resistance * change;
    }

    pub(super) fn advance(
        &mut self,
        moved: &[Movement],
        rotations: RotationIncrement,
        duration: f64,
    ) -> f64 {
        let (_, rotation, slope) = self.functions.interpolate(moved);
        let change = slope * rotations.rate(rotation);
        (self.rate_before, self.last_rate) = (self.last_rate, change / duration);
        self.last_moment = self.moment;
        self.functions.weight * self.moment * change
    }

    pub(super) fn transmitted(&self, rates: DashpotRates<'_>) -> f64 {
        let [_, _, is_carried] = rates.is_extrapolated;
        self.damping
            * if is_carried {
                self.carried(rates.extrapolation)
            } else {
                self.functions.interpolate(rates.present).2
            }
    }

    pub(super) fn emit_dashpot_forces(
        &self,
        rates: DashpotRates<'_>,
        first: usize,
        give: &mut dyn FnMut(usize, Movement),
    ) {
        self.distribute(self.transmitted(rates), first, give);
    }

    pub(super) fn each_damped_rate(&self, rates: &[Movement], take: &mut dyn FnMut(f64, f64)) {
        let (_, _, rate) = self.functions.interpolate(rates);
        take(self.functions.weight * self.damping, rate);
    }

    pub(super) fn save(&self, state: &mut Vec<f64>) {
        state.extend([self.last_rate, self.last_moment, self.rate_before]);
    }

    pub(super) fn restore(&mut self, next: &mut dyn FnMut() -> f64) {
        (self.last_rate, self.last_moment) = (next(), next());
        self.rate_before = next();
    }
}
