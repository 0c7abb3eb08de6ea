//! Responses to unit impulses, computed without allocation in every step.

use crate::linalg::{BandedLu, BandedMatrix, LinearError};

pub struct InertiaSolver {
    inertia: BandedMatrix,
    is_factorised: bool,
    forces: Vec<f64>,
    rates: Vec<f64>,
}

impl InertiaSolver {
    pub fn new(unknowns: usize, half_bandwidth: usize, degrees_of_freedom: usize) -> Self {
        Self {
            inertia: BandedMatrix::zeros(unknowns, half_bandwidth),
            is_factorised: false,
            forces: vec![0.0; degrees_of_freedom],
            rates: vec![0.0; unknowns],
        }
    }

    pub fn is_factorised(&self) -> bool {
        self.is_factorised
    }

    /// Factorises the inertia matrix. The callback `fill` adds its entries to a zero matrix.
    pub fn factorise(&mut self, fill: impl FnOnce(&mut BandedMatrix)) -> Result<(), LinearError> {
        self.is_factorised = false;
        self.inertia.clear();
        fill(&mut self.inertia);
        self.inertia.factorise()?;
        self.is_factorised = true;
        Ok(())
    }

    pub fn factors(&self) -> BandedLu<'_> {
        self.inertia.factors()
    }

    /// Velocity in the direction of a unit impulse that this impulse causes [1/mass]. For the impulse of a contact, it is the relative velocity.
    /// The callback `add_forces` adds the generalised forces of the impulse.
    pub fn response(&mut self, add_forces: impl FnOnce(&mut [f64])) -> f64 {
        let Self { inertia, forces, rates, .. } = self;
        forces.fill(0.0);
        add_forces(forces);
        rates.copy_from_slice(&forces[..inertia.size()]);
        inertia.factors().solve(rates);
        rates.iter().zip(forces.iter()).map(|(rate, force)| rate * force).sum()
    }
}
