//! How beams and particles look: lines to draw, and marks at knots or nodes.

use crate::beams::{Mesh, Place};
use crate::geometry::Vec2;
use crate::model::{BeamDefinition, ModelError, Scene};

/// Points along each span of a beam of higher degree.
const POINTS_A_SPAN: usize = 8;

/// Points along a span of a beam of some degree.
fn pieces(degree: usize) -> usize {
    if degree == 1 { 1 } else { POINTS_A_SPAN }
}

/// The places of a beam that a picture needs: points of its axis, and its knots or nodes.
#[derive(Debug, Clone)]
pub struct Outline {
    line: Vec<Place>,
    marks: Vec<Place>,
}

/// A configuration of a scene as it is drawn, in plain points [length].
#[derive(Debug, Clone, PartialEq)]
pub struct Configuration {
    /// The time of the configuration [time].
    pub time: f64,
    /// A line of points for each beam [length].
    pub lines: Vec<Vec<Vec2>>,
    /// The knots or nodes of all beams [length].
    pub marks: Vec<Vec2>,
    /// The places of the particles [length].
    pub particles: Vec<Vec2>,
}

impl Outline {
    /// The outlines of the beams of a scene on their meshes.
    ///
    /// # Errors
    /// When an axis has a point without a tangent.
    pub fn of_scene(scene: &Scene, meshes: &[Mesh]) -> Result<Vec<Self>, ModelError> {
        let of_beam = |(index, (beam, mesh)): (usize, (&BeamDefinition, &Mesh))| {
            let place = |xi: f64| {
                Place::at(index, &beam.axis, mesh, xi).map_err(|source| ModelError::Beam {
                    beam: beam.name.clone(),
                    source: source.into(),
                })
            };
            Ok(Self {
                line: Self::parameters(mesh).into_iter().map(place).collect::<Result<_, _>>()?,
                marks: mesh.basis().breaks().into_iter().map(place).collect::<Result<_, _>>()?,
            })
        };
        scene.beams.iter().zip(meshes).enumerate().map(of_beam).collect()
    }

    /// The parameters of a mesh at the places of its line: the breaks, and evenly between them.
    pub(super) fn parameters(mesh: &Mesh) -> Vec<f64> {
        let pieces = pieces(mesh.basis().degree());
        let within = |pair: &[f64]| {
            let (start, end) = (pair[0], pair[1]);
            (0..pieces).map(move |i| start + (end - start) * i as f64 / pieces as f64)
        };
        let breaks = mesh.basis().breaks();
        breaks.windows(2).flat_map(within).chain(breaks.last().copied()).collect()
    }

    /// How many places of the line further the next station of the axis is: there are two a span, and one where spans are straight.
    pub fn places_a_station(degree: usize) -> usize {
        pieces(degree).div_ceil(2)
    }

    /// Stations of the axis between two knots.
    pub fn stations_within_a_span(degree: usize) -> usize {
        pieces(degree) / Self::places_a_station(degree) - 1
    }

    /// The places of the centre line, from its start to its end.
    pub fn line(&self) -> &[Place] {
        &self.line
    }

    /// The knots or nodes.
    pub fn marks(&self) -> &[Place] {
        &self.marks
    }

    /// The configuration as drawn from the control points of all bodies [length]: one beam after another, then the particles.
    pub fn draw(outlines: &[Self], time: f64, control_points: &[&[Vec2]]) -> Configuration {
        let at = |place: &Place| place.interpolate(control_points[place.body]);
        Configuration {
            time,
            lines: outlines.iter().map(|outline| outline.line.iter().map(at).collect()).collect(),
            marks: outlines.iter().flat_map(|outline| outline.marks.iter().map(at)).collect(),
            particles: control_points[outlines.len()..].iter().flat_map(|of| of.to_vec()).collect(),
        }
    }
}
