//! Definitions of beams, particles, rigid bodies and start velocities in a scene.

use serde::{Deserialize, Serialize};

use crate::beams::{Mesh, Rotation, SectionVariation, Station};
use crate::geometry::{Curve, GaussRule, Span, Vec2, interpolate};
use crate::system::SystemError;

/// Rigid motion of a body at the start of the scene.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct StartMotion {
    /// Velocity of the point `centre` [length/time].
    pub velocity: Vec2,
    /// Angular velocity of the body [1/time].
    pub spin: f64,
    /// Centre of rotation [length]; the centre of mass if not given.
    pub centre: Option<Vec2>,
}

impl Default for StartMotion {
    fn default() -> Self {
        Self { velocity: Vec2::zeros(), spin: 0.0, centre: None }
    }
}

/// Beam of a scene.
#[derive(Debug, Clone, Serialize, Deserialize)]
pub struct BeamDefinition {
    /// Name of the beam in messages and reports.
    pub name: String,
    /// Initial axis, which is free of stress [length].
    pub axis: Curve,
    /// Mesh of the beam: basis and quadrature.
    pub mesh: Mesh,
    /// Sections along the beam: stiffness and inertia.
    pub section: SectionVariation,
    /// Motion of the beam at the start.
    pub motion: StartMotion,
}

impl BeamDefinition {
    /// Returns a beam with zero start velocity.
    pub fn new(
        name: impl Into<String>,
        axis: Curve,
        mesh: Mesh,
        section: impl Into<SectionVariation>,
    ) -> Self {
        let motion = StartMotion::default();
        Self { name: name.into(), axis, mesh, section: section.into(), motion }
    }

    /// Length of the axis on the mesh [length], from which the mass in a run is computed.
    ///
    /// # Errors
    /// Fails if the mesh cannot interpolate the axis.
    pub fn meshed_length(&self) -> Result<f64, SystemError> {
        let basis = self.mesh.basis();
        let points = interpolate(&self.axis, basis).map_err(SystemError::geometry(&self.name))?;
        let rule = GaussRule::new(basis.degree() + 1).map_err(SystemError::geometry(&self.name))?;
        let of_span = |span: &Span| {
            let at = |(xi, weight): (f64, f64)| {
                weight * basis.evaluate_in(span, xi).combine(1, &points).norm()
            };
            rule.iter_on(span.start, span.end).map(at).sum::<f64>()
        };
        Ok(basis.spans().iter().map(of_span).sum())
    }

    /// Mass of the beam, without attached masses [mass].
    pub fn mass(&self) -> f64 {
        self.section.mean().mass_per_length * self.axis.length()
    }

    /// Returns true if the beam has a start velocity.
    pub fn starts_in_motion(&self) -> bool {
        self.motion.velocity != Vec2::zeros() || self.motion.spin != 0.0
    }
}

/// Particle of a scene. Its mass is stored as a point mass of the scene.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct ParticleDefinition {
    /// Name of the particle in messages and reports.
    pub name: String,
    /// Initial position of the particle [length].
    pub position: Vec2,
}

/// Rigid body of a scene: a centre of mass and further points.
/// The mass and the inertia of the body are stored as a point mass of the scene.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct RigidBodyDefinition {
    /// Name of the rigid body in messages and reports.
    pub name: String,
    /// Initial position of the centre of mass [length].
    pub position: Vec2,
    /// Initial angle of the body frame [rad].
    pub angle: f64,
    /// Named points in the body frame, relative to the centre of mass [length].
    pub points: Vec<(String, Vec2)>,
    /// Corners of the polygon drawn in pictures, in the body frame relative to the centre of mass [length]. If empty, the points are drawn.
    pub outline: Vec<Vec2>,
    /// Motion of the rigid body at the start.
    pub motion: StartMotion,
}

impl RigidBodyDefinition {
    pub(crate) fn control_point(&self, name: &str) -> Option<usize> {
        let (at, (_, place)) = self.points.iter().enumerate().find(|(_, (own, _))| own == name)?;
        Some(if *place == Vec2::zeros() { 0 } else { at + 1 })
    }

    /// Initial control points: the centre of mass, followed by the other points [length].
    pub fn control_points(&self) -> Vec<Vec2> {
        let frame = Rotation::by(self.angle);
        let points = self.points.iter().map(|(_, place)| self.position + frame.to_space(*place));
        std::iter::once(self.position).chain(points).collect()
    }

    /// Indices of the control points off the centre of mass, which rigid links connect to the centre of mass.
    pub fn links(&self) -> impl Iterator<Item = usize> + '_ {
        let points = self.points.iter().enumerate();
        points.filter(|(_, (_, place))| *place != Vec2::zeros()).map(|(at, _)| at + 1)
    }

    /// Reason for rejecting the outline; `None` if it is accepted. The outline must be a polygon with at least three corners.
    /// A body with an outline also needs a point off the centre of mass, to show its rotation.
    pub(crate) fn outline_refused(&self) -> Option<&'static str> {
        match self.outline.len() {
            0 => None,
            1 | 2 => Some("it needs at least three corners"),
            _ if self.links().next().is_none() => Some(
                "the body has no point off its centre, which shows its rotation; add one in points",
            ),
            _ => None,
        }
    }

    /// Returns true if the body has a start velocity.
    pub fn starts_in_motion(&self) -> bool {
        self.motion.velocity != Vec2::zeros() || self.motion.spin != 0.0
    }

    /// Largest distance of a point from the centre of mass [length].
    pub fn size(&self) -> f64 {
        self.points.iter().map(|(_, place)| place.norm()).fold(0.0, f64::max)
    }
}

/// Start velocity of a single node.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct StationVelocity {
    /// Station of the node.
    pub station: Station,
    /// Velocity of the node [length/time].
    pub velocity: Vec2,
    /// Angular velocity of the node [1/time]; `None` if the node has the angular velocity of the beam.
    pub spin: Option<f64>,
}
