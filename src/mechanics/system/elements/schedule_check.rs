//! Check of sampled schedules for changes between the samples of a step.

use crate::integrators::Interval;
use crate::loads::{Schedule, StepMean};

/// Largest difference between the results of two quadrature rules for the mean of a schedule that is accepted without a warning.
/// The difference between the results is a fraction of the largest value of the schedule [-].
/// A jump that is more than 2 % of the step from both ends causes a difference of at least 0.09 of the jump.
/// A sine with 2.5 steps per period causes a difference of about `LARGEST_MISS`.
const LARGEST_MISS: f64 = 0.01;

/// Largest difference between two quadrature rules for the mean of a schedule over a step.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct UnsampledChange {
    /// Middle of the step with the largest difference [time].
    pub time: f64,
    /// Difference between two quadrature rules for the mean, as a fraction of the largest value of the schedule [-].
    pub sampling_error: f64,
}

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
    /// Creates the check of a schedule; `None` if the means of the schedule over steps are exact.
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

    /// Largest change of the schedule between the samples of a step so far; `None` if the steps resolve the schedule.
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
