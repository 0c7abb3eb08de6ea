//! Coulomb friction of a contact point. The contact deflects elastically along the surface before it slips.
//!
//! `docs/theory.md`, section 9.7, derives the mean force of a step.
//! The friction force is the mean over the exact path in the step. It never exceeds the friction limit, and a sticking contact does not creep.
//! If the coefficient of restitution is below 1, and in brakes, a viscous friction force acts in parallel with the elastic one.

use std::array::from_fn;

use super::SOFT;
use crate::elementary::square;
use crate::geometry::larger;
use crate::system::elements::coordinate::rounding_error;
use crate::system::elements::mixed_force::{CORNER_TOLERANCE, ForceTarget, MixedForce};

/// Damping factor at which a sticking contact is critically damped [-]. Larger factors are reduced to this value.
const MOST_DAMPING: f64 = 2.0;

#[derive(Debug, Clone, Copy)]
struct FrictionLaw {
    /// Stiffness along the surface [force/length].
    stiffness: f64,
    /// Friction limit: largest magnitude of the friction force [force].
    limit: f64,
    /// Elastic deflection of the contact along the surface at the start of the step [length].
    deflection: f64,
    /// Viscous force per slip [force/length].
    damping: f64,
    /// Weight of the friction force in the mean friction force of the step [-]; 1 unless the force is evaluated at the end of the step.
    share: f64,
}

#[derive(Debug, Clone, Copy)]
struct FrictionTarget {
    by_slip: ForceTarget,
    by_limit: f64,
}

impl FrictionLaw {
    fn yield_deflection(&self) -> f64 {
        self.limit / self.stiffness
    }

    fn start_deflection(&self) -> f64 {
        let most = self.yield_deflection();
        self.deflection.clamp(-most, most)
    }

    fn end_deflection(&self, slip: f64) -> f64 {
        let most = self.yield_deflection();
        (self.start_deflection() + slip).clamp(-most, most)
    }

    fn mean_force(&self, slip: f64) -> FrictionTarget {
        let Self { stiffness, limit, deflection, damping, share } = *self;
        let sign = 1.0_f64.copysign(slip);
        let (slip, start) = (slip.abs(), sign * self.start_deflection());
        let start_by_limit = match deflection.abs() > self.yield_deflection() {
            true => (sign * deflection).signum() / stiffness,
            false => 0.0,
        };
        let elastic_slip = self.yield_deflection() - start;
        let (force, slope, by_limit) = if slip <= elastic_slip {
            (stiffness * (start + 0.5 * slip), 0.5 * stiffness, stiffness * start_by_limit)
        } else {
            let missing = 0.5 * stiffness * elastic_slip * (elastic_slip / slip);
            let by_limit = 1.0 - elastic_slip / slip * (1.0 - stiffness * start_by_limit);
            (limit - missing, missing / slip, by_limit)
        };
        let damped = force + damping * slip;
        let (force, stiffness, by_limit) =
            if damped > limit { (limit, 0.0, 1.0) } else { (damped, slope + damping, by_limit) };
        let by_slip = ForceTarget { force: sign * force / share, stiffness: stiffness / share };
        FrictionTarget { by_slip, by_limit: sign * by_limit / share }
    }
}

/// Slip in an iterate as a function of `N` local coordinates, and the generalised force of a unit friction force.
#[derive(Debug, Clone, Copy)]
pub struct SlipTrial<const N: usize> {
    pub slip: f64,
    pub slope: [f64; N],
    /// Generalised force due to a unit friction force. The work of this generalised force equals the slip.
    pub direction: [f64; N],
    pub direction_slope: [[f64; N]; N],
    /// Largest of the increments from which the slip is computed [length]. It determines the rounding error of the slip.
    pub moved: f64,
}

impl<const N: usize> SlipTrial<N> {
    const NONE: Self = Self {
        slip: 0.0,
        slope: [0.0; N],
        direction: [0.0; N],
        direction_slope: [[0.0; N]; N],
        moved: 0.0,
    };
}

