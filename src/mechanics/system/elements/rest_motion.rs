//! Rest lengths and rest angles of springs that are prescribed functions of time, as in winches, cylinders and servos (docs/theory.md, section 9.1).
//!
//! The argument of the spring law is the elongation minus the rest length.
//! The work of the actuator in a step is the mean force of the step times the decrease of the rest length.
//! This work is exactly the energy that the spring exchanges with the actuator.

use serde::{Deserialize, Serialize};

use super::coordinate::Coordinate;
use super::{ScheduleCheck, StartMismatch, UnsampledChange};
use crate::integrators::Interval;
use crate::loads::{LimitSide, LoadError, MotionInStep, PrescribedMotion};

/// Rest length or rest angle of a spring as a function of time.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct PrescribedRest {
    /// Rest length or rest angle at time zero [length, rad]; `None` for the value in the initial configuration on the meshes.
    pub start: Option<f64>,
    /// Motion of the rest length or rest angle. A prescribed position is the rest length itself, not its change.
    pub motion: PrescribedMotion,
}

/// Prescribed rest length or rest angle of a spring in a step.
#[derive(Debug, Clone)]
pub struct RestMotion {
    motion: PrescribedMotion,
    /// Rest length or rest angle at time zero [length, rad].
    start: f64,
    /// Smallest admissible value [length, rad].
    lowest: f64,
    growth: Coordinate,
    in_step: MotionInStep,
    /// Rate at the end of the last step [length/time, rad/time].
    rate: f64,
    /// Work of the actuator since the start [energy].
    work: f64,
    check: Option<ScheduleCheck>,
}

impl RestMotion {
    /// Creates the rest motion of a spring whose rest length or rest angle is `start` at time zero.
    /// `lowest` is the smallest admissible value: zero for a length, negative infinity for an angle.
    pub fn new(motion: PrescribedMotion, start: f64, lowest: f64) -> Self {
        let check = match &motion {
            PrescribedMotion::Position(_) => None,
            PrescribedMotion::Rate(schedule) => ScheduleCheck::of(schedule),
        };
        // A schedule without a value at the start has been refused by the scene.
        let rate = motion.beginning(0.0).map_or(0.0, |begin| begin.rate);
        let (growth, in_step) = (Coordinate::default(), MotionInStep::default());
        Self { motion, start, lowest, growth, in_step, rate, work: 0.0, check }
    }

    /// Present rest length or rest angle [length, rad].
    pub fn value(&self) -> f64 {
        self.start + self.growth.value
    }

    /// Change of the rest length or rest angle since the start [length, rad].
    pub fn growth(&self) -> Coordinate {
        self.growth
    }

    /// Change of the rest length or rest angle in the step [length, rad].
    pub fn increment(&self) -> f64 {
        self.in_step.increment
    }

    /// Rate at the start of the step [length/time, rad/time].
    pub fn rate(&self) -> f64 {
        self.rate
    }

    /// Work of the actuator since the start [energy].
    pub fn work(&self) -> f64 {
        self.work
    }

    /// Work of the actuator in a step with the given mean force [energy].
    pub fn work_in_step(&self, force: f64) -> f64 {
        -force * self.in_step.increment
    }

    /// Function of time, as text.
    pub fn describe(&self) -> String {
        let function = self.motion.schedule().describe();
        match &self.motion {
            PrescribedMotion::Position(_) => function,
            PrescribedMotion::Rate(_) => format!("{} with the rate {function}", self.start),
        }
    }

    pub fn may_jump_at(&self, time: f64) -> bool {
        let schedule = self.motion.schedule();
        schedule.may_jump_at(time) || schedule.is_break(time)
    }

    pub fn missed_change(&self) -> Option<UnsampledChange> {
        self.check.as_ref()?.missed()
    }

    /// Evaluates the increment in a step.
    ///
    /// # Errors
    /// Fails if the function has no finite value, a prescribed position jumps, or the value at the end of the step is below its lowest value.
    pub fn begin_step(&mut self, interval: Interval) -> Result<(), LoadError> {
        self.in_step = self.motion.over(interval.start, interval.end, interval.duration())?;
        let length = self.value() + self.in_step.increment;
        if length < self.lowest {
            return Err(LoadError::NegativeLength { length });
        }
        let mean = self.in_step.mean;
        self.check.iter_mut().for_each(|check| check.begin_step(interval, mean));
        Ok(())
    }

    /// Prepares a static increment, or a step after the release of the spring. The rest length or rest angle is then constant.
    pub fn begin_movement(&mut self) {
        self.in_step = MotionInStep::default();
    }

    /// Sets the rate to its value at a time. A prescribed position is set to its value at this time, without work.
    ///
    /// # Errors
    /// Fails if the function has no finite value.
    pub fn set_at(&mut self, time: f64) -> Result<(), LoadError> {
        self.rate = self.motion.beginning(time)?.rate;
        if let PrescribedMotion::Position(schedule) = &self.motion {
            self.growth = (schedule.value(time, LimitSide::After)? - self.start).into();
        }
        Ok(())
    }

    /// Difference between the present value and the prescribed value just after a time; `None` if they are equal or a rate is prescribed.
    pub fn mismatch_at(&self, time: f64) -> Option<StartMismatch> {
        let PrescribedMotion::Position(schedule) = &self.motion else { return None };
        StartMismatch::between(self.value(), schedule.value(time, LimitSide::After).ok()?)
    }

    /// Updates the rest motion at the end of a step with the given mean force.
    pub fn advance(&mut self, force: f64) {
        self.work += self.work_in_step(force);
        self.growth = self.growth.after(self.in_step.increment);
        self.rate = self.in_step.rate;
        self.check.iter_mut().for_each(ScheduleCheck::advance);
    }

    pub fn save(&self, state: &mut Vec<f64>) {
        state.extend([self.growth.value, self.growth.rest, self.rate, self.work]);
        self.check.iter().for_each(|check| check.save(state));
    }

    pub fn restore(&mut self, next: &mut dyn FnMut() -> f64) {
        self.growth = Coordinate { value: next(), rest: next() };
        (self.rate, self.work) = (next(), next());
        self.check.iter_mut().for_each(|check| check.restore(next));
    }
}
