//! A slider and the stops at the ends of its master: blows, what a stop stores, leaning and leaving.

use super::{SliderContact, would_pull};
use crate::integrators::IntervalEnd;
use crate::system::bodies::Body;
use crate::system::sliders::{AxialImpact, MasterEnd, SliderState};

impl SliderContact {
    /// Makes the slider rest against the stop at an end of its master.
    pub fn hold(&mut self, end: MasterEnd) {
        self.state = SliderState::Held(end);
    }

    /// Takes what a blow has given to the bodies from what the stop stores or, where it does not give all back, to what is lost.
    pub fn give(&mut self, work: f64) {
        match self.restitution < 1.0 {
            true => self.lost -= work,
            false => self.stored -= work,
        }
    }

    /// Whether the slider leans on a stop that would have had to pull.
    pub fn is_pulled_off(&self) -> bool {
        self.is_pulled && matches!(self.state, SliderState::Held(_))
    }

    /// Lets the slider slide away from the stop on which it leans.
    pub fn leave_stop(&mut self, bodies: &[Body], time: f64) {
        let tangent = self.tangent(bodies);
        (self.state, self.is_pulled, self.left_at) = (SliderState::Sliding, false, time);
        self.kinked_axis.iter_mut().for_each(|axis| axis.leave_stop(tangent));
    }

    /// Notes whether the stop on which the slider leans has had to pull in a step of such an ending that was found; not within a step.
    pub fn note_pull(&mut self, ending: IntervalEnd) {
        let leans = matches!(self.state, SliderState::Held(_)) && !self.stop_may_pull;
        let is_drawn_off = self.is_drawn_beyond([self.push, self.push_beyond], self.pressing);
        self.leaves_beyond = leans && is_drawn_off;
        let pulls = would_pull(self.push, self.pressing, self.length) || is_drawn_off;
        self.is_pulled = leans && ending == IntervalEnd::OfStep && pulls;
    }

    /// Notes that the slider struck an end of its master in steps that are so many times as long as the blow [-].
    pub fn note_blow(&mut self, blows_in_a_step: f64) {
        self.blows_in_a_step = self.blows_in_a_step.max(blows_in_a_step);
    }

    /// How long a blow at the end of the slider's master lasts [time].
    ///
    /// A blow on a beam lasts at least until its wave has come back, twice the length over `c` (Saint-Venant 1883), or, on a light
    /// slave, until that has come to rest, which takes some `m/(c ρA)`. Where nothing gives way, there is no wave to resolve, and it lasts for ever.
    pub fn blow_lasts(&self, bodies: &[Body], blow: AxialImpact) -> f64 {
        let (master, slave) = &self.bars;
        let on_master = blow.master.is_some().then(|| {
            // A beam that strikes is no heavier than its waves let it be at once.
            master.answer_time(1.0, blow.slave.filter(|_| slave.is_none()))
        });
        let on_slave = slave.filter(|_| blow.slave.is_some()).map(|slave| {
            let (body, point) = self.connection.slave;
            let points = bodies[body].dynamics.control_points();
            let axis = points[(point + 1).min(points.len() - 1)] - points[point.saturating_sub(1)];
            let tangent = self.tangent(bodies);
            slave.answer_time(axis.dot(&tangent) / (axis.norm() * tangent.norm()), None)
        });
        2.0 * on_master.into_iter().chain(on_slave).fold(f64::INFINITY, f64::min)
    }
}
