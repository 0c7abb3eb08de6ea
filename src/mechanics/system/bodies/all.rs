//! All bodies of a model, the sections whose angles are tracked, and the points at which bodies are joined.

use std::ops::{Deref, DerefMut};

use super::halves::BodyHalves;
use super::{Body, DegreesOfFreedom, Momenta, Tracker};
use crate::beams::{BodyPoint, Mesh, Movement};
use crate::geometry::{Vec2, larger};

/// Largest value of a basis function at a node that counts as zero [-].
const NO_WEIGHT: f64 = 1e-12;

/// Bodies of a model: beams, then particles, then rigid bodies. The type dereferences to a slice of bodies.
pub struct Bodies {
    pub(super) all: Vec<Body>,
    meshes: Vec<Mesh>,
    pub(super) trackers: Vec<Tracker>,
    joined: Vec<(BodyPoint, BodyPoint)>,
    /// Mass of the beams [mass].
    mass: f64,
    pub(super) threads: usize,
    /// Division of the bodies into two halves that two threads process; `None` if a division saves no time.
    pub(super) halves: Option<BodyHalves>,
}

impl Deref for Bodies {
    type Target = [Body];

    fn deref(&self) -> &[Body] {
        &self.all
    }
}

impl DerefMut for Bodies {
    fn deref_mut(&mut self) -> &mut [Body] {
        &mut self.all
    }
}

impl Bodies {
    pub fn new(
        all: Vec<Body>,
        meshes: Vec<Mesh>,
        trackers: Vec<Tracker>,
        joined: Vec<(BodyPoint, BodyPoint)>,
        mass: f64,
    ) -> Self {
        Self { all, meshes, trackers, joined, mass, threads: 1, halves: None }
    }

    pub fn renumber(
        &mut self,
        numbers: Vec<Vec<[usize; 3]>>,
        unknowns: usize,
        joined: Vec<(BodyPoint, BodyPoint)>,
    ) {
        for (body, own) in self.all.iter_mut().zip(numbers) {
            body.renumber(own, unknowns);
        }
        self.divide(self.threads);
        self.joined = joined;
    }

    pub fn meshes(&self) -> &[Mesh] {
        &self.meshes
    }

    /// Mass of the beams, without attached masses [mass].
    pub fn mass(&self) -> f64 {
        self.mass
    }

    pub fn tracked_sections(&self) -> usize {
        self.trackers.len()
    }

    /// Angle of a tracked section, counted over full turns [rad].
    pub fn angle(&self, section: usize) -> Option<f64> {
        self.trackers.get(section).map(|tracker| tracker.angle)
    }

    /// Position of a point of a body at the start of the step [length].
    pub fn position(&self, place: &BodyPoint) -> Vec2 {
        place.interpolate(self[place.body].dynamics.control_points())
    }

    pub fn fastest_speed(&self, rates: &[f64]) -> f64 {
        let speeds = self.iter().flat_map(|body| {
            (0..body.degrees_of_freedom.len()).map(|point| body.vector_at(point, rates).norm())
        });
        speeds.fold(0.0, larger)
    }

    /// Largest gap between two points that a joint connects [length].
    pub fn largest_gap(&self) -> f64 {
        let gap = |(a, b): &(BodyPoint, BodyPoint)| (self.position(a) - self.position(b)).norm();
        self.joined.iter().map(gap).fold(0.0, larger)
    }

    pub fn momenta(&mut self, rates: &[f64]) -> Momenta {
        let mut sum = Momenta::default();
        self.all.iter_mut().for_each(|body| sum += body.momenta(rates));
        sum
    }

    pub fn strain_energy(&self) -> f64 {
        self.iter().map(|body| body.dynamics.strain_energy()).sum()
    }

    pub fn gather(&mut self, increments: &[f64]) {
        for body in &mut self.all {
            body.gather(increments);
        }
    }

    pub fn by_control_point(&self, values: &[f64]) -> Vec<Vec<Movement>> {
        let mut all = Vec::new();
        self.write_by_control_point(values, &mut all);
        all
    }

    pub fn write_by_control_point(&self, values: &[f64], all: &mut Vec<Vec<Movement>>) {
        all.resize_with(self.len(), Vec::new);
        for (body, own) in self.iter().zip(all) {
            own.clear();
            own.extend(body.by_control_point(values));
        }
    }

    pub fn number_separately(&mut self) -> Vec<DegreesOfFreedom> {
        let mut next = 0;
        let own = self.iter().map(|body| {
            let points = body.degrees_of_freedom.iter().map(|_| {
                next += 3;
                [next - 3, next - 2, next - 1]
            });
            points.collect::<Vec<_>>().into()
        });
        let own = own.collect::<Vec<_>>();
        self.number_as(own)
    }

    pub fn number_as(&mut self, numbers: Vec<DegreesOfFreedom>) -> Vec<DegreesOfFreedom> {
        let bodies = self.all.iter_mut().zip(numbers);
        bodies.map(|(body, own)| std::mem::replace(&mut body.degrees_of_freedom, own)).collect()
    }

    pub fn exchange_numbers(&mut self, numbers: &mut [DegreesOfFreedom]) {
        let bodies = self.all.iter_mut().zip(numbers);
        bodies.for_each(|(body, own)| std::mem::swap(&mut body.degrees_of_freedom, own));
    }

    pub fn tied_nodes(&self, place: &BodyPoint) -> Option<Vec<(usize, usize)>> {
        let mut nodes = vec![node_of(place)?];
        let mut next = 0;
        while let Some(&at) = nodes.get(next) {
            next += 1;
            for (one, other) in &self.joined {
                for (here, there) in [(one, other), (other, one)] {
                    let there = node_of(there).filter(|there| !nodes.contains(there));
                    if node_of(here) == Some(at) {
                        nodes.extend(there);
                    }
                }
            }
        }
        Some(nodes)
    }

    pub fn save(&self, state: &mut Vec<f64>) {
        self.iter().for_each(|body| body.dynamics.save(state));
        self.trackers.iter().for_each(|tracker| tracker.save(state));
    }

    pub fn restore(&mut self, next: &mut dyn FnMut() -> f64) {
        self.all.iter_mut().for_each(|body| body.dynamics.restore(next));
        self.trackers.iter_mut().for_each(|tracker| tracker.restore(next));
    }
}

fn node_of(place: &BodyPoint) -> Option<(usize, usize)> {
    let point = place.nearest_control_point();
    let is_node = place.weights().all(|(at, weight)| at == point || weight.abs() < NO_WEIGHT);
    is_node.then_some((place.body, point))
}
