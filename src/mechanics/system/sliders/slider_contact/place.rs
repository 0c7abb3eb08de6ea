//! Position and speed of a slider along its master or track.

use super::SliderContact;
use crate::joints::TrackDirection;
use crate::system::bodies::Body;
use crate::system::sliders::master_curve::END_TOLERANCE;
use crate::system::sliders::{MasterEnd, SliderState, TrackPath};

impl SliderContact {
    /// Distance of the slider from an end of its master, as a fraction of the parameter range [-].
    pub fn distance_to(&self, end: MasterEnd) -> f64 {
        self.master.distance(self.parameter, end)
    }

    pub fn is_at(&self, end: MasterEnd) -> bool {
        self.distance_to(end) <= END_TOLERANCE
    }

    /// Position of the slider along the undeformed master or track, from 0 to 1, plus completed rounds on a closed track [-].
    pub fn position(&self) -> f64 {
        let part = self.part_of_master();
        self.track.as_ref().map_or(part, |route| route.arc_length(part) / route.length())
    }

    /// Arc length of the slider from the start of the undeformed master or track, including completed rounds on a closed track [length].
    pub fn arc_length(&self) -> f64 {
        let part = self.part_of_master();
        self.track.as_ref().map_or(part * self.master.length(), |route| route.arc_length(part))
    }

    fn part_of_master(&self) -> f64 {
        // After the arrival at an end, rounding errors separate the position of the slider from the end.
        if self.is_at(MasterEnd::Start) {
            return 0.0;
        }
        if self.is_at(MasterEnd::End) {
            return 1.0;
        }
        self.master.part_before(self.parameter)
    }

    /// Speed of the slider along the undeformed master or track, positive towards the end [length/time].
    pub fn speed(&self, bodies: &[Body], rates: &[f64]) -> f64 {
        let along = self.master.stretch(self.parameter) * self.rate(bodies, rates);
        self.heading().map_or(along, |heading| along * heading.sign())
    }

    /// Name of the limit at which the slider is held: the `start` or `end` of its master or track, or a `seam`.
    pub fn held_by(&self, bodies: &[Body]) -> Option<&'static str> {
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

    fn heading(&self) -> Option<TrackDirection> {
        self.track.as_deref().map(TrackPath::present).map(|leg| leg.heading)
    }
}