impl SlipTrial<1> {
    /// Slip that is a local coordinate itself.
    pub fn of_coordinate(slip: f64, moved: f64) -> Self {
        Self { slip, slope: [1.0], direction: [1.0], direction_slope: [[0.0]], moved }
    }
}

/// Damping coefficient along the surface while a contact sticks [force·time/length].
/// `factor` is the damping factor of the normal force [-].
pub fn sticking_damping(stiffness: f64, mass: f64, factor: f64) -> f64 {
    let factor = factor.min(MOST_DAMPING);
    let is_damped = factor > 0.0 && mass.is_finite();
    if is_damped { factor * (stiffness * mass).sqrt() } else { 0.0 }
}

/// Friction force of a contact point in a step. Its slip is a function of `N` local coordinates.
#[derive(Debug, Clone)]
pub struct PointFriction<const N: usize> {
    coefficient: f64,
    /// Stiffness along the surface [force/length].
    stiffness: f64,
    /// Damping coefficient of the friction force while the contact sticks [force·time/length].
    damping: f64,
    /// Effective mass along the surface [mass]. For a contact between bodies, it contains the mobilities of both bodies.
    mass: f64,
    /// Elastic deflection along the surface at the start of the step [length].
    deflection: f64,
    /// Friction force, as an internal force along the normal rotated by +90° [force].
    force: MixedForce,
    by_normal: f64,
    trial: SlipTrial<N>,
    linearised: SlipTrial<N>,
}

#[derive(Debug, Clone, Copy)]
pub struct NormalContact {
    /// Normal force [force]. It is negative if the contact pulls in the present iterate.
    pub force: f64,
    pub duration: f64,
    /// Weight of the contact force in the mean contact force of the step [-]; 1 unless the force is evaluated at the end of the step.
    pub share: f64,
}

impl<const N: usize> PointFriction<N> {
    pub fn new(coefficient: f64) -> Self {
        Self {
            coefficient,
            stiffness: 0.0,
            damping: 0.0,
            mass: 0.0,
            deflection: 0.0,
            force: MixedForce::default(),
            by_normal: 0.0,
            trial: SlipTrial::NONE,
            linearised: SlipTrial::NONE,
        }
    }

    /// Increases the stiffness at a constant friction force. Returns the energy dissipated by this change [energy].
    pub fn stiffen(&mut self, stiffness: f64, damping_factor: f64) -> f64 {
        let before = self.energy();
        self.deflection *= self.stiffness / stiffness;
        self.set_stiffness(stiffness, damping_factor);
        before - self.energy()
    }

    /// Sets the stiffness [force/length] and the damping along the surface, for the present effective mass.
    pub fn set_stiffness(&mut self, stiffness: f64, damping_factor: f64) {
        self.set_scales(stiffness, self.mass, damping_factor);
    }

    /// Stiffness along the surface [force/length].
    pub fn stiffness(&self) -> f64 {
        self.stiffness
    }

    /// Sets the stiffness, the damping and the effective mass along the surface.
    /// `damping_factor` is the damping factor of the normal force [-].
    pub fn set_scales(&mut self, stiffness: f64, mass: f64, damping_factor: f64) {
        (self.stiffness, self.mass) = (stiffness, mass);
        self.damping = sticking_damping(stiffness, mass, damping_factor);
    }

    pub fn begin_step(&mut self) {
        self.force.begin_step();
    }

    /// Sets the friction force and the deflection to zero.
    pub fn clear(&mut self) {
        self.release();
        (self.deflection, self.force.last) = (0.0, 0.0);
    }

    /// Sets the friction force to zero, for an open contact or before a static increment. The deflection is kept.
    pub fn release(&mut self) {
        (self.force.force, self.force.mismatch, self.by_normal) = (0.0, 0.0, 0.0);
        (self.trial, self.linearised) = (SlipTrial::NONE, SlipTrial::NONE);
    }

    pub fn evaluate(&mut self, trial: SlipTrial<N>) {
        self.trial = trial;
    }

