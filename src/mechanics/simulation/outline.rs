//! Geometry of beams, particles and rigid bodies for drawing: lines, and marks at knots or nodes.

use crate::beams::{BodyPoint, Mesh};
use crate::elementary::atan2;
use crate::geometry::{Vec2, cross, perpendicular};
use crate::system::{BeamDefinition, RigidBodyDefinition, Scene, SystemError};

const POINTS_A_SPAN: usize = 8;

fn pieces(degree: usize) -> usize {
    if degree == 1 { 1 } else { POINTS_A_SPAN }
}

/// Points that define the drawing of a body: points of a beam axis and its knots or nodes, or points of a rigid body.
#[derive(Debug, Clone)]
pub struct Outline {
    line: Vec<BodyPoint>,
    marks: Vec<BodyPoint>,
    corners: Vec<Vec2>,
}

/// Configuration of a scene for drawing, given by the coordinates of points [length].
#[derive(Debug, Clone, PartialEq)]
pub struct DrawnConfiguration {
    /// Time of the configuration [time].
    pub time: f64,
    /// Polyline of each beam [length].
    pub lines: Vec<Vec<Vec2>>,
    /// Polyline around each rigid body that has further points than its centre [length].
    pub bodies: Vec<Vec<Vec2>>,
    /// Positions of the knots or nodes of all beams [length].
    pub marks: Vec<Vec2>,
    /// Positions of the particles, followed by the centres of rigid bodies [length].
    pub particles: Vec<Vec2>,
}

impl Outline {
    /// Creates the outlines of the beams of a scene on their meshes, followed by the outlines of rigid bodies with points off the centre.
    ///
    /// # Errors
    /// Fails if an axis has a point without a tangent.
    pub fn of_scene(scene: &Scene, meshes: &[Mesh]) -> Result<Vec<Self>, SystemError> {
        let of_beam = |(index, (beam, mesh)): (usize, (&BeamDefinition, &Mesh))| {
            let place = |xi: f64| {
                BodyPoint::at(index, &beam.axis, mesh, xi).map_err(|source| SystemError::Beam {
                    beam: beam.name.clone(),
                    source: source.into(),
                })
            };
            Ok(Self {
                line: Self::parameters(mesh).into_iter().map(place).collect::<Result<_, _>>()?,
                marks: mesh.basis().breaks().into_iter().map(place).collect::<Result<_, _>>()?,
                corners: Vec::new(),
            })
        };
        let first = scene.first_rigid_body();
        let bodies = (first..).zip(&scene.rigid_bodies);
        let bodies = bodies.filter(|(_, body)| body.links().next().is_some());
        let bodies = bodies.map(|(index, body)| Ok(Self::of_rigid_body(index, body)));
        scene.beams.iter().zip(meshes).enumerate().map(of_beam).chain(bodies).collect()
    }

    fn of_rigid_body(index: usize, body: &RigidBodyDefinition) -> Self {
        if !body.outline.is_empty() {
            return Self::polygon(index, body);
        }
        let mut points: Vec<usize> = body.links().collect();
        let direction = |point: &usize| {
            let place = body.points[point - 1].1;
            atan2(place.y, place.x)
        };
        points.sort_by(|a, b| direction(a).total_cmp(&direction(b)));
        match points.as_slice() {
            [only] => points = vec![0, *only],
            [one, other] => points = vec![*one, 0, *other],
            _ => points.extend(points.first().copied()),
        }
        let place = |point| BodyPoint::of_point(index, point, body.angle);
        let line = points.into_iter().map(place).collect();
        Self { line, marks: Vec::new(), corners: Vec::new() }
    }

    fn polygon(index: usize, body: &RigidBodyDefinition) -> Self {
        let at = |point: &usize| body.points[point - 1].1;
        let farther = |a: &usize, b: &usize| at(a).norm().total_cmp(&at(b).norm());
        let point = body.links().max_by(farther).unwrap_or(0);
        let arm = if point == 0 { Vec2::new(1.0, 0.0) } else { at(&point) };
        let size = arm.norm_squared();
        let seen = |corner: &Vec2| Vec2::new(arm.dot(corner), cross(arm, *corner)) / size;
        let corners = body.outline.iter().chain(body.outline.first()).map(seen).collect();
        let line = [0, point].map(|point| BodyPoint::of_point(index, point, body.angle));
        Self { line: line.into(), marks: Vec::new(), corners }
    }

    /// Corners of the closed polygon of a rigid body, relative to the line between the two points of [`line`](Self::line).
    /// The first coordinate of a corner is along the line, the second coordinate is to its left. The unit is the length of the line.
    pub fn corners(&self) -> &[Vec2] {
        &self.corners
    }

    fn points(&self, at: impl Fn(&BodyPoint) -> Vec2) -> Vec<Vec2> {
        let line: Vec<Vec2> = self.line.iter().map(at).collect();
        let ([centre, point], false) = (line.as_slice(), self.corners.is_empty()) else {
            return line;
        };
        let arm = point - centre;
        let corner = |corner: &Vec2| centre + arm * corner.x + perpendicular(arm) * corner.y;
        self.corners.iter().map(corner).collect()
    }

    fn is_of_beam(&self) -> bool {
        !self.marks.is_empty()
    }

    pub(super) fn parameters(mesh: &Mesh) -> Vec<f64> {
        let pieces = pieces(mesh.basis().degree());
        let within = |pair: &[f64]| {
            let (start, end) = (pair[0], pair[1]);
            (0..pieces).map(move |i| start + (end - start) * i as f64 / pieces as f64)
        };
        let breaks = mesh.basis().breaks();
        breaks.windows(2).flat_map(within).chain(breaks.last().copied()).collect()
    }

    /// Number of outline points per station of the axis. A span has two stations, or one station for degree 1.
    pub fn places_a_station(degree: usize) -> usize {
        pieces(degree).div_ceil(2)
    }

    /// Number of stations between two consecutive knots: one, or zero for degree 1.
    /// Stations are the outline points at which fields along a beam are evaluated.
    pub fn stations_within_a_span(degree: usize) -> usize {
        pieces(degree) / Self::places_a_station(degree) - 1
    }

    /// Points of the drawn line, from start to end.
    pub fn line(&self) -> &[BodyPoint] {
        &self.line
    }

    /// Points of the outline at the knots or nodes of the beam.
    pub fn marks(&self) -> &[BodyPoint] {
        &self.marks
    }

    /// Computes a configuration for drawing from the control points of all bodies [length].
    /// The control points are given for beams, then particles, then rigid bodies.
    pub fn draw(outlines: &[Self], time: f64, control_points: &[&[Vec2]]) -> DrawnConfiguration {
        let at = |place: &BodyPoint| place.interpolate(control_points[place.body]);
        let beams = outlines.partition_point(Self::is_of_beam);
        let mut lines: Vec<Vec<Vec2>> = outlines.iter().map(|outline| outline.points(at)).collect();
        DrawnConfiguration {
            time,
            bodies: lines.split_off(beams),
            lines,
            marks: outlines.iter().flat_map(|outline| outline.marks.iter().map(at)).collect(),
            particles: control_points[beams..]
                .iter()
                .filter_map(|of| of.first())
                .copied()
                .collect(),
        }
    }
}
