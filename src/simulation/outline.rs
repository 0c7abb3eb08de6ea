//! How the beams look: lines to draw, and marks at knots or nodes.

use crate::beams::{Mesh, Place, Station};
use crate::geometry::Vec2;
use crate::model::Scene;

/// Points along each span of a beam of higher degree.
const POINTS_A_SPAN: usize = 8;

/// The places of a beam that a picture needs.
#[derive(Debug, Clone)]
pub struct Outline {
    line: Vec<Place>,
    marks: Vec<Place>,
}

/// A configuration as it is drawn.
#[derive(Debug, Clone, PartialEq)]
pub struct Configuration {
    /// When.
    pub time: f64,
    /// A line for each beam.
    pub lines: Vec<Vec<Vec2>>,
    /// Knots or nodes of all beams.
    pub marks: Vec<Vec2>,
}

impl Outline {
    /// The outlines of the beams of a scene on their meshes.
    pub fn of_scene(scene: &Scene, meshes: &[Mesh]) -> Vec<Self> {
        scene
            .beams
            .iter()
            .zip(meshes)
            .enumerate()
            .map(|(index, (beam, mesh))| {
                let place = |xi: f64| {
                    let ((a, b), (c, d)) = (mesh.basis().domain(), beam.axis.domain());
                    let along = if xi == b { d } else { c + (xi - a) * (d - c) / (b - a) };
                    let arc_length = beam.axis.length_to(along).ok()?;
                    Station { beam: index, arc_length }.place(&beam.axis, mesh).ok()
                };
                let pieces = if mesh.basis().degree() == 1 { 1 } else { POINTS_A_SPAN };
                let within = |pair: &[f64]| {
                    let (start, end) = (pair[0], pair[1]);
                    (0..pieces).map(move |i| start + (end - start) * i as f64 / pieces as f64)
                };
                let breaks = mesh.basis().breaks();
                let parameters = breaks.windows(2).flat_map(within).chain(breaks.last().copied());
                Self {
                    line: parameters.filter_map(place).collect(),
                    marks: breaks.iter().copied().filter_map(place).collect(),
                }
            })
            .collect()
    }

    /// The lines and marks of control points of all beams, one beam after another.
    pub fn draw(outlines: &[Self], time: f64, control_points: &[&[Vec2]]) -> Configuration {
        let at = |place: &Place| place.interpolate(control_points[place.beam]);
        Configuration {
            time,
            lines: outlines.iter().map(|outline| outline.line.iter().map(at).collect()).collect(),
            marks: outlines.iter().flat_map(|outline| outline.marks.iter().map(at)).collect(),
        }
    }
}
