//! Normal force of a contact as an independent unknown, and its law.

use super::law::ContactLaw;
use crate::beams::RateCollocation;
use crate::elementary::square;
use crate::geometry::larger;
use crate::integrators::Stage;
use crate::system::elements::coordinate::{Coordinate, rounding_error};
use crate::system::elements::mixed_force::{CORNER_TOLERANCE, ForceTarget, MixedForce};
use crate::system::elements::rate_history::RateHistory;

/// Largest ratio of contact stiffness to impedance of the body for which the contact counts as soft [-].
pub const SOFT: f64 = 1e-2;

#[derive(Debug, Clone, Copy)]
pub struct NormalLaw {
    pub elastic: ContactLaw,
    /// Dimensionless factor of the damping coefficient [-]. It follows from the coefficient of restitution.
    pub damping: f64,
}

#[derive(Clone, Copy)]
pub struct ContactTime {
    pub stage: Stage,
    /// Factor by which the contact force is multiplied in the balance of the step [-].
    pub weight: f64,
    /// Coefficients in the formula for rates; `None` if damping is not evaluated.
    pub rates: Option<RateCollocation>,
    /// Duration of the step [time]; infinite for a static increment, in which all rates are zero.
    pub duration: f64,
}

impl ContactTime {
    /// Creates the time integration data of a contact for a stage with the given weight. In a static increment, damping is not evaluated.
    pub fn new(rate_history: &RateHistory, (stage, weight): (Stage, f64)) -> Self {
        let duration = rate_history.duration();
        let rates = rate_history.at(stage, weight).filter(|_| duration.is_finite());
        Self { stage, weight, rates, duration }
    }

    /// Weight of the contact force in the mean force of the step [-]. It differs from 1 only at the stage [`Stage::End`].
    /// The damping force is divided by the weight, because it is evaluated only at the end of the step.
    pub fn share(&self) -> f64 {
        if self.stage == Stage::End { self.weight } else { 1.0 }
    }
}

#[derive(Debug, Clone, Copy, Default)]
pub struct GapChange {
    pub value: f64,
    /// Largest of the increments from which the change of the gap is computed [length]. It determines the rounding error of the change.
    pub moved: f64,
}

#[derive(Debug, Clone)]
pub struct NormalForce {
    /// Quadrature weight of a contact point of a beam [length]; 1 for a particle or a point of a body.
    weight: f64,
    /// Effective mass of the contact [mass]. It scales the search for the force and limits the damping.
    pub mass: f64,
    /// Gap at the start of the step [length].
    pub gap: Coordinate,
    /// Speed at which the gap closed before the contact [length/time].
    pub approach: f64,
    /// Mean rate of the gap in the last step [length/time].
    pub last_rate: f64,
    /// Internal force in the gap [force]; negative in a closed contact.
    pub tension: MixedForce,
}

impl NormalForce {
    pub fn new(weight: f64) -> Self {
        Self {
            weight,
            mass: 0.0,
            gap: Coordinate::default(),
            approach: 0.0,
            last_rate: 0.0,
            tension: MixedForce::default(),
        }
    }

    pub fn is_closed(&self) -> bool {
        self.gap.value < 0.0
    }

    /// Stiffness at first touch [force/length].
    pub fn stiffness(&self, law: &NormalLaw) -> f64 {
        self.weight * law.elastic.stiffness()
    }

    /// Sets the contact force to zero. Callers use it if no contact is possible in the present iterate.
    pub fn open(&mut self) {
        self.tension.force = 0.0;
        self.tension.mismatch = 0.0;
    }

    /// Tension that the contact law requires for a change of the gap, without damping.
    pub fn elastic(&self, law: &NormalLaw, stage: Stage, change: f64) -> ForceTarget {
        let gap = self.gap.value;
        let law = match stage {
            Stage::Start => ForceTarget { stiffness: 0.0, ..law.elastic.at(gap) },
            Stage::End => law.elastic.at(gap + change),
            Stage::Midpoint | Stage::DampedMidpoint(_) => law.elastic.mean(gap, change),
        };
        ForceTarget { force: self.weight * law.force, stiffness: self.weight * law.stiffness }
    }

    /// Tension that the contact law requires for a change of the gap. A contact does not pull, so the mean tension of the step is never positive.
    pub fn target(&self, law: &NormalLaw, time: ContactTime, change: f64) -> ForceTarget {
        let elastic = self.elastic(law, time.stage, change);
        let Some(rates) = time.rates.filter(|_| law.damping > 0.0) else { return elastic };
        let (damping, by_change) = self.damping(law, elastic, self.mass);
        let rate = change * rates.by_change - self.last_rate * rates.by_last;
        let share = 1.0 / time.share();
        let force = elastic.force + share * damping * rate;
        let most = self.largest_tension(law, time);
        if force > most {
            return ForceTarget { force: most, stiffness: 0.0 };
        }
        let stiffness = elastic.stiffness + share * (damping * rates.by_change + by_change * rate);
        ForceTarget { force, stiffness }
    }

