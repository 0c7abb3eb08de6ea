//! Sliders at the seams of their tracks.

use super::{SliderContact, is_tensile};
use crate::geometry::{Basis, Vec2};
use crate::joints::ContactUnknowns;
use crate::system::bodies::Body;
use crate::system::sliders::{MasterEnd, Seam, SliderState, TrackPath};

impl SliderContact {
    pub fn set_track(&mut self, route: TrackPath) {
        self.track = Some(Box::new(route));
        let functions = self.most_of_masters(Basis::functions);
        self.before.reserve(functions);
        self.movements.reserve(functions);
    }

    pub fn is_on_track(&self) -> bool {
        self.track.is_some()
    }

    pub(super) fn most_of_masters(&self, of: impl Fn(&Basis) -> usize) -> usize {
        let own = of(self.path.basis());
        self.track.as_ref().map_or(own, |route| route.bases().map(of).fold(own, usize::max))
    }

    /// Seam at an end of the present master; `None` if the slider is not on a track, or if the track does not continue at this end.
    pub fn seam(&self, bodies: &[Body], end: MasterEnd) -> Option<Seam> {
        self.track.as_ref()?.seam(bodies, end)
    }

    /// Returns true if the slider left a stop or a seam, or passed a seam, exactly at `time`.
    /// A slider that returns to a seam exactly at the time at which it passed or left the seam is held there.
    pub fn crossed_seam_at(&self, time: f64) -> bool {
        self.stop_left_at == time
            || self.track.as_ref().is_some_and(|route| route.crossed_at == time)
    }

    /// Returns true if the slider is held at a seam whose beams have separated.
    pub(super) fn is_held_at_open_end(&self, bodies: &[Body]) -> bool {
        let SliderState::Held(end) = self.state else { return false };
        !self.ends.has_stop() && self.track.as_ref().is_some_and(|route| route.is_torn(bodies, end))
    }

    /// Tangents of the track on both sides of a seam, in the direction in which the slider passes the seam [-].
    pub fn corner(&self, bodies: &[Body], end: MasterEnd, seam: Seam) -> Option<[Vec2; 2]> {
        let leg = self.track.as_ref()?.segment(seam.segment);
        let inward = -seam.end.outward();
        let beyond = leg.end_tangent(bodies, &[], seam.end).normalize() * inward;
        Some([self.along(bodies) * end.outward(), beyond])
    }

    pub fn record_crossing(&mut self, time: f64) {
        self.track.iter_mut().for_each(|route| route.crossed_at = time);
    }

    pub fn beam_beyond(&self, seam: Seam) -> Option<usize> {
        self.track.as_ref().map(|route| route.segment(seam.segment).beam)
    }

    /// Moves the slider from an end of its beam to the other side of the seam.
    pub fn cross_seam(&mut self, seam: Seam) {
        let Some(route) = &mut self.track else { return };
        route.cross_seam(seam);
        self.set_master();
        self.set_parameter(self.master.end(seam.end));
        self.unknowns = ContactUnknowns { force: self.unknowns.force, ..ContactUnknowns::zeros() };
        if let SliderState::Held(_) = self.state {
            self.state = SliderState::Held(seam.end);
        }
    }

    pub(super) fn set_master(&mut self) {
        let Some(leg) = self.track.as_deref().map(TrackPath::present) else { return };
        if leg.beam == self.connection.master {
            return;
        }
        (self.connection.master, self.bars.0) = (leg.beam, leg.bar);
        (self.master, self.length) = (leg.master.clone(), leg.length_of_parameter());
        (self.path, self.start_path) = (leg.path.clone(), leg.path.clone());
    }

    pub(super) fn seam_push(&self, bodies: &[Body], increments: &[f64], force: Vec2) -> f64 {
        let SliderState::Held(end) = self.state else { return 0.0 };
        let Some(route) = &self.track else { return 0.0 };
        route.seam(bodies, end).map_or(0.0, |seam| {
            let leg = route.segment(seam.segment);
            let tangent = leg.end_tangent(bodies, increments, seam.end);
            let scale = self.length / leg.length_of_parameter();
            force.dot(&tangent) * seam.end.outward() * scale
        })
    }

    pub(super) fn is_pulled_across(&self, [push, push_beyond]: [f64; 2], force: f64) -> bool {
        push_beyond < push && is_tensile(push_beyond, force, self.length)
    }

    pub fn change_sides(&mut self, bodies: &[Body]) {
        let SliderState::Held(end) = self.state else { return };
        if !std::mem::take(&mut self.crosses_seam) {
            return;
        }
        if let Some(seam) = self.seam(bodies, end) {
            self.cross_seam(seam);
        }
    }
}
