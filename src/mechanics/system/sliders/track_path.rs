//! Beams of a track in sequence, and the position of a slider on the track.

use std::sync::Arc;

use super::{ImpactBar, MasterCurve, MasterEnd};
use crate::geometry::{Basis, ContactPath, Vec2};
use crate::joints::{TrackDirection, TrackEnd};
use crate::system::bodies::Body;

/// Largest distance of two beam ends that count as one point, as a fraction of the beam length plus the distance from the origin [-].
const SAME: f64 = 1e-9;

#[derive(Debug, Clone)]
pub struct TrackPathSegment {
    pub beam: usize,
    pub heading: TrackDirection,
    pub master: MasterCurve,
    pub path: ContactPath,
    pub bar: ImpactBar,
    slopes: [(usize, Vec<f64>); 2],
}

#[derive(Debug, Clone)]
pub struct TrackPath {
    segments: Arc<[TrackPathSegment]>,
    end: TrackEnd,
    /// Arc length of the undeformed track at the start of each beam, followed by the total length [length].
    lengths: Arc<[f64]>,
    segment: usize,
    /// Number of passages from the last beam of a closed track to its first beam, minus the number of reverse passages.
    turns: f64,
    /// Time of the last passage of a seam [time]; [`NEVER`](super::slider_contact::NEVER) before the first passage.
    pub crossed_at: f64,
}

/// Beam end at which a track continues beyond an end of another beam.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Seam {
    pub segment: usize,
    pub end: MasterEnd,
    turns: f64,
}

impl TrackPath {
    pub fn new(segments: Arc<[TrackPathSegment]>, end: TrackEnd, segment: usize) -> Self {
        let ends = segments.iter().scan(0.0, |sum, leg| {
            *sum += leg.master.length();
            Some(*sum)
        });
        let lengths = std::iter::once(0.0).chain(ends).collect();
        Self {
            segments,
            end,
            lengths,
            segment,
            turns: 0.0,
            crossed_at: super::slider_contact::NEVER,
        }
    }

    pub fn present(&self) -> &TrackPathSegment {
        &self.segments[self.segment]
    }

    pub fn segment(&self, leg: usize) -> &TrackPathSegment {
        &self.segments[leg]
    }

    /// Length of the undeformed track [length].
    pub fn length(&self) -> f64 {
        self.lengths[self.segments.len()]
    }

    pub fn arc_length(&self, part: f64) -> f64 {
        let leg = self.present();
        let along = leg.heading.along(leg.master.length(), part * leg.master.length());
        self.turns * self.length() + (self.lengths[self.segment] + along)
    }

    pub fn bases(&self) -> impl Iterator<Item = &Basis> {
        self.segments.iter().map(|leg| leg.path.basis())
    }

    pub fn seam(&self, bodies: &[Body], end: MasterEnd) -> Option<Seam> {
        self.seam_at(end).filter(|seam| self.evaluate_seam(bodies, end, *seam))
    }

    /// Returns true if the undeformed track continues beyond an end of the present beam, but the beams have separated.
    pub fn is_torn(&self, bodies: &[Body], end: MasterEnd) -> bool {
        self.seam_at(end).is_some_and(|seam| !self.evaluate_seam(bodies, end, seam))
    }

    fn seam_at(&self, end: MasterEnd) -> Option<Seam> {
        let last = self.segments.len() - 1;
        let leads_on = end == self.present().exit_end();
        let (leg, turns) = match (leads_on, self.segment) {
            (true, leg) if leg < last => (leg + 1, 0.0),
            (false, leg) if leg > 0 => (leg - 1, 0.0),
            _ if self.end == TrackEnd::Open => return None,
            (true, _) => (0, 1.0),
            (false, _) => (last, -1.0),
        };
        let leaves_at = self.segments[leg].exit_end();
        Some(Seam {
            segment: leg,
            end: if leads_on { leaves_at.opposite() } else { leaves_at },
            turns,
        })
    }

    fn evaluate_seam(&self, bodies: &[Body], end: MasterEnd, seam: Seam) -> bool {
        let next = &self.segments[seam.segment];
        let (here, there) =
            (self.present().end_point(bodies, end), next.end_point(bodies, seam.end));
        (there - here).norm() <= SAME * (next.master.length() + here.norm())
    }

    pub fn cross_seam(&mut self, seam: Seam) {
        self.segment = seam.segment;
        self.turns += seam.turns;
    }

    pub fn numbers(&self) -> [f64; 3] {
        [self.segment as f64, self.turns, self.crossed_at]
    }

    pub fn restore(&mut self, [leg, turns, passed_at]: [f64; 3]) {
        (self.segment, self.turns, self.crossed_at) = (leg as usize, turns, passed_at);
    }

    pub fn stored_segment(&self, [leg, turns, _]: [f64; 3]) -> Option<&TrackPathSegment> {
        let is_whole = leg >= 0.0 && leg.fract() == 0.0 && turns.fract() == 0.0;
        let may_turn = turns == 0.0 || self.end == TrackEnd::Closed;
        let leg = self.segments.get(leg as usize);
        leg.filter(|_| is_whole && may_turn)
    }
}

impl TrackPathSegment {
    pub fn new(
        beam: usize,
        heading: TrackDirection,
        master: MasterCurve,
        mut path: ContactPath,
        bar: ImpactBar,
    ) -> Self {
        let slopes = [MasterEnd::Start, MasterEnd::End].map(|end| {
            path.set_interval(master.end(end), master.end(end));
            (path.first(), path.slope().to_vec())
        });
        Self { beam, heading, master, path, bar, slopes }
    }

    fn exit_end(&self) -> MasterEnd {
        match self.heading {
            TrackDirection::Forward => MasterEnd::End,
            TrackDirection::Backward => MasterEnd::Start,
        }
    }

    fn end_point(&self, bodies: &[Body], end: MasterEnd) -> Vec2 {
        let points = bodies[self.beam].dynamics.control_points();
        match end {
            MasterEnd::Start => points[0],
            MasterEnd::End => points[points.len() - 1],
        }
    }

    pub fn end_tangent(&self, bodies: &[Body], increments: &[f64], end: MasterEnd) -> Vec2 {
        let (first, slopes) = &self.slopes[end as usize];
        let body = &bodies[self.beam];
        let points = body.dynamics.control_points();
        let place = |at: usize| points[at] - points[*first] + body.vector_at(at, increments);
        slopes.iter().zip(*first..).map(|(slope, at)| place(at) * *slope).sum()
    }

    /// Length of the beam per unit of its mesh parameter [length].
    pub fn length_of_parameter(&self) -> f64 {
        let (first, last) = self.master.domain();
        self.master.length() / (last - first)
    }
}
