//! The beams of a track, one after the other, and where on them a slider is.

use std::sync::Arc;

use super::{ImpactBar, MasterCurve, MasterEnd};
use crate::geometry::{Basis, ContactPath, Vec2};
use crate::joints::{TrackDirection, TrackEnd};
use crate::system::bodies::Body;

/// The ends of two beams are one place if they are no further apart than this part of the beam and of their distance from the origin.
const SAME: f64 = 1e-9;

/// A beam of a track, as a slider finds it that comes along.
#[derive(Debug, Clone)]
pub struct TrackPathSegment {
    /// The index of the beam.
    pub beam: usize,
    /// How the track leads along the beam.
    pub heading: TrackDirection,
    /// The beam as drawn.
    pub rail: MasterCurve,
    /// The functions of its mesh along ways.
    pub passage: ContactPath,
    /// The beam as a blow runs through it.
    pub bar: ImpactBar,
    /// At both of its ends, which functions have slopes, and these.
    slopes: [(usize, Vec<f64>); 2],
}

/// The way of a slider from beam to beam: the beams of its track, and how far it has come.
#[derive(Debug, Clone)]
pub struct TrackPath {
    /// Shared by all sliders on the track.
    legs: Arc<[TrackPathSegment]>,
    course: TrackEnd,
    /// The length of the track before each of its beams, and of all of it, as drawn [length].
    lengths: Arc<[f64]>,
    /// The number of the beam on which the slider is, among those of the track.
    leg: usize,
    /// How often the slider has passed from the last beam of a closed track to the first, less the times it came back.
    turns: f64,
    /// When the slider passed a seam last; [`NEVER`](super::sliding::NEVER) before it did [time].
    pub passed_at: f64,
}

/// Where a track goes on beyond an end of one of its beams.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Seam {
    /// The number of the beam on which it goes on, among those of the track.
    pub leg: usize,
    /// The end of that beam.
    pub end: MasterEnd,
    /// By how much the number of turns changes.
    turns: f64,
}

impl TrackPath {
    /// The route along the beams of a track, for a slider on one of them that has passed no seam yet.
    pub fn new(legs: Arc<[TrackPathSegment]>, course: TrackEnd, leg: usize) -> Self {
        let ends = legs.iter().scan(0.0, |sum, leg| {
            *sum += leg.rail.length();
            Some(*sum)
        });
        let lengths = std::iter::once(0.0).chain(ends).collect();
        Self { legs, course, lengths, leg, turns: 0.0, passed_at: super::slider_contact::NEVER }
    }

    /// The beam of the track on which the slider is.
    pub fn present(&self) -> &TrackPathSegment {
        &self.legs[self.leg]
    }

    /// A beam of the track by its number.
    pub fn leg(&self, leg: usize) -> &TrackPathSegment {
        &self.legs[leg]
    }

    /// The length of the track as drawn [length].
    pub fn length(&self) -> f64 {
        self.lengths[self.legs.len()]
    }

    /// How far the slider has come along the track where such a part of its present beam lies behind it in the direction of that, turns of a closed track
    /// included [length].
    pub fn arc_length(&self, part: f64) -> f64 {
        let leg = self.present();
        let along = leg.heading.along(leg.rail.length(), part * leg.rail.length());
        self.turns * self.length() + (self.lengths[self.leg] + along)
    }

    /// The bases of the beams of the track, in its order.
    pub fn bases(&self) -> impl Iterator<Item = &Basis> {
        self.legs.iter().map(|leg| leg.passage.basis())
    }

    /// Where the track goes on beyond an end of the present beam, if it does and the beams meet there.
    pub fn seam(&self, bodies: &[Body], end: MasterEnd) -> Option<Seam> {
        self.beyond(end).filter(|seam| self.meet(bodies, end, *seam))
    }

    /// Whether the track went on beyond an end of the present beam, and the beams have come apart there.
    pub fn is_torn(&self, bodies: &[Body], end: MasterEnd) -> bool {
        self.beyond(end).is_some_and(|seam| !self.meet(bodies, end, seam))
    }

