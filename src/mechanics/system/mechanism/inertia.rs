//! Inertia of all bodies.

use super::{StaticOrder, System};
use crate::integrators::Inertia;
use crate::linalg::{BandedMatrix, SymmetricSparse};

impl Inertia for System {
    fn add_inertia(&mut self, factor: f64, rates: &[f64], out: &mut [f64]) {
        self.bodies.add_inertia(factor, rates, out);
        self.elements.add_inertia(&self.bodies, factor, rates, out);
    }

    fn add_inertia_tangent(&self, factor: f64, tangent: &mut BandedMatrix) {
        self.bodies.add_inertia_tangent(factor, tangent);
        let add = &mut |row, column, value| tangent.add(row, column, value);
        self.elements.inertia_entries(&self.bodies, factor, self.unknowns.count(), add);
    }
}

impl System {
    /// Calls `add` with the row, column and value of each entry of the inertia matrix.
    /// The caller must add up values for the same row and column.
    pub(super) fn inertia_entries(&self, add: &mut impl FnMut(usize, usize, f64)) {
        self.bodies.iter().for_each(|body| body.inertia_entries(1.0, add));
        self.elements.inertia_entries(&self.bodies, 1.0, self.unknowns.count(), add);
    }

    /// Inertia matrix for the given order of unknowns [mass, mass·length, mass·length²].
    pub(crate) fn sparse_inertia(&self, order: &StaticOrder) -> SymmetricSparse {
        SymmetricSparse::new(order.count(), |add| {
            self.inertia_entries(&mut |row, column, value| {
                add(order.place(row), order.place(column), value);
            });
        })
    }

    /// Approximate accelerations of the unknowns: forces divided by the diagonal of the inertia matrix [length/time², 1/time²].
    /// The off-diagonal entries are ignored. The result is zero for unknowns without inertia.
    pub fn uncoupled_accelerations(&self, forces: &[f64]) -> Vec<f64> {
        let inertia = self.diagonal_of_inertia();
        let of = |(force, inertia): (&f64, f64)| if inertia > 0.0 { force / inertia } else { 0.0 };
        forces.iter().zip(inertia).map(of).collect()
    }

    /// Band matrix of the inertia, with the constraints of rigid links and inclined rollers at their force unknowns [mass, mass·length, mass·length²].
    pub(super) fn banded_inertia(&self) -> BandedMatrix {
        let mut inertia =
            BandedMatrix::zeros(self.unknowns.count(), self.unknowns.half_bandwidth());
        self.fill_banded_inertia(&mut inertia);
        inertia
    }

    pub(super) fn fill_banded_inertia(&self, inertia: &mut BandedMatrix) {
        self.add_inertia_tangent(1.0, inertia);
        self.links.add_coupling(&self.bodies, self.unknowns.count(), inertia);
        inertia.weigh_rows();
    }

    /// Diagonal of the inertia matrix of the unknown degrees of freedom [mass, mass·length²].
    pub(in crate::system) fn diagonal_of_inertia(&self) -> Vec<f64> {
        let mut diagonal = vec![0.0; self.unknowns.count()];
        self.inertia_entries(&mut |row, column, value| {
            if row == column {
                diagonal[row] += value;
            }
        });
        diagonal
    }
}
