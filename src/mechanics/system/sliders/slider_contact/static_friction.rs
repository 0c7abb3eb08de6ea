//! Static friction of a slider: the force along the master at which a sticking slider starts to slip.
//!
//! The force on the slider drops at the start of a slip. The time of this start must therefore be accurate to second order.
//! The contact forces of a step are means. They are extrapolated linearly to the end of the step:
//!
//! ```text
//! F₀, F₁, F₂: mean forces of the attempted step and of the two steps before, with the durations h₀, h₁, h₂
//! A = (h₀ F₀ + h₁ F₁)/(h₀ + h₁)      B = (h₁ F₁ + h₂ F₂)/(h₁ + h₂)      F_end = A + (A - B)(h₀ + h₁)/(h₀ + h₂)
//! ```
//!
//! In the second step after a slip, `F_end` is extrapolated from `F₀` and `F₁`, and in the first step it is `F₀`.
//! The force `F₀` itself must not exceed the limit either. Otherwise, a jump of a load would not start a slip at once.
//!
//! Vibrations faster than the steps add impulses that change sign from step to step. The means over two steps remove these impulses.

/// Largest difference between the force along the master and its limit at the start of a slip, as a fraction of the force.
const AT_LIMIT: f64 = 1e-9;

/// Mean contact forces of a slider that sticks, in a step.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct StickingForces {
    /// Force along the master [force].
    pub along: f64,
    /// Normal force from which the friction limit is computed [force].
    pub across: f64,
    /// Duration of the step [time]; zero if the forces are unknown.
    pub duration: f64,
}

impl StickingForces {
    fn joined(self, before: Self) -> Self {
        let duration = self.duration + before.duration;
        let mean = |now: f64, last: f64| (self.duration * now + before.duration * last) / duration;
        Self {
            along: mean(self.along, before.along),
            across: mean(self.across, before.across),
            duration,
        }
    }
}

/// Static friction of a slider, with the forces of the last steps in which the slider stuck.
#[derive(Debug, Clone)]
pub struct StaticFriction {
    /// Coefficient of static friction [-].
    coefficient: f64,
    last: [StickingForces; 2],
    /// Friction limit minus the force along the master, at the start of the step [force]; zero if the forces at the start are unknown.
    reserve: f64,
}

impl StaticFriction {
    pub fn new(coefficient: f64) -> Self {
        Self { coefficient, last: Default::default(), reserve: 0.0 }
    }

    pub fn start_reserve(&self) -> f64 {
        self.reserve
    }

    fn end_reserve(&self, step: StickingForces) -> f64 {
        let [last, before] = self.last;
        let of_step = self.limit_reserve([step.along, step.across]);
        if last.duration == 0.0 {
            return of_step;
        }
        let (late, early, factor) = match before.duration > 0.0 {
            true => {
                let late = step.joined(last);
                let factor = late.duration / (step.duration + before.duration);
                (late, last.joined(before), factor)
            }
            false => (step, last, step.duration / (step.duration + last.duration)),
        };
        let at_end = [(late.along, early.along), (late.across, early.across)]
            .map(|(late, early)| late + (late - early) * factor);
        self.limit_reserve(at_end).min(of_step)
    }

    fn limit_reserve(&self, [along, across]: [f64; 2]) -> f64 {
        self.coefficient * across.abs() - along.abs()
    }

    /// Excess of the force over the friction limit at the end of a step [force]; `None` if the slider sticks.
    pub fn excess(&self, step: StickingForces) -> Option<f64> {
        let reserve = self.end_reserve(step);
        (reserve < -AT_LIMIT * step.along.abs()).then_some(-reserve)
    }

    /// Friction limit minus the force at the end of a step that has to end at the start of a slip [force]; `None` at the limit.
    pub fn missed(&self, step: StickingForces) -> Option<f64> {
        let reserve = self.end_reserve(step);
        (reserve > AT_LIMIT * step.along.abs()).then_some(reserve)
    }

    pub fn advance(&mut self, step: StickingForces) {
        self.reserve = self.end_reserve(step);
        self.last = [step, self.last[0]];
    }

    /// Discards the forces of the last steps, after a change between slip and stick.
    pub fn clear(&mut self) {
        *self = Self::new(self.coefficient);
    }

    pub fn numbers(&self) -> [f64; 7] {
        let [last, before] = self.last;
        let StickingForces { along, across, duration } = last;
        [along, across, duration, before.along, before.across, before.duration, self.reserve]
    }

    pub fn restore(&mut self, numbers: [f64; 7]) {
        let [along, across, duration, along_before, across_before, before, reserve] = numbers;
        let last = StickingForces { along, across, duration };
        let earlier =
            StickingForces { along: along_before, across: across_before, duration: before };
        (self.last, self.reserve) = ([last, earlier], reserve);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The extrapolation to the end of a step is exact for forces that grow linearly, for any step lengths.
    /// Impulses that change sign from step to step do not affect the result.
    #[test]
    fn linear_forces_are_extrapolated_without_alternating_impulses() {
        let mut friction = StaticFriction::new(0.5);
        let (mut time, mut sign) = (0.0, 1.0);
        for (at, duration) in [0.1, 0.04, 0.07, 0.2].into_iter().enumerate() {
            let middle = time + 0.5 * duration;
            let along = 3.0 + 2.0 * middle + sign * 0.001 / duration;
            friction.advance(StickingForces { along, across: 20.0 - middle, duration });
            (time, sign) = (time + duration, -sign);
            let exact = 0.5 * (20.0 - time) - (3.0 + 2.0 * time);
            let error = (friction.start_reserve() - exact).abs();
            assert!(error < 1e-12 || at < 2, "{at}: {error:e}");
        }
    }

    /// A mean force above the limit starts a slip, although the force extrapolated to the end of the step is below the limit.
    #[test]
    fn mean_force_must_not_exceed_the_limit() {
        let mut friction = StaticFriction::new(0.5);
        let step = |along| StickingForces { along, across: 20.0, duration: 0.1 };
        friction.advance(step(20.0));
        assert_eq!(friction.excess(step(10.5)), Some(0.5));
        assert_eq!(friction.excess(step(9.5)), None);
    }
}