    /// Where the track goes on beyond an end of the present beam as drawn.
    fn beyond(&self, end: MasterEnd) -> Option<Seam> {
        let last = self.legs.len() - 1;
        let leads_on = end == self.present().leaves_at();
        let (leg, turns) = match (leads_on, self.leg) {
            (true, leg) if leg < last => (leg + 1, 0.0),
            (false, leg) if leg > 0 => (leg - 1, 0.0),
            _ if self.course == TrackEnd::Open => return None,
            (true, _) => (0, 1.0),
            (false, _) => (last, -1.0),
        };
        let leaves_at = self.legs[leg].leaves_at();
        Some(Seam { leg, end: if leads_on { leaves_at.opposite() } else { leaves_at }, turns })
    }

    /// Whether the beams of a seam beyond an end of the present beam are at one place there.
    fn meet(&self, bodies: &[Body], end: MasterEnd, seam: Seam) -> bool {
        let next = &self.legs[seam.leg];
        let (here, there) =
            (self.present().end_point(bodies, end), next.end_point(bodies, seam.end));
        (there - here).norm() <= SAME * (next.rail.length() + here.norm())
    }

    /// Goes on to the other side of a seam.
    pub fn pass(&mut self, seam: Seam) {
        self.leg = seam.leg;
        self.turns += seam.turns;
    }

    /// The state of the route in numbers.
    pub fn numbers(&self) -> [f64; 3] {
        [self.leg as f64, self.turns, self.passed_at]
    }

    /// Takes the state of the route back from its numbers.
    pub fn take(&mut self, [leg, turns, passed_at]: [f64; 3]) {
        (self.leg, self.turns, self.passed_at) = (leg as usize, turns, passed_at);
    }

    /// The beam that such numbers say that the slider is on, if they may be those of this route.
    pub fn stored_leg(&self, [leg, turns, _]: [f64; 3]) -> Option<&TrackPathSegment> {
        let is_whole = leg >= 0.0 && leg.fract() == 0.0 && turns.fract() == 0.0;
        let may_turn = turns == 0.0 || self.course == TrackEnd::Closed;
        let leg = self.legs.get(leg as usize);
        leg.filter(|_| is_whole && may_turn)
    }
}

impl TrackPathSegment {
    /// A beam of a track, by its index, along which this leads so.
    pub fn new(
        beam: usize,
        heading: TrackDirection,
        rail: MasterCurve,
        mut passage: ContactPath,
        bar: ImpactBar,
    ) -> Self {
        let slopes = [MasterEnd::Start, MasterEnd::End].map(|end| {
            passage.go(rail.end(end), rail.end(end));
            (passage.first(), passage.slope().to_vec())
        });
        Self { beam, heading, rail, passage, bar, slopes }
    }

    /// The end of the beam at which the track leaves it.
    fn leaves_at(&self) -> MasterEnd {
        match self.heading {
            TrackDirection::Forward => MasterEnd::End,
            TrackDirection::Backward => MasterEnd::Start,
        }
    }

    /// Where an end of the beam is [length].
    fn end_point(&self, bodies: &[Body], end: MasterEnd) -> Vec2 {
        let points = bodies[self.beam].dynamics.control_points();
        match end {
            MasterEnd::Start => points[0],
            MasterEnd::End => points[points.len() - 1],
        }
    }

    /// The derivative of the place on the beam by its parameter at an end, after movements of all bodies by such increments, none if there are none [length].
    pub fn end_tangent(&self, bodies: &[Body], increments: &[f64], end: MasterEnd) -> Vec2 {
        let (first, slopes) = &self.slopes[end as usize];
        let body = &bodies[self.beam];
        let points = body.dynamics.control_points();
        let place = |at: usize| points[at] - points[*first] + body.vector_at(at, increments);
        slopes.iter().zip(*first..).map(|(slope, at)| place(at) * *slope).sum()
    }

    /// The length of the beam for a parameter of one [length].
    pub fn length_of_parameter(&self) -> f64 {
        let (first, last) = self.rail.domain();
        self.rail.length() / (last - first)
    }
}
