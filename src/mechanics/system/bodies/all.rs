//! All bodies of a model, and what is watched on them.

use std::ops::{Deref, DerefMut};

use super::halves::BodyHalves;
use super::{Body, DegreesOfFreedom, Momenta, Tracker};
use crate::beams::{BodyPoint, Mesh, Movement};
use crate::geometry::{Vec2, larger};

/// A function that is smaller than this at a place is zero there.
const NO_WEIGHT: f64 = 1e-12;

/// The bodies of a model: beams, then particles, then rigid bodies, and what is watched on them; it derefs to the slice of them.
pub struct Bodies {
    pub(super) all: Vec<Body>,
    /// Of the beams.
    meshes: Vec<Mesh>,
    /// Sections whose angle is followed: starts and ends of all beams, then the stations of the scene, then rigid bodies.
    pub(super) trackers: Vec<Tracker>,
    /// Pairs of places that joints hold together.
    joined: Vec<(BodyPoint, BodyPoint)>,
    /// That of the beams alone [mass].
    mass: f64,
    /// How many threads may work at once.
    pub(super) threads: usize,
    /// Where there are many bodies.
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
    /// Bodies with the meshes of the beams among them, the sections that are followed, the places that joints hold together, and the
    /// mass of the beams [mass].
    pub fn new(
        all: Vec<Body>,
        meshes: Vec<Mesh>,
        trackers: Vec<Tracker>,
        joined: Vec<(BodyPoint, BodyPoint)>,
        mass: f64,
    ) -> Self {
        Self { all, meshes, trackers, joined, mass, threads: 1, halves: None }
    }

    /// Gives the movements of all bodies other numbers, of which so many are unknown, and tells which places joints hold together.
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

    /// The meshes of the beams, with breaks where joints are.
    pub fn meshes(&self) -> &[Mesh] {
        &self.meshes
    }

    /// The mass of the beams, without what stands on them [mass].
    pub fn mass(&self) -> f64 {
        self.mass
    }

    /// The number of sections whose angle is followed.
    pub fn followed_sections(&self) -> usize {
        self.trackers.len()
    }

    /// The unwrapped angle of a section that is followed, by its number [rad].
    pub fn angle(&self, section: usize) -> Option<f64> {
        self.trackers.get(section).map(|tracker| tracker.angle)
    }

    /// The point where a place is at the start of the step [length].
    pub fn position(&self, place: &BodyPoint) -> Vec2 {
        place.interpolate(self[place.body].dynamics.control_points())
    }

    /// The speed of the fastest control point [length/time].
    pub fn fastest_speed(&self, rates: &[f64]) -> f64 {
        let speeds = self.iter().flat_map(|body| {
            (0..body.degrees_of_freedom.len()).map(|point| body.vector_at(point, rates).norm())
        });
        speeds.fold(0.0, larger)
    }

    /// The largest distance between places that joints hold together [length].
    pub fn largest_gap(&self) -> f64 {
        let gap = |(a, b): &(BodyPoint, BodyPoint)| (self.position(a) - self.position(b)).norm();
        self.joined.iter().map(gap).fold(0.0, larger)
    }

    /// Momenta and twice the kinetic energy of all bodies, from the rates of the unknowns.
    pub fn momenta(&mut self, rates: &[f64]) -> Momenta {
        let mut sum = Momenta::default();
        self.all.iter_mut().for_each(|body| sum += body.momenta(rates));
        sum
    }

    /// The strain energy of all bodies [energy].
    pub fn strain_energy(&self) -> f64 {
        self.iter().map(|body| body.dynamics.strain_energy()).sum()
    }

    /// Gives every body its part of the increments of the unknowns.
    pub fn gather(&mut self, increments: &[f64]) {
        for body in &mut self.all {
            body.gather(increments);
        }
    }

    /// The values of unknowns at the control points of every body; supported movements are zero.
    pub fn by_control_point(&self, values: &[f64]) -> Vec<Vec<Movement>> {
        self.iter().map(|body| body.by_control_point(values).collect()).collect()
    }

    /// Gives every movement of every control point a number of its own, as if nothing were joined; the numbers that they had.
    pub fn number_apart(&mut self) -> Vec<DegreesOfFreedom> {
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

    /// Gives the movements of all control points other numbers; the numbers that they had.
    pub fn number_as(&mut self, numbers: Vec<DegreesOfFreedom>) -> Vec<DegreesOfFreedom> {
        let bodies = self.all.iter_mut().zip(numbers);
        bodies.map(|(body, own)| std::mem::replace(&mut body.degrees_of_freedom, own)).collect()
    }

    /// Exchanges the numbers of the movements of all control points for others.
    pub fn exchange_numbers(&mut self, numbers: &mut [DegreesOfFreedom]) {
        let bodies = self.all.iter_mut().zip(numbers);
        bodies.for_each(|(body, own)| std::mem::swap(&mut body.degrees_of_freedom, own));
    }

    /// The nodes that joints hold together at a place, as indices of bodies and control points; none where the place is no node.
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

    /// Appends the state of all bodies at the start of a step.
    pub fn save(&self, state: &mut Vec<f64>) {
        self.iter().for_each(|body| body.dynamics.save(state));
        self.trackers.iter().for_each(|tracker| tracker.save(state));
    }

    /// Takes the state of all bodies back, in the order in which it was appended.
    pub fn restore(&mut self, next: &mut dyn FnMut() -> f64) {
        self.all.iter_mut().for_each(|body| body.dynamics.restore(next));
        self.trackers.iter_mut().for_each(|tracker| tracker.restore(next));
    }
}

/// The body and the control point of a place, if it is where a control point is.
fn node_of(place: &BodyPoint) -> Option<(usize, usize)> {
    let point = place.nearest_control_point();
    let is_node = place.weights().all(|(at, weight)| at == point || weight.abs() < NO_WEIGHT);
    is_node.then_some((place.body, point))
}
