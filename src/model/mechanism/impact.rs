//! Impulses at sliders: consistent start velocities, and bounces off the ends of a master.
//!
//! An impulse `P` at a contact changes the velocities by `M (v⁺ - v⁻) = Gᵀ P`, `G v` being the velocity of the slave relative
//! to its place on the master. Where the contact is closed, linear and angular momentum stay;
//! a gap of the relaxed rule costs angular momentum.

use crate::geometry::{Vec2, perpendicular};
use crate::integrators::Mechanism;
use crate::joints::StartVelocities;
use crate::linalg::{BandedLu, BandedMatrix, LinearError};
use crate::model::bodies::Body;
use crate::model::mechanism::Model;
use crate::model::scene::Scene;
use crate::model::sliders::{SliderState, Sliding};
use crate::model::words::ModelError;
use crate::model::words::SliderError;

/// Largest start velocity across the master, relative to the fastest point of the scene: where a mechanism has a dead centre, velocities of
/// that size have left nothing but their rounding.
const SAME_VELOCITY: f64 = 1e-9;

/// What moves by less than this part of the change of relative velocity is held.
const GIVES: f64 = 1e-9;

/// What two that strike each other along a master set against the blow: the masses that answer at once, none where it is held, or so
/// heavy that it does not give way.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Blow {
    /// The slave's [mass].
    pub(in crate::model) slave: Option<f64>,
    /// The master's [mass].
    pub(in crate::model) master: Option<f64>,
}

/// The component of a relative velocity on which an impulse acts.
struct Direction {
    slider: usize,
    unit: Vec2,
}

impl Model {
    /// Deals with start velocities that would leave the masters, as each slider says.
    ///
    /// Speeds across a master that strain nothing by more than rounding, as waves go, are none either: `w/c < ε`.
    pub(in crate::model) fn settle_start_velocities(
        &mut self,
        scene: &Scene,
    ) -> Result<(), ModelError> {
        let negligible = SAME_VELOCITY * self.fastest_speed() + f64::EPSILON * scene.fastest_wave();
        let mut is_projected = false;
        for (slider, described) in self.sliders.iter().zip(&scene.sliders) {
            match described.velocities {
                StartVelocities::Check => {
                    slider.check_velocity(&self.bodies, &self.rates, negligible)?;
                }
                StartVelocities::Project => is_projected = true,
            }
        }
        if is_projected {
            let across: Vec<Direction> =
                (0..self.sliders.len()).map(|at| self.across(at)).collect();
            // Projection: the impulses take the velocities across away (Gauss's principle of least constraint).
            _ = self.strike(&across, -1.0).map_err(|_| self.overdetermined())?;
        }
        Ok(())
    }

    /// The speed of the fastest control point [length/time].
    fn fastest_speed(&self) -> f64 {
        let speeds = self.bodies.iter().flat_map(|body| {
            (0..body.degrees_of_freedom.len())
                .map(|point| body.vector_at(point, &self.rates).norm())
        });
        speeds.fold(0.0, f64::max)
    }

    /// A slider bounces off the end of its master, as off an elastic stop: all velocities relative to masters are reversed in
    /// the directions that transmit forces, which keeps the energy (`P·(G v⁺ + G v⁻) = 0`).
    ///
    /// Tells what the two set against it: waves run from what gave way.
    ///
    /// # Errors
    /// When the impulse is not determined.
    pub fn bounce(&mut self, slider: usize) -> Result<Blow, ModelError> {
        let directions = self.sliders.iter().enumerate().flat_map(|(at, other)| {
            let along = match other.state {
                SliderState::Released => return Vec::new(),
                SliderState::Sliding => (at == slider).then(|| self.along(at)),
                SliderState::Held(_) => Some(self.along(at)),
            };
            std::iter::once(self.across(at)).chain(along).collect()
        });
        let directions: Vec<Direction> = directions.collect();
        // Behind that across the master.
        let of_blow = directions.iter().rposition(|direction| direction.slider == slider);
        let before = self.speeds_along(slider);
        let impulses = self.strike(&directions, -2.0).map_err(|_| self.overdetermined())?;
        let after = self.speeds_along(slider);
        let impulse = of_blow.map_or(0.0, |at| impulses[at].abs());
        let changes = [(after.0 - before.0).abs(), (after.1 - before.1).abs()];
        let least = GIVES * (changes[0] + changes[1]);
        let [slave, master] = changes.map(|change| (change > least).then(|| impulse / change));
        Ok(Blow { slave, master })
    }

    /// How fast a slave and its place on the master move along the master.
    fn speeds_along(&self, slider: usize) -> (f64, f64) {
        let unit = self.along(slider).unit;
        let slider = &self.sliders[slider];
        let (slave, relative) = (
            slider.slave_velocity(&self.bodies, &self.rates),
            slider.relative_velocity(&self.bodies, &self.rates),
        );
        (slave.dot(&unit), (slave - relative).dot(&unit))
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

    pub(in crate::model) fn overdetermined(&self) -> ModelError {
        let names: Vec<&str> = self.slider_names().collect();
        SliderError::Overdetermined { sliders: names.join("', '") }.into()
    }

    /// Changes the components of the relative velocities by `factor` times themselves, by impulses at the sliders, which it tells.
    fn strike(&mut self, directions: &[Direction], factor: f64) -> Result<Vec<f64>, LinearError> {
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
        Ok(impulses)
    }

    /// How velocities across the masters answer to unit impulses across them: `G M⁻¹ Gᵀ`.
    pub(in crate::model) fn response_across(&self) -> Result<Vec<Vec<f64>>, LinearError> {
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
    pub(in crate::model) fn diagonal_of_inertia(&self) -> Vec<f64> {
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
    fn check_velocity(
        &self,
        bodies: &[Body],
        rates: &[f64],
        negligible: f64,
    ) -> Result<(), ModelError> {
        let relative = self.relative_velocity(bodies, rates);
        let across = perpendicular(self.tangent(bodies).normalize()).dot(&relative);
        if across.abs() <= negligible {
            return Ok(());
        }
        Err(SliderError::LeavesMaster { slider: self.name.clone(), speed: across.abs() }.into())
    }
}
