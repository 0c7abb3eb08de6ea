//! Where a slider is along its master or its track, and how fast it goes along.

use super::SliderContact;
use crate::joints::TrackDirection;
use crate::system::bodies::Body;
use crate::system::sliders::master_curve::LANDED;
use crate::system::sliders::{MasterEnd, SliderState, TrackPath};

impl SliderContact {
    /// How far the slider is from an end of its master, as a part of the parameters of the master [-].
    pub fn distance_to(&self, end: MasterEnd) -> f64 {
        self.rail.distance(self.parameter, end)
    }

    /// Whether the slider is at an end of its master.
    pub fn is_at(&self, end: MasterEnd) -> bool {
        self.distance_to(end) <= LANDED
    }

    /// The place of the slider along its master or its track as drawn: 0 at the start, 1 at the end; round a closed track it counts on, or back [-].
    pub fn position(&self) -> f64 {
        let part = self.part_of_master();
        self.route.as_ref().map_or(part, |route| route.arc_length(part) / route.length())
    }

    /// How far the slider is from the start of its master or its track, as drawn, turns of a closed track included [length].
    pub fn arc_length(&self) -> f64 {
        let part = self.part_of_master();
        self.route.as_ref().map_or(part * self.rail.length(), |route| route.arc_length(part))
    }

    fn part_of_master(&self) -> f64 {
        // Arrivals are a few digits short of the end, or beyond it.
        if self.is_at(MasterEnd::Start) {
            return 0.0;
        }
        if self.is_at(MasterEnd::End) {
            return 1.0;
        }
        self.rail.part_before(self.parameter)
    }

    /// How much of its master or its track, as drawn, the slider passes in a unit of time, positive towards the end [length/time].
    pub fn speed(&self, bodies: &[Body], rates: &[f64]) -> f64 {
        let along = self.rail.stretch(self.parameter) * self.rate(bodies, rates);
        self.heading().map_or(along, |heading| along * heading.sign())
    }

    /// On what the slider leans, if it does: the `start` or the `end` of its master or its track, or a `seam` of that.
    pub fn leans_on(&self, bodies: &[Body]) -> Option<&'static str> {
        let SliderState::Held(end) = self.state else { return None };
        if self.seam(bodies, end).is_some() {
            return Some("seam");
        }
        let on_track = match self.heading() {
            Some(TrackDirection::Backward) => end.opposite(),
            Some(TrackDirection::Forward) | None => end,
        };
        Some(on_track.name())
    }

    /// How the track leads along the master, for a slider on one.
    fn heading(&self) -> Option<TrackDirection> {
        self.route.as_deref().map(TrackPath::present).map(|leg| leg.heading)
    }
}
