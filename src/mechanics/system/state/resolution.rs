//! Measures of the temporal resolution of the motion, computed from quantities of each step.

use crate::beams::RotationIncrement;
use crate::elementary::square;

/// Squared prediction errors of a step in the norm of the diagonal inertia. Each squared error is twice an energy [energy].
#[derive(Debug, Clone, Copy, Default)]
pub struct GuessErrors {
    /// Squared difference between the mean rates of the step and the rates at its start, weighted by mass [energy].
    pub by_start: f64,
    /// Squared difference between the mean rates of this step and the previous step, weighted by mass [energy].
    pub by_mean: f64,
    /// Squared mean rates of the step, weighted by mass [energy].
    pub motion: f64,
}

impl GuessErrors {
    pub fn add(&mut self, inertia: f64, found: f64, [at_start, mean]: [f64; 2]) {
        self.by_start += inertia * square(found - at_start);
        self.by_mean += inertia * square(found - mean);
        self.motion += inertia * square(found);
    }
}

/// Largest relative difference of two step lengths that count as equal.
const EQUALLY_LONG: f64 = 1e-3;

/// Measures of the temporal resolution of the motion in the steps so far (docs/theory.md, section 13.3).
/// The energy of unresolved motion follows from the differences of the rates in consecutive steps.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Resolution {
    kinetic: f64,
    unresolved: f64,
    bent: f64,
    last: f64,
    /// Squared error of the prediction of the last step from its start rates, weighted by mass [energy].
    last_by_start: f64,
    /// Largest rotation of a section in a step [rad].
    rotation: f64,
    duration: f64,
    /// Largest energy of motions that are attributed to rounding [energy].
    noise: f64,
}

impl Resolution {
    pub(super) fn above(noise: f64) -> Self {
        Self {
            kinetic: 0.0,
            unresolved: 0.0,
            bent: 0.0,
            last: 0.0,
            last_by_start: 0.0,
            rotation: 0.0,
            duration: 0.0,
            noise,
        }
    }

    pub(super) fn noise(&self) -> f64 {
        self.noise
    }

    pub(super) fn add(
        &mut self,
        missed: &GuessErrors,
        duration: f64,
        increment: f64,
        rotations: RotationIncrement,
    ) {
        if increment > self.rotation {
            let angle = rotations.angle(increment);
            if angle > self.rotation {
                (self.rotation, self.duration) = (angle, duration);
            }
        }
        let is_as_long = (duration - self.last).abs() <= EQUALLY_LONG * duration.abs();
        self.last = duration;
        let kinetic = missed.motion + missed.by_start;
        if is_as_long && kinetic > self.noise {
            self.kinetic += kinetic;
            let by_start = 0.5 * (missed.by_start + self.last_by_start);
            self.unresolved += by_start - 0.25 * missed.by_mean;
            self.bent += missed.by_mean * square(0.25 * duration);
        }
        self.last_by_start = missed.by_start;
    }

    /// Unresolved fraction of the kinetic energy, summed over the steps that contribute to the resolution measures [-].
    pub fn unresolved_share(&self) -> f64 {
        if self.kinetic > 0.0 { (self.unresolved / self.kinetic).max(0.0) } else { 0.0 }
    }

    /// Twice the sum of the kinetic energies of all steps that contribute to the resolution measures [energy].
    pub fn kinetic(&self) -> f64 {
        self.kinetic
    }

    /// Angular frequency, as a mean over all vibrations weighted by accelerations [rad/time].
    /// The angular frequency is exact for a single vibration, infinite if the period is lost in rounding, and zero without vibration.
    pub fn angular_frequency(&self) -> f64 {
        if self.unresolved <= 0.0 { 0.0 } else { (self.unresolved / self.bent).sqrt() }
    }

    /// Largest rotation of a section in a step or substep [rad].
    pub fn rotation(&self) -> f64 {
        self.rotation
    }

    pub(crate) fn turned_in(&self) -> f64 {
        self.duration
    }

