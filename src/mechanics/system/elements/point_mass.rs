//! Point masses.

use serde::{Deserialize, Serialize};

use super::element::{AssemblyContext, BuiltElement, ElementDef, SceneChecks};
use crate::beams::{BodyPoint, Station};
use crate::geometry::{Vec2, cross};
use crate::system::bodies::{Body, Momenta};
use crate::system::{SystemError, Turning};

/// Definition of a point mass in a scene.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct PointMass {
    /// Station of the point mass.
    pub station: Station,
    /// Mass [mass].
    pub mass: f64,
    /// Rotary inertia [mass·length²].
    pub rotary_inertia: f64,
}

impl ElementDef for PointMass {
    fn check(&self, setting: &dyn SceneChecks) -> Result<(), SystemError> {
        setting.check_station("a mass", &self.station)?;
        let Self { station, mass, rotary_inertia } = self;
        let object = || format!("mass at {}", setting.describe(station));
        let refused = |name, value, allowed| {
            Err(SystemError::Value { object: object(), name, value, allowed })
        };
        // A pure rotary inertia, such as a flywheel on its shaft, has no mass.
        let is_light = *mass == 0.0 && *rotary_inertia > 0.0;
        if !(mass.is_finite() && (*mass > 0.0 || is_light)) {
            let allowed = match station.turns() && *mass == 0.0 {
                true => "positive if the inertia is zero [mass]",
                false => "a positive finite number [mass]",
            };
            return refused("mass", *mass, allowed);
        }
        if !(rotary_inertia.is_finite() && *rotary_inertia >= 0.0) {
            let allowed = "zero or a positive finite number [mass·length²]";
            return refused("rotary inertia", *rotary_inertia, allowed);
        }
        if *rotary_inertia > 0.0 && !station.turns() {
            let by = Turning::RotaryInertia;
            return Err(SystemError::ParticleTurned { object: object(), by });
        }
        Ok(())
    }

    fn build(&self, site: &dyn AssemblyContext) -> Result<BuiltElement, SystemError> {
        let Self { mass, rotary_inertia, .. } = *self;
        Ok(BuiltElement::PointMass(NodalMass {
            place: site.place(&self.station)?,
            mass,
            rotary_inertia,
        }))
    }
}

/// Point mass on a body of a model. Its inertia is distributed to the control points whose basis functions are nonzero at the point mass.
#[derive(Debug, Clone, Copy)]
pub struct NodalMass {
    pub place: BodyPoint,
    pub mass: f64,
    pub rotary_inertia: f64,
}

impl NodalMass {
    fn inertia(&self) -> [f64; 3] {
        [self.mass, self.mass, self.rotary_inertia]
    }

    pub fn add_inertia(&self, bodies: &[Body], factor: f64, rates: &[f64], out: &mut [f64]) {
        let body = &bodies[self.place.body];
        let rate = body.at(&self.place, rates);
        for (point, weight) in self.place.weights() {
            for ((&at, inertia), rate) in
                body.degrees_of_freedom[point].iter().zip(self.inertia()).zip(rate)
            {
                out[at] += factor * weight * inertia * rate;
            }
        }
    }

    /// Calls `add` with the row, column and value of each entry of `factor · M`, where `M` is the mass matrix of the point mass.
    /// The caller must add up values for the same row and column.
    pub fn inertia_entries(
        &self,
        bodies: &[Body],
        factor: f64,
        unknowns: usize,
        add: &mut impl FnMut(usize, usize, f64),
    ) {
        let body = &bodies[self.place.body];
        for (a, weight_a) in self.place.weights() {
            for (b, weight_b) in self.place.weights() {
                let degrees = body.degrees_of_freedom[a].iter().zip(&body.degrees_of_freedom[b]);
                for ((&row, &column), inertia) in degrees.zip(self.inertia()) {
                    if row < unknowns && column < unknowns {
                        add(row, column, factor * weight_a * weight_b * inertia);
                    }
                }
            }
        }
    }

    pub fn momenta(&self, bodies: &[Body], rates: &[f64]) -> Momenta {
        let body = &bodies[self.place.body];
        let [vx, vy, spin] = body.at(&self.place, rates);
        let velocity = Vec2::new(vx, vy);
        let linear = velocity * self.mass;
        let at = self.place.interpolate(body.dynamics.control_points());
        let turning = self.rotary_inertia * spin;
        Momenta {
            twice_kinetic: linear.dot(&velocity) + turning * spin,
            linear,
            angular: cross(at, linear) + turning,
        }
    }
}
