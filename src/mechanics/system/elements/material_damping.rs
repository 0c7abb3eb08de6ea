//! Kelvin–Voigt material damping of a beam. Dashpots act parallel to the section forces at the quadrature points.

use serde::{Deserialize, Serialize};

use super::element::{AssemblyContext, BuiltElement, ElementDef, SceneChecks};
use super::internal_force::InternalForce;
use super::rate_history::RateHistory;
use super::{TrialState, WorkAndImpulse, collocation};
use crate::beams::{
    Dashpots, ForceSummary, Movement, Relaxation, RotationIncrement, SectionPlace, Station,
};
use crate::geometry::Vec2;
use crate::integrators::Interval;
use crate::linalg::BandedMatrix;
use crate::loads::LoadError;
use crate::system::SystemError;
use crate::system::bodies::Body;

/// Definition of material damping in a scene: the relaxation times of a beam.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct MaterialDamping {
    /// Name of the beam, which is also used in the columns of its damping.
    pub name: String,
    /// Index of the beam.
    pub beam: usize,
    /// Relaxation times of the material.
    pub relaxation: Relaxation,
}

impl ElementDef for MaterialDamping {
    fn check(&self, setting: &dyn SceneChecks) -> Result<(), SystemError> {
        setting.check_station("a damped material", &Station::on_beam(self.beam, 0.0))?;
        self.relaxation.validated().map_err(|(name, value)| SystemError::Value {
            object: format!("damping of beam '{}'", self.name),
            name,
            value,
            allowed: Relaxation::ALLOWED,
        })
    }

    fn build(&self, site: &dyn AssemblyContext) -> Result<BuiltElement, SystemError> {
        let (mesh, body) = (site.mesh(self.beam), site.body(self.beam));
        let wrong = |source| SystemError::Beam { beam: self.name.clone(), source };
        let (relaxation, points) = (self.relaxation, body.control_points());
        let dashpots =
            Dashpots::new(mesh, points, site.variation(self.beam), relaxation).map_err(wrong)?;
        Ok(BuiltElement::Resistance(Box::new(DampedMaterial {
            name: format!("damping of beam '{}'", self.name),
            beam: self.beam,
            relaxation,
            movements: vec![[0.0; 3]; points.len()],
            dashpots,
            rate_history: RateHistory::default(),
            rotations: RotationIncrement::TangentScaled,
            dissipated: 0.0,
        })))
    }
}

struct DampedMaterial {
    name: String,
    beam: usize,
    relaxation: Relaxation,
    dashpots: Dashpots,
    movements: Vec<Movement>,
    rate_history: RateHistory,
    rotations: RotationIncrement,
    dissipated: f64,
}

impl DampedMaterial {
    fn gather(&mut self, bodies: &[Body], values: &[f64]) {
        let movements = bodies[self.beam].by_control_point(values);
        self.movements.iter_mut().zip(movements).for_each(|(to, from)| *to = from);
    }
}

fn scatter<'a>(degrees: &'a [[usize; 3]], out: &'a mut [f64]) -> impl FnMut(usize, Movement) + 'a {
    move |point, force| {
        degrees[point].iter().zip(force).for_each(|(&at, force)| out[at] += force);
    }
}

impl InternalForce for DampedMaterial {
    fn name(&self) -> &str {
        &self.name
    }

    fn begin_step(
        &mut self,
        interval: Interval,
        bodies: &[Body],
        rates: &[f64],
    ) -> Result<(), LoadError> {
        self.rate_history.begin(interval.duration());
        self.gather(bodies, rates);
        self.dashpots.begin_step(&self.movements);
        Ok(())
    }

    fn begin_movement(&mut self, _bodies: &[Body]) {
        self.rate_history.begin(f64::INFINITY);
        self.dashpots.rest_without_damping();
    }

    fn clear_rate_history(&mut self) {
        self.dashpots.clear_rate_history();
    }

