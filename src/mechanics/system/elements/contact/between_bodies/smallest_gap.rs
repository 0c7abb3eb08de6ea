//! Smallest gap between the bodies of an element.

use super::forces::CandidatePair;
use super::pair::PairIndex;
use super::shape::{Bounds, Configuration, NearestSearch, Shape};
use crate::elementary::square;
use crate::system::bodies::Body;

/// Relative accuracy of the smallest gap of bodies that are not in contact. Contact points that would reduce the gap by less are not evaluated.
const ACCURACY: f64 = 1e-3;

pub(super) struct GapSearch<'s> {
    shapes: &'s [Shape],
    configurations: Vec<Configuration>,
    /// Smallest gap found so far [length].
    gap: f64,
}

impl<'s> GapSearch<'s> {
    pub(super) fn new(shapes: &'s [Shape], bodies: &[Body]) -> Self {
        let place =
            |shape: &Shape| shape.configuration(bodies[shape.body].dynamics.control_points());
        let configurations: Vec<_> = shapes.iter().map(place).collect();
        let all = configurations.iter().map(Configuration::bounds).reduce(Bounds::joined);
        Self { shapes, configurations, gap: all.map_or(0.0, |all| all.diagonal()) }
    }

    /// Smallest gap of the candidate pairs and of the closed contacts, whose gaps are given by `closed` [length].
    /// The result is at most the diagonal of the box around all bodies.
    pub(super) fn smallest(
        mut self,
        candidates: &[CandidatePair],
        closed: impl Iterator<Item = f64>,
    ) -> f64 {
        self.gap = closed.fold(self.gap, f64::min);
        let each_once = candidates.iter().filter(|one| one.shape < one.target);
        each_once.for_each(|candidate| self.add_vertices(candidate));
        for candidate in candidates {
            if !self.is_near(candidate) {
                continue;
            }
            for site in 0..self.shapes[candidate.shape].sites.len() {
                self.add_site(candidate.at(site));
            }
        }
        self.gap
    }

    fn reach(&self, &CandidatePair { shape, target, .. }: &CandidatePair) -> f64 {
        self.shapes[shape].radius + self.shapes[target].radius
    }

    /// Largest distance between two axes at which the gap between their bodies is smaller than the smallest gap found so far [length].
    /// `reach` is the sum of the radii of the bodies [length].
    fn limit(&self, reach: f64) -> f64 {
        (1.0 - ACCURACY) * self.gap.max(0.0) + reach
    }

    fn is_near(&self, candidate: &CandidatePair) -> bool {
        let [own, other] =
            [candidate.shape, candidate.target].map(|at| self.configurations[at].bounds());
        let limit = self.limit(self.reach(candidate));
        self.gap > 0.0 && own.squared_distance(&other) < square(limit)
    }

    /// Updates the smallest gap found so far with the gaps between the span ends of two bodies.
    /// A small initial gap excludes most contact points from the search for smaller gaps.
    fn add_vertices(&mut self, candidate: &CandidatePair) {
        let CandidatePair { shape, target, .. } = *candidate;
        if !self.is_near(candidate) {
            return;
        }
        let vertices = |at: usize| self.shapes[at].vertices(&self.configurations[at]);
        let mut squared = f64::INFINITY;
        for own in vertices(shape) {
            vertices(target).for_each(|other| squared = squared.min((own - other).norm_squared()));
        }
        self.gap = self.gap.min((squared.sqrt() - self.reach(candidate)).max(0.0));
    }

    fn add_site(&mut self, index: PairIndex) {
        let reach = index.reach(self.shapes);
        let limit = self.limit(reach);
        let place = index.place(self.shapes);
        let position = place.interpolate(&self.configurations[index.shape].points);
        let at = &self.configurations[index.target];
        if self.gap <= 0.0 || at.is_beyond(position, limit) {
            return;
        }
        let search =
            NearestSearch { position, allowed: index.allowed(self.shapes), limit, hint: 0 };
        if let Some(foot) = self.shapes[index.target].nearest(at, &search) {
            let apart = position - foot.combine(0, &at.points);
            self.gap = (apart.norm() - reach).max(0.0);
        }
    }
}
