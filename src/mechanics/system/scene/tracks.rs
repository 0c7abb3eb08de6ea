//! Tracks of a scene: connections of their beams, and positions along them.

use super::Scene;
use super::ties::is_closed;
use crate::beams::Station;
use crate::geometry::Vec2;
use crate::joints::{Slider, Track, TrackBeam, TrackDirection, TrackEnd};
use crate::system::SystemError;
use crate::system::errors::{TrackError, written};

impl Scene {
    /// Adds a track along consecutive beams and returns its index.
    /// The direction of the track on each beam follows from the ends that touch.
    /// If the first beam can be passed in both directions, the track leads from the start to the end of this beam.
    ///
    /// # Errors
    /// Fails if the name is taken or invalid, if no beam is given, or if a beam is given twice.
    /// Fails if a beam does not start at the end of the previous beam or is not joined to it. On a closed track, the last beam precedes the first.
    pub fn add_track(
        &mut self,
        name: String,
        beams: &[usize],
        course: TrackEnd,
    ) -> Result<usize, SystemError> {
        self.check_name("track", &name)?;
        let legs = self.segments(&name, beams, course)?;
        self.tracks.push(Track { name, beams: legs, end: course });
        Ok(self.tracks.len() - 1)
    }

    /// Initial length of a track [length].
    pub fn track_length(&self, track: usize) -> f64 {
        self.tracks[track].beams().map(|beam| self.beams[beam].axis.length()).sum()
    }

    /// Position at an arc length along a track, given by the beam and the arc length along the beam [length].
    pub fn place_on_track(&self, track: usize, arc_length: f64) -> (usize, f64) {
        let mut left = arc_length;
        let (last, before) = self.tracks[track].beams.split_last().expect("a track has beams");
        for leg in before {
            let length = self.beams[leg.beam].axis.length();
            if left < length {
                return (leg.beam, leg.heading.along(length, left));
            }
            left -= length;
        }
        let length = self.beams[last.beam].axis.length();
        (last.beam, last.heading.along(length, left.min(length)))
    }

    /// Initial position on a track nearest to a station, given by the beam and the arc length along the beam [length].
    ///
    /// # Errors
    /// Fails if the station lies outside its beam.
    pub fn nearest_on_track(
        &self,
        track: usize,
        station: &Station,
    ) -> Result<(usize, f64), SystemError> {
        self.nearest_of(self.tracks[track].beams(), station)
    }

    /// Arc length along a track at a position on one of its beams [length].
    pub fn length_along_track(&self, track: usize, beam: usize, arc_length: f64) -> f64 {
        let legs = &self.tracks[track].beams;
        let length = |leg: &TrackBeam| self.beams[leg.beam].axis.length();
        let before = legs.iter().take_while(|leg| leg.beam != beam);
        let own = legs.iter().find(|leg| leg.beam == beam);
        let own = own.map_or(0.0, |leg| leg.heading.along(length(leg), arc_length));
        before.map(length).sum::<f64>() + own
    }

    pub(crate) fn is_on_closed_track(&self, slider: usize) -> bool {
        let track = self.sliders[slider].track.map(|track| &self.tracks[track]);
        track.is_some_and(|track| track.end == TrackEnd::Closed)
    }

    pub(in crate::system) fn masters(&self, slider: &Slider) -> Vec<usize> {
        match slider.track {
            Some(track) => self.tracks[track].beams().collect(),
            None => vec![slider.master],
        }
    }

    pub(crate) fn most_settlings(&self) -> usize {
        let on_tracks = self.sliders.iter().filter(|slider| slider.track.is_some());
        2 * self.sliders.len()
            + 2 * on_tracks.map(|slider| self.masters(slider).len()).sum::<usize>()
    }

    pub(super) fn add_stored_track(&mut self, track: Track) -> Result<(), SystemError> {
        let count = self.beams.len();
        if let Some(index) = track.beams().find(|beam| *beam >= count) {
            return Err(SystemError::Missing { object: "a track", kind: "beam", index, count });
        }
        let beams: Vec<usize> = track.beams().collect();
        self.add_track(track.name, &beams, track.end).map(|_| ())
    }

    pub(super) fn check_stored_track(&self, slider: &Slider) -> Result<(), SystemError> {
        let Some(index) = slider.track else { return Ok(()) };
        let (object, count) = ("a slider", self.tracks.len());
        let Some(track) = self.tracks.get(index) else {
            return Err(SystemError::Missing { object, kind: "track", index, count });
        };
        match track.beams().any(|beam| beam == slider.master) {
            true => Ok(()),
            false => {
                let (index, count) = (slider.master, track.beams.len());
                Err(SystemError::Missing { object, kind: "beam of its track", index, count })
            }
        }
    }

