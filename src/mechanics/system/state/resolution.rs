//! How well steps resolve the motion: measured while they are taken, from numbers that are there anyway.

use crate::beams::RotationIncrement;
use crate::elementary::square;

/// What the guesses for a step were worth, in the norm of the diagonal of the inertia matrix: twice an energy each [energy].
#[derive(Debug, Clone, Copy, Default)]
pub struct GuessErrors {
    /// The miss `Σ m (v̄ - v0)²` of a guess from the rates `v0` at the start of the step; `v̄` are the mean rates of the step [energy].
    pub by_start: f64,
    /// The miss `Σ m (v̄ - v̄₋)²` of a guess from the mean rates `v̄₋` of the step before [energy].
    pub by_mean: f64,
    /// The motion `Σ m v̄²` of the step itself [energy].
    pub moved: f64,
}

impl GuessErrors {
    /// Adds the misses of a movement with an inertia, found at a mean rate, by its two guesses.
    pub fn add(&mut self, inertia: f64, found: f64, [at_start, mean]: [f64; 2]) {
        self.by_start += inertia * square(found - at_start);
        self.by_mean += inertia * square(found - mean);
        self.moved += inertia * square(found);
    }
}

/// Steps whose lengths differ by less than this, as a part of them, are equally long.
const EQUALLY_LONG: f64 = 1e-3;

/// How far the steps behind the present resolve the motion. It is a part of the state: steps that are taken back do not count.
///
/// A vibration `v = a cos ωt` that steps of the energy–momentum method turn by `φ` each, `tan(φ/2) = ω h/2`, has in the mean over its
/// phases `Σ m v̄² = ½ m a² cos²(φ/2)`, `S = Σ m (v̄ - v0)² = ½ m a² sin²(φ/2)` and `M = Σ m (v̄ - v̄₋)² = ½ m a² sin²φ`. So
/// `S - M/4 = ½ m a² sin⁴(φ/2)`: the energy of what steps do not follow, with hardly anything of what they do. Of motions at several
/// frequencies all these sums are the sums of theirs (theory.md, section 13).
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Resolution {
    /// `Σ (m v̄² + S)` over the steps that are as long as the one before [energy].
    kinetic: f64,
    /// `Σ (S - M/4)` over these [energy].
    unresolved: f64,
    /// `Σ h² M/16` over these: `ω²` is the quotient of the two [energy·time²].
    bent: f64,
    /// The length of the last step [time].
    last: f64,
    /// The largest rotation of a section in a step [rad].
    rotation: f64,
    /// How long the step was, or the part of one, in which a section turned so far; negative of one that went back [time].
    turned_in: f64,
    /// Motions below this are those of rounding [energy].
    noise: f64,
}

impl Resolution {
    /// The resolution before the first step, with the energy below which all motion is rounding [energy].
    pub(super) fn above(noise: f64) -> Self {
        Self {
            kinetic: 0.0,
            unresolved: 0.0,
            bent: 0.0,
            last: 0.0,
            rotation: 0.0,
            turned_in: 0.0,
            noise,
        }
    }

    /// The energy below which all motion is rounding [energy].
    pub(super) fn noise(&self) -> f64 {
        self.noise
    }

    /// Takes in a step, or a part of one, of some length [time], in which sections turned by such increments at most.
    pub(super) fn add(
        &mut self,
        missed: &GuessErrors,
        duration: f64,
        increment: f64,
        rotations: RotationIncrement,
    ) {
        // An increment is no smaller than its angle, which costs more.
        if increment > self.rotation {
            let angle = rotations.angle(increment);
            if angle > self.rotation {
                (self.rotation, self.turned_in) = (angle, duration);
            }
        }
        let is_as_long = (duration - self.last).abs() <= EQUALLY_LONG * duration.abs();
        self.last = duration;
        let kinetic = missed.moved + missed.by_start;
        if is_as_long && kinetic > self.noise {
            self.kinetic += kinetic;
            self.unresolved += missed.by_start - 0.25 * missed.by_mean;
            self.bent += missed.by_mean * square(0.25 * duration);
        }
    }

    /// The part of the kinetic energy that belongs to vibration which steps do not follow, in the mean over all steps: of a
    /// single vibration `sin⁴(φ/2)` [-].
    pub fn unresolved_share(&self) -> f64 {
        if self.kinetic > 0.0 { (self.unresolved / self.kinetic).max(0.0) } else { 0.0 }
    }

    /// The kinetic energy of all steps that count, together [energy].
    pub fn kinetic(&self) -> f64 {
        self.kinetic
    }

    /// The angular frequency `ω` of what accelerates the scene, in the mean over accelerations; exact for a single vibration, infinite
    /// where nothing but rounding is left of its period, zero for what does not vibrate [rad/time].
    pub fn angular_frequency(&self) -> f64 {
        if self.unresolved <= 0.0 { 0.0 } else { (self.unresolved / self.bent).sqrt() }
    }

    /// The largest rotation of a section in a step, or in a part of one where a method has parts [rad].
    pub fn rotation(&self) -> f64 {
        self.rotation
    }

    /// How long the step was in which a section turned so far, or the part of one; negative of one that went back [time].
    pub fn turned_in(&self) -> f64 {
        self.turned_in
    }

    pub(super) fn save(&self, state: &mut Vec<f64>) {
        let turned = [self.rotation, self.turned_in];
        state.extend(
            [self.kinetic, self.unresolved, self.bent, self.last].into_iter().chain(turned),
        );
    }

    pub(super) fn restore(&mut self, next: &mut dyn FnMut() -> f64) {
        for number in [
            &mut self.kinetic,
            &mut self.unresolved,
            &mut self.bent,
            &mut self.last,
            &mut self.rotation,
            &mut self.turned_in,
        ] {
            *number = next();
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Steps of the energy–momentum method over vibrations, each with a mass, an amplitude of its velocity and `ω h`.
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
                missed.moved += vibration.0 * now.powi(2);
                now
            });
            mean = Some(means.collect());
            resolution.add(&missed, 0.5, 0.1, RotationIncrement::Angle);
        }
        resolution
    }

    #[test]
    fn a_single_vibration_shows_its_frequency_and_its_share_at_any_step() {
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
    fn vibration_that_steps_do_not_follow_is_seen_under_motion_that_they_do() {
        let hidden = vibrating(&[(1.0, 10.0, 0.05), (1.0, 2.0, 40.0)], 100_000);
        assert!((hidden.unresolved_share() - 4.0 / 104.0).abs() < 1e-3, "{hidden:?}");
        assert!(hidden.angular_frequency() * 0.5 > 10.0, "{hidden:?}");
        let alone = vibrating(&[(1.0, 10.0, 0.05)], 100_000);
        assert!(alone.unresolved_share() < 1e-6, "{alone:?}");
    }

    #[test]
    fn a_fall_from_rest_is_resolved_from_its_first_step_on() {
        let mut resolution = Resolution::above(0.0);
        for step in 0..3 {
            let (now, before) = (f64::from(step) + 0.5, f64::from(step) - 0.5);
            let by_mean = if step == 0 { now } else { now - before };
            let missed =
                GuessErrors { by_start: 0.25, by_mean: by_mean.powi(2), moved: now.powi(2) };
            resolution.add(&missed, 1.0, 0.0, RotationIncrement::Angle);
            assert_eq!(resolution.unresolved_share(), 0.0);
        }
    }
}
