//! Places of a body.

use serde::{Deserialize, Serialize};

use super::Mesh;
use crate::geometry::{Curve, GeometryError, MAX_DEGREE, ROUNDING_OF_PLACES, Vec2, corresponding};

/// One of the bodies of a scene: a beam, a particle, or a rigid body with one of its points.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
pub enum BodyIndex {
    /// The body is a beam, by its index among the beams of the scene.
    Beam(usize),
    /// The body is a particle, by its index among the particles of the scene.
    Particle(usize),
    /// The body is a rigid one, by its index among the rigid bodies of the scene, seen at its centre of mass (0) or at one of its points (from 1 on).
    Rigid(usize, usize),
}

/// A place on a body of a scene.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct Station {
    /// The body on which the station is.
    pub body: BodyIndex,
    /// The arc length of the station from the start of the beam as drawn; zero on a particle and on a rigid body [length].
    pub arc_length: f64,
}

/// A place on a body of a model, with the basis functions that are not zero there.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct BodyPoint {
    /// The index of the body in the model: beams come first, then particles, then rigid bodies.
    pub body: usize,
    /// The index of the first control point whose function is not zero at this place.
    pub first: usize,
    shape: [f64; MAX_DEGREE + 1],
    order: usize,
    /// The direction of the axis as drawn at this place, or the angle of a rigid body [rad].
    pub tangent_angle: f64,
}

impl Station {
    /// The station of a beam, by its index, at an arc length [length] from its start as drawn.
    pub fn on_beam(beam: usize, arc_length: f64) -> Self {
        Self { body: BodyIndex::Beam(beam), arc_length }
    }

    /// The only station of a particle.
    pub fn on_particle(particle: usize) -> Self {
        Self { body: BodyIndex::Particle(particle), arc_length: 0.0 }
    }

    /// The centre of mass (0) of a rigid body, by its index, or one of its points (from 1 on).
    pub fn on_rigid_body(body: usize, point: usize) -> Self {
        Self { body: BodyIndex::Rigid(body, point), arc_length: 0.0 }
    }

    /// Whether both are one place but for rounding, on a body of a length.
    pub fn is_at(&self, other: &Self, length: f64) -> bool {
        let apart = (self.arc_length - other.arc_length).abs();
        self.body == other.body && apart <= ROUNDING_OF_PLACES * length
    }

    /// The index of the beam that the station is on, if it is on one.
    pub fn beam(&self) -> Option<usize> {
        match self.body {
            BodyIndex::Beam(beam) => Some(beam),
            BodyIndex::Particle(_) | BodyIndex::Rigid(..) => None,
        }
    }

    /// Whether the body turns at the station: all but particles do.
    pub fn turns(&self) -> bool {
        !matches!(self.body, BodyIndex::Particle(_))
    }

    /// The parameter of the mesh [-] at this station of an axis.
    ///
    /// # Errors
    /// When the station lies outside the axis.
    pub fn parameter(&self, axis: &Curve, mesh: &Mesh) -> Result<f64, GeometryError> {
        let along = axis.parameter_at(self.arc_length)?;
        Ok(corresponding(along, axis.domain(), mesh.basis().domain()))
    }
}

impl BodyPoint {
    /// The place of a particle: its one control point.
    pub fn of_particle(body: usize) -> Self {
        Self::of_point(body, 0, 0.0)
    }

    /// The place of a point of a rigid body, by its control point: 0 is the centre of mass; the body as drawn is turned by an angle [rad].
    pub fn of_point(body: usize, point: usize, angle: f64) -> Self {
        let mut shape = [0.0; MAX_DEGREE + 1];
        shape[0] = 1.0;
        Self { body, first: point, shape, order: 1, tangent_angle: angle }
    }

    /// The place of a beam at a parameter of its mesh.
    ///
    /// # Errors
    /// When the parameter lies outside the mesh, or the axis has no tangent there.
    pub fn at(body: usize, axis: &Curve, mesh: &Mesh, xi: f64) -> Result<Self, GeometryError> {
        let values = mesh.basis().evaluate(xi)?;
        // At a break some functions of the span are zero: who stands there neither reads nor moves their control points.
        let is_here = |value: &f64| *value != 0.0;
        let skipped = values.values().iter().position(is_here).unwrap_or(0);
        let last = values.values().iter().rposition(is_here).unwrap_or(0);
        let here = &values.values()[skipped..=last];
        let mut shape = [0.0; MAX_DEGREE + 1];
        shape[..here.len()].copy_from_slice(here);
        let tangent_angle =
            axis.tangent_angle(corresponding(xi, mesh.basis().domain(), axis.domain()))?;
        Ok(Self { body, first: values.first + skipped, shape, order: here.len(), tangent_angle })
    }

    /// The values of the basis functions that are not zero at this place [-].
    pub fn shape(&self) -> &[f64] {
        &self.shape[..self.order]
    }

    /// The control points of this place with their basis functions: (index, value).
    pub fn weights(&self) -> impl Iterator<Item = (usize, f64)> + '_ {
        (self.first..).zip(self.shape().iter().copied())
    }

    /// The index of the control point with the largest function at this place: the one that lies there where the mesh has a break.
    pub fn nearest_control_point(&self) -> usize {
        self.weights()
            .max_by(|(_, a), (_, b)| a.total_cmp(b))
            .map_or(self.first, |(index, _)| index)
    }

    /// The combination of control values that belongs to this place, in their unit.
    pub fn interpolate(&self, values: &[Vec2]) -> Vec2 {
        self.weights().map(|(index, weight)| values[index] * weight).sum()
    }
}
