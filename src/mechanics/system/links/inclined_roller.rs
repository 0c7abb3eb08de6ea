//! An inclined roller in a step: a point that keeps to a straight line, and the force across the line by which it does.
//!
//! ```text
//! n·Δx = 0          on the point -λ n,   n across the line, of length one
//! ```
//!
//! The equation is linear in increments, so that the work `-λ n·Δx` of the force vanishes, whatever the increments; it gives the impulse `-Δt λ n` at the
//! mean place of the point, as other supports do. Velocities of methods that take `v1 = 2 Δx/Δt - v0` stay along the line if they begin so.

use super::rigid_link::ForceUnknowns;
use crate::beams::{ForceSummary, SpanStiffness};
use crate::geometry::{Vec2, larger};
use crate::linalg::BandedMatrix;
use crate::system::bodies::Bodies;

/// A point of a body that keeps to a straight line.
#[derive(Debug, Clone)]
pub struct InclinedRoller {
    /// The joint of the scene that it is, by its index.
    pub joint: usize,
    /// The body, and the control point of it that keeps to the line.
    pub node: (usize, usize),
    /// The unknown of the force; none after the roller has let go.
    pub unknown: Option<usize>,
    /// `n` [-].
    across: Vec2,
    /// The place of the point as drawn, which is on the line [length].
    on_line: Vec2,
    /// The size of the scene, which the violation is relative to, with the movements of the iterate [length].
    size: f64,
    moved: f64,
    /// `λ`: that of the last step, or at rest [force].
    force: f64,
}

impl InclinedRoller {
    /// A roller at a control point of a body, which is at a place of its line, in a scene of some size [length]; `across` is a unit vector.
    pub fn new(
        joint: usize,
        node: (usize, usize),
        unknown: Option<usize>,
        across: Vec2,
        on_line: Vec2,
        size: f64,
    ) -> Self {
        Self { joint, node, unknown, across, on_line, size, moved: 0.0, force: 0.0 }
    }

    /// The unknowns of the movements of the point along both axes.
    pub fn degrees(&self, bodies: &Bodies) -> [usize; 2] {
        let (body, point) = self.node;
        let [x, y, _] = bodies[body].degrees_of_freedom[point];
        [x, y]
    }

    /// The force on the point, where its unknown has such a value [force].
    pub fn force_of(&self, unknown: f64) -> Vec2 {
        self.across * -unknown
    }

    /// The force on the point in the last step, or at rest; none after it has let go [force].
    pub fn force(&self) -> Vec2 {
        self.force_of(if self.unknown.is_some() { self.force } else { 0.0 })
    }

    /// `λ` of the last step, or at rest [force].
    pub fn multiplier(&self) -> f64 {
        self.force
    }

    /// The values that belong to the movements of the point along both axes; none of those that are supported.
    fn values_at(&self, bodies: &Bodies, values: &[f64]) -> Vec2 {
        let [x, y] = self.degrees(bodies).map(|at| values.get(at).copied().unwrap_or(0.0));
        Vec2::new(x, y)
    }

    /// Adds the force of an iterate to a residual, and in the place of its unknown how far the point leaves the line.
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
        out[unknown] += self.across.dot(&moved);
        self.moved = larger(moved.x.abs(), moved.y.abs());
        ForceSummary { force: force.abs(), ..ForceSummary::default() }
    }

    /// Adds the derivatives of what [`add`](Self::add) adds; supported movements have none.
    pub fn add_tangent(
        &self,
        bodies: &Bodies,
        acting: ForceUnknowns,
        movements: usize,
        tangent: &mut BandedMatrix,
    ) {
        self.couple(bodies, acting.share(), movements, tangent);
    }

    /// Couples force and movements in the manner of a matrix of inertia: an impulse of the force and rates.
    pub fn add_coupling(&self, bodies: &Bodies, movements: usize, matrix: &mut BandedMatrix) {
        self.couple(bodies, 1.0, movements, matrix);
    }

    fn couple(&self, bodies: &Bodies, share: f64, movements: usize, matrix: &mut BandedMatrix) {
        let Some(unknown) = self.unknown else { return };
        for (at, across) in self.degrees(bodies).into_iter().zip([self.across.x, self.across.y]) {
            if at < movements {
                matrix.add(at, unknown, share * across);
                matrix.add(unknown, at, across);
            }
        }
    }

    /// Adds the force `λ` to a residual.
    pub fn transmit(&self, bodies: &Bodies, force: f64, out: &mut [f64]) {
        let [x, y] = self.degrees(bodies);
        out[x] += force * self.across.x;
        out[y] += force * self.across.y;
    }

    /// How far the point leaves its line by a residual, relative to the scene and its movements [-].
    pub fn violation(&self, residual: &[f64]) -> f64 {
        let off = self.unknown.map_or(0.0, |at| residual[at].abs());
        if off == 0.0 { 0.0 } else { off / (self.size + self.moved) }
    }

    /// How far the point is from its line [length].
    pub fn gap(&self, bodies: &Bodies) -> f64 {
        match self.unknown {
            Some(_) => self.across.dot(&(self.place(bodies) - self.on_line)).abs(),
            None => 0.0,
        }
    }

    /// Where the point is at the start of a step [length].
    pub fn place(&self, bodies: &Bodies) -> Vec2 {
        let (body, point) = self.node;
        bodies[body].dynamics.control_points()[point]
    }

    /// Where the point is in the middle of the step of the movements that the bodies gathered last [length].
    pub fn mean_place(&self, bodies: &Bodies) -> Vec2 {
        let (body, point) = self.node;
        let [x, y, _] = bodies[body].moved()[point];
        self.place(bodies) + 0.5 * Vec2::new(x, y)
    }

    /// The velocity of the point across its line, by rates of all movements [length/time].
    pub fn velocity_violation(&self, bodies: &Bodies, rates: &[f64]) -> f64 {
        self.across.dot(&self.values_at(bodies, rates))
    }

    /// Accepts the unknowns of a step or a movement.
    pub fn advance(&mut self, acting: ForceUnknowns, values: &[f64]) {
        if let Some(unknown) = self.unknown {
            self.force = acting.force(self.force, values[unknown]);
        }
    }

    /// Gives how the roller resists small movements, were it as stiff as that [force/length].
    pub fn at_rest(
        &self,
        bodies: &Bodies,
        stiffness: f64,
        span: &mut SpanStiffness,
        take: &mut dyn FnMut(&[usize], &SpanStiffness),
    ) {
        let Some(unknown) = self.unknown else { return };
        span.begin(0);
        span.strains.extend([self.across.x, self.across.y]);
        span.stiffness.push(stiffness);
        take(&self.degrees(bodies), span);
        // Nothing asks for the force itself.
        span.begin(0);
        span.strains.push(1.0);
        span.stiffness.push(stiffness);
        take(&[unknown], span);
    }

    /// Appends the state of the roller at the start of a step.
    pub fn save(&self, state: &mut Vec<f64>) {
        state.push(self.force);
    }

    /// Takes the state of the roller back, in the order in which it was appended.
    pub fn restore(&mut self, next: &mut dyn FnMut() -> f64) {
        self.force = next();
    }
}