    fn law(&self, contact: NormalContact) -> FrictionLaw {
        FrictionLaw {
            stiffness: self.stiffness,
            limit: self.coefficient * contact.force.max(0.0),
            deflection: self.deflection,
            damping: self.damping / contact.duration,
            share: contact.share,
        }
    }

    /// Returns the relative difference between the friction force and the force that the friction law requires; zero within rounding.
    pub fn compare(&mut self, contact: NormalContact) -> f64 {
        let target = self.law(contact).mean_force(self.trial.slip).by_slip;
        let stiffness = larger(target.stiffness, self.stiffness);
        let extent = CORNER_TOLERANCE * larger(self.trial.moved, self.deflection.abs());
        let missed = self.force.compare(ForceTarget { stiffness, ..target }, extent);
        let is_rounding = self.force.missing_change().abs() <= rounding_error(self.trial.moved);
        if is_rounding { 0.0 } else { missed }
    }

    /// Linearises the friction law at the present slip. A stiff contact is linearised at the slip where the law meets the response of the body.
    pub fn linearise(&mut self, contact: NormalContact) {
        let impedance = 2.0 * self.mass / square(contact.duration);
        let (law, slip) = (self.law(contact), self.trial.slip);
        let point = match self.stiffness > SOFT * impedance {
            true => ForceTarget::intersection_point(slip, self.force.force, impedance, |slip| {
                law.mean_force(slip).by_slip
            }),
            false => slip,
        };
        let FrictionTarget { by_slip: ForceTarget { force, stiffness }, by_limit } =
            law.mean_force(point);
        let is_pushed = contact.force >= 0.0;
        self.by_normal = if is_pushed { self.coefficient * by_limit } else { 0.0 };
        let force = force + stiffness * (slip - point);
        self.force.linearise(ForceTarget { force, stiffness });
        self.linearised = self.trial;
    }

    pub fn present(&self) -> [f64; N] {
        self.trial.direction.map(|by| by * self.force.force)
    }

    pub fn condensed(&self, normal_mismatch: f64) -> [f64; N] {
        let force = self.force.force + self.mismatch(normal_mismatch);
        self.linearised.direction.map(|by| by * force)
    }

    /// Generalised force that would remove the present difference between the friction force and its law.
    pub fn missing(&self, normal_mismatch: f64) -> [f64; N] {
        self.linearised.direction.map(|by| by * self.mismatch(normal_mismatch))
    }

    fn mismatch(&self, normal_mismatch: f64) -> f64 {
        self.force.mismatch + self.by_normal * normal_mismatch
    }

    pub fn tangent(&self, normal_slope: [f64; N]) -> [[f64; N]; N] {
        let SlipTrial { slope, direction, direction_slope, .. } = &self.linearised;
        let by_normal = normal_slope.map(|by| by * self.by_normal);
        from_fn(|row| {
            from_fn(|column| {
                let of_force = self.force.stiffness * slope[column] + by_normal[column];
                direction[row] * of_force + direction_slope[row][column] * self.force.force
            })
        })
    }

    pub fn correct(&mut self, moved: [f64; N], normal_change: f64) {
        let slope = &self.linearised.slope;
        self.force.correct((0..N).map(|at| slope[at] * moved[at]).sum());
        self.force.force += self.by_normal * normal_change;
    }

    /// Ends a step. Returns the energy dissipated by friction [energy].
    pub fn advance(&mut self, contact: NormalContact) -> f64 {
        let is_met = self.compare(contact) == 0.0;
        // The slip is corrected to the value that belongs to the friction force. Otherwise, the rounding error of increments would store energy.
        let slip = self.trial.slip + if is_met { self.force.missing_change() } else { 0.0 };
        let before = self.energy();
        self.deflection = self.law(contact).end_deflection(slip);
        self.force.last = self.force.force;
        contact.share * self.force.force * slip - (self.energy() - before)
    }

