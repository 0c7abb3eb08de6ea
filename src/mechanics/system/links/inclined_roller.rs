//! Inclined roller in a step: a point on a straight line, with a constraint force across the line (docs/theory.md, section 9.5).
//!
//! The constraint force of the roller does no work in any increment that satisfies the constraint.
//! The impulse of the roller acts at the mean position of its point, like impulses of other supports.

use super::rigid_link::ForceUnknowns;
use crate::beams::{ForceSummary, SpanStiffness};
use crate::geometry::{Vec2, larger};
use crate::linalg::BandedMatrix;
use crate::system::bodies::Bodies;

#[derive(Debug, Clone)]
pub struct InclinedRoller {
    pub joint: usize,
    /// Body and control point of the constrained point.
    pub node: (usize, usize),
    /// Force unknown of the roller; `None` after a release.
    pub unknown: Option<usize>,
    normal: Vec2,
    origin: Vec2,
    size: f64,
    movement: f64,
    force: f64,
}

impl InclinedRoller {
    /// Creates a roller at a control point on its line. `size` is the size of the scene [length].
    pub fn new(
        joint: usize,
        node: (usize, usize),
        unknown: Option<usize>,
        normal: Vec2,
        origin: Vec2,
        size: f64,
    ) -> Self {
        Self { joint, node, unknown, normal, origin, size, movement: 0.0, force: 0.0 }
    }

    pub fn degrees(&self, bodies: &Bodies) -> [usize; 2] {
        let (body, point) = self.node;
        let [x, y, _] = bodies[body].degrees_of_freedom[point];
        [x, y]
    }

    /// Force of the roller on its point for a value of the constraint multiplier [force].
    pub fn force_of(&self, unknown: f64) -> Vec2 {
        self.normal * -unknown
    }

    /// Force of the roller on its point in the last step or static solution [force]; zero after a release.
    pub fn force(&self) -> Vec2 {
        self.force_of(if self.unknown.is_some() { self.force } else { 0.0 })
    }

    /// Multiplier of the constraint in the last step or static solution [force].
    pub fn multiplier(&self) -> f64 {
        self.force
    }

    fn values_at(&self, bodies: &Bodies, values: &[f64]) -> Vec2 {
        let [x, y] = self.degrees(bodies).map(|at| values.get(at).copied().unwrap_or(0.0));
        Vec2::new(x, y)
    }

    pub fn add(
        &mut self,
        bodies: &Bodies,
        acting: ForceUnknowns,
        values: &[f64],
        out: &mut [f64],
    ) -> ForceSummary {
        let Some(unknown) = self.unknown else { return ForceSummary::default() };
        let force = acting.force(self.force, values[unknown]);
        self.transmit(bodies, force, out);
        let moved = self.values_at(bodies, values);
        out[unknown] += self.normal.dot(&moved);
        self.movement = larger(moved.x.abs(), moved.y.abs());
        ForceSummary { force: force.abs(), ..ForceSummary::default() }
    }

    pub fn add_tangent(
        &self,
        bodies: &Bodies,
        acting: ForceUnknowns,
        movements: usize,
        tangent: &mut BandedMatrix,
    ) {
        self.couple(bodies, acting.force_derivative(), movements, tangent);
    }

    pub fn add_coupling(&self, bodies: &Bodies, movements: usize, matrix: &mut BandedMatrix) {
        self.couple(bodies, 1.0, movements, matrix);
    }

    fn couple(&self, bodies: &Bodies, share: f64, movements: usize, matrix: &mut BandedMatrix) {
        let Some(unknown) = self.unknown else { return };
        for (at, across) in self.degrees(bodies).into_iter().zip([self.normal.x, self.normal.y]) {
            if at < movements {
                matrix.add(at, unknown, share * across);
                matrix.add(unknown, at, across);
            }
        }
    }

    pub fn transmit(&self, bodies: &Bodies, force: f64, out: &mut [f64]) {
        let [x, y] = self.degrees(bodies);
        out[x] += force * self.normal.x;
        out[y] += force * self.normal.y;
    }

    pub fn violation(&self, residual: &[f64]) -> f64 {
        let off = self.unknown.map_or(0.0, |at| residual[at].abs());
        if off == 0.0 { 0.0 } else { off / (self.size + self.movement) }
    }

    pub fn gap(&self, bodies: &Bodies) -> f64 {
        match self.unknown {
            Some(_) => self.normal.dot(&(self.place(bodies) - self.origin)).abs(),
            None => 0.0,
        }
    }

    /// Position of the point of the roller at the start of a step [length].
    pub fn place(&self, bodies: &Bodies) -> Vec2 {
        let (body, point) = self.node;
        bodies[body].dynamics.control_points()[point]
    }

    /// Mean of the positions of the point at the start and the end of the present step [length].
    /// The increments of the step are taken from `bodies`.
    pub fn mean_place(&self, bodies: &Bodies) -> Vec2 {
        let (body, point) = self.node;
        let [x, y, _] = bodies[body].moved()[point];
        self.place(bodies) + 0.5 * Vec2::new(x, y)
    }

    /// Velocity of the point of the roller across its line [length/time].
    pub fn velocity_violation(&self, bodies: &Bodies, rates: &[f64]) -> f64 {
        self.normal.dot(&self.values_at(bodies, rates))
    }

    pub fn advance(&mut self, acting: ForceUnknowns, values: &[f64]) {
        if let Some(unknown) = self.unknown {
            self.force = acting.force(self.force, values[unknown]);
        }
    }

    pub fn at_rest(
        &self,
        bodies: &Bodies,
        stiffness: f64,
        span: &mut SpanStiffness,
        take: &mut dyn FnMut(&[usize], &SpanStiffness),
    ) {
        let Some(unknown) = self.unknown else { return };
        span.begin(0);
        span.strains.extend([self.normal.x, self.normal.y]);
        span.stiffness.push(stiffness);
        take(&self.degrees(bodies), span);
        span.begin(0);
        span.strains.push(1.0);
        span.stiffness.push(stiffness);
        take(&[unknown], span);
    }

    pub fn save(&self, state: &mut Vec<f64>) {
        state.push(self.force);
    }

    pub fn restore(&mut self, next: &mut dyn FnMut() -> f64) {
        self.force = next();
    }
}
