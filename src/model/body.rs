//! A body of the model: its dynamics, and where its movements stand among the degrees of freedom.

use crate::beams::{BodyDynamics, Collocation, ForceSummary, Movement, Place, RotationIncrement};
use crate::geometry::{Vec2, cross};
use crate::linalg::BandedMatrix;

/// A beam or a particle with the places of its movements in the vectors of the mechanism.
pub(super) struct Body {
    pub(super) dynamics: Box<dyn BodyDynamics>,
    pub(super) degrees_of_freedom: Vec<[usize; 3]>,
    /// For each span that moves consecutive unknowns only: the first of them.
    consecutive: Vec<Option<usize>>,
    unknowns: usize,
    moved: Vec<Movement>,
    forces: Vec<Movement>,
}

impl Body {
    pub(super) fn new(
        dynamics: Box<dyn BodyDynamics>,
        degrees_of_freedom: Vec<[usize; 3]>,
        unknowns: usize,
    ) -> Self {
        let order = dynamics.order();
        let is_consecutive = |first: usize| {
            let span = degrees_of_freedom[first..first + order].as_flattened();
            let steps = span.windows(2).all(|pair| pair[1] == pair[0] + 1);
            (steps && span.iter().all(|&at| at < unknowns)).then(|| span[0])
        };
        let mut consecutive = vec![None; degrees_of_freedom.len()];
        for first in dynamics.span_starts() {
            consecutive[first] = is_consecutive(first);
        }
        let zeros = vec![[0.0; 3]; degrees_of_freedom.len()];
        Self {
            dynamics,
            degrees_of_freedom,
            consecutive,
            unknowns,
            moved: zeros.clone(),
            forces: zeros,
        }
    }

    /// The values of the unknowns at this body; supported movements are zero.
    pub(super) fn gather(&mut self, values: &[f64]) -> &[Movement] {
        for (movement, degrees) in self.moved.iter_mut().zip(&self.degrees_of_freedom) {
            *movement = degrees.map(|at| values.get(at).copied().unwrap_or(0.0));
        }
        &self.moved
    }

    /// The movement of a place, from values of the unknowns.
    pub(super) fn at(&self, place: &Place, values: &[f64]) -> Movement {
        let mut sum = [0.0; 3];
        for (point, share) in place.weights() {
            for (sum, &at) in sum.iter_mut().zip(&self.degrees_of_freedom[point]) {
                *sum += share * values.get(at).copied().unwrap_or(0.0);
            }
        }
        sum
    }

    /// The x and y components of a control point, from values of the unknowns.
    pub(super) fn vector_at(&self, point: usize, values: &[f64]) -> Vec2 {
        let [x, y, _] = self.degrees_of_freedom[point];
        let value = |at: usize| values.get(at).copied().unwrap_or(0.0);
        Vec2::new(value(x), value(y))
    }

    /// A control point, and what rounding has cut off it so far [length].
    pub(super) fn precise_point(&self, point: usize) -> (Vec2, Vec2) {
        (self.dynamics.control_points()[point], self.dynamics.remainders()[point])
    }

    /// The movements that were gathered last.
    pub(super) fn moved(&self) -> &[Movement] {
        &self.moved
    }

    /// Accepts the movements that were gathered last.
    pub(super) fn advance(&mut self, rotations: RotationIncrement) {
        self.dynamics.advance(&self.moved, rotations);
    }

    fn scatter(&mut self, out: &mut [f64]) {
        for (force, degrees) in self.forces.iter_mut().zip(&self.degrees_of_freedom) {
            for (value, &at) in force.iter_mut().zip(degrees) {
                out[at] += std::mem::take(value);
            }
        }
    }

    pub(super) fn add_forces(
        &mut self,
        at: Collocation,
        increments: &[f64],
        weight: f64,
        out: &mut [f64],
    ) -> ForceSummary {
        self.gather(increments);
        let summary = self.dynamics.add_forces(at, &self.moved, weight, &mut self.forces);
        self.scatter(out);
        summary
    }

    pub(super) fn add_linearised_forces(
        &mut self,
        at: Collocation,
        increments: &[f64],
        weight: f64,
        out: &mut [f64],
        tangent: &mut BandedMatrix,
    ) {
        self.gather(increments);
        let Self { dynamics, degrees_of_freedom, consecutive, moved, forces, unknowns, .. } = self;
        let rows = 3 * dynamics.order();
        dynamics.add_linearised_forces(at, moved, weight, forces, &mut |first, block| {
            if let Some(start) = consecutive[first] {
                return tangent.add_block(start, rows, block);
            }
            let degrees = degrees_of_freedom[first..first + rows / 3].as_flattened();
            for (values, &row) in block.chunks_exact(rows).zip(degrees) {
                add_row(tangent, row, degrees, values, *unknowns);
            }
        });
        self.scatter(out);
    }

    pub(super) fn add_mismatch_forces(&mut self, weight: f64, out: &mut [f64]) {
        self.dynamics.add_mismatch_forces(weight, &mut self.forces);
        self.scatter(out);
    }

    pub(super) fn correct_section_forces(&mut self, correction: &[f64]) {
        self.gather(correction);
        self.dynamics.correct_section_forces(&self.moved);
    }

    pub(super) fn add_inertia(&mut self, factor: f64, rates: &[f64], out: &mut [f64]) {
        self.gather(rates);
        self.dynamics.add_inertia(factor, &self.moved, &mut self.forces);
        self.scatter(out);
    }

    /// Gives `factor · M` to `add`: row, column and value; several of one place add up.
    pub(super) fn inertia_entries(&self, factor: f64, add: &mut impl FnMut(usize, usize, f64)) {
        self.dynamics.add_inertia_tangent(factor, &mut |a, b, inertia| {
            for ((&row, &column), value) in
                self.degrees_of_freedom[a].iter().zip(&self.degrees_of_freedom[b]).zip(inertia)
            {
                if row < self.unknowns && column < self.unknowns {
                    add(row, column, value);
                }
            }
        });
    }

    /// Twice the kinetic energy, the momentum and the angular momentum about the origin.
    pub(super) fn momenta(&mut self, rates: &[f64]) -> (f64, Vec2, f64) {
        self.gather(rates);
        self.dynamics.add_inertia(1.0, &self.moved, &mut self.forces);
        let (mut twice_kinetic, mut momentum, mut angular) = (0.0, Vec2::zeros(), 0.0);
        let points = self.dynamics.control_points();
        for ((part, rate), point) in self.forces.iter_mut().zip(&self.moved).zip(points) {
            let [px, py, spin] = std::mem::take(part);
            let linear = Vec2::new(px, py);
            twice_kinetic += px * rate[0] + py * rate[1] + spin * rate[2];
            momentum += linear;
            angular += cross(*point, linear) + spin;
        }
        (twice_kinetic, momentum, angular)
    }
}

fn add_row(
    tangent: &mut BandedMatrix,
    row: usize,
    columns: &[usize],
    values: &[f64],
    unknowns: usize,
) {
    if row >= unknowns {
        return;
    }
    for (&column, &value) in columns.iter().zip(values) {
        if column < unknowns {
            tangent.add(row, column, value);
        }
    }
}
