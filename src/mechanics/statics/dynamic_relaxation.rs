//! Equilibria of what only its loads hold.

use super::StaticsError;
use super::continuation::Continuation;
use super::error::StepFailure;

/// The scene may move so far in a pass: root mean square, relative to the longest beam.
const FAR: f64 = 0.15;

/// A pass that moves it less is near enough to the rest for Newton's method alone,
const NEAR: f64 = 1e-2;

/// and after one that moves it less than this nothing drives it away, were it the top of a hill.
const STILL: f64 = 1e-13;

/// Passes that move it little become less sluggish by so much.
const EASIER: f64 = 0.2;

/// Those that find nothing, or move it too far, become more sluggish by so much.
const HARDER: f64 = 4.0;

/// Most tries of a first pass.
const MOST_FIRST_PASSES: usize = 60;

/// Most passes.
const MOST_PASSES: usize = 400;

/// A scene that has moved so many times its size is on its way to nowhere.
const NOWHERE: f64 = 30.0;

/// A slider that would leave its master so often does.
const MOST_LEAVES: usize = 12;

impl Continuation<'_> {
    /// Finds the equilibrium to which the unloaded scene sinks under a part of its loads, as if its masses moved in something viscous:
    /// `σ M u + F(u) - λ P = 0` again and again, with a `σ` that falls with the way (pseudo-transient continuation; Kelley & Keyes, SIAM J. Numer.
    /// Anal. 35 (1998) 508–523). So many of its movements meet no resistance as it is drawn.
    ///
    /// Every pass goes downhill: `K + σ M` is positive definite where it begins.
    pub(super) fn settle(
        &mut self,
        factor: f64,
        movements: usize,
        goes_on: &mut dyn FnMut(f64) -> bool,
    ) -> Result<(), StaticsError> {
        let mut rate = self.first_rate(factor, goes_on)?;
        let (mut way, mut iterations, mut leaves, mut miss) = (0.0, 0, 0, StepFailure::Far);
        for _ in 0..MOST_PASSES {
            self.ask(goes_on)?;
            let before = self.model.state();
            match self.balance_from(factor, rate) {
                Ok(work) if self.moved() <= FAR => {
                    let moved = self.moved();
                    self.model.move_by(&self.unknowns, factor);
                    (way, iterations) = (way + moved, iterations + work);
                    if moved < NEAR && (moved < STILL || self.falls() == 0) {
                        let near = self.model.state();
                        match self.balance_from(factor, 0.0) {
                            Ok(work) if self.moved() <= NEAR => {
                                self.model.move_by(&self.unknowns, factor);
                                self.arrive(factor, way, iterations + work);
                                return Ok(());
                            }
                            found => miss = found.err().unwrap_or(StepFailure::Far),
                        }
                        self.model.restore(&near);
                    }
                    if moved < 0.5 * FAR && self.falls_against(EASIER * rate) == 0 {
                        rate *= EASIER;
                    }
                }
                found => {
                    miss = found.err().unwrap_or(StepFailure::Far);
                    leaves += usize::from(matches!(miss, StepFailure::Leaves { .. }));
                    self.model.restore(&before);
                    rate *= HARDER;
                }
            }
            if way > NOWHERE {
                miss = StepFailure::Endless;
                break;
            }
            if leaves > MOST_LEAVES {
                break;
            }
        }
        self.go_back();
        let (scene, reason) = (self.scene.name.clone(), Box::new(miss));
        Err(StaticsError::Loose { scene, movements, reason })
    }

    /// A rate [1/time²] with which the first pass goes downhill, and moves the scene by a small part of itself.
    fn first_rate(
        &mut self,
        factor: f64,
        goes_on: &mut dyn FnMut(f64) -> bool,
    ) -> Result<f64, StaticsError> {
        let mut rate = self.model.slowest_bending().unwrap_or(1.0);
        for _ in 0..MOST_FIRST_PASSES {
            self.ask(goes_on)?;
            let found = self.balance_from(factor, rate);
            let is_near = found.is_ok() && self.moved() <= FAR;
            self.go_back();
            if is_near && self.falls_against(rate) == 0 {
                break;
            }
            rate *= 100.0;
        }
        Ok(rate)
    }
}
