//! Check of sampled schedules for changes within a step that the samples miss.

use crate::integrators::Interval;
use crate::loads::{Schedule, StepMean};

/// Difference between two rules for the mean over a step, relative to the largest value, above which the steps do not resolve a schedule. A jump
/// causes at least a tenth of its size, a sine this value with 2.7 steps per period.
const LARGEST_MISS: f64 = 0.01;

/// Largest difference between two rules for the mean of a schedule over a step.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct UnsampledChange {
    /// Middle of the step [time].
    pub time: f64,
    /// Difference, relative to the largest value of the schedule [-].
    pub sampling_error: f64,
}

/// Largest difference so far. Schedules with exact means have no entry in the state.
#[derive(Debug, Clone, Copy, Default)]
pub struct ScheduleCheck {
    time: f64,
    sampling_error: f64,
    largest: f64,
    in_step: MissedInStep,
}

#[derive(Debug, Clone, Copy, Default)]
struct MissedInStep {
    time: f64,
    mean: StepMean,
}

impl ScheduleCheck {
    /// Check of a schedule; `None` if its means are exact.
    pub fn of(schedule: &Schedule) -> Option<Self> {
        schedule.is_sampled_in_steps().then(Self::default)
    }

    pub fn begin_step(&mut self, interval: Interval, mean: StepMean) {
        self.in_step = MissedInStep { time: 0.5 * (interval.start + interval.end), mean };
    }

    pub fn advance(&mut self) {
        let MissedInStep { time, mean: StepMean { sampling_error: missed, largest, .. } } =
            self.in_step;
        if missed > self.sampling_error {
            (self.time, self.sampling_error) = (time, missed);
        }
        self.largest = self.largest.max(largest);
    }

    /// Largest change that the steps so far have missed; `None` if they resolve the schedule.
    pub fn missed(&self) -> Option<UnsampledChange> {
        let is_missed = self.sampling_error > LARGEST_MISS * self.largest;
        is_missed.then(|| UnsampledChange {
            time: self.time,
            sampling_error: self.sampling_error / self.largest,
        })
    }

    pub fn save(&self, state: &mut Vec<f64>) {
        state.extend([self.time, self.sampling_error, self.largest]);
    }

    pub fn restore(&mut self, next: &mut dyn FnMut() -> f64) {
        (self.time, self.sampling_error, self.largest) = (next(), next(), next());
    }
}
