//! All rigid links and inclined rollers of a model.

use super::rigid_link::{ArmRule, ForceUnknowns};
use super::{InclinedRoller, RigidLink};
use crate::beams::{ForceSummary, SpanStiffness};
use crate::geometry::{Vec2, larger};
use crate::linalg::BandedMatrix;
use crate::system::bodies::Bodies;

/// Rigid links (in the order of bodies and points) and inclined rollers (in the order of joints) of a model.
pub struct Links {
    rigid: Vec<RigidLink>,
    rollers: Vec<InclinedRoller>,
    force_unknowns: ForceUnknowns,
}

impl Links {
    pub fn new(rigid: Vec<RigidLink>, rollers: Vec<InclinedRoller>) -> Self {
        Self { rigid, rollers, force_unknowns: ForceUnknowns::AtRest }
    }

    pub fn renumber(
        &mut self,
        rigid: impl Iterator<Item = [usize; 2]>,
        rollers: impl Iterator<Item = Option<usize>>,
    ) {
        self.rigid.iter_mut().zip(rigid).for_each(|(link, own)| link.unknowns = own);
        self.rollers.iter_mut().zip(rollers).for_each(|(roller, own)| roller.unknown = own);
    }

    pub fn exchange_unknowns(&mut self, rigid: &mut [[usize; 2]], rollers: &mut [Option<usize>]) {
        let links = self.rigid.iter_mut().zip(rigid);
        links.for_each(|(link, own)| std::mem::swap(&mut link.unknowns, own));
        let all = self.rollers.iter_mut().zip(rollers);
        all.for_each(|(roller, own)| std::mem::swap(&mut roller.unknown, own));
    }

    pub fn all_rollers(&self) -> &[InclinedRoller] {
        &self.rollers
    }

    pub fn count(&self) -> usize {
        self.rigid.len()
    }

    pub fn iter(&self) -> impl Iterator<Item = &RigidLink> {
        self.rigid.iter()
    }

    /// Largest distance between the two points of a rigid link [length]; zero without links.
    pub fn largest_arm(&self) -> f64 {
        self.rigid.iter().map(|link| link.arm().norm()).fold(0.0, larger)
    }

    pub fn rollers(&self) -> impl Iterator<Item = (usize, &InclinedRoller)> {
        self.rollers.iter().filter_map(|roller| Some((roller.unknown?, roller)))
    }

    pub fn forces(&self) -> usize {
        2 * self.rigid.len() + self.rollers().count()
    }

    pub fn force_of_rollers(
        &self,
        nodes: &[(usize, usize)],
        force: impl Fn(usize) -> Vec2,
    ) -> Option<Vec2> {
        let all = self.rollers.iter().enumerate();
        let there = all.filter(|(_, at)| at.unknown.is_some() && nodes.contains(&at.node));
        there.map(|(index, _)| force(index)).reduce(|sum, force| sum + force)
    }

    pub fn begin_step(&mut self, duration: f64) {
        self.force_unknowns = ForceUnknowns::Step(duration);
    }

    pub fn begin_movement(&mut self) {
        self.force_unknowns = ForceUnknowns::AtRest;
    }

    pub fn add(
        &mut self,
        bodies: &Bodies,
        arms: ArmRule,
        values: &[f64],
        out: &mut [f64],
        summary: &mut ForceSummary,
    ) {
        for link in &mut self.rigid {
            summary.join(&link.add(bodies, self.force_unknowns, arms, values, out));
        }
        for roller in &mut self.rollers {
            summary.join(&roller.add(bodies, self.force_unknowns, values, out));
        }
    }

    pub fn add_tangent(
        &self,
        bodies: &Bodies,
        arms: ArmRule,
        values: &[f64],
        unknowns: usize,
        tangent: &mut BandedMatrix,
    ) {
        for link in &self.rigid {
            link.add_tangent(bodies, self.force_unknowns, arms, values, unknowns, tangent);
        }
        for roller in &self.rollers {
            roller.add_tangent(bodies, self.force_unknowns, unknowns, tangent);
        }
    }

    pub fn add_coupling(&self, bodies: &Bodies, unknowns: usize, matrix: &mut BandedMatrix) {
        self.rigid.iter().for_each(|link| link.add_coupling(bodies, unknowns, matrix));
        self.rollers.iter().for_each(|roller| roller.add_coupling(bodies, unknowns, matrix));
    }

