//! Shapes of modes or of buckling, as displacements of control points.

use crate::beams::{BodyPoint, Mesh};
use crate::geometry::Vec2;
use crate::system::System;

/// Displacements of the control points of all bodies in several shapes.
#[derive(Debug, Clone)]
pub struct ModeShapes {
    meshes: Vec<Mesh>,
    /// Control points of all bodies in the configuration [length].
    points: Vec<Vec<Vec2>>,
    displacements: Vec<Vec<Vec<Vec2>>>,
}

impl ModeShapes {
    pub(crate) fn of<'s>(model: &System, shapes: impl Iterator<Item = &'s [f64]>) -> Self {
        Self {
            meshes: model.meshes().to_vec(),
            points: model.control_points().map(<[Vec2]>::to_vec).collect(),
            displacements: shapes.map(|shape| model.displacements(shape)).collect(),
        }
    }

    /// First body with the largest displacement in a shape, to six digits; `None` if nothing is displaced.
    pub(crate) fn most_displaced_body(&self, shape: usize) -> Option<usize> {
        let largest = self.largest(shape);
        let moves_most =
            |body: &Vec<Vec2>| body.iter().any(|by| by.norm() >= (1.0 - 1e-6) * largest);
        self.displacements[shape].iter().position(moves_most).filter(|_| largest > 0.0)
    }

    /// Number of shapes.
    pub fn count(&self) -> usize {
        self.displacements.len()
    }

    /// Meshes of the beams.
    pub fn meshes(&self) -> &[Mesh] {
        &self.meshes
    }

    /// Control points of all bodies in the configuration to which the displacements are added [length].
    pub fn points(&self) -> &[Vec<Vec2>] {
        &self.points
    }

    /// Larger side of the bounding box of the configuration [length].
    pub fn size(&self) -> f64 {
        let points = || self.points.iter().flatten();
        let side = |along: fn(&Vec2) -> f64| {
            let least = points().map(along).fold(f64::INFINITY, f64::min);
            points().map(along).fold(f64::NEG_INFINITY, f64::max) - least
        };
        side(|at| at.x).max(side(|at| at.y))
    }

    /// Configuration displaced by a shape. `amplitude` is the largest displacement of a control point [length].
    pub fn displaced(&self, shape: usize, amplitude: f64) -> Vec<Vec<Vec2>> {
        let largest = self.largest(shape);
        if largest == 0.0 {
            return self.points.clone();
        }
        let scale = amplitude / largest;
        let moved = |(points, by): (&Vec<Vec2>, &Vec<Vec2>)| {
            points.iter().zip(by).map(|(point, by)| point + by * scale).collect()
        };
        self.points.iter().zip(&self.displacements[shape]).map(moved).collect()
    }

    /// Displacement of a point in a shape, as a multiple of the largest displacement of a control point [-].
    pub fn displacement(&self, shape: usize, place: &BodyPoint) -> Vec2 {
        match self.largest(shape) {
            0.0 => Vec2::zeros(),
            largest => place.interpolate(&self.displacements[shape][place.body]) / largest,
        }
    }

    fn largest(&self, shape: usize) -> f64 {
        let points = self.displacements[shape].iter().flatten();
        points.map(|by| by.norm()).fold(0.0, f64::max)
    }
}
