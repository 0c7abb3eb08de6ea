//! Definition of an obstacle in a scene.

use serde::{Deserialize, Serialize};

use super::forces::{ObstacleForces, TouchingBody};
use super::point::{ContactPoint, Surface};
use crate::beams::Station;
use crate::geometry::Vec2;
use crate::system::SystemError;
use crate::system::elements::contact::{
    ContactLaw, ContactTarget, LEAST_RESTITUTION, NormalLaw, contact_parameters, damping_factor,
};
use crate::system::elements::element::{AssemblyContext, BuiltElement, ElementDef, SceneChecks};
use crate::system::errors::finite;

/// Shape of an obstacle.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub enum ObstacleShape {
    /// Half-plane with a straight boundary.
    HalfPlane {
        /// Point of the boundary of the half-plane [length].
        point: Vec2,
        /// Outer unit normal of the half-plane [-].
        normal: Vec2,
    },
    /// Circular disc as obstacle.
    Disc {
        /// Centre of the disc [length].
        centre: Vec2,
        /// Radius of the disc [length].
        radius: f64,
    },
}

/// Obstacle that is fixed to the ground. Its contact force is a function of the gap.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Obstacle {
    /// Name of the obstacle in messages and columns.
    pub name: String,
    /// Shape of the obstacle.
    pub shape: ObstacleShape,
    /// Bodies that can touch the obstacle; empty for all beams and particles of the scene.
    pub targets: Vec<ContactTarget>,
    /// Distance between the surface and the axis of a body that touches the obstacle [length].
    pub radius: f64,
    /// Force per penetration on a point [force/length], or force per length and penetration on a beam [force/length²].
    pub stiffness: f64,
    /// Coefficient of restitution of an impact that the steps resolve [-]; 1 for an elastic contact.
    pub restitution: f64,
    /// Coefficient of friction [-].
    #[serde(default)]
    pub friction: f64,
}

impl Obstacle {
    /// Type and name of the obstacle for messages.
    pub fn object(&self) -> String {
        format!("obstacle '{}'", self.name)
    }

    fn refuse(&self, name: &'static str, value: f64, allowed: &'static str) -> SystemError {
        SystemError::Value { object: self.object(), name, value, allowed }
    }

    fn targets_in(&self, scene: &dyn SceneChecks) -> Vec<ContactTarget> {
        if self.targets.is_empty() { scene.contact_targets() } else { self.targets.clone() }
    }

    fn surface(&self) -> Surface {
        let Self { shape, radius, stiffness, restitution, friction, .. } = *self;
        let law = match shape {
            ObstacleShape::HalfPlane { .. } => ContactLaw::HalfPlane { stiffness },
            ObstacleShape::Disc { radius: of_disc, .. } => {
                ContactLaw::Disc { stiffness, radius: of_disc + radius }
            }
        };
        let law = NormalLaw { elastic: law, damping: damping_factor(restitution) };
        Surface { shape, radius, law, friction }
    }
}

impl ElementDef for Obstacle {
    fn check(&self, setting: &dyn SceneChecks) -> Result<(), SystemError> {
        let name = self.object();
        match self.shape {
            ObstacleShape::HalfPlane { point, normal } => {
                finite(&name, "point", point.as_slice())?;
                finite(&name, "normal", normal.as_slice())?;
                let length = normal.norm();
                if (length - 1.0).abs() > 1e-12 {
                    return Err(self.refuse("length of the normal", length, "1"));
                }
            }
            ObstacleShape::Disc { centre, radius } => {
                finite(&name, "centre", centre.as_slice())?;
                if !(radius.is_finite() && radius > 0.0) {
                    let allowed = "a positive finite number [length]";
                    return Err(self.refuse("radius of the disc", radius, allowed));
                }
            }
        }
        let Self { radius, stiffness, restitution, friction, .. } = *self;
        if !(friction.is_finite() && friction >= 0.0) {
            return Err(self.refuse("friction", friction, "zero or a positive finite number"));
        }
        if !(radius.is_finite() && radius >= 0.0) {
            let allowed = "zero or a positive finite number [length]";
            return Err(self.refuse("radius", radius, allowed));
        }
        if !(stiffness.is_finite() && stiffness > 0.0) {
            return Err(self.refuse("stiffness", stiffness, "a positive finite number"));
        }
        if !(LEAST_RESTITUTION..=1.0).contains(&restitution) {
            return Err(self.refuse("restitution", restitution, "a number from 0.05 to 1"));
        }
        for target in &self.targets {
            setting.check_station("an obstacle", &target.station())?;
        }
        Ok(())
    }

    fn coupled(&self, scene: &dyn SceneChecks) -> Vec<Vec<Station>> {
        let station = |target: ContactTarget| match target {
            ContactTarget::Beam(_) => None,
            ContactTarget::Point(station) => Some(vec![station]),
        };
        self.targets_in(scene).into_iter().filter_map(station).collect()
    }

    fn build(&self, site: &dyn AssemblyContext) -> Result<BuiltElement, SystemError> {
        let touching = |target: &ContactTarget| match target {
            ContactTarget::Beam(beam) => points_of_beam(site, *beam),
            ContactTarget::Point(station) => {
                let place = site.place(station)?;
                Ok(vec![ContactPoint::new(place, 1.0)])
            }
        };
        let (targets, surface) = (self.targets_in(site.scene()), self.surface());
        if targets.is_empty() {
            let allowed = "at least 1; name points of rigid bodies as its bodies";
            return Err(self.refuse("number of bodies that can touch it", 0.0, allowed));
        }
        let bodies = targets.iter().map(|target| {
            let mut points = touching(target)?;
            if surface.friction > 0.0 {
                points = points.into_iter().map(|point| point.with_friction(&surface)).collect();
            }
            Ok(TouchingBody::new(points))
        });
        let bodies = bodies.collect::<Result<_, SystemError>>()?;
        let forces = ObstacleForces::new(self.name.clone(), surface, bodies);
        Ok(BuiltElement::Resistance(Box::new(forces)))
    }
}

fn points_of_beam(
    site: &dyn AssemblyContext,
    beam: usize,
) -> Result<Vec<ContactPoint>, SystemError> {
    let parameters = contact_parameters(site.mesh(beam), site.body(beam).control_points());
    let point = |(xi, weight)| Ok(ContactPoint::new(site.place_at(beam, xi)?, weight));
    parameters.into_iter().map(point).collect()
}
