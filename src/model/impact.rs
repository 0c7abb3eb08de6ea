//! Impulses at sliders: consistent start velocities, and bounces off the ends of a master.
//!
//! An impulse `P` at a contact changes the velocities by `M (v⁺ - v⁻) = Gᵀ P`, `G v` being the velocity of the slave relative
//! to its place on the master. Where the contact is closed, linear and angular momentum stay;
//! a gap of the relaxed rule costs angular momentum.

use super::body::Body;
use super::error::ModelError;
use super::mechanism::Model;
use super::slider_error::SliderError;
use super::sliding::{SliderState, Sliding};
use crate::geometry::{Vec2, perpendicular};
use crate::integrators::Mechanism;
use crate::joints::StartVelocities;
use crate::linalg::{BandedLu, BandedMatrix, LinearError};

/// Largest start velocity across the master, relative to the velocities there.
const SAME_VELOCITY: f64 = 1e-9;

/// The component of a relative velocity on which an impulse acts.
struct Direction {
    slider: usize,
    unit: Vec2,
}

impl Model {
    /// Deals with start velocities that would leave the masters, as each slider says.
    pub(super) fn settle_start_velocities(
        &mut self,
        choices: impl Iterator<Item = StartVelocities>,
    ) -> Result<(), ModelError> {
        let mut is_projected = false;
        for (slider, choice) in self.sliders.iter().zip(choices) {
            match choice {
                StartVelocities::Check => slider.check_velocity(&self.bodies, &self.rates)?,
                StartVelocities::Project => is_projected = true,
            }
        }
        if is_projected {
            let across: Vec<Direction> =
                (0..self.sliders.len()).map(|at| self.across(at)).collect();
            // Projection: the impulses take the velocities across away (Gauss's principle of least constraint).
            self.strike(&across, -1.0).map_err(|_| self.overdetermined())?;
        }
        Ok(())
    }

    /// A slider bounces off the end of its master, as off an elastic stop: all velocities relative to masters are reversed in
    /// the directions that transmit forces, which keeps the energy (`P·(G v⁺ + G v⁻) = 0`).
    ///
    /// # Errors
    /// When the impulse is not determined.
    pub fn bounce(&mut self, slider: usize) -> Result<(), ModelError> {
        let directions = self.sliders.iter().enumerate().flat_map(|(at, other)| {
            let along = match other.state {
                SliderState::Released => return Vec::new(),
                SliderState::Sliding => (at == slider).then(|| self.along(at)),
                SliderState::Held(_) => Some(self.along(at)),
            };
            std::iter::once(self.across(at)).chain(along).collect()
        });
        let directions: Vec<Direction> = directions.collect();
        self.strike(&directions, -2.0).map_err(|_| self.overdetermined())
    }

    /// What unit impulses transmit, and how the velocities answer.
    fn answers(
        &self,
        inertia: &BandedLu<'_>,
        directions: &[Direction],
    ) -> Vec<(Vec<f64>, Vec<f64>)> {
        let answer = |direction| {
            let forces = self.transmit(direction);
            let mut rates = forces[..self.unknowns].to_vec();
            inertia.solve(&mut rates);
            (forces, rates)
        };
        directions.iter().map(answer).collect()
    }

    fn along(&self, slider: usize) -> Direction {
        Direction { slider, unit: self.sliders[slider].tangent(&self.bodies).normalize() }
    }

    fn across(&self, slider: usize) -> Direction {
        let Direction { slider, unit } = self.along(slider);
        Direction { slider, unit: perpendicular(unit) }
    }

    pub(super) fn overdetermined(&self) -> ModelError {
        let names: Vec<&str> = self.slider_names().collect();
        SliderError::Overdetermined { sliders: names.join("', '") }.into()
    }

