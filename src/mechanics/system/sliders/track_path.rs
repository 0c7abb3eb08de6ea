//! Beams of a track in sequence, and the position of a slider on them.

use std::sync::Arc;

use super::{ImpactBar, MasterCurve, MasterEnd};
use crate::geometry::{Basis, ContactPath, Vec2};
use crate::joints::{TrackDirection, TrackEnd};
use crate::system::bodies::Body;

/// Distance of the ends of two beams below which they coincide, relative to the beam and to their distance from the origin.
const SAME: f64 = 1e-9;

/// Beam of a track with the data of its sliders.
#[derive(Debug, Clone)]
pub struct TrackPathSegment {
    pub beam: usize,
    pub heading: TrackDirection,
    pub rail: MasterCurve,
    pub passage: ContactPath,
    pub bar: ImpactBar,
    slopes: [(usize, Vec<f64>); 2],
}

/// Path of a slider along the beams of its track.
#[derive(Debug, Clone)]
pub struct TrackPath {
    legs: Arc<[TrackPathSegment]>,
    course: TrackEnd,
    /// Lengths of the track before each of its beams, and in total, as drawn [length].
    lengths: Arc<[f64]>,
    /// Index of the present beam in the track.
    leg: usize,
    /// Number of passages from the last beam of a closed track to the first, minus those back.
    turns: f64,
    /// Time of the last passage of a seam; [`NEVER`](super::slider_contact::NEVER) before the first [time].
    pub passed_at: f64,
}

/// Continuation of a track beyond an end of one of its beams.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Seam {
    /// Index of the next beam in the track.
    pub leg: usize,
    pub end: MasterEnd,
    turns: f64,
}

impl TrackPath {
    pub fn new(legs: Arc<[TrackPathSegment]>, course: TrackEnd, leg: usize) -> Self {
        let ends = legs.iter().scan(0.0, |sum, leg| {
            *sum += leg.rail.length();
            Some(*sum)
        });
        let lengths = std::iter::once(0.0).chain(ends).collect();
        Self { legs, course, lengths, leg, turns: 0.0, passed_at: super::slider_contact::NEVER }
    }

    pub fn present(&self) -> &TrackPathSegment {
        &self.legs[self.leg]
    }

    pub fn segment(&self, leg: usize) -> &TrackPathSegment {
        &self.legs[leg]
    }

    /// Length of the track as drawn [length].
    pub fn length(&self) -> f64 {
        self.lengths[self.legs.len()]
    }

    /// Distance along the track, given the fraction of the present beam behind the slider in beam direction; unwrapped on closed tracks [length].
    pub fn arc_length(&self, part: f64) -> f64 {
        let leg = self.present();
        let along = leg.heading.along(leg.rail.length(), part * leg.rail.length());
        self.turns * self.length() + (self.lengths[self.leg] + along)
    }

    /// Bases of the beams in the order of the track.
    pub fn bases(&self) -> impl Iterator<Item = &Basis> {
        self.legs.iter().map(|leg| leg.passage.basis())
    }

    /// Seam beyond an end of the present beam, if the track continues and the beams meet there.
    pub fn seam(&self, bodies: &[Body], end: MasterEnd) -> Option<Seam> {
        self.seam_at(end).filter(|seam| self.evaluate_seam(bodies, end, *seam))
    }

    /// Returns true if the track as drawn continues beyond an end of the present beam but the beams are separated.
    pub fn is_torn(&self, bodies: &[Body], end: MasterEnd) -> bool {
        self.seam_at(end).is_some_and(|seam| !self.evaluate_seam(bodies, end, seam))
    }

    fn seam_at(&self, end: MasterEnd) -> Option<Seam> {
        let last = self.legs.len() - 1;
        let leads_on = end == self.present().exit_end();
        let (leg, turns) = match (leads_on, self.leg) {
            (true, leg) if leg < last => (leg + 1, 0.0),
            (false, leg) if leg > 0 => (leg - 1, 0.0),
            _ if self.course == TrackEnd::Open => return None,
            (true, _) => (0, 1.0),
            (false, _) => (last, -1.0),
        };
        let leaves_at = self.legs[leg].exit_end();
        Some(Seam { leg, end: if leads_on { leaves_at.opposite() } else { leaves_at }, turns })
    }

    fn evaluate_seam(&self, bodies: &[Body], end: MasterEnd, seam: Seam) -> bool {
        let next = &self.legs[seam.leg];
        let (here, there) =
            (self.present().end_point(bodies, end), next.end_point(bodies, seam.end));
        (there - here).norm() <= SAME * (next.rail.length() + here.norm())
    }

    /// Moves to the other side of a seam.
    pub fn cross_seam(&mut self, seam: Seam) {
        self.leg = seam.leg;
        self.turns += seam.turns;
    }

    pub fn numbers(&self) -> [f64; 3] {
        [self.leg as f64, self.turns, self.passed_at]
    }

    pub fn restore(&mut self, [leg, turns, passed_at]: [f64; 3]) {
        (self.leg, self.turns, self.passed_at) = (leg as usize, turns, passed_at);
    }

    pub fn stored_segment(&self, [leg, turns, _]: [f64; 3]) -> Option<&TrackPathSegment> {
        let is_whole = leg >= 0.0 && leg.fract() == 0.0 && turns.fract() == 0.0;
        let may_turn = turns == 0.0 || self.course == TrackEnd::Closed;
        let leg = self.legs.get(leg as usize);
        leg.filter(|_| is_whole && may_turn)
    }
}

impl TrackPathSegment {
    pub fn new(
        beam: usize,
        heading: TrackDirection,
        rail: MasterCurve,
        mut passage: ContactPath,
        bar: ImpactBar,
    ) -> Self {
        let slopes = [MasterEnd::Start, MasterEnd::End].map(|end| {
            passage.set_interval(rail.end(end), rail.end(end));
            (passage.first(), passage.slope().to_vec())
        });
        Self { beam, heading, rail, passage, bar, slopes }
    }

    fn exit_end(&self) -> MasterEnd {
        match self.heading {
            TrackDirection::Forward => MasterEnd::End,
            TrackDirection::Backward => MasterEnd::Start,
        }
    }

    /// Position of an end of the beam [length].
    fn end_point(&self, bodies: &[Body], end: MasterEnd) -> Vec2 {
        let points = bodies[self.beam].dynamics.control_points();
        match end {
            MasterEnd::Start => points[0],
            MasterEnd::End => points[points.len() - 1],
        }
    }

    /// Derivative of the place on the beam with respect to its parameter at an end, after given increments of all bodies; none if empty [length].
    pub fn end_tangent(&self, bodies: &[Body], increments: &[f64], end: MasterEnd) -> Vec2 {
        let (first, slopes) = &self.slopes[end as usize];
        let body = &bodies[self.beam];
        let points = body.dynamics.control_points();
        let place = |at: usize| points[at] - points[*first] + body.vector_at(at, increments);
        slopes.iter().zip(*first..).map(|(slope, at)| place(at) * *slope).sum()
    }

    /// Length of the beam per unit of parameter [length].
    pub fn length_of_parameter(&self) -> f64 {
        let (first, last) = self.rail.domain();
        self.rail.length() / (last - first)
    }
}
