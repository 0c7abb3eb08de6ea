//! Strain rates at the end of a step for the dashpot forces.
//!
//! If the steps are too long to resolve a rate, its mean values in the last two steps are extrapolated to the end of the last step.
//! The error of the extrapolated rate is of second order in the step length.

use super::Movement;

#[derive(Debug, Clone, Copy)]
pub(super) struct DashpotRates<'a> {
    pub(super) present: &'a [Movement],
    /// Time from the middle of the last step to its end, as a fraction of the time between the middles of the last two steps [-].
    pub(super) extrapolation: f64,
    pub(super) is_extrapolated: [bool; 3],
}

/// Squared errors of a strain rate in a step, multiplied by the damping coefficient `c` [energy/time].
/// The first error is the rate at the start of the step minus the interpolation between the mean rates of this step and the last step:
/// `off = c (start − interpolated)²`.
/// The second error is the change of the mean rate since the last step: `apart = c (now − before)²`.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub(super) struct RateMismatch {
    pub(super) off: f64,
    pub(super) apart: f64,
}

impl RateMismatch {
    pub(super) fn of(damping: f64, start: f64, [before, now]: [f64; 2], fraction: f64) -> Self {
        let (change, off) = (now - before, start - before);
        let off = off - fraction * change;
        Self { off: damping * off * off, apart: damping * change * change }
    }

    pub(super) fn join(&mut self, other: Self) {
        self.off += other.off;
        self.apart += other.apart;
    }
}

/// Factor by which each step multiplies the squared errors that have been summed over all earlier steps.
const KEPT: f64 = 0.8;

/// Largest value of `√(off / apart)` (see [`RateMismatch`]) for which the steps count as resolving the rate.
/// For a vibration of angular frequency `ω`, the root is below this limit if the step length `h` satisfies `ω h < 2`.
const MOST_OFF: f64 = 0.5;

#[derive(Debug, Clone, Default)]
pub(super) struct RateResolution {
    mismatches: [RateMismatch; 3],
    extrapolation: f64,
    before: f64,
}

impl RateResolution {
    pub(super) fn fraction(&self, duration: f64) -> Option<f64> {
        let between = duration + self.before;
        // No interpolation exists if the middles of a forward and a backward substep of the fourth-order method coincide.
        let is_there = duration.is_finite() && self.before * between > 0.0;
        is_there.then(|| self.before / between)
    }

    pub(super) fn add(&mut self, duration: f64, seen: [RateMismatch; 3]) {
        if !duration.is_finite() {
            *self = Self::default();
            return;
        }
        for (all, seen) in self.mismatches.iter_mut().zip(seen) {
            *all = RateMismatch { off: KEPT * all.off, apart: KEPT * all.apart };
            all.join(seen);
        }
        self.extrapolation =
            self.fraction(duration).map_or(0.0, |fraction| 1.0 - fraction).max(0.0);
        self.before = duration;
    }

    pub(super) fn selected<'a>(&self, present: &'a [Movement]) -> DashpotRates<'a> {
        let is_off = |seen: RateMismatch| seen.off > MOST_OFF * MOST_OFF * seen.apart;
        let carried = self.mismatches.map(|seen| self.extrapolation > 0.0 && is_off(seen));
        DashpotRates { present, extrapolation: self.extrapolation, is_extrapolated: carried }
    }

    pub(super) fn save(&self, state: &mut Vec<f64>) {
        state.extend(self.mismatches.iter().flat_map(|seen| [seen.off, seen.apart]));
        state.extend([self.extrapolation, self.before]);
    }

    pub(super) fn restore(&mut self, next: &mut dyn FnMut() -> f64) {
        let seen = [(); 3].map(|()| RateMismatch { off: next(), apart: next() });
        *self = Self { mismatches: seen, extrapolation: next(), before: next() };
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn selections(rate: impl Fn(i32) -> f64) -> Vec<bool> {
        let mut watch = RateResolution::default();
        let mean = |step: i32| 0.5 * (rate(step) + rate(step - 1));
        let extrapolates = (1..300).map(|step| {
            let seen = watch.fraction(0.1).map(|fraction| {
                RateMismatch::of(2.0, rate(step - 1), [mean(step - 1), mean(step)], fraction)
            });
            watch.add(
                0.1,
                [RateMismatch::default(), seen.unwrap_or_default(), RateMismatch::default()],
            );
            let [axial, shear, bending] = watch.selected(&[]).is_extrapolated;
            assert!(!axial && !bending);
            !shear
        });
        extrapolates.collect()
    }

    #[test]
    fn resolved_rates_are_extrapolated() {
        for turn in [0.01, 0.1, 0.5, 1.0] {
            let extrapolates = selections(|step| (turn * f64::from(step) + 0.3).cos());
            assert!(extrapolates.into_iter().all(|extrapolates| extrapolates), "{turn}");
        }
        assert!(selections(|step| 0.7_f64.powi(step)).into_iter().all(|extrapolates| extrapolates));
        assert!(
            selections(|step| f64::from(step.max(100)))
                .into_iter()
                .all(|extrapolates| extrapolates)
        );
    }

    #[test]
    fn alternating_rates_are_not_extrapolated() {
        for ring in [0.1, 1.0, 100.0] {
            let extrapolates =
                selections(|step| (0.1 * f64::from(step)).cos() + ring * (-1.0_f64).powi(step));
            assert!(extrapolates.into_iter().skip(1).all(|extrapolates| !extrapolates), "{ring}");
        }
    }

    #[test]
    fn step_of_infinite_duration_ends_extrapolation() {
        let mut watch = RateResolution::default();
        let seen = [RateMismatch { off: 1.0, apart: 0.0 }; 3];
        watch.add(0.1, seen);
        assert_eq!(watch.selected(&[]).is_extrapolated, [false; 3]);
        watch.add(0.3, seen);
        assert_eq!(watch.selected(&[]).is_extrapolated, [true; 3]);
        assert_eq!(watch.selected(&[]).extrapolation, 0.75);
        watch.add(f64::INFINITY, seen);
        assert_eq!(watch.selected(&[]).is_extrapolated, [false; 3]);
    }
}