    fn add_forces(&mut self, at: TrialState<'_>, out: &mut [f64]) -> ForceSummary {
        let Some(rates) = self.rate_history.at(at.stage, at.weight) else {
            return ForceSummary::default();
        };
        self.gather(at.bodies, at.increments);
        self.rotations = collocation(at.stage).rotations;
        let degrees = &at.bodies[self.beam].degrees_of_freedom;
        self.dashpots.add_forces(rates, &self.movements, &mut scatter(degrees, out))
    }

    fn add_linearised_forces(
        &mut self,
        at: TrialState<'_>,
        out: &mut [f64],
        unknowns: usize,
        tangent: &mut BandedMatrix,
    ) {
        let Some(rates) = self.rate_history.at(at.stage, at.weight) else { return };
        self.gather(at.bodies, at.increments);
        let degrees = &at.bodies[self.beam].degrees_of_freedom;
        let order = self.dashpots.order();
        let mut add = |first: usize, block: &[f64]| {
            let degrees = degrees[first..first + order].as_flattened();
            for (values, row) in block.chunks_exact(degrees.len()).zip(degrees) {
                for (value, column) in values.iter().zip(degrees) {
                    if *row < unknowns && *column < unknowns {
                        tangent.add(*row, *column, *value);
                    }
                }
            }
        };
        let give = &mut scatter(degrees, out);
        self.dashpots.add_linearised_forces(rates, &self.movements, give, &mut add);
    }

    fn add_mismatch_forces(&self, bodies: &[Body], _weight: f64, out: &mut [f64]) {
        let degrees = &bodies[self.beam].degrees_of_freedom;
        self.dashpots.add_mismatch_forces(&mut scatter(degrees, out));
    }

    fn correct(&mut self, bodies: &[Body], correction: &[f64]) {
        self.gather(bodies, correction);
        self.dashpots.correct(&self.movements);
    }

    fn exchange(&self, _bodies: &[Body], _duration: f64) -> WorkAndImpulse {
        WorkAndImpulse::default()
    }

    fn advance(&mut self, bodies: &[Body]) {
        let moved = bodies[self.beam].moved();
        self.dissipated +=
            self.dashpots.advance(moved, self.rotations, self.rate_history.duration());
        self.rate_history.end();
    }

    fn dissipated(&self) -> f64 {
        self.dissipated
    }

    fn transmitted(
        &self,
        bodies: &[Body],
        (beam, place): (usize, &SectionPlace),
        rates: &[f64],
    ) -> Option<(Vec2, f64)> {
        (beam == self.beam).then(|| {
            let rates: Vec<Movement> = bodies[beam].by_control_point(rates).collect();
            self.dashpots.transmitted(place, &rates)
        })
    }

    fn damped_beam(&self) -> Option<usize> {
        Some(self.beam)
    }

    fn add_forces_at_start(&self, bodies: &[Body], rates: &[Vec<Movement>], out: &mut [f64]) {
        let degrees = &bodies[self.beam].degrees_of_freedom;
        self.dashpots.emit_dashpot_forces(&rates[self.beam], &mut scatter(degrees, out));
    }

    fn each_damped_rate(&self, bodies: &[Body], rates: &[f64], take: &mut dyn FnMut(f64, f64)) {
        let rates: Vec<Movement> = bodies[self.beam].by_control_point(rates).collect();
        self.dashpots.each_damped_rate(&rates, take);
    }

    fn save(&self, state: &mut Vec<f64>) {
        self.rate_history.save(state);
        self.dashpots.save(state);
        state.push(self.dissipated);
    }

    fn restore(&mut self, next: &mut dyn FnMut() -> f64) {
        self.rate_history.restore(next);
        self.dashpots.restore(next);
        self.dissipated = next();
    }

    fn explain(&self) -> String {
        let Relaxation { axial, shear, bending } = self.relaxation;
        format!(
            "Kelvin–Voigt, relaxation times: axial {axial}, shear {shear}, bending {bending}; viscous forces at the quadrature points, eliminated from the matrix"
        )
    }
}
