//! Sums over all bodies in a step, computed sequentially or in two concurrent halves.

use super::halves::BodyHalves;
use super::{Bodies, Body};
use crate::beams::{Collocation, ForceSummary, RotationIncrement};
use crate::linalg::{BandRows, BandedMatrix};
use crate::threads::run_concurrently;

impl Bodies {
    /// Sets the number of threads for a large body or many bodies, and returns the largest number of threads in use.
    pub fn divide(&mut self, threads: usize) -> usize {
        self.threads = threads;
        let parts = self.all.iter_mut().map(|body| body.divide(threads)).max().unwrap_or(1);
        self.halves = BodyHalves::worthwhile(&self.all, threads);
        if self.halves.is_some() { parts.max(2) } else { parts }
    }

    pub fn threads(&self) -> usize {
        self.threads
    }

    fn each(&mut self, work: impl Fn(&mut Body) + Sync) {
        match &self.halves {
            None => self.all.iter_mut().for_each(work),
            Some(halves) => {
                let (first, second) = self.all.split_at_mut(halves.body);
                run_concurrently([first, second], |bodies| bodies.iter_mut().for_each(&work));
            }
        }
    }

    pub fn begin_step(&mut self) {
        self.each(|body| body.dynamics.begin_step());
    }

    /// Adds the internal forces of all bodies to `out`.
    /// Returns the largest force, moment, rotation and strain residual of all bodies.
    pub fn add_forces(
        &mut self,
        at: Collocation,
        increments: &[f64],
        weight: f64,
        out: &mut [f64],
    ) -> ForceSummary {
        self.each(|body| body.add_section_forces(at, increments, weight));
        self.scatter(out)
    }

    fn scatter(&mut self, out: &mut [f64]) -> ForceSummary {
        let mut summary = ForceSummary::default();
        for body in &mut self.all {
            summary.join(&body.scatter(out));
        }
        summary
    }

    pub fn add_linearised_forces(
        &mut self,
        at: Collocation,
        increments: &[f64],
        weight: f64,
        out: &mut [f64],
        tangent: &mut BandedMatrix,
    ) {
        self.linearise(at, increments, weight, tangent);
        self.scatter(out);
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
        run_concurrently([(first, before), (second, behind)], |(bodies, mut rows)| {
            bodies.iter_mut().for_each(|body| work(body, rows.reborrow()));
        });
        for &at in &halves.astride {
            let (before, _) = tangent.rows_mut().split_at(halves.row);
            self.all[at].clear_forces();
            work(&mut self.all[at], before);
        }
    }

    pub fn add_inertia_tangent(&self, factor: f64, tangent: &mut BandedMatrix) {
        let Some(halves) = &self.halves else {
            return self
                .all
                .iter()
                .for_each(|body| body.add_inertia_tangent(factor, tangent.rows_mut()));
        };
        let (first, second) = self.all.split_at(halves.body);
        let (before, behind) = tangent.rows_mut().split_at(halves.row);
        run_concurrently([(first, before), (second, behind)], |(bodies, mut rows)| {
            bodies.iter().for_each(|body| body.add_inertia_tangent(factor, rows.reborrow()));
        });
        for &at in &halves.astride {
            let (before, _) = tangent.rows_mut().split_at(halves.row);
            self.all[at].add_inertia_tangent(factor, before);
        }
    }

    pub fn add_mismatch_forces(&mut self, weight: f64, out: &mut [f64]) {
        self.each(|body| body.add_mismatch_forces(weight));
        self.scatter(out);
    }

    pub fn correct_section_forces(&mut self, correction: &[f64]) {
        self.each(|body| body.correct_section_forces(correction));
    }

    pub fn add_inertia(&mut self, factor: f64, rates: &[f64], out: &mut [f64]) {
        self.each(|body| body.add_inertia_forces(factor, rates));
        self.scatter(out);
    }

    pub fn advance(&mut self, rotations: RotationIncrement) {
        for tracker in &mut self.trackers {
            tracker.advance(self.all[tracker.place.body].moved(), rotations);
        }
        self.each(|body| body.advance(rotations));
    }
}