    /// Upper limit of the tension in an iterate [force]. At or below this limit, the mean tension of the step is not positive.
    /// For methods with forces at both ends of the step, the limit depends on the tension at the start.
    fn largest_tension(&self, law: &NormalLaw, time: ContactTime) -> f64 {
        let share = time.share();
        (1.0 - 1.0 / share) * self.elastic(law, Stage::Start, 0.0).force
    }

    /// Damping coefficient at an elastic tension, and its derivative with respect to the change of the gap.
    ///
    /// The damping coefficient is limited to the value that it reaches in an impact of the effective mass on the contact.
    /// Without the limit, a resting contact would have an unbounded damping coefficient, because its approach speed is almost zero.
    pub fn damping(&self, law: &NormalLaw, elastic: ForceTarget, mass: f64) -> (f64, f64) {
        if elastic.force == 0.0 {
            return (0.0, 0.0);
        }
        let most = (self.stiffness(law) * mass).sqrt();
        let by_force = -elastic.force / self.approach;
        match by_force < most {
            true => {
                let by_change = -elastic.stiffness / self.approach;
                (law.damping * by_force, law.damping * by_change)
            }
            false => (law.damping * most, 0.0),
        }
    }

    /// Tension and stiffness at the point where the contact law is linearised.
    pub fn linearisation_target(
        &mut self,
        law: &NormalLaw,
        time: ContactTime,
        change: f64,
    ) -> ForceTarget {
        let estimate = self.tension.impedance(change);
        let impedance = match time.duration.is_finite() {
            true => Some(2.0 * self.mass / square(time.duration)),
            false => estimate,
        };
        let is_stiff = |impedance: &f64| self.stiffness(law) > SOFT * impedance;
        match impedance.filter(is_stiff) {
            Some(impedance) if impedance > 0.0 => {
                ForceTarget::intersection(change, self.tension.force, impedance, |change| {
                    self.target(law, time, change)
                })
            }
            _ => self.target(law, time, change),
        }
    }

    /// Returns the relative difference between the tension and the target that the contact law requires; zero within rounding.
    pub fn compare(&mut self, law: &NormalLaw, target: ForceTarget, moved: f64) -> f64 {
        let stiffness = larger(target.stiffness, self.stiffness(law));
        let extent = CORNER_TOLERANCE * larger(moved, self.gap.value.abs());
        let missed = self.tension.compare(ForceTarget { stiffness, ..target }, extent);
        let is_rounding = self.tension.missing_change().abs() <= rounding_error(moved);
        if is_rounding { 0.0 } else { missed }
    }

    /// Ends a step. Returns the energy dissipated in the contact [energy].
    pub fn advance(
        &mut self,
        law: &NormalLaw,
        time: ContactTime,
        GapChange { value: change, moved }: GapChange,
    ) -> f64 {
        let elastic = self.elastic(law, time.stage, change);
        let lost = match law.damping > 0.0 && time.duration.is_finite() {
            true => time.share() * (self.tension.force - elastic.force) * change,
            false => 0.0,
        };
        let target = self.target(law, time, change);
        self.gap = self.gap.after(change);
        if self.compare(law, target, moved) == 0.0 {
            // The gap is corrected to the value for which the contact law gives the present force.
            // Otherwise, the rounding error of the gap increments would store energy.
            self.gap = self.gap.after(self.tension.missing_change());
        }
        self.tension.last = self.tension.force;
        self.last_rate = if time.duration.is_finite() { change / time.duration } else { 0.0 };
        lost
    }

    pub fn energy(&self, law: &NormalLaw) -> f64 {
        self.weight * law.elastic.energy(self.gap.value)
    }

    /// Contact force in the last step, averaged over the step [force].
    pub fn last(&self) -> f64 {
        -self.tension.last
    }

    pub fn save(&self, state: &mut Vec<f64>) {
        let Self { gap, approach, last_rate, tension, .. } = self;
        state.extend([gap.value, gap.rest, *approach, *last_rate, tension.last]);
    }

    pub fn restore(&mut self, next: &mut dyn FnMut() -> f64) {
        self.gap = Coordinate { value: next(), rest: next() };
        (self.approach, self.last_rate, self.tension.last) = (next(), next(), next());
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::beams::RotationIncrement;

    #[test]
    fn an_open_contact_is_not_damped() {
        let elastic = ContactLaw::HalfPlane { stiffness: 1e4 };
        let law = NormalLaw { elastic, damping: 1.0 };
        let rotations = RotationIncrement::TangentScaled;
        let rates = RateCollocation { fraction: 0.5, by_change: 100.0, by_last: 0.0, rotations };
        let time = |stage| ContactTime { stage, weight: 1.0, rates: Some(rates), duration: 0.01 };
        for approach in [0.0, 2.0] {
            let mut normal = NormalForce::new(1.0);
            (normal.gap, normal.approach, normal.mass) = (Coordinate::from(0.5), approach, 1.0);
            for stage in [Stage::Midpoint, Stage::End] {
                let target = normal.target(&law, time(stage), -0.4);
                assert_eq!((target.force, target.stiffness), (0.0, 0.0), "{approach}, {stage:?}");
                assert!(normal.target(&law, time(stage), -0.6).force < 0.0);
            }
        }
    }
}