    fn segments(
        &self,
        track: &str,
        beams: &[usize],
        course: TrackEnd,
    ) -> Result<Vec<TrackBeam>, SystemError> {
        let name = |beam: usize| self.beams[beam].name.clone();
        for (at, &beam) in beams.iter().enumerate() {
            if beams[..at].contains(&beam) {
                return Err(
                    TrackError::RepeatedBeam { track: track.to_owned(), beam: name(beam) }.into()
                );
            }
        }
        let Some((&first, rest)) = beams.split_first() else {
            return Err(TrackError::Empty { track: track.to_owned() }.into());
        };
        let leg = |beam: usize, heading: TrackDirection| TrackBeam { beam, heading };
        let headings = [TrackDirection::Forward, TrackDirection::Backward];
        let meets = |heading: &TrackDirection| {
            rest.first().is_none_or(|next| self.next_segment(leg(first, *heading), *next).is_some())
        };
        let heading = headings.into_iter().find(meets).unwrap_or(TrackDirection::Forward);
        let mut legs = vec![leg(first, heading)];
        for &beam in rest {
            let before = legs[legs.len() - 1];
            let Some(next) = self.next_segment(before, beam) else {
                let [start, end] = headings.map(|heading| self.begin(leg(beam, heading)));
                return Err(TrackError::Gap {
                    track: track.to_owned(),
                    before: name(before.beam),
                    next: name(beam),
                    place: written(self.drawn_end(before)),
                    start: written(start.1),
                    end: written(end.1),
                }
                .into());
            };
            legs.push(next);
        }
        if course == TrackEnd::Closed {
            let (here, (_, start)) = (self.drawn_end(legs[legs.len() - 1]), self.begin(legs[0]));
            if !self.touches(legs[legs.len() - 1], legs[0]) {
                let (here, gap, start) = (written(here), (here - start).norm(), written(start));
                return Err(
                    TrackError::Open { track: track.to_owned(), place: here, start, gap }.into()
                );
            }
        }
        let closing = (course == TrackEnd::Closed).then(|| (legs[legs.len() - 1], legs[0]));
        let seams = legs.windows(2).map(|pair| (pair[0], pair[1])).chain(closing);
        for (before, next) in seams {
            let (one, other) = (self.end(before).0, self.begin(next).0);
            if !self.moves_with(&one, &other) {
                return Err(TrackError::NotJoined {
                    track: track.to_owned(),
                    first_end: self.describe(&one),
                    other: self.describe(&other),
                    place: written(self.drawn_end(before)),
                }
                .into());
            }
        }
        Ok(legs)
    }

    fn next_segment(&self, before: TrackBeam, beam: usize) -> Option<TrackBeam> {
        let ways = [TrackDirection::Forward, TrackDirection::Backward]
            .map(|heading| TrackBeam { beam, heading });
        let touching = || ways.into_iter().filter(|leg| self.touches(before, *leg));
        let is_joined = |leg: &TrackBeam| self.moves_with(&self.end(before).0, &self.begin(*leg).0);
        touching().find(is_joined).or_else(|| touching().next())
    }

    fn touches(&self, before: TrackBeam, next: TrackBeam) -> bool {
        let (there, here) = (self.begin(next).1, self.drawn_end(before));
        is_closed((there - here).norm(), self.beams[next.beam].axis.length(), here)
    }

    /// End of a beam where a track leaves the beam, with its initial position [length].
    fn end(&self, leg: TrackBeam) -> (Station, Vec2) {
        self.begin(TrackBeam { heading: leg.heading.reversed(), ..leg })
    }

    fn drawn_end(&self, leg: TrackBeam) -> Vec2 {
        self.end(leg).1
    }

    /// End of a beam where a track enters the beam, with its initial position [length].
    fn begin(&self, leg: TrackBeam) -> (Station, Vec2) {
        let axis = &self.beams[leg.beam].axis;
        let station = Station::on_beam(leg.beam, leg.heading.along(axis.length(), 0.0));
        let (first, last) = axis.domain();
        let at = if leg.heading == TrackDirection::Forward { first } else { last };
        (station, axis.point(at).unwrap_or_else(|_| Vec2::zeros()))
    }
}