    /// Changes the components of the relative velocities by `factor` times themselves, by impulses at the sliders.
    fn strike(&mut self, directions: &[Direction], factor: f64) -> Result<(), LinearError> {
        let (unknowns, count) = (self.unknowns, directions.len());
        let mut inertia = self.inertia();
        let inertia = inertia.factorise()?;
        let answers = self.answers(&inertia, directions);
        let mut response = BandedMatrix::zeros(count, count.saturating_sub(1));
        for (row, (forces, _)) in answers.iter().enumerate() {
            for (column, (_, rates)) in answers.iter().enumerate() {
                response.add(row, column, product(rates, forces));
            }
        }
        let mut impulses: Vec<f64> =
            answers.iter().map(|(forces, _)| factor * product(&self.rates, forces)).collect();
        response.factorise()?.solve(&mut impulses);

        let mut change = vec![0.0; unknowns];
        let mut residual = vec![0.0; self.degrees_of_freedom()];
        for (impulse, (forces, rates)) in impulses.iter().zip(&answers) {
            change.iter_mut().zip(rates).for_each(|(change, rate)| *change += impulse * rate);
            residual.iter_mut().zip(forces).for_each(|(out, force)| *out -= impulse * force);
        }
        // What is left of `M (v⁺ - v⁻) - Gᵀ P` at supports is their impulse.
        self.add_inertia_of_all(1.0, &change, &mut residual);
        self.rates.iter_mut().zip(&change).for_each(|(rate, change)| *rate += change);
        self.forecast.jump(&change);
        self.accelerations.forget();
        let reactions = self.reactions(&residual, 1.0);
        self.exchanged += reactions;
        Ok(())
    }

    /// How velocities across the masters answer to unit impulses across them: `G M⁻¹ Gᵀ`.
    pub(super) fn response_across(&self) -> Result<Vec<Vec<f64>>, LinearError> {
        let across: Vec<Direction> = (0..self.sliders.len()).map(|at| self.across(at)).collect();
        let mut inertia = self.inertia();
        let answers = self.answers(&inertia.factorise()?, &across);
        let row = |rates| answers.iter().map(|(forces, _)| product(rates, forces)).collect();
        Ok(answers.iter().map(|(_, rates)| row(rates)).collect())
    }

    /// The inertia matrix.
    fn inertia(&self) -> BandedMatrix {
        let mut inertia = BandedMatrix::zeros(self.unknowns, self.half_bandwidth);
        self.add_inertia_tangent(1.0, &mut inertia);
        inertia
    }

    /// Its diagonal.
    pub(super) fn diagonal_of_inertia(&self) -> Vec<f64> {
        let mut diagonal = vec![0.0; self.unknowns];
        self.inertia_entries(1.0, &mut |row, column, value| {
            if row == column {
                diagonal[row] += value;
            }
        });
        diagonal
    }

    /// `Gᵀ` times a unit impulse: on the slave, and the opposite one on the master.
    fn transmit(&self, direction: &Direction) -> Vec<f64> {
        let mut forces = vec![0.0; self.degrees_of_freedom()];
        let slider = &self.sliders[direction.slider];
        let mut add = |[x, y, _]: [usize; 3], force: Vec2| {
            forces[x] += force.x;
            forces[y] += force.y;
        };
        let (body, point) = slider.connection.slave;
        add(self.bodies[body].degrees_of_freedom[point], direction.unit);
        let master = &self.bodies[slider.connection.master];
        for (point, weight) in slider.weights() {
            add(master.degrees_of_freedom[point], direction.unit * -weight);
        }
        forces
    }
}

/// Of as many entries as the shorter one has.
fn product(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}

impl Sliding {
    fn check_velocity(&self, bodies: &[Body], rates: &[f64]) -> Result<(), ModelError> {
        let relative = self.relative_velocity(bodies, rates);
        let across = perpendicular(self.tangent(bodies).normalize()).dot(&relative);
        let (body, point) = self.connection.slave;
        let size = bodies[body].vector_at(point, rates).norm() + relative.norm();
        if across.abs() <= SAME_VELOCITY * size {
            return Ok(());
        }
        Err(SliderError::LeavesMaster { slider: self.name.clone(), speed: across.abs() }.into())
    }
}
