//! Detection of contacts that last only a few steps: with obstacles, between bodies, and of springs that can be slack, such as bumpers and ropes.

/// Largest number of steps during a contact for which the steps do not resolve the bounce.
const FEW: f64 = 3.0;

/// Largest change of the rate of an elongation or gap in a contact without a bounce, as a fraction of the rate at the start of the contact [-].
const TURNED: f64 = 0.5;

/// Largest contact depth that is attributed to rounding, as a fraction of the length or angle of the spring.
const ROUNDING_DEPTH: f64 = 1e-12;

/// Contact with a rebound that lasts too few steps to be resolved.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ShortBounce {
    /// Number of steps during the contact [-], including steps at whose start or end the contact is open (the spring is slack).
    pub steps: f64,
    /// Largest force of the bounce, averaged over a step [force, force·length].
    pub force: f64,
    /// Duration of the bounce [time].
    pub duration: f64,
}

#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct ContactWatch {
    steps: f64,
    /// Rate of the elongation or gap at the beginning of the contact [length/time, rad/time].
    entry: f64,
    /// Largest force of the present contact so far [force, force·length].
    force: f64,
    duration: f64,
    /// Largest force of a bounce that is attributed to rounding [force, force·length].
    noise: f64,
    unresolved: Option<ShortBounce>,
}

impl ContactWatch {
    pub fn new(largest_stiffness: f64, extent: f64) -> Self {
        Self { noise: ROUNDING_DEPTH * largest_stiffness * extent, ..Self::default() }
    }

    /// Records a step. The flags are true if the contact is open (the spring is slack) at the start and at the end of the step.
    /// The rates of the elongation or gap in the previous step and in the recorded step are `before` and `rate`.
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
        // Substeps may run backwards in time.
        self.duration += duration.abs();
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

    pub fn short_bounce(&self) -> Option<ShortBounce> {
        self.unresolved
    }

    pub fn save(&self, state: &mut Vec<f64>) {
        state.extend([self.steps, self.entry, self.force, self.duration]);
        let bounce = |bounce: ShortBounce| [bounce.steps, bounce.force, bounce.duration];
        state.extend(self.unresolved.map_or([0.0; 3], bounce));
    }

    pub fn restore(&mut self, next: &mut dyn FnMut() -> f64) {
        (self.steps, self.entry, self.force, self.duration) = (next(), next(), next(), next());
        let (steps, force, duration) = (next(), next(), next());
        self.unresolved = (steps > 0.0).then_some(ShortBounce { steps, force, duration });
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn bounced(force: f64) -> ContactWatch {
        let mut watch = ContactWatch::new(1e4, 2.0);
        watch.add([true, false], [1.0, 1.0], (force, 0.1));
        watch.add([false, true], [1.0, -1.0], (force, 0.3));
        watch
    }

    #[test]
    fn bounce_with_a_force_of_rounding_is_ignored() {
        assert_eq!(
            bounced(3e-8).short_bounce(),
            Some(ShortBounce { steps: 2.0, force: 3e-8, duration: 0.4 })
        );
        assert_eq!(bounced(1e-8).short_bounce(), None);
    }

    #[test]
    fn backward_substeps_give_a_positive_bounce_duration() {
        let mut watch = ContactWatch::new(1e4, 2.0);
        watch.add([true, false], [1.0, 1.0], (3.0, 0.1));
        watch.add([false, true], [1.0, -1.0], (3.0, -0.3));
        let duration = watch.short_bounce().map(|bounce| bounce.duration);
        assert_eq!(duration, Some(0.4));
    }
}
