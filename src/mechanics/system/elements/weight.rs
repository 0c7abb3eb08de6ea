//! Weight of the bodies.

use super::load_vector::LoadVector;
use super::point_mass::NodalMass;
use super::{ExternalForce, TrialState, WorkAndImpulse};
use crate::beams::BodyDynamics;
use crate::geometry::Vec2;
use crate::integrators::Method;
use crate::system::bodies::Body;

pub struct Weight {
    gravity: Vec2,
    forces: LoadVector,
}

impl Weight {
    pub fn new<'a>(gravity: Vec2, beams: impl Iterator<Item = &'a dyn BodyDynamics>) -> Self {
        let mut forces = LoadVector::default();
        for (index, beam) in beams.enumerate() {
            for (point, mass) in beam.lumped_masses().into_iter().enumerate() {
                let force = gravity * mass;
                forces.push(index, point, [force.x, force.y, 0.0]);
            }
        }
        Self { gravity, forces }
    }

    pub fn energy_of(&self, bodies: &[Body], body: usize) -> f64 {
        -self.forces.potential_work_on(bodies, |other| other == body)
    }

    pub fn add(&mut self, mass: &NodalMass) {
        for (point, weight) in mass.place.weights() {
            let force = self.gravity * (weight * mass.mass);
            self.forces.push(mass.place.body, point, [force.x, force.y, 0.0]);
        }
    }
}

impl ExternalForce for Weight {
    fn name(&self) -> &str {
        "gravity"
    }

    fn subtract_from(&mut self, at: TrialState<'_>, out: &mut [f64]) -> (f64, f64) {
        self.forces.subtract_from(at, at.weight, out);
        self.forces.largest(1.0)
    }

    /// Impulse of the weight. The work is zero in the result, because the potential energy contains the work of the weight.
    fn exchange(&self, bodies: &[Body], duration: f64) -> WorkAndImpulse {
        WorkAndImpulse { work: 0.0, ..self.forces.exchange(bodies, 1.0, duration) }
    }

    fn energy(&self, bodies: &[Body]) -> Option<f64> {
        Some(-self.forces.potential_work(bodies))
    }

    fn explain(&self, _methods: &[Method]) -> String {
        let (x, y) = (self.gravity.x, self.gravity.y);
        format!("({x}, {y}): constant weight with a potential energy")
    }
}
