//! All rigid links of a model.

use super::RigidLink;
use super::rigid_link::{ArmRule, ForceUnknowns};
use crate::beams::{ForceSummary, SpanAtRest};
use crate::geometry::{Vec2, larger};
use crate::linalg::BandedMatrix;
use crate::model::bodies::Bodies;

/// The rigid links of a model, in the order of its rigid bodies and their points.
pub struct RigidLinks {
    all: Vec<RigidLink>,
    acting: ForceUnknowns,
}

impl RigidLinks {
    /// The rigid links of a model.
    pub fn new(all: Vec<RigidLink>) -> Self {
        Self { all, acting: ForceUnknowns::AtRest }
    }

    /// Gives the forces of all rigid links other unknowns, in their order.
    pub fn renumber(&mut self, unknowns: impl Iterator<Item = [usize; 2]>) {
        self.all.iter_mut().zip(unknowns).for_each(|(link, own)| link.unknowns = own);
    }

    /// Exchanges the unknowns of the forces of all rigid links for others, in their order.
    pub fn exchange_unknowns(&mut self, unknowns: &mut [[usize; 2]]) {
        let links = self.all.iter_mut().zip(unknowns);
        links.for_each(|(link, own)| std::mem::swap(&mut link.unknowns, own));
    }

    /// The number of rigid links.
    pub fn count(&self) -> usize {
        self.all.len()
    }

    /// The rigid links, in the order of rigid bodies and points.
    pub fn iter(&self) -> impl Iterator<Item = &RigidLink> {
        self.all.iter()
    }

    /// Prepares a step of some duration [time].
    pub fn begin_step(&mut self, duration: f64) {
        self.acting = ForceUnknowns::Step(duration);
    }

    /// Prepares a movement between two places at rest.
    pub fn begin_movement(&mut self) {
        self.acting = ForceUnknowns::AtRest;
    }

    /// Adds the forces of all rigid links in an iterate, and by how much points are off their places; the largest that was met.
    pub fn add(
        &mut self,
        bodies: &Bodies,
        arms: ArmRule,
        values: &[f64],
        out: &mut [f64],
        summary: &mut ForceSummary,
    ) {
        for link in &mut self.all {
            summary.join(&link.add(bodies, self.acting, arms, values, out));
        }
    }

    /// Adds the derivatives of what [`add`](Self::add) adds; there are so many unknowns.
    pub fn add_tangent(
        &self,
        bodies: &Bodies,
        arms: ArmRule,
        values: &[f64],
        unknowns: usize,
        tangent: &mut BandedMatrix,
    ) {
        for link in &self.all {
            link.add_tangent(bodies, self.acting, arms, values, unknowns, tangent);
        }
    }

    /// Couples the forces of all rigid links with movements as at the start of a step; there are so many unknowns.
    pub fn add_coupling(&self, bodies: &Bodies, unknowns: usize, matrix: &mut BandedMatrix) {
        self.all.iter().for_each(|link| link.add_coupling(bodies, unknowns, matrix));
    }

    /// Puts the centripetal accelerations of points, and what prescribed accelerations add to them, where the equations of the rigid links stand.
    pub fn set_acceleration_bias(
        &self,
        bodies: &Bodies,
        rates: &[f64],
        prescribed: &[f64],
        out: &mut [f64],
    ) {
        for link in &self.all {
            let bias =
                link.centripetal(bodies, rates) - link.velocity_violation(bodies, prescribed);
            [out[link.unknowns[0]], out[link.unknowns[1]]] = [bias.x, bias.y];
        }
    }

    /// Puts a multiple of the velocities of points relative to their places in bodies where the equations of the rigid links stand.
    pub fn set_velocity_violation(
        &self,
        bodies: &Bodies,
        rates: &[f64],
        factor: f64,
        out: &mut [f64],
    ) {
        for link in &self.all {
            let violation = link.velocity_violation(bodies, rates) * factor;
            [out[link.unknowns[0]], out[link.unknowns[1]]] = [violation.x, violation.y];
        }
    }

    /// Adds the forces among the unknowns to those on bodies, with the arms at the start of a step.
    pub fn transmit(&self, bodies: &Bodies, unknowns: &[f64], out: &mut [f64]) {
        for link in &self.all {
            let force = Vec2::new(unknowns[link.unknowns[0]], unknowns[link.unknowns[1]]);
            link.transmit(bodies, force, link.arm(), out);
        }
    }

    /// Makes the forces among the unknowns zero.
    pub fn clear(&self, unknowns: &mut [f64]) {
        self.all.iter().flat_map(|link| link.unknowns).for_each(|at| unknowns[at] = 0.0);
    }

    /// Puts the forces where their unknowns stand: their rates, from which the next step is guessed.
    pub fn write_forces(&self, rates: &mut [f64]) {
        for link in &self.all {
            let force = link.force();
            [rates[link.unknowns[0]], rates[link.unknowns[1]]] = [force.x, force.y];
        }
    }

    /// Exchanges the forces of all rigid links for others, in their order [force].
    pub fn exchange_forces(&mut self, others: &mut [Vec2]) {
        self.all.iter_mut().zip(others).for_each(|(link, other)| link.exchange_force(other));
    }

    /// The largest distance of a point from its place by a residual, relative to its movements and its arm [-].
    pub fn violation(&self, residual: &[f64]) -> f64 {
        self.all.iter().fold(0.0, |most, link| larger(most, link.violation(residual)))
    }

    /// The largest distance of a point from its place [length].
    pub fn largest_gap(&self, bodies: &Bodies) -> f64 {
        self.all.iter().fold(0.0, |most, link| larger(most, link.gap(bodies)))
    }

    /// Lets all rigid links accept the unknowns of a step or a movement.
    pub fn advance(&mut self, bodies: &Bodies, arms: ArmRule, values: &[f64]) {
        for link in &mut self.all {
            link.advance(bodies, self.acting, arms, values);
        }
    }

    /// Gives how all rigid links resist small movements, were they as stiff as that [force/length].
    pub fn each_at_rest(
        &self,
        bodies: &Bodies,
        stiffness: f64,
        take: &mut dyn FnMut(&[usize], &SpanAtRest),
    ) {
        let mut span = SpanAtRest::default();
        self.all.iter().for_each(|link| link.at_rest(bodies, stiffness, &mut span, take));
    }

    /// Appends the state of all rigid links at the start of a step.
    pub fn save(&self, state: &mut Vec<f64>) {
        self.all.iter().for_each(|link| link.save(state));
    }

    /// Takes the state of all rigid links back, in the order in which it was appended.
    pub fn restore(&mut self, next: &mut dyn FnMut() -> f64) {
        self.all.iter_mut().for_each(|link| link.restore(next));
    }
}
