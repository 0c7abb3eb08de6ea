//! Slider at the stops of its master: impacts, stored energy, holding and release.

use super::{SliderContact, is_tensile};
use crate::integrators::IntervalEnd;
use crate::system::bodies::Body;
use crate::system::sliders::{AxialImpact, MasterEnd, SliderState};

impl SliderContact {
    pub fn hold_at(&mut self, end: MasterEnd) {
        self.state = SliderState::Held(end);
    }

    /// Records the work that an impact does on the bodies: the energy stored in the stop decreases by this work.
    /// If the impact loses energy or the contact is unilateral, the lost energy of the slider decreases instead.
    pub fn book_impact_work(&mut self, work: f64) {
        match self.restitution < 1.0 || self.unilateral.is_some() {
            true => self.lost_energy -= work,
            false => self.stop_energy -= work,
        }
    }

    pub fn is_pulled_off(&self) -> bool {
        self.is_pulled && matches!(self.state, SliderState::Held(_))
    }

    pub fn leave_stop(&mut self, bodies: &[Body], time: f64) {
        let tangent = self.tangent(bodies);
        (self.state, self.is_pulled, self.stop_left_at) = (SliderState::Sliding, false, time);
        self.kinked_axis.iter_mut().for_each(|axis| axis.remove_stop_force(tangent));
    }

    /// Records a tensile stop force at the end of a step. Nothing is recorded at the end of a substep.
    pub fn record_tension(&mut self, ending: IntervalEnd) {
        let leans = matches!(self.state, SliderState::Held(_)) && !self.stop_may_pull;
        let is_drawn_off = self.is_pulled_across([self.push, self.push_beyond], self.contact_force);
        self.crosses_seam = leans && is_drawn_off;
        let pulls = is_tensile(self.push, self.contact_force, self.length) || is_drawn_off;
        self.is_pulled = leans && ending == IntervalEnd::Step && pulls;
    }

    /// Records the ratio of step length to impact duration for an impact at an end of the master [-].
    pub fn record_impact_ratio(&mut self, impacts_per_step: f64) {
        self.impacts_per_step = self.impacts_per_step.max(impacts_per_step);
    }

    /// Duration of an impact at the end of the master [time].
    ///
    /// In a beam of length `L`, an impact lasts until the impact wave returns, after `2 L/c` with the wave speed `c` (Saint-Venant 1883).
    /// If the slave is rigid and light, the impact on the master lasts only until the slave stops.
    /// Rigid bodies have no waves. If both bodies are rigid, the impact duration is infinite.
    pub fn impact_duration(&self, bodies: &[Body], impact: AxialImpact) -> f64 {
        let (master, slave) = &self.bars;
        let on_master = impact
            .master
            .is_some()
            .then(|| master.wave_travel_time(1.0, impact.slave.filter(|_| slave.is_none())));
        let on_slave = slave.filter(|_| impact.slave.is_some()).map(|slave| {
            let (body, point) = self.connection.slave;
            let points = bodies[body].dynamics.control_points();
            let axis = points[(point + 1).min(points.len() - 1)] - points[point.saturating_sub(1)];
            let tangent = self.tangent(bodies);
            slave.wave_travel_time(axis.dot(&tangent) / (axis.norm() * tangent.norm()), None)
        });
        2.0 * on_master.into_iter().chain(on_slave).fold(f64::INFINITY, f64::min)
    }
}
