//! The equations of equilibrium: under a prescribed load, and at a prescribed distance along the path.

use crate::geometry::larger;
use crate::integrators::Forces;
use crate::linalg::BorderedMatrix;
use crate::model::{Model, StaticForces, UnknownKind};
use crate::newton::{Equations, Imbalance};

/// The forces of a model at rest, and what its residual is compared with.
pub(super) struct Balance<'a> {
    pub(super) model: &'a mut Model,
    /// A length of the scene, which makes a force of a moment: under pure moments there is no other.
    pub(super) length: f64,
}

impl Balance<'_> {
    fn imbalance(&mut self, movements: &[f64], factor: f64, forces: &mut [f64]) -> Imbalance {
        let StaticForces { force, moment, strain_mismatch } =
            self.model.add_static_forces(movements, factor, forces);
        let scale = force + moment / self.length;
        let kinds = self.model.unknown_kinds();
        let largest = forces.iter().zip(kinds).fold(0.0, |most, (r, kind)| match kind {
            UnknownKind::Position => larger(most, r.abs()),
            UnknownKind::Rotation => larger(most, r.abs() / self.length),
            UnknownKind::Force => most,
        });
        // Nothing is balanced by nothing.
        let force = if largest == 0.0 { 0.0 } else { largest / scale };
        let constraint = self.model.lever_violation(forces);
        Imbalance { force, strain: strain_mismatch, constraint }
    }
}

/// The equations `F(u) - λ P(u) = 0` of a model at rest for a given load factor `λ`.
pub(super) struct UnderLoad<'a> {
    pub(super) balance: Balance<'a>,
    pub(super) factor: f64,
}

impl Equations for UnderLoad<'_> {
    fn linearise(&mut self, u: &[f64], residual: &mut [f64], tangent: &mut BorderedMatrix) {
        let Self { balance: Balance { model, .. }, factor } = self;
        model.add_linearised_static_forces(u, *factor, residual, tangent.band_mut());
    }

    fn condense(&mut self, residual: &mut [f64]) {
        self.balance.model.add_mismatch_forces(1.0, residual);
    }

    fn correct(&mut self, correction: &[f64]) {
        self.balance.model.correct_section_forces(correction);
    }

    fn imbalance(&mut self, u: &[f64], residual: &mut [f64]) -> Imbalance {
        self.balance.imbalance(u, self.factor, residual)
    }
}

/// The equations `F(u) - λ P(u) = 0` with `t·u = Δs`: the load factor `λ`, the last unknown, is found so that the movement ends in a plane.
pub(super) struct AlongPath<'a> {
    pub(super) balance: Balance<'a>,
    /// The normal `t` of the plane in which the movement ends, in the metric of the path.
    pub(super) normal: &'a [f64],
    /// The distance `Δs` of that plane from the last equilibrium, in the metric of the path.
    pub(super) distance: f64,
    /// The forces on the unknowns and the supports, in the order of the model [force, force·length].
    pub(super) forces: &'a mut [f64],
}

impl AlongPath<'_> {
    /// How far the movement is beyond the plane.
    fn beyond_plane(&self, movements: &[f64]) -> f64 {
        let way: f64 = self.normal.iter().zip(movements).map(|(t, u)| t * u).sum();
        way - self.distance
    }

    fn add_forces_to(&self, residual: &mut [f64]) {
        let free = residual.iter_mut().zip(&*self.forces).take(self.normal.len());
        free.for_each(|(residual, force)| *residual += force);
    }
}

impl Equations for AlongPath<'_> {
    fn linearise(&mut self, unknowns: &[f64], residual: &mut [f64], tangent: &mut BorderedMatrix) {
        let (movements, factor) = unknowns.split_at(self.normal.len());
        let model = &mut *self.balance.model;
        self.forces.fill(0.0);
        model.subtract_static_loads(movements, 1.0, self.forces);
        let border = tangent.border_mut();
        for (at, (load, normal)) in self.forces.iter().zip(self.normal).enumerate() {
            border.add_to_column(at, 0, *load);
            border.add_to_row(0, at, *normal);
        }
        self.forces.fill(0.0);
        let band = tangent.band_mut();
        model.add_linearised_static_forces(movements, factor[0], self.forces, band);
        self.add_forces_to(residual);
        residual[movements.len()] = self.beyond_plane(movements);
    }

    fn condense(&mut self, residual: &mut [f64]) {
        self.forces.fill(0.0);
        self.balance.model.add_mismatch_forces(1.0, self.forces);
        self.add_forces_to(residual);
    }

    fn correct(&mut self, correction: &[f64]) {
        let movements = &correction[..self.normal.len()];
        self.balance.model.correct_section_forces(movements);
    }

    fn imbalance(&mut self, unknowns: &[f64], residual: &mut [f64]) -> Imbalance {
        let (movements, factor) = unknowns.split_at(self.normal.len());
        self.forces.fill(0.0);
        let imbalance = self.balance.imbalance(movements, factor[0], self.forces);
        self.add_forces_to(residual);
        let beyond = self.beyond_plane(movements);
        residual[movements.len()] = beyond;
        Imbalance {
            constraint: larger(imbalance.constraint, beyond.abs() / self.distance),
            ..imbalance
        }
    }
}
