//! Vectors for the accelerations and contact forces at the present time. They are kept between steps to avoid allocation.

use crate::beams::Movement;
use crate::joints::Wrench;
use crate::linalg::{BandedLu, BandedMatrix, LinearError};

/// Accelerations and contact forces at the present time, and the vectors for their computation.
pub struct PresentForces {
    pub rates: Vec<Vec<Movement>>,
    /// Internal forces minus loads for each degree of freedom, plus the inertia forces of prescribed accelerations.
    pub residual: Vec<f64>,
    /// Prescribed accelerations, indexed by the degree of freedom; empty without drives.
    pub prescribed: Vec<f64>,
    /// Accelerations, and forces of rigid links and rollers, in the order of the unknowns.
    pub accelerations: Vec<f64>,
    /// Force and couple of each slave on its master [force, force·length].
    pub contacts: Vec<Wrench>,
    /// Unit wrench of each contact force, with the index of its slider.
    pub directions: Vec<(usize, Wrench)>,
    /// Responses to unit contact forces. There may be more entries than contact forces, because entries are reused.
    pub responses: Vec<ContactResponse>,
    /// Acceleration in each contact direction due to each unit contact force [1/mass].
    matrix: BandedMatrix,
    pub magnitudes: Vec<f64>,
}

#[derive(Default)]
pub struct ContactResponse {
    forces: Vec<f64>,
    /// Force and couple on the slave per unit of the contact force, including friction [-, length].
    pub direction: Wrench,
    /// Accelerations of the unknowns per unit of the contact force.
    pub rates: Vec<f64>,
}

impl ContactResponse {
    /// Sets the response to a unit force. The callback `transmit` adds the generalised forces of the unit force to a zero vector.
    pub fn set(
        &mut self,
        direction: Wrench,
        inertia: &BandedLu<'_>,
        [unknowns, degrees_of_freedom]: [usize; 2],
        transmit: impl FnOnce(&mut [f64]),
    ) {
        self.direction = direction;
        self.forces.clear();
        self.forces.resize(degrees_of_freedom, 0.0);
        transmit(&mut self.forces);
        self.rates.clear();
        self.rates.extend_from_slice(&self.forces[..unknowns]);
        inertia.solve(&mut self.rates);
    }

    pub fn add(&mut self, factor: f64, other: &Self) {
        self.direction += other.direction * factor;
        let pairs = self.rates.iter_mut().zip(&other.rates);
        pairs.for_each(|(rate, other)| *rate += factor * other);
    }

    pub fn component(&self, rates: &[f64]) -> f64 {
        let touched = self.forces.iter().zip(rates).filter(|(force, _)| **force != 0.0);
        touched.map(|(force, rate)| rate * force).sum()
    }
}

impl Default for PresentForces {
    fn default() -> Self {
        Self {
            rates: Vec::new(),
            residual: Vec::new(),
            prescribed: Vec::new(),
            accelerations: Vec::new(),
            contacts: Vec::new(),
            directions: Vec::new(),
            responses: Vec::new(),
            matrix: BandedMatrix::zeros(0, 0),
            magnitudes: Vec::new(),
        }
    }
}

impl PresentForces {
    /// Computes the magnitudes of the contact forces.
    /// The callback `carried` returns the acceleration that the contact requires in each contact direction [length/time²].
    pub fn solve(&mut self, carried: impl Fn(&(usize, Wrench)) -> f64) -> Result<(), LinearError> {
        let Self { accelerations, directions, responses, matrix, magnitudes, .. } = self;
        let count = directions.len();
        let responses = &responses[..count];
        magnitudes.clear();
        let missing = directions.iter().zip(responses);
        magnitudes.extend(missing.map(|(at, own)| carried(at) - own.component(accelerations)));
        match matrix.size() == count {
            true => matrix.clear(),
            false => *matrix = BandedMatrix::zeros(count, count - 1),
        }
        for (row, own) in responses.iter().enumerate() {
            for (column, other) in responses.iter().enumerate() {
                matrix.add(row, column, own.component(&other.rates));
            }
        }
        matrix.factorise()?.solve(magnitudes);
        Ok(())
    }

    /// Adds the contact forces to the accelerations, and to the forces on the masters.
    pub fn apply(&mut self) {
        let Self { accelerations, contacts, directions, responses, magnitudes, .. } = self;
        for ((force, own), (slider, _)) in magnitudes.iter().zip(responses).zip(directions) {
            contacts[*slider] -= own.direction * *force;
            let all = accelerations.iter_mut().zip(&own.rates);
            all.for_each(|(acceleration, rate)| *acceleration += force * rate);
        }
    }
}