    pub fn set_acceleration_bias(
        &self,
        bodies: &Bodies,
        rates: &[f64],
        prescribed: &[f64],
        out: &mut [f64],
    ) {
        for link in &self.rigid {
            let bias =
                link.centripetal(bodies, rates) - link.velocity_violation(bodies, prescribed);
            [out[link.unknowns[0]], out[link.unknowns[1]]] = [bias.x, bias.y];
        }
        self.rollers().for_each(|(unknown, _)| out[unknown] = 0.0);
    }

    pub fn set_velocity_violation(
        &self,
        bodies: &Bodies,
        rates: &[f64],
        factor: f64,
        out: &mut [f64],
    ) {
        for link in &self.rigid {
            let violation = link.velocity_violation(bodies, rates) * factor;
            [out[link.unknowns[0]], out[link.unknowns[1]]] = [violation.x, violation.y];
        }
        for (unknown, roller) in self.rollers() {
            out[unknown] = roller.velocity_violation(bodies, rates) * factor;
        }
    }

    pub fn transmit(&self, bodies: &Bodies, unknowns: &[f64], out: &mut [f64]) {
        for link in &self.rigid {
            let force = Vec2::new(unknowns[link.unknowns[0]], unknowns[link.unknowns[1]]);
            link.transmit(bodies, force, link.arm(), out);
        }
        self.rollers().for_each(|(at, roller)| roller.transmit(bodies, unknowns[at], out));
    }

    pub fn clear(&self, unknowns: &mut [f64]) {
        self.rigid.iter().flat_map(|link| link.unknowns).for_each(|at| unknowns[at] = 0.0);
        self.rollers().for_each(|(at, _)| unknowns[at] = 0.0);
    }

    pub fn write_forces(&self, rates: &mut [f64]) {
        for link in &self.rigid {
            let force = link.force();
            [rates[link.unknowns[0]], rates[link.unknowns[1]]] = [force.x, force.y];
        }
        self.rollers().for_each(|(at, roller)| rates[at] = roller.multiplier());
    }

    /// Swaps the stored forces of all rigid links with the forces in `others` [force].
    pub fn exchange_forces(&mut self, others: &mut [Vec2]) {
        self.rigid.iter_mut().zip(others).for_each(|(link, other)| link.exchange_force(other));
    }

    /// Largest constraint violation in a residual [-].
    /// The violation of a link is divided by the sum of the length of its arm and the largest increment of its points.
    /// The violation of a roller is divided by the sum of the size of the scene and the largest increment of its point.
    pub fn violation(&self, residual: &[f64]) -> f64 {
        let most = self.rigid.iter().fold(0.0, |most, link| larger(most, link.violation(residual)));
        self.rollers.iter().fold(most, |most, roller| larger(most, roller.violation(residual)))
    }

    /// Largest distance of a linked point from its position in the body, or of a roller from its line [length].
    pub fn largest_gap(&self, bodies: &Bodies) -> f64 {
        let most = self.rigid.iter().fold(0.0, |most, link| larger(most, link.gap(bodies)));
        self.rollers.iter().fold(most, |most, roller| larger(most, roller.gap(bodies)))
    }

    pub fn advance(&mut self, bodies: &Bodies, arms: ArmRule, values: &[f64]) {
        for link in &mut self.rigid {
            link.advance(bodies, self.force_unknowns, arms, values);
        }
        self.rollers.iter_mut().for_each(|roller| roller.advance(self.force_unknowns, values));
    }

    /// Calls `take` with the static stiffness of each link and roller.
    /// Each constraint is replaced by a spring with the penalty stiffness `stiffness` [force/length].
    pub fn for_each_static_stiffness(
        &self,
        bodies: &Bodies,
        stiffness: f64,
        take: &mut dyn FnMut(&[usize], &SpanStiffness),
    ) {
        let mut span = SpanStiffness::default();
        self.rigid.iter().for_each(|link| link.at_rest(bodies, stiffness, &mut span, take));
        self.rollers.iter().for_each(|roller| roller.at_rest(bodies, stiffness, &mut span, take));
    }

    pub fn save(&self, state: &mut Vec<f64>) {
        self.rigid.iter().for_each(|link| link.save(state));
        self.rollers.iter().for_each(|roller| roller.save(state));
    }

    pub fn restore(&mut self, next: &mut dyn FnMut() -> f64) {
        self.rigid.iter_mut().for_each(|link| link.restore(next));
        self.rollers.iter_mut().for_each(|roller| roller.restore(next));
    }
}