    pub(super) fn save(&self, state: &mut Vec<f64>) {
        let sums = [self.kinetic, self.unresolved, self.bent, self.last, self.last_by_start];
        state.extend(sums.into_iter().chain([self.rotation, self.duration]));
    }

    pub(super) fn restore(&mut self, next: &mut dyn FnMut() -> f64) {
        for number in [
            &mut self.kinetic,
            &mut self.unresolved,
            &mut self.bent,
            &mut self.last,
            &mut self.last_by_start,
            &mut self.rotation,
            &mut self.duration,
        ] {
            *number = next();
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn vibrating(vibrations: &[(f64, f64, f64)], steps: usize) -> Resolution {
        let mut resolution = Resolution::above(0.0);
        let mut mean: Option<Vec<f64>> = None;
        for step in 0..steps {
            let velocity = |(_, amplitude, turn): &(f64, f64, f64), step: usize| {
                amplitude * (2.0 * (0.5 * turn).atan() * step as f64 + 0.3).cos()
            };
            let mut missed = GuessErrors::default();
            let means = vibrations.iter().enumerate().map(|(at, vibration)| {
                let (start, end) = (velocity(vibration, step), velocity(vibration, step + 1));
                let now = 0.5 * (start + end);
                let before = mean.as_ref().map_or(start, |mean| mean[at]);
                missed.by_start += vibration.0 * (now - start).powi(2);
                missed.by_mean += vibration.0 * (now - before).powi(2);
                missed.motion += vibration.0 * now.powi(2);
                now
            });
            mean = Some(means.collect());
            resolution.add(&missed, 0.5, 0.1, RotationIncrement::Angle);
        }
        resolution
    }

    #[test]
    fn frequency_and_unresolved_share_are_exact_for_a_single_vibration() {
        for turn in [0.3, 1.0, 2.0, 7.0, 300.0] {
            let resolution = vibrating(&[(2.0, 3.0, turn)], 100_000);
            let frequency = resolution.angular_frequency();
            let sine = (0.5 * 2.0 * (0.5_f64 * turn).atan()).sin();
            assert!((frequency * 0.5 / turn - 1.0).abs() < 0.01, "{turn}: {frequency}");
            let share = resolution.unresolved_share();
            assert!((share - sine.powi(4)).abs() < 0.01 * sine.powi(4) + 1e-9, "{turn}: {share}");
        }
    }

    #[test]
    fn few_periods_in_fine_steps_give_the_frequency() {
        for (turn, steps) in [(0.05, 130), (0.05, 300), (0.3, 30), (0.3, 45)] {
            let resolution = vibrating(&[(1.0, 2.0, turn)], steps);
            let frequency = resolution.angular_frequency() * 0.5;
            assert!((frequency / turn - 1.0).abs() < 0.1, "{turn}, {steps}: {frequency}");
        }
    }

    #[test]
    fn unresolved_vibration_is_detected_under_resolved_motion() {
        let hidden = vibrating(&[(1.0, 10.0, 0.05), (1.0, 2.0, 40.0)], 100_000);
        assert!((hidden.unresolved_share() - 4.0 / 104.0).abs() < 1e-3, "{hidden:?}");
        assert!(hidden.angular_frequency() * 0.5 > 10.0, "{hidden:?}");
        let alone = vibrating(&[(1.0, 10.0, 0.05)], 100_000);
        assert!(alone.unresolved_share() < 1e-6, "{alone:?}");
    }

    #[test]
    fn fall_from_rest_has_no_unresolved_share() {
        let mut resolution = Resolution::above(0.0);
        for step in 0..3 {
            let (now, before) = (f64::from(step) + 0.5, f64::from(step) - 0.5);
            let by_mean = if step == 0 { now } else { now - before };
            let missed =
                GuessErrors { by_start: 0.25, by_mean: by_mean.powi(2), motion: now.powi(2) };
            resolution.add(&missed, 1.0, 0.0, RotationIncrement::Angle);
            assert_eq!(resolution.unresolved_share(), 0.0);
        }
    }
}
