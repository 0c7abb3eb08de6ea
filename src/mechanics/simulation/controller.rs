//! PI controller of the step size.
//!
//! References: K. Gustafsson, ACM Trans. Math. Softw. 17 (1991); E. Hairer & G. Wanner, Solving Ordinary Differential Equations II, section IV.2.

use serde::{Deserialize, Serialize};

use crate::elementary::power;

/// Safety factor: ratio of the selected step size to the step size for which the controller predicts the allowed error [-].
const SAFETY: f64 = 0.9;

const MOST_GROWTH: f64 = 5.0;

const LEAST_GROWTH: f64 = 0.2;

const SECOND_REJECTION_FACTOR: f64 = 0.5;

/// Exponent of the PI controller. It multiplies the step size by `e^(-NOW/p) f^(BEFORE/p)`, where `e` is the error of the last accepted step,
/// `f` is the error of the accepted step before it, and `p` is the order of the error, see [`StepController::order`].
const NOW: f64 = 0.7;

/// Second exponent of the PI controller, see [`NOW`].
const BEFORE: f64 = 0.4;

/// Smallest error that the controller uses, as a fraction of the allowed error. Smaller errors are replaced by this value.
const LEAST_ERROR: f64 = 1e-4;

#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct StepController {
    /// Exponent of the step size in the error of a single step [-].
    pub(super) order: f64,
    pub(super) first: f64,
    pub(super) smallest: f64,
    pub(super) largest: f64,
}

#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub(super) struct StepSizeState {
    /// Size of the next step if no event shortens it [time].
    pub(super) unconstrained_size: f64,
    pub(super) error: Option<f64>,
    pub(super) tries: usize,
}

#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct TriedStep {
    pub(super) duration: f64,
    /// Error of the step as a fraction of the allowed error [-].
    pub(super) error: f64,
}

impl StepController {
    pub(super) fn start(&self) -> StepSizeState {
        StepSizeState { unconstrained_size: self.first, error: None, tries: 0 }
    }

    pub(super) fn allows(&self, state: &StepSizeState) -> bool {
        let is_error = state.error.is_none_or(|error| error >= LEAST_ERROR && error.is_finite());
        (self.smallest..=self.largest).contains(&state.unconstrained_size)
            && state.unconstrained_size.is_finite()
            && is_error
            && state.tries < usize::MAX / 2
    }

    pub(super) fn restart(&self, state: &mut StepSizeState) {
        *state = StepSizeState {
            unconstrained_size: state.unconstrained_size.min(self.first),
            ..self.start()
        };
    }

    pub(super) fn accept(&self, state: &mut StepSizeState, trial: TriedStep) {
        let error = trial.error.max(LEAST_ERROR);
        let growth = match state.error {
            None => self.room(error),
            Some(last) => power(self.room(error), NOW) / power(self.room(last), BEFORE),
        };
        // After a failed attempt, the step size must not grow.
        let most = if state.tries > 0 { 1.0 } else { MOST_GROWTH };
        let wish = trial.duration * growth.clamp(LEAST_GROWTH, most);
        *state =
            StepSizeState { unconstrained_size: self.bounded(wish), error: Some(error), tries: 0 };
    }

    /// Updates the controller after an accepted step that an event shortened. The step size may increase but not decrease.
    pub(super) fn accept_cut(&self, state: &mut StepSizeState, trial: TriedStep) {
        let mut alone = StepSizeState { error: None, ..*state };
        self.accept(&mut alone, trial);
        *state = StepSizeState {
            unconstrained_size: alone.unconstrained_size.max(state.unconstrained_size),
            error: state.error,
            tries: 0,
        };
    }

    pub(super) fn reject(&self, state: &mut StepSizeState, trial: TriedStep) {
        let most = if state.tries > 0 { SECOND_REJECTION_FACTOR } else { SAFETY };
        let error = if trial.error.is_nan() { f64::INFINITY } else { trial.error };
        self.shorten(state, trial.duration, self.room(error).clamp(LEAST_GROWTH, most));
    }

    pub(super) fn fail(&self, state: &mut StepSizeState, duration: f64) {
        self.shorten(state, duration, SECOND_REJECTION_FACTOR);
    }

