//! A slider on a track and the seams between its beams: passing them, and leaning on them.

use super::{SliderContact, would_pull};
use crate::geometry::{Basis, Vec2};
use crate::joints::ContactUnknowns;
use crate::system::bodies::Body;
use crate::system::sliders::{MasterEnd, Seam, SliderState, TrackPath};

impl SliderContact {
    /// Lets the slider pass from beam to beam along a route, on one of whose beams it is.
    pub fn follow(&mut self, route: TrackPath) {
        self.route = Some(Box::new(route));
        let functions = self.most_of_masters(Basis::functions);
        self.before.reserve(functions);
        self.moved.reserve(functions);
    }

    /// Whether the slider is on a track.
    pub fn is_on_track(&self) -> bool {
        self.route.is_some()
    }

    /// The largest of a number that belongs to the mesh of a master, among all masters that the slider may have.
    pub(super) fn most_of_masters(&self, of: impl Fn(&Basis) -> usize) -> usize {
        let own = of(self.passage.basis());
        self.route.as_ref().map_or(own, |route| route.bases().map(of).fold(own, usize::max))
    }

    /// Where the track goes on beyond an end of the present master, if the slider is on one that does.
    pub fn seam(&self, bodies: &[Body], end: MasterEnd) -> Option<Seam> {
        self.route.as_ref()?.seam(bodies, end)
    }

    /// Whether the slider passed a seam at a time, or left one on which it leant: one that is led back at once does not get away.
    pub fn came_to_seam_at(&self, time: f64) -> bool {
        self.left_at == time || self.route.as_ref().is_some_and(|route| route.passed_at == time)
    }

    /// Whether the slider leans where there was a seam, on what is now an end of the track that holds nobody.
    pub(super) fn leans_on_nothing(&self, bodies: &[Body]) -> bool {
        let SliderState::Held(end) = self.state else { return false };
        !self.ends.has_stop() && self.route.as_ref().is_some_and(|route| route.is_torn(bodies, end))
    }

    /// The directions in which the slider leaves the one side of a seam beyond an end of its master, and comes to the other [-].
    pub fn corner(&self, bodies: &[Body], end: MasterEnd, seam: Seam) -> Option<[Vec2; 2]> {
        let leg = self.route.as_ref()?.leg(seam.leg);
        let inward = -seam.end.outward();
        let beyond = leg.end_tangent(bodies, &[], seam.end).normalize() * inward;
        Some([self.along(bodies) * end.outward(), beyond])
    }

    /// Notes when the slider passes a seam.
    pub fn note_passing(&mut self, time: f64) {
        self.route.iter_mut().for_each(|route| route.passed_at = time);
    }

    /// The beam on the other side of a seam, by its index.
    pub fn beam_beyond(&self, seam: Seam) -> Option<usize> {
        self.route.as_ref().map(|route| route.leg(seam.leg).beam)
    }

    /// Puts the slider on the other side of a seam at which it is.
    pub fn pass(&mut self, seam: Seam) {
        let Some(route) = &mut self.route else { return };
        route.pass(seam);
        self.take_master();
        self.stand_at(self.rail.end(seam.end));
        self.unknowns = ContactUnknowns { force: self.unknowns.force, ..ContactUnknowns::zeros() };
        if let SliderState::Held(_) = self.state {
            self.state = SliderState::Held(seam.end);
        }
    }

    /// Takes the beam of the track for a master that the route says.
    pub(super) fn take_master(&mut self) {
        let Some(leg) = self.route.as_deref().map(TrackPath::present) else { return };
        if leg.beam == self.connection.master {
            return;
        }
        (self.connection.master, self.bars.0) = (leg.beam, leg.bar);
        (self.rail, self.length) = (leg.rail.clone(), leg.length_of_parameter());
        (self.passage, self.here) = (leg.passage.clone(), leg.passage.clone());
    }

    /// How much a seam on which the slider leans keeps it from the beam on the other side with such a force on its master, times the tangent there, after
    /// movements by such increments [force·length]; zero where it leans on none.
    pub(super) fn push_beyond_seam(&self, bodies: &[Body], increments: &[f64], force: Vec2) -> f64 {
        let SliderState::Held(end) = self.state else { return 0.0 };
        let Some(route) = &self.route else { return 0.0 };
        route.seam(bodies, end).map_or(0.0, |seam| {
            let leg = route.leg(seam.leg);
            let tangent = leg.end_tangent(bodies, increments, seam.end);
            // As lengths for a parameter of one on the own side are, to be compared with these.
            let scale = self.length / leg.length_of_parameter();
            force.dot(&tangent) * seam.end.outward() * scale
        })
    }

    /// Whether a seam would have to pull the slider off the beam on the other side, and more than off its own, by what it pushes on both sides, times
    /// tangents [force·length], under a force of such a size [force].
    pub(super) fn is_drawn_beyond(&self, [push, push_beyond]: [f64; 2], force: f64) -> bool {
        push_beyond < push && would_pull(push_beyond, force, self.length)
    }

    /// Puts a slider that leans on a seam on its other side, if it is drawn off there.
    pub fn change_sides(&mut self, bodies: &[Body]) {
        let SliderState::Held(end) = self.state else { return };
        if !std::mem::take(&mut self.leaves_beyond) {
            return;
        }
        if let Some(seam) = self.seam(bodies, end) {
            self.pass(seam);
        }
    }
}
