//! Places of a beam.

use super::Mesh;
use crate::geometry::{Curve, GeometryError, MAX_DEGREE, Vec2, corresponding};

/// A place on a beam of a scene.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Station {
    /// The index of the beam in its scene.
    pub beam: usize,
    /// The arc length from the start of the beam as drawn [length].
    pub arc_length: f64,
}

/// A place with the basis functions that are non-zero there.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Place {
    /// The index of the beam in its scene.
    pub beam: usize,
    /// The first control point with a non-zero function.
    pub first: usize,
    shape: [f64; MAX_DEGREE + 1],
    order: usize,
    /// The direction of the axis as drawn [rad].
    pub tangent_angle: f64,
}

impl Station {
    /// The parameter of the mesh at this station of an axis.
    ///
    /// # Errors
    /// When the station lies outside the axis.
    pub fn parameter(&self, axis: &Curve, mesh: &Mesh) -> Result<f64, GeometryError> {
        let along = axis.parameter_at(self.arc_length)?;
        Ok(corresponding(along, axis.domain(), mesh.basis().domain()))
    }

    /// The basis functions at this station.
    ///
    /// # Errors
    /// When the station lies outside the axis.
    pub fn place(&self, axis: &Curve, mesh: &Mesh) -> Result<Place, GeometryError> {
        Place::at(self.beam, axis, mesh, self.parameter(axis, mesh)?)
    }
}

impl Place {
    /// The place of a beam at a parameter of its mesh.
    ///
    /// # Errors
    /// When the parameter lies outside the mesh, or the axis has no tangent there.
    pub fn at(beam: usize, axis: &Curve, mesh: &Mesh, xi: f64) -> Result<Self, GeometryError> {
        let values = mesh.basis().evaluate(xi)?;
        let mut shape = [0.0; MAX_DEGREE + 1];
        let order = values.values().len();
        shape[..order].copy_from_slice(values.values());
        let tangent_angle =
            axis.tangent_angle(corresponding(xi, mesh.basis().domain(), axis.domain()))?;
        Ok(Self { beam, first: values.first, shape, order, tangent_angle })
    }

    /// The basis functions that are non-zero here.
    pub fn shape(&self) -> &[f64] {
        &self.shape[..self.order]
    }

    /// The control points with their functions: (index, value).
    pub fn weights(&self) -> impl Iterator<Item = (usize, f64)> + '_ {
        (self.first..).zip(self.shape().iter().copied())
    }

    /// The control point with the largest function here: the one that lies at this place where the mesh has a break.
    pub fn nearest_control_point(&self) -> usize {
        self.weights()
            .max_by(|(_, a), (_, b)| a.total_cmp(b))
            .map_or(self.first, |(index, _)| index)
    }

    /// The combination of control values that belongs to this place.
    pub fn interpolate(&self, values: &[Vec2]) -> Vec2 {
        self.weights().map(|(index, weight)| values[index] * weight).sum()
    }
}
