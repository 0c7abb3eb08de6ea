//! All levers of a model.

use super::Lever;
use super::lever::{Acting, Leverage};
use crate::beams::{ForceSummary, SpanAtRest};
use crate::geometry::{Vec2, larger};
use crate::linalg::BandedMatrix;
use crate::model::bodies::Bodies;

/// The levers of a model, in the order of its rigid bodies and their points.
pub struct Levers {
    all: Vec<Lever>,
    acting: Acting,
}

impl Levers {
    /// The levers of a model.
    pub fn new(all: Vec<Lever>) -> Self {
        Self { all, acting: Acting::AtRest }
    }

    /// Gives the forces of all levers other unknowns, in their order.
    pub fn renumber(&mut self, unknowns: impl Iterator<Item = [usize; 2]>) {
        self.all.iter_mut().zip(unknowns).for_each(|(lever, own)| lever.unknowns = own);
    }

    /// The number of levers.
    pub fn count(&self) -> usize {
        self.all.len()
    }

    /// The levers, in the order of rigid bodies and points.
    pub fn iter(&self) -> impl Iterator<Item = &Lever> {
        self.all.iter()
    }

    /// Prepares a step of some duration [time].
    pub fn begin_step(&mut self, duration: f64) {
        self.acting = Acting::Step(duration);
    }

    /// Prepares a movement between two places at rest.
    pub fn begin_movement(&mut self) {
        self.acting = Acting::AtRest;
    }

    /// Adds the forces of all levers in an iterate, and by how much points are off their places; the largest that was met.
    pub fn add(
        &mut self,
        bodies: &Bodies,
        leverage: Leverage,
        values: &[f64],
        out: &mut [f64],
        summary: &mut ForceSummary,
    ) {
        for lever in &mut self.all {
            summary.join(&lever.add(bodies, self.acting, leverage, values, out));
        }
    }

    /// Adds the derivatives of what [`add`](Self::add) adds; there are so many unknowns.
    pub fn add_tangent(
        &self,
        bodies: &Bodies,
        leverage: Leverage,
        values: &[f64],
        unknowns: usize,
        tangent: &mut BandedMatrix,
    ) {
        for lever in &self.all {
            lever.add_tangent(bodies, self.acting, leverage, values, unknowns, tangent);
        }
    }

    /// Couples the forces of all levers with movements as at the start of a step; there are so many unknowns.
    pub fn add_coupling(&self, bodies: &Bodies, unknowns: usize, matrix: &mut BandedMatrix) {
        self.all.iter().for_each(|lever| lever.add_coupling(bodies, unknowns, matrix));
    }

    /// Puts the accelerations by which arms turn, and what given accelerations make of them, where the equations of the levers stand.
    pub fn set_carried(&self, bodies: &Bodies, rates: &[f64], given: &[f64], out: &mut [f64]) {
        for lever in &self.all {
            let carried = lever.centripetal(bodies, rates) - lever.slip(bodies, given);
            [out[lever.unknowns[0]], out[lever.unknowns[1]]] = [carried.x, carried.y];
        }
    }

    /// Puts a multiple of the velocities of points beside their bodies where the equations of the levers stand.
    pub fn set_slip(&self, bodies: &Bodies, rates: &[f64], factor: f64, out: &mut [f64]) {
        for lever in &self.all {
            let slip = lever.slip(bodies, rates) * factor;
            [out[lever.unknowns[0]], out[lever.unknowns[1]]] = [slip.x, slip.y];
        }
    }

    /// Adds the forces among the unknowns to those on bodies, with the arms at the start of a step.
    pub fn transmit(&self, bodies: &Bodies, unknowns: &[f64], out: &mut [f64]) {
        for lever in &self.all {
            let force = Vec2::new(unknowns[lever.unknowns[0]], unknowns[lever.unknowns[1]]);
            lever.transmit(bodies, force, lever.arm(), out);
        }
    }

    /// Makes the forces among the unknowns zero.
    pub fn clear(&self, unknowns: &mut [f64]) {
        self.all.iter().flat_map(|lever| lever.unknowns).for_each(|at| unknowns[at] = 0.0);
    }

    /// Puts the forces where their unknowns stand: their rates, from which the next step is guessed.
    pub fn write_forces(&self, rates: &mut [f64]) {
        for lever in &self.all {
            let force = lever.force();
            [rates[lever.unknowns[0]], rates[lever.unknowns[1]]] = [force.x, force.y];
        }
    }

    /// The largest distance of a point from its place by a residual, relative to its movements and its arm [-].
    pub fn violation(&self, residual: &[f64]) -> f64 {
        self.all.iter().fold(0.0, |most, lever| larger(most, lever.violation(residual)))
    }

    /// The largest distance of a point from its place [length].
    pub fn largest_gap(&self, bodies: &Bodies) -> f64 {
        self.all.iter().fold(0.0, |most, lever| larger(most, lever.gap(bodies)))
    }

    /// Lets all levers accept the unknowns of a step or a movement.
    pub fn advance(&mut self, bodies: &Bodies, leverage: Leverage, values: &[f64]) {
        for lever in &mut self.all {
            lever.advance(bodies, self.acting, leverage, values);
        }
    }

    /// Gives how all levers resist small movements, were they as stiff as that [force/length].
    pub fn each_at_rest(
        &self,
        bodies: &Bodies,
        stiffness: f64,
        take: &mut dyn FnMut(&[usize], &SpanAtRest),
    ) {
        let mut span = SpanAtRest::default();
        self.all.iter().for_each(|lever| lever.at_rest(bodies, stiffness, &mut span, take));
    }

    /// Appends the state of all levers at the start of a step.
    pub fn save(&self, state: &mut Vec<f64>) {
        self.all.iter().for_each(|lever| lever.save(state));
    }

    /// Takes the state of all levers back, in the order in which it was appended.
    pub fn restore(&mut self, next: &mut dyn FnMut() -> f64) {
        self.all.iter_mut().for_each(|lever| lever.restore(next));
    }
}
