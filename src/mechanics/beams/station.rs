//! Positions on a body.

use serde::{Deserialize, Serialize};

use super::Mesh;
use crate::geometry::{Curve, GeometryError, MAX_DEGREE, ROUNDING_OF_PLACES, Vec2, corresponding};

/// Body of a scene: a beam, a particle, or a point of a rigid body.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
pub enum BodyIndex {
    /// Index among the beams of the scene.
    Beam(usize),
    /// Index among the particles of the scene.
    Particle(usize),
    /// Index among the rigid bodies of the scene, and index of the point: the centre of mass (0) or another point (from 1).
    Rigid(usize, usize),
}

/// Position on a body of a scene.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct Station {
    /// Body of the station.
    pub body: BodyIndex,
    /// Arc length of the station from the start of the beam in the initial configuration [length]; zero on particles and rigid bodies.
    pub arc_length: f64,
}

/// Position on a body of a model, with the basis functions that are nonzero at this position.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct BodyPoint {
    /// Index of the body in the model: beams, then particles, then rigid bodies.
    pub body: usize,
    /// First control point whose basis function is nonzero at this position.
    pub first: usize,
    shape: [f64; MAX_DEGREE + 1],
    order: usize,
    /// Initial angle of the axis tangent, or of the rigid body [rad].
    pub tangent_angle: f64,
}

impl Station {
    /// Station of a beam at an initial arc length [length].
    pub fn on_beam(beam: usize, arc_length: f64) -> Self {
        Self { body: BodyIndex::Beam(beam), arc_length }
    }

    /// Station of a particle.
    pub fn on_particle(particle: usize) -> Self {
        Self { body: BodyIndex::Particle(particle), arc_length: 0.0 }
    }

    /// Station at the centre of mass (0) or another point (from 1) of a rigid body.
    pub fn on_rigid_body(body: usize, point: usize) -> Self {
        Self { body: BodyIndex::Rigid(body, point), arc_length: 0.0 }
    }

    /// Returns true if two stations coincide within rounding. `length` is the length of the body.
    pub fn is_at(&self, other: &Self, length: f64) -> bool {
        let apart = (self.arc_length - other.arc_length).abs();
        self.body == other.body && apart <= ROUNDING_OF_PLACES * length
    }

    /// Index of the beam of the station; `None` for stations of other bodies.
    pub fn beam(&self) -> Option<usize> {
        match self.body {
            BodyIndex::Beam(beam) => Some(beam),
            BodyIndex::Particle(_) | BodyIndex::Rigid(..) => None,
        }
    }

    /// Returns true if the body of the station has a rotation. A particle has no rotation.
    pub fn turns(&self) -> bool {
        !matches!(self.body, BodyIndex::Particle(_))
    }

    /// Parameter of the mesh [-] at this station.
    ///
    /// # Errors
    /// Fails if the station lies outside the axis.
    pub fn parameter(&self, axis: &Curve, mesh: &Mesh) -> Result<f64, GeometryError> {
        let along = axis.parameter_at(self.arc_length)?;
        Ok(corresponding(along, axis.domain(), mesh.basis().domain()))
    }
}

impl BodyPoint {
    /// Position of a particle.
    pub fn of_particle(body: usize) -> Self {
        Self::of_point(body, 0, 0.0)
    }

    /// Position of a point of a rigid body whose initial angle is `angle` [rad].
    /// The argument `point` is the index of the control point: 0 for the centre of mass, and 1 or more for the other points.
    pub fn of_point(body: usize, point: usize, angle: f64) -> Self {
        let mut shape = [0.0; MAX_DEGREE + 1];
        shape[0] = 1.0;
        Self { body, first: point, shape, order: 1, tangent_angle: angle }
    }

    /// Position on a beam at a parameter of its mesh.
    ///
    /// # Errors
    /// Fails if the parameter lies outside the mesh, or if the axis has no tangent at the parameter.
    pub fn at(body: usize, axis: &Curve, mesh: &Mesh, xi: f64) -> Result<Self, GeometryError> {
        let values = mesh.basis().evaluate(xi)?;
        // At a break, some functions of the span are zero. The control points of these functions are left out.
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

    /// Values of the basis functions that are nonzero at this position [-].
    pub fn shape(&self) -> &[f64] {
        &self.shape[..self.order]
    }

    /// Pairs of a control point and the value of its basis function at this position.
    pub fn weights(&self) -> impl Iterator<Item = (usize, f64)> + '_ {
        (self.first..).zip(self.shape().iter().copied())
    }

    pub(crate) fn nearest_control_point(&self) -> usize {
        self.weights()
            .max_by(|(_, a), (_, b)| a.total_cmp(b))
            .map_or(self.first, |(index, _)| index)
    }

    /// Interpolates values of control points at this position.
    pub fn interpolate(&self, values: &[Vec2]) -> Vec2 {
        let points = &values[self.first..self.first + self.order];
        points.iter().zip(self.shape()).fold(Vec2::zeros(), |sum, (point, by)| sum + point * *by)
    }
}
