//! Equations of equilibrium, either for a given load factor or for a given distance along the path of equilibria.

use crate::geometry::larger;
use crate::integrators::{Forces, Inertia, Mechanism};
use crate::linalg::BorderedMatrix;
use crate::newton::{Equations, ResidualNorms};
use crate::system::{StaticForces, System, UnknownKind};

pub(super) struct Balance<'a> {
    pub(super) model: &'a mut System,
    /// Length by which moments are divided for comparison with forces. It determines the force scale if all loads are moments [length].
    pub(super) length: f64,
    pub(super) goes_on: &'a mut dyn FnMut() -> bool,
}

impl Balance<'_> {
    fn imbalance(&mut self, unknowns: &[f64], factor: f64, forces: &mut [f64]) -> ResidualNorms {
        let StaticForces { force, moment, strain_mismatch } =
            self.model.add_static_forces(unknowns, factor, forces);
        let scale = force + moment / self.length;
        let kinds = self.model.unknown_kinds();
        let largest = forces.iter().zip(kinds).fold(0.0, |most, (r, kind)| match kind {
            UnknownKind::Position => larger(most, r.abs()),
            UnknownKind::Rotation => larger(most, r.abs() / self.length),
            UnknownKind::Force => most,
        });
        // Without forces, the scale is zero and the quotient would be NaN.
        let force = if largest == 0.0 { 0.0 } else { largest / scale };
        let constraint = self.model.violation_at_rest(forces, scale);
        ResidualNorms { force, strain: strain_mismatch, constraint }
    }
}

pub(super) struct UnderLoad<'a> {
    pub(super) balance: Balance<'a>,
    pub(super) factor: f64,
    /// Factor by which inertia matrix times displacements is added to the equations as viscous damping [1/time²]; zero for an equilibrium.
    pub(super) rate: f64,
}

impl UnderLoad<'_> {
    fn add_internal_forces(&mut self, unknowns: &[f64], residual: &mut [f64]) {
        if self.rate > 0.0 {
            let model = &mut *self.balance.model;
            let movements = &unknowns[..model.unknowns()];
            model.add_inertia(self.rate, movements, residual);
        }
    }
}

impl Equations for UnderLoad<'_> {
    fn linearise(&mut self, u: &[f64], residual: &mut [f64], tangent: &mut BorderedMatrix) {
        self.add_internal_forces(u, residual);
        let Self { balance: Balance { model, .. }, factor, rate } = self;
        if *rate > 0.0 {
            model.add_inertia_tangent(*rate, tangent.band_mut());
        }
        model.add_linearised_static_forces(u, *factor, residual, tangent);
    }

    fn condense(&mut self, residual: &mut [f64]) {
        self.balance.model.add_mismatch_forces(1.0, residual);
    }

    fn correct(&mut self, correction: &[f64]) {
        let movements = self.balance.model.unknowns();
        self.balance.model.correct_section_forces(&correction[..movements]);
    }

    fn imbalance(&mut self, u: &[f64], residual: &mut [f64]) -> ResidualNorms {
        self.add_internal_forces(u, residual);
        self.balance.imbalance(u, self.factor, residual)
    }

    fn goes_on(&mut self) -> bool {
        (self.balance.goes_on)()
    }
}

/// Equations of equilibrium with the load factor as the last unknown.
pub(super) struct AlongPath<'a, 'b> {
    pub(super) balance: &'a mut Balance<'b>,
    pub(super) normal: &'a [f64],
    /// Distance from the last equilibrium to the plane on which the next equilibrium is sought, in the norm of displacements and rotations.
    /// The vector `normal` is perpendicular to this plane.
    pub(super) distance: f64,
    pub(super) forces: &'a mut [f64],
}

impl AlongPath<'_, '_> {
    fn distance_from_plane(&self, movements: &[f64]) -> f64 {
        let projection: f64 = self.normal.iter().zip(movements).map(|(t, u)| t * u).sum();
        projection - self.distance
    }

    fn add_forces_to(&self, residual: &mut [f64]) {
        let free = residual.iter_mut().zip(&*self.forces).take(self.normal.len());
        free.for_each(|(residual, force)| *residual += force);
    }
}

impl Equations for AlongPath<'_, '_> {
    fn linearise(&mut self, unknowns: &[f64], residual: &mut [f64], tangent: &mut BorderedMatrix) {
        let (moved, factor) = unknowns.split_at(self.normal.len());
        let model = &mut *self.balance.model;
        let movements = model.unknowns();
        self.forces.fill(0.0);
        model.subtract_static_loads(&moved[..movements], 1.0, self.forces);
        let (border, last) = (tangent.border_mut(), moved.len() - movements);
        for (at, (load, normal)) in self.forces.iter().zip(self.normal).take(movements).enumerate()
        {
            border.add_to_column(at, last, *load);
            border.add_to_row(last, at, *normal);
        }
        self.forces.fill(0.0);
        model.add_linearised_static_forces(moved, factor[0], self.forces, tangent);
        self.add_forces_to(residual);
        residual[moved.len()] = self.distance_from_plane(moved);
    }

    fn condense(&mut self, residual: &mut [f64]) {
        self.forces.fill(0.0);
        self.balance.model.add_mismatch_forces(1.0, self.forces);
        self.add_forces_to(residual);
    }

    fn correct(&mut self, correction: &[f64]) {
        let movements = &correction[..self.balance.model.unknowns()];
        self.balance.model.correct_section_forces(movements);
    }

    fn imbalance(&mut self, unknowns: &[f64], residual: &mut [f64]) -> ResidualNorms {
        let (movements, factor) = unknowns.split_at(self.normal.len());
        self.forces.fill(0.0);
        let imbalance = self.balance.imbalance(movements, factor[0], self.forces);
        self.add_forces_to(residual);
        let beyond = self.distance_from_plane(movements);
        residual[movements.len()] = beyond;
        ResidualNorms {
            constraint: larger(imbalance.constraint, beyond.abs() / self.distance),
            ..imbalance
        }
    }

    fn goes_on(&mut self) -> bool {
        (self.balance.goes_on)()
    }
}
