//! Many bodies in two halves, on which two threads work at once, with the very bits that one thread gives.
//!
//! Sums are made in the order of the bodies: each adds up its forces for itself, and one thread hands them on. Of the tangent the second half has the
//! rows for itself that no body of the first one has; what its bodies give to rows before these they give again afterwards. What takes little time is
//! left to one thread.

use super::{Bodies, Body};
use crate::beams::{Collocation, ForceSummary, RotationIncrement, at_once};
use crate::linalg::{BandRows, BandedMatrix};

/// Fewest control points of a half: below it starting a thread takes more than it saves (docs/studies.md).
const SMALLEST_HALF: usize = 1500;

/// The largest part of all control points that bodies astride may have: so much is done twice.
const LARGEST_ASTRIDE: f64 = 0.1;

/// Where bodies are cut in two halves.
#[derive(Debug, Clone)]
pub(super) struct Halves {
    /// The first body of the second half.
    body: usize,
    /// The first row of the tangent that no body of the first half has.
    row: usize,
    /// The bodies of the second half that have rows before that one.
    astride: Vec<usize>,
}

impl Halves {
    /// The cut of bodies into two halves, where two threads pay.
    pub(super) fn worthwhile(bodies: &[Body], threads: usize) -> Option<Self> {
        let points = |bodies: &[Body]| bodies.iter().map(Body::points).sum::<usize>();
        let all = points(bodies);
        if threads < 2 || all < 2 * SMALLEST_HALF || bodies.iter().any(Body::is_divided) {
            return None;
        }
        let mut before = 0;
        let body = bodies.iter().take_while(|body| {
            before += body.points();
            2 * before <= all
        });
        let body = body.count();
        let (first, second) = bodies.split_at(body);
        if points(first).min(points(second)) < SMALLEST_HALF {
            return None;
        }
        let row = first.iter().filter_map(Body::last_row).max().map_or(0, |row| row + 1);
        let reaches = |at: &usize| bodies[*at].first_row().is_some_and(|first| first < row);
        let astride: Vec<usize> = (body..bodies.len()).filter(reaches).collect();
        let twice: usize = astride.iter().map(|at| bodies[*at].points()).sum();
        (twice as f64 <= LARGEST_ASTRIDE * all as f64).then_some(Self { body, row, astride })
    }
}

impl Bodies {
    /// Lets up to `threads` threads work on a large body, or on many, from here on, with the same results; gives how many will at most.
    pub fn divide(&mut self, threads: usize) -> usize {
        self.threads = threads;
        let parts = self.all.iter_mut().map(|body| body.divide(threads)).max().unwrap_or(1);
        self.halves = Halves::worthwhile(&self.all, threads);
        if self.halves.is_some() { parts.max(2) } else { parts }
    }

    /// How many threads may work at once.
    pub fn threads(&self) -> usize {
        self.threads
    }

    /// Begins a step of all bodies with the section forces of the last one.
    pub fn begin_step(&mut self) {
        self.all.iter_mut().for_each(|body| body.dynamics.begin_step());
    }

    /// Adds the internal forces of all bodies to `out`; the largest that was met.
    pub fn add_forces(
        &mut self,
        at: Collocation,
        increments: &[f64],
        weight: f64,
        out: &mut [f64],
    ) -> ForceSummary {
        let meet = |bodies: &mut [Body]| {
            bodies.iter_mut().for_each(|body| body.meet_forces(at, increments, weight));
        };
        match &self.halves {
            None => meet(&mut self.all),
            Some(halves) => {
                let (first, second) = self.all.split_at_mut(halves.body);
                at_once([first, second], meet);
            }
        }
        let mut summary = ForceSummary::default();
        for body in &mut self.all {
            summary.join(&body.hand_on(out));
        }
        summary
    }

    /// Adds the condensed internal forces of all bodies to `out`, and their derivatives to the tangent.
    pub fn add_linearised_forces(
        &mut self,
        at: Collocation,
        increments: &[f64],
        weight: f64,
        out: &mut [f64],
        tangent: &mut BandedMatrix,
    ) {
        self.linearise(at, increments, weight, tangent);
        self.all.iter_mut().for_each(|body| _ = body.hand_on(out));
    }

    fn linearise(
        &mut self,
        at: Collocation,
        increments: &[f64],
        weight: f64,
        tangent: &mut BandedMatrix,
    ) {
        let work = |body: &mut Body, rows: BandRows<'_>| {
            body.linearise(at, increments, weight, rows);
        };
        let Some(halves) = &self.halves else {
            return self.all.iter_mut().for_each(|body| work(body, tangent.rows_mut()));
        };
        let (first, second) = self.all.split_at_mut(halves.body);
        let (before, behind) = tangent.rows_mut().split_at(halves.row);
        at_once([(first, before), (second, behind)], |(bodies, mut rows)| {
            bodies.iter_mut().for_each(|body| work(body, rows.reborrow()));
        });
        for &at in &halves.astride {
            let (before, _) = tangent.rows_mut().split_at(halves.row);
            self.all[at].forget_forces();
            work(&mut self.all[at], before);
        }
    }

    /// Adds `factor · M` of all bodies to the tangent.
    pub fn add_inertia_tangent(&self, factor: f64, tangent: &mut BandedMatrix) {
        self.all.iter().for_each(|body| body.add_inertia_tangent(factor, tangent.rows_mut()));
    }

    /// Adds the forces to `out` that would close the strain mismatch of all bodies.
    pub fn add_mismatch_forces(&mut self, weight: f64, out: &mut [f64]) {
        for body in &mut self.all {
            body.meet_mismatch(weight);
            body.hand_on(out);
        }
    }

    /// Updates the section forces of all bodies for a correction of the unknowns.
    pub fn correct_section_forces(&mut self, correction: &[f64]) {
        self.all.iter_mut().for_each(|body| body.correct_section_forces(correction));
    }

    /// Adds `factor · M · rates` of all bodies to `out`, one entry for each unknown.
    pub fn add_inertia(&mut self, factor: f64, rates: &[f64], out: &mut [f64]) {
        for body in &mut self.all {
            body.meet_inertia(factor, rates);
            body.hand_on(out);
        }
    }

    /// Lets all bodies accept the movements that were gathered last.
    pub fn advance(&mut self, rotations: RotationIncrement) {
        for tracker in &mut self.trackers {
            tracker.advance(self.all[tracker.place.body].moved(), rotations);
        }
        self.all.iter_mut().for_each(|body| body.advance(rotations));
    }
}
