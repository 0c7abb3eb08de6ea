//! Rates of strain at the end of a step, where a step resolves how they relax and where it does not.
//!
//! What decays within a step leaves it in the energy–momentum method with `v1 ≈ -v0`, and where a stiff dashpot goes along with a large motion, rates at the end
//! of a step carry the error of that motion, of second order, times its damping: the mean of a step is right, its ends are not, and a dashpot that is asked for
//! the force at the end tells one that was never there. The means of the last two steps, carried on to the end, tell it with an error of second order.

use super::Movement;

/// With which rates a dashpot is asked for its force at the present moment.
#[derive(Debug, Clone, Copy)]
pub(super) struct DashpotRates<'a> {
    /// The present rates of the control points of its span.
    pub(super) present: &'a [Movement],
    /// How far beyond its middle the last step ends, as a part of the time between the middles of the last two [-].
    pub(super) late: f64,
    /// Whether the means of the last two steps are carried on instead, of stretching, shear and bending.
    pub(super) carried: [bool; 3],
}

/// How far rates at the start of a step are from those between the means of this step and the one before, and how far these are apart: as powers, of
/// stretching, shear or bending [energy/time].
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub(super) struct RateMismatch {
    pub(super) off: f64,
    pub(super) apart: f64,
}

impl RateMismatch {
    /// What is seen of a rate at the start of a step, and of its means in the step before and in this one, behind its damping [force·time; energy/time].
    pub(super) fn of(damping: f64, start: f64, [before, now]: [f64; 2], share: f64) -> Self {
        let (change, off) = (now - before, start - before);
        let off = off - share * change;
        Self { off: damping * off * off, apart: damping * change * change }
    }

    pub(super) fn join(&mut self, other: Self) {
        self.off += other.off;
        self.apart += other.apart;
    }
}

/// The part of what was seen that is left after a step.
const KEPT: f64 = 0.8;

/// Rates are resolved where those at the ends of steps are off by less than this part of what they change in a step: a vibration with `ω h < 2`.
const MOST_OFF: f64 = 0.5;

/// How well steps resolve the rates of what is damped, by those that were seen last.
#[derive(Debug, Clone, Default)]
pub(super) struct RateResolution {
    /// Of stretching, shear and bending, older steps for less.
    seen: [RateMismatch; 3],
    /// How far beyond its middle the last step ends, as a part of the time between the middles of the last two; zero before there were two [-].
    late: f64,
    /// The duration of the last step; zero before there was one [time].
    before: f64,
}

impl RateResolution {
    /// Where between the middles of the last step and of one of a duration [time] the latter begins, as a part of that; none where there is no such step.
    pub(super) fn share(&self, duration: f64) -> Option<f64> {
        let between = duration + self.before;
        // A part of a fourth-order step goes back in time, and may end where the one before began.
        let is_there = duration.is_finite() && self.before * between > 0.0;
        is_there.then(|| self.before / between)
    }

    /// Takes in a step of a duration [time], infinite where it took no time.
    pub(super) fn add(&mut self, duration: f64, seen: [RateMismatch; 3]) {
        if !duration.is_finite() {
            *self = Self::default();
            return;
        }
        for (all, seen) in self.seen.iter_mut().zip(seen) {
            *all = RateMismatch { off: KEPT * all.off, apart: KEPT * all.apart };
            all.join(seen);
        }
        self.late = self.share(duration).map_or(0.0, |share| 1.0 - share).max(0.0);
        self.before = duration;
    }

    /// With which rates dashpots of a span are to be asked, where its control points have these.
    pub(super) fn told<'a>(&self, present: &'a [Movement]) -> DashpotRates<'a> {
        let is_off = |seen: RateMismatch| seen.off > MOST_OFF * MOST_OFF * seen.apart;
        let carried = self.seen.map(|seen| self.late > 0.0 && is_off(seen));
        DashpotRates { present, late: self.late, carried }
    }

    pub(super) fn save(&self, state: &mut Vec<f64>) {
        state.extend(self.seen.iter().flat_map(|seen| [seen.off, seen.apart]));
        state.extend([self.late, self.before]);
    }

    pub(super) fn restore(&mut self, next: &mut dyn FnMut() -> f64) {
        let seen = [(); 3].map(|()| RateMismatch { off: next(), apart: next() });
        *self = Self { seen, late: next(), before: next() };
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Whether rates are told as they are after each of some steps, where they are given at the ends of these.
    fn are_told(rate: impl Fn(i32) -> f64) -> Vec<bool> {
        let mut watch = RateResolution::default();
        let mean = |step: i32| 0.5 * (rate(step) + rate(step - 1));
        let told = (1..300).map(|step| {
            let seen = watch.share(0.1).map(|share| {
                RateMismatch::of(2.0, rate(step - 1), [mean(step - 1), mean(step)], share)
            });
            watch.add(
                0.1,
                [RateMismatch::default(), seen.unwrap_or_default(), RateMismatch::default()],
            );
            let [axial, shear, bending] = watch.told(&[]).carried;
            assert!(!axial && !bending);
            !shear
        });
        told.collect()
    }

    #[test]
    fn rates_of_vibration_and_of_decay_that_steps_resolve_are_told_as_they_are() {
        for turn in [0.01, 0.1, 0.5, 1.0] {
            let told = are_told(|step| (turn * f64::from(step) + 0.3).cos());
            assert!(told.into_iter().all(|told| told), "{turn}");
        }
        assert!(are_told(|step| 0.7_f64.powi(step)).into_iter().all(|told| told));
        assert!(are_told(|step| f64::from(step.max(100))).into_iter().all(|told| told));
    }

    #[test]
    fn rates_that_alternate_are_carried_on_from_means() {
        for ring in [0.1, 1.0, 100.0] {
            let told =
                are_told(|step| (0.1 * f64::from(step)).cos() + ring * (-1.0_f64).powi(step));
            assert!(told.into_iter().skip(1).all(|told| !told), "{ring}");
        }
    }

    #[test]
    fn a_movement_that_takes_no_time_ends_it() {
        let mut watch = RateResolution::default();
        let seen = [RateMismatch { off: 1.0, apart: 0.0 }; 3];
        watch.add(0.1, seen);
        assert_eq!(watch.told(&[]).carried, [false; 3]);
        watch.add(0.3, seen);
        assert_eq!(watch.told(&[]).carried, [true; 3]);
        assert_eq!(watch.told(&[]).late, 0.75);
        watch.add(f64::INFINITY, seen);
        assert_eq!(watch.told(&[]).carried, [false; 3]);
    }
}
