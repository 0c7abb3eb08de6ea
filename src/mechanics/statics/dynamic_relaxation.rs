//! Dynamic relaxation, which finds equilibria of scenes that are restrained only by loads.

use super::StaticsError;
use super::continuation::Continuation;
use super::error::StepFailure;

/// Largest root mean square displacement that is accepted in a pass, as a fraction of the size of the scene.
const FAR: f64 = 0.15;

/// Largest displacement in a pass after which Newton's method is tried without viscous damping, as a fraction of the size of the scene.
const NEAR: f64 = 1e-2;

/// Largest displacement in a pass that counts as zero, as a fraction of the size of the scene.
/// After a pass of dynamic relaxation without displacement, Newton's method is tried even if the configuration is unstable.
const STATIONARY: f64 = 1e-13;

/// Factor by which the damping rate is multiplied after a pass with a small displacement.
const EASIER: f64 = 0.2;

/// Factor by which the damping rate is multiplied after a pass that failed or had too large displacements.
const HARDER: f64 = 4.0;

const MOST_FIRST_PASSES: usize = 60;

const MOST_PASSES: usize = 400;

/// Largest total displacement over all passes, as a multiple of the size of the scene.
/// A scene whose total displacement exceeds `ENDLESS_MOVEMENT` counts as a mechanism.
const ENDLESS_MOVEMENT: f64 = 30.0;

/// Largest number of passes in which a slider may cross the end of its master.
/// A slider that crosses the end of its master in more than `MOST_LEAVES` passes counts as having left its master.
const MOST_LEAVES: usize = 12;

impl Continuation<'_> {
    /// Finds an equilibrium under a fraction of the loads by dynamic relaxation.
    /// The scene starts without load and approaches the equilibrium in passes with viscous damping.
    /// The damping force is the damping rate [1/time²] times the inertia matrix times the displacements of the pass.
    /// The damping rate decreases from pass to pass (pseudo-transient continuation; Kelley & Keyes 1998).
    /// The argument `movements` is the number of degrees of freedom without restraint in the initial configuration.
    pub(super) fn find_equilibrium(
        &mut self,
        factor: f64,
        movements: usize,
    ) -> Result<(), StaticsError> {
        let mut rate = self.first_rate(factor)?;
        let (mut travelled, mut iterations, mut leaves, mut miss) =
            (0.0, 0, 0, StepFailure::FarSolution);
        for _ in 0..MOST_PASSES {
            self.query_monitor()?;
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
        self.query_monitor()?;
        let (scene, reason) = (self.scene.name.clone(), Box::new(miss));
        Err(StaticsError::Unrestrained { scene, movements, reason })
    }

    /// Damping rate [1/time²] for which the first pass reduces the energy and displaces the scene by a small distance.
    fn first_rate(&mut self, factor: f64) -> Result<f64, StaticsError> {
        let bending = self.model.slowest_bending();
        let mut rate = bending.unwrap_or_else(|| self.acceleration_by_size(factor) / NEAR);
        for _ in 0..MOST_FIRST_PASSES {
            self.query_monitor()?;
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

#[cfg(test)]
mod tests {
    use crate::beams::Station;
    use crate::geometry::Vec2;
    use crate::statics::{Equilibrium, Loading};
    use crate::system::{
        Anchor, Origin, ParticleDefinition, Scene, Spring, SpringKind, SpringLaw, System,
    };
    use crate::vibration::Modes;

    fn spring(name: String, anchors: [Anchor; 2], (length, time): (f64, f64)) -> Spring {
        Spring {
            name,
            kind: SpringKind::Length(anchors.to_vec()),
            law: Some(SpringLaw::Linear { stiffness: 1e3 / (time * time), natural: length }),
            origin: Origin::Zero,
            damping: 0.0.into(),
            rest: None,
        }
    }

    fn chain(count: usize, units: (f64, f64)) -> Scene {
        let mut scene = Scene::new("chain");
        let at = |index: usize| Vec2::new(index as f64 * units.0, 0.0);
        let mut last = Anchor::Ground(at(0));
        for index in 1..=count + 1 {
            let next = if index > count {
                Anchor::Ground(at(index))
            } else {
                let bead =
                    ParticleDefinition { name: format!("bead {index}"), position: at(index) };
                Anchor::Station(scene.add_particle(bead, 1.0).unwrap())
            };
            scene.add_spring(spring(format!("spring {index}"), [last, next], units)).unwrap();
            last = next;
        }
        scene
    }

    const UNITS: [(f64, f64); 6] =
        [(1e-9, 1.0), (1e-6, 1e-6), (1e6, 1.0), (1.0, 1e6), (1e3, 1e3), (1e9, 1e-9)];

    #[test]
    fn equilibrium_of_a_sagging_chain_is_found_in_any_units() {
        let sag = |units: (f64, f64)| {
            let mut scene = chain(4, units);
            scene.gravity = Vec2::new(0.0, -9.81) * (units.0 / (units.1 * units.1));
            let found = Equilibrium::find(scene, Loading::default(), &mut |_| true).unwrap();
            let iterations: usize = found.path().points().iter().map(|at| at.iterations).sum();
            let state = found.model().control_points();
            let lowest = state.map(|points| points[0].y / units.0).fold(0.0, f64::min);
            (lowest, iterations)
        };
        let (own, work) = sag((1.0, 1.0));
        for units in UNITS {
            let (other, iterations) = sag(units);
            assert!((other / own - 1.0).abs() < 1e-9, "{units:?}: {other} {own}");
            assert!(iterations.abs_diff(work) <= 5, "{units:?}: {iterations} {work}");
        }
    }

    #[test]
    fn modes_of_a_chain_are_the_same_in_any_units() {
        const COUNT: usize = 150;
        let lowest = |units: (f64, f64)| {
            let mut scene = chain(COUNT, units);
            for index in 0..COUNT {
                let place = scene.particles[index].position + Vec2::new(0.0, units.0);
                let bead = Anchor::Station(Station::on_particle(index));
                let name = format!("hanger {index}");
                scene.add_spring(spring(name, [Anchor::Ground(place), bead], units)).unwrap();
            }
            let model = System::assemble(&scene).unwrap();
            let modes = Modes::of(&model, 3, &mut || true).unwrap();
            modes.all().iter().map(|mode| mode.angular_frequency() * units.1).collect::<Vec<_>>()
        };
        let own = lowest((1.0, 1.0));
        for units in UNITS {
            for (other, own) in lowest(units).iter().zip(&own) {
                assert!((other / own - 1.0).abs() < 1e-9, "{units:?}: {other} {own}");
            }
        }
    }
}
