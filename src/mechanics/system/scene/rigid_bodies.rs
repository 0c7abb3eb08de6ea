//! Rigid bodies of a scene, and access to their points by name.

use super::{RigidBodyDefinition, Scene};
use crate::beams::Station;
use crate::geometry::Vec2;
use crate::system::SystemError;
use crate::system::elements::PointMass;
use crate::system::errors::{check_name, finite};

const CENTRE: &str = "centre";

impl Scene {
    /// Index of the first rigid body among all bodies, after beams and particles.
    pub fn first_rigid_body(&self) -> usize {
        self.beams.len() + self.particles.len()
    }

    /// Adds a rigid body with a mass [mass] and an inertia about its centre of mass [mass·length²], and returns its index.
    ///
    /// Either the mass or the inertia may be zero. Other objects must then restrain the motions without inertia.
    ///
    /// # Errors
    /// Fails if the name is taken, two points share a name, a number is not finite or is negative, or mass and inertia are both zero.
    /// Also fails if the outline is not a polygon, or if a body with an outline has no point off its centre of mass.
    pub fn add_rigid_body(
        &mut self,
        body: RigidBodyDefinition,
        mass: f64,
        rotary_inertia: f64,
    ) -> Result<usize, SystemError> {
        self.check_rigid_body(&body)?;
        self.rigid_bodies.push(body);
        let index = self.rigid_bodies.len() - 1;
        let station = Station::on_rigid_body(index, 0);
        self.add_mass(PointMass { station, mass, rotary_inertia }).inspect_err(|_| {
            self.rigid_bodies.pop();
        })?;
        Ok(index)
    }

    pub(super) fn check_rigid_body(&self, body: &RigidBodyDefinition) -> Result<(), SystemError> {
        self.check_name("body", &body.name)?;
        let object = format!("body '{}'", body.name);
        finite(&object, "place", body.position.as_slice())?;
        finite(&object, "angle", &[body.angle])?;
        finite(&object, "velocity", body.motion.velocity.as_slice())?;
        finite(&object, "spin", &[body.motion.spin])?;
        for corner in &body.outline {
            finite(&object, "corner of the outline", corner.as_slice())?;
        }
        if let Some(why) = body.outline_refused() {
            return Err(SystemError::Outline { body: body.name.clone(), reason: why });
        }
        finite(&object, "about", body.motion.centre.as_ref().map_or(&[], |at| at.as_slice()))?;
        for (at, (name, place)) in body.points.iter().enumerate() {
            finite(&object, "point", place.as_slice())?;
            check_name("point", name)?;
            if name == CENTRE && *place != Vec2::zeros() {
                let (kind, why) = ("point", "this is the name of the centre of mass");
                return Err(SystemError::Unnamed { kind, name: name.clone(), reason: why });
            }
            if body.points[..at].iter().any(|(other, _)| other == name) {
                let name = name.clone();
                return Err(SystemError::DuplicateName { kind: "point", new: "point", name });
            }
        }
        Ok(())
    }

    /// Returns the station at a named point of a rigid body.
    ///
    /// # Errors
    /// Fails if the point does not exist. The error lists the points of the body.
    pub fn point_of_body(&self, body: usize, point: &str) -> Result<Station, SystemError> {
        let definition = &self.rigid_bodies[body];
        let found = definition.control_point(point);
        let found = found.ok_or_else(|| {
            let known = definition.points.iter().map(|(name, _)| format!("'{name}'"));
            SystemError::NoPoint {
                body: definition.name.clone(),
                point: point.to_owned(),
                known: known.collect::<Vec<_>>().join(", "),
            }
        })?;
        Ok(Station::on_rigid_body(body, found))
    }

    pub(super) fn describe_point(&self, body: usize, point: usize) -> String {
        let RigidBodyDefinition { name, points, .. } = &self.rigid_bodies[body];
        match point.checked_sub(1).and_then(|at| points.get(at)) {
            Some((point, _)) => format!("point '{point}' of body '{name}'"),
            None => format!("the centre of body '{name}'"),
        }
    }
}
