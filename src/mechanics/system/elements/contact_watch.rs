//! How long bounces last on a spring that is slack at times: bumpers, ropes.

/// A bounce that takes this many steps or fewer is not resolved: a half of its period is passed in three.
const FEW: f64 = 3.0;

/// A touch that changes the rate by less than this part of it is no bounce.
const TURNED: f64 = 0.5;

/// A touch by less than this part of a length or angle is one of rounding.
const TOUCH: f64 = 1e-12;

/// A bounce on a spring that steps did not resolve.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ShortBounce {
    /// The number of steps, or of parts of steps, in which the spring was not slack [-].
    pub steps: f64,
    /// The largest force in it, mean of a step [force, force·length].
    pub force: f64,
    /// How long it took [time].
    pub duration: f64,
}

/// Watches when a spring is slack and when it is not: a part of its state.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct ContactWatch {
    /// The steps since it is not slack; zero while it is.
    steps: f64,
    /// The rate of elongation with which that began [length/time, rad/time].
    entry: f64,
    /// The largest force since then [force, force·length].
    force: f64,
    /// The time since then [time].
    duration: f64,
    /// A force that rounding of the length or angle makes: bounces with less are none [force, force·length].
    noise: f64,
    /// The hardest bounce that steps did not resolve; none so far.
    unresolved: Option<ShortBounce>,
}

impl ContactWatch {
    /// Watches a spring of such a largest stiffness, whose length or angle has such an extent.
    pub fn new(largest_stiffness: f64, extent: f64) -> Self {
        Self { noise: TOUCH * largest_stiffness * extent, ..Self::default() }
    }

    /// Takes in a step with such a rate, the rate of the step before, its force and duration [time]; whether the spring was slack at its start, and is at its end.
    pub fn add(
        &mut self,
        [was_slack, is_slack]: [bool; 2],
        [before, rate]: [f64; 2],
        (force, duration): (f64, f64),
    ) {
        if was_slack && is_slack {
            return;
        }
        if was_slack {
            let entry = if before == 0.0 { rate } else { before };
            *self = Self { steps: 0.0, entry, force: 0.0, duration: 0.0, ..*self };
        }
        self.steps += 1.0;
        self.duration += duration;
        self.force = self.force.max(force.abs());
        if !is_slack {
            return;
        }
        let is_bounce = self.entry != 0.0 && (rate - self.entry).abs() > TURNED * self.entry.abs();
        let is_hardest = self.unresolved.is_none_or(|bounce| self.force > bounce.force);
        if is_bounce && self.steps <= FEW && is_hardest && self.force > self.noise {
            let Self { steps, force, duration, .. } = *self;
            self.unresolved = Some(ShortBounce { steps, force, duration });
        }
        self.steps = 0.0;
        self.entry = 0.0;
    }

    /// The bounce of the largest force among those that steps did not resolve.
    pub fn short_bounce(&self) -> Option<ShortBounce> {
        self.unresolved
    }

    /// Appends the numbers of the watch.
    pub fn save(&self, state: &mut Vec<f64>) {
        state.extend([self.steps, self.entry, self.force, self.duration]);
        let bounce = |bounce: ShortBounce| [bounce.steps, bounce.force, bounce.duration];
        state.extend(self.unresolved.map_or([0.0; 3], bounce));
    }

    /// Takes the numbers of the watch back, in the order in which they were appended.
    pub fn restore(&mut self, next: &mut dyn FnMut() -> f64) {
        (self.steps, self.entry, self.force, self.duration) = (next(), next(), next(), next());
        let (steps, force, duration) = (next(), next(), next());
        self.unresolved = (steps > 0.0).then_some(ShortBounce { steps, force, duration });
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Slack, one step in touch, slack again with the rate turned round.
    fn bounced(force: f64) -> ContactWatch {
        let mut watch = ContactWatch::new(1e4, 2.0);
        watch.add([true, false], [1.0, 1.0], (force, 0.1));
        watch.add([false, true], [1.0, -1.0], (force, 0.3));
        watch
    }

    #[test]
    fn a_bounce_of_rounding_is_none() {
        assert_eq!(
            bounced(3e-8).short_bounce(),
            Some(ShortBounce { steps: 2.0, force: 3e-8, duration: 0.4 })
        );
        assert_eq!(bounced(1e-8).short_bounce(), None);
    }
}
