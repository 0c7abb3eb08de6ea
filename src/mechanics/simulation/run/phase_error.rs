//! Accumulated phase error of the vibration of a run (docs/theory.md, section 13.3).

use std::f64::consts::TAU;

use super::Simulation;
use crate::elementary::{atan, power, sin, square};
use crate::geometry::larger;
use crate::integrators::Method;
use crate::simulation::{StepSize, Warning};

/// Largest error of positions without a warning, as a fraction of the amplitude of the motion [-].
const LARGEST_ERROR: f64 = 0.02;

/// Error of positions for which the warning recommends a step size, as a fraction of the amplitude of the motion [-].
const ADVISED_ERROR: f64 = 0.007;

/// Largest fraction of the kinetic energy in the vibration for which no warning is given [-].
const LEAST_SHARE: f64 = 0.125;

/// Largest error of positions for which no warning is given, as a fraction of the size of the scene [-].
const NEGLIGIBLE_ERROR: f64 = 5e-3;

/// Largest phase per step for which the steps resolve the vibration [rad]. For larger phases, other warnings are given.
const RESOLVED_ANGLE: f64 = 1.8;

/// Largest error of positions due to a phase error, as a multiple of the amplitude.
const OPPOSITE: f64 = 2.0;

impl Simulation {
    /// Warning about the accumulated phase error of fixed steps.
    /// The phase error is that of a single vibration, which has the measured mean frequency and a part of the kinetic energy.
    ///
    /// Scenes with drives or controllers are not checked, because drives and controllers impose the phase of the motion.
    pub(super) fn phase_error(&self) -> Option<Warning> {
        let StepSize::Fixed(dt) = self.settings.dt else { return None };
        let is_imposed = !self.scene.drives.is_empty()
            || self.scene.schedules().any(|(_, schedule)| schedule.is_sampled());
        let resolution = self.model.resolution();
        let frequency = resolution.angular_frequency();
        let turn = frequency * dt;
        if is_imposed || turn == 0.0 || turn > RESOLVED_ANGLE {
            return None;
        }
        let PhaseSum { phase, unresolved, kinetic, steps } = self.phase_sum(frequency);
        let share = (resolution.unresolved_share() * steps / unresolved).min(1.0);
        if !(share > LEAST_SHARE && share * phase.min(OPPOSITE) > LARGEST_ERROR) {
            return None;
        }
        let speed = (2.0 * share * kinetic / (steps * self.model.total_mass())).sqrt();
        let displacement = speed / frequency * phase.min(OPPOSITE);
        if self.scene.size().is_some_and(|size| displacement <= NEGLIGIBLE_ERROR * size) {
            return None;
        }
        let order = f64::from(self.settings.method.entry().claims.order.max(2));
        let fourth = Method::FourthOrder;
        Some(Warning::Phase {
            dt,
            period: TAU / frequency,
            share,
            phase,
            advised: dt * power(ADVISED_ERROR / (share * phase), 1.0 / order),
            method: (self.settings.method != fourth).then(|| fourth.entry().name),
        })
    }

    /// Sums the phase errors of a vibration over the rows of the history.
    ///
    /// If dampers dissipate energy, the sum decreases in proportion to this energy as a fraction of the largest kinetic energy.
    /// The result is the largest value of the sum multiplied by the ratio of the amplitude at the row to the largest amplitude.
    fn phase_sum(&self, frequency: f64) -> PhaseSum {
        let rows = self.history().samples();
        let largest = rows.iter().map(|row| row.measures.energy.kinetic).fold(0.0, larger);
        let (mut sum, mut present) = (PhaseSum::default(), 0.0);
        let mut step = StepErrors::default();
        for pair in rows.windows(2).filter(|pair| pair[1].dt > 0.0) {
            let [before, now] = [pair[0].measures, pair[1].measures];
            let dt = pair[1].dt;
            if dt != step.dt {
                step = StepErrors::of(self.settings.method, dt, frequency);
            }
            let steps = (now.time - before.time) / dt;
            let lost = (now.dissipated - before.dissipated).max(0.0) / largest;
            present = present * (1.0 - lost).max(0.0) + steps * step.phase;
            sum.phase = larger(sum.phase, present * (now.energy.kinetic / largest).sqrt());
            sum.unresolved += steps * step.unresolved;
            sum.kinetic += steps * now.energy.kinetic;
            sum.steps += steps;
        }
        sum
    }
}

#[derive(Debug, Clone, Copy, Default)]
struct StepErrors {
    dt: f64,
    phase: f64,
    unresolved: f64,
}

impl StepErrors {
    fn of(method: Method, dt: f64, frequency: f64) -> Self {
        let half_turn = atan(0.5 * frequency * dt * method.first_part());
        let unresolved = square(square(sin(half_turn)));
        Self { dt, phase: method.phase_error(frequency * dt), unresolved }
    }
}

#[derive(Debug, Clone, Copy, Default)]
struct PhaseSum {
    phase: f64,
    unresolved: f64,
    kinetic: f64,
    steps: f64,
}
