//! Mean forces over a step.

use std::ops::{Add, Mul};

/// Mean force over a step, accumulated from the mean forces over its substeps. A substep may run backwards in time.
#[derive(Debug, Clone, Copy, Default)]
pub struct StepMean<T> {
    /// Mean force over the last step. Before the first step, it is the present force.
    pub value: T,
    /// Total duration of the substeps since the end of the last step [time].
    pub covered: f64,
}

impl<T: Copy + Add<Output = T> + Mul<f64, Output = T>> StepMean<T> {
    pub fn at_start(value: T) -> Self {
        Self { value, covered: 0.0 }
    }

    pub fn add(&mut self, force: T, duration: f64) {
        if self.covered == 0.0 {
            *self = Self { value: force, covered: duration };
            return;
        }
        self.covered += duration;
        let share = duration / self.covered;
        self.value = self.value * (1.0 - share) + force * share;
    }

    pub fn end_step(&mut self) {
        self.covered = 0.0;
    }
}