    pub fn energy(&self) -> f64 {
        0.5 * self.stiffness * self.deflection * self.deflection
    }

    /// Mean friction force in the last step along the surface, positive to the right of the normal of the surface [force].
    pub fn last(&self) -> f64 {
        self.force.last
    }

    /// Generalised internal force of friction at the start of the step.
    /// `rates` is the slip trial for the rates of the local coordinates. Since the slip is linear in these coordinates, it contains the slip rate.
    pub fn at_start(&self, rates: &SlipTrial<N>, normal_force: f64, damping: f64) -> [f64; N] {
        let limit = self.coefficient * normal_force.max(0.0);
        let force = self.stiffness * self.deflection + damping * rates.slip;
        rates.direction.map(|by| by * force.clamp(-limit, limit))
    }

    pub fn sticking_damping(&self) -> f64 {
        self.damping
    }

    pub fn save(&self, state: &mut Vec<f64>) {
        state.extend([self.deflection, self.force.last]);
    }

    pub fn restore(&mut self, next: &mut dyn FnMut() -> f64) {
        (self.deflection, self.force.last) = (next(), next());
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const SLIPS: [f64; 7] = [-0.9, -0.03, -0.004, 0.0, 0.005, 0.04, 1.2];

    fn laws() -> impl Iterator<Item = FrictionLaw> {
        let of = |(deflection, damping)| FrictionLaw {
            stiffness: 200.0,
            limit: 3.0,
            deflection,
            damping,
            share: 1.0,
        };
        [(0.0, 0.0), (0.01, 0.0), (-0.014, 40.0), (0.02, 0.0), (-0.3, 7.0)].into_iter().map(of)
    }

    #[test]
    fn mean_friction_force_does_the_work_of_the_exact_path() {
        for law in laws().map(|law| FrictionLaw { damping: 0.0, ..law }) {
            for slip in SLIPS {
                let pieces = 200_000;
                let part = slip / f64::from(pieces);
                let (mut at, mut work) = (law.start_deflection(), 0.0);
                for _ in 0..pieces {
                    let next = FrictionLaw { deflection: at, ..law }.end_deflection(part);
                    work += 0.5 * law.stiffness * (at + next) * part;
                    at = next;
                }
                let met = law.mean_force(slip).by_slip.force * slip;
                assert!((met - work).abs() < 1e-5, "{law:?} {slip}: {met} {work}");
                assert!((at - law.end_deflection(slip)).abs() < 1e-12);
            }
        }
    }

    #[test]
    fn friction_force_stays_within_its_limit_and_dissipates() {
        for law in laws() {
            for slip in SLIPS {
                let force = law.mean_force(slip).by_slip.force;
                assert!(force.abs() <= law.limit * (1.0 + 1e-15), "{law:?} {slip}");
                let energy = |at: f64| 0.5 * law.stiffness * at * at;
                let lost = force * slip - energy(law.end_deflection(slip)) + energy(law.deflection);
                assert!(lost > -1e-14, "{law:?} {slip}: {lost}");
            }
        }
    }

    #[test]
    fn friction_derivatives_agree_with_finite_differences() {
        let step = 1e-7;
        for law in laws() {
            for slip in SLIPS.map(|slip| slip + 1e-4) {
                let force = |slip: f64, limit: f64| FrictionLaw { limit, ..law }.mean_force(slip);
                let difference = |slip_step: f64, limit_step: f64| {
                    let of = |sign: f64| {
                        force(slip + sign * slip_step, law.limit + sign * limit_step).by_slip.force
                    };
                    (of(1.0) - of(-1.0)) / (2.0 * step)
                };
                let met = law.mean_force(slip);
                let by_slip = difference(step, 0.0);
                let by_limit = difference(0.0, step);
                let tolerance = 1e-5 * law.stiffness;
                assert!((met.by_slip.stiffness - by_slip).abs() < tolerance, "{law:?} {slip}");
                assert!((met.by_limit - by_limit).abs() < 1e-5, "{law:?} {slip}");
            }
        }
    }
}
