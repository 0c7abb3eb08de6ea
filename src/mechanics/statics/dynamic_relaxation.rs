//! Dynamic relaxation to equilibria of scenes that only loads restrain.

use super::StaticsError;
use super::continuation::Continuation;
use super::error::StepFailure;

/// Largest root mean square displacement in a pass, relative to the longest beam.
const FAR: f64 = 0.15;

/// Displacement in a pass, relative to the longest beam, below which Newton's method is tried without viscous damping.
const NEAR: f64 = 1e-2;

/// Displacement in a pass, relative to the longest beam, below which the configuration counts as stationary, even if it is unstable.
const STATIONARY: f64 = 1e-13;

/// Factor of the rate after passes with small displacements.
const EASIER: f64 = 0.2;

/// Factor by which the rate changes after a failed pass or one with too large displacements.
const HARDER: f64 = 4.0;

/// Largest number of attempts at the first pass.
const MOST_FIRST_PASSES: usize = 60;

const MOST_PASSES: usize = 400;

/// Sum of the displacements of all passes, relative to the size of the scene, above which the motion counts as endless.
const ENDLESS_MOVEMENT: f64 = 30.0;

/// Number of departures from its master after which a slider counts as leaving it.
const MOST_LEAVES: usize = 12;

impl Continuation<'_> {
    /// Finds the equilibrium that the unloaded scene approaches under a fraction of its loads with viscous damping. It repeats steps
    /// `σ M u + F(u) - λ P = 0` with decreasing `σ` (pseudo-transient continuation; Kelley & Keyes, SIAM J. Numer. Anal. 35 (1998) 508–523).
    /// `movements` is the number of unrestrained degrees of freedom as drawn.
    ///
    /// `K + σ M` is positive definite at the start of every pass, so every pass reduces the energy.
    pub(super) fn find_equilibrium(
        &mut self,
        factor: f64,
        movements: usize,
        goes_on: &mut dyn FnMut(f64) -> bool,
    ) -> Result<(), StaticsError> {
        let mut rate = self.first_rate(factor, goes_on)?;
        let (mut travelled, mut iterations, mut leaves, mut miss) =
            (0.0, 0, 0, StepFailure::FarSolution);
        for _ in 0..MOST_PASSES {
            self.query_monitor(goes_on)?;
            let before = self.model.state();
            match self.balance_from(factor, rate) {
                Ok(work) if self.distance_moved() <= FAR => {
                    let moved = self.distance_moved();
                    self.model.move_by(&self.unknowns, factor);
                    (travelled, iterations) = (travelled + moved, iterations + work);
                    if moved < NEAR && (moved < STATIONARY || self.unstable_directions() == 0) {
                        let near = self.model.state();
                        match self.balance_from(factor, 0.0) {
                            Ok(work) if self.distance_moved() <= NEAR => {
                                self.model.move_by(&self.unknowns, factor);
                                self.append_point(factor, travelled, iterations + work);
                                return Ok(());
                            }
                            found => miss = found.err().unwrap_or(StepFailure::FarSolution),
                        }
                        self.model.restore(&near);
                    }
                    if moved < 0.5 * FAR
                        && self.unstable_directions_with_inertia(EASIER * rate) == 0
                    {
                        rate *= EASIER;
                    }
                }
                found => {
                    miss = found.err().unwrap_or(StepFailure::FarSolution);
                    leaves += usize::from(matches!(miss, StepFailure::LeavesMaster { .. }));
                    self.model.restore(&before);
                    rate *= HARDER;
                }
            }
            if travelled > ENDLESS_MOVEMENT {
                miss = StepFailure::Mechanism;
                break;
            }
            if leaves > MOST_LEAVES {
                break;
            }
        }
        self.restore_last();
        let (scene, reason) = (self.scene.name.clone(), Box::new(miss));
        Err(StaticsError::Unrestrained { scene, movements, reason })
    }

    /// Rate [1/time²] for which the first pass reduces the energy and displaces the scene by a small distance.
    fn first_rate(
        &mut self,
        factor: f64,
        goes_on: &mut dyn FnMut(f64) -> bool,
    ) -> Result<f64, StaticsError> {
        let mut rate = self.model.slowest_bending().unwrap_or(1.0);
        for _ in 0..MOST_FIRST_PASSES {
            self.query_monitor(goes_on)?;
            let found = self.balance_from(factor, rate);
            let is_near = found.is_ok() && self.distance_moved() <= FAR;
            self.restore_last();
            if is_near && self.unstable_directions_with_inertia(rate) == 0 {
                break;
            }
            rate *= 100.0;
        }
        Ok(rate)
    }
}