    fn room(&self, error: f64) -> f64 {
        SAFETY * power(error, -1.0 / self.order)
    }

    fn shorten(&self, state: &mut StepSizeState, duration: f64, part: f64) {
        state.tries += 1;
        state.unconstrained_size = self.bounded(duration.min(state.unconstrained_size) * part);
    }

    fn bounded(&self, wish: f64) -> f64 {
        wish.clamp(self.smallest, self.largest)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const CONTROLLER: StepController =
        StepController { order: 3.0, first: 0.1, smallest: 1e-3, largest: 10.0 };

    fn sizes(first: f64, right: impl Fn(usize) -> f64) -> (Vec<f64>, usize) {
        let mut state = StepSizeState { unconstrained_size: first, ..CONTROLLER.start() };
        let (mut sizes, mut rejected) = (Vec::new(), 0);
        while sizes.len() < 30 {
            let duration = state.unconstrained_size;
            let trial = TriedStep { duration, error: (duration / right(sizes.len())).powi(3) };
            if trial.error <= 1.0 {
                CONTROLLER.accept(&mut state, trial);
                sizes.push(duration);
            } else {
                CONTROLLER.reject(&mut state, trial);
                rejected += 1;
            }
        }
        (sizes, rejected)
    }

    #[test]
    fn step_size_settles_slightly_below_the_ideal_size() {
        for first in [1e-3, 1.0, 9.0] {
            let (sizes, rejected) = sizes(first, |_| 1.0);
            assert!((sizes[29] - SAFETY).abs() < 0.01, "{first}: {}", sizes[29]);
            assert!(rejected <= 2, "{first}: {rejected}");
        }
    }

    #[test]
    fn step_size_follows_a_changing_ideal_size() {
        let (sizes, rejected) = sizes(0.5, |step| if step < 15 { 1.0 } else { 0.1 });
        assert!(sizes[14] > 0.6 && sizes[15] < 0.1 && sizes[29] > 0.06, "{sizes:?}");
        assert!(rejected <= 3, "{rejected}");
    }

    #[test]
    fn accepted_cut_step_only_raises_too_small_step_sizes() {
        let mut state = StepSizeState { unconstrained_size: 1.0, error: Some(0.5), tries: 0 };
        let before = state;
        CONTROLLER.accept_cut(&mut state, TriedStep { duration: 1e-2, error: 1e-9 });
        assert_eq!(state, before);
        CONTROLLER.accept_cut(&mut state, TriedStep { duration: 0.9, error: 1e-3 });
        assert!(state.unconstrained_size > 4.0 && state.error == before.error);
    }

    #[test]
    fn failed_steps_are_halved_down_to_the_smallest() {
        let mut state = CONTROLLER.start();
        CONTROLLER.fail(&mut state, 0.1);
        assert_eq!((state.unconstrained_size, state.tries), (0.05, 1));
        CONTROLLER.accept(&mut state, TriedStep { duration: 0.05, error: 1e-6 });
        assert_eq!((state.unconstrained_size, state.tries), (0.05, 0), "it does not grow at once");
        CONTROLLER.reject(&mut state, TriedStep { duration: 2e-3, error: f64::NAN });
        assert_eq!(state.unconstrained_size, 1e-3);
    }

    #[test]
    fn infinite_steps_are_shortened_after_failure() {
        let mut state = StepSizeState { unconstrained_size: 4.0, error: None, tries: 0 };
        CONTROLLER.fail(&mut state, f64::INFINITY);
        assert_eq!(state.unconstrained_size, 2.0);
        CONTROLLER.reject(&mut state, TriedStep { duration: f64::INFINITY, error: f64::NAN });
        assert_eq!(state.unconstrained_size, 0.4);
    }

    #[test]
    fn step_size_restarts_after_a_jump() {
        let mut state = StepSizeState { unconstrained_size: 3.0, error: Some(0.5), tries: 2 };
        CONTROLLER.restart(&mut state);
        assert_eq!(state, CONTROLLER.start());
        state.unconstrained_size = 0.01;
        CONTROLLER.restart(&mut state);
        assert_eq!(state.unconstrained_size, 0.01);
    }
}
