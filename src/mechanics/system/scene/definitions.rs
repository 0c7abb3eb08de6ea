//! Beams, particles, rigid bodies and start velocities as a scene describes them.

use serde::{Deserialize, Serialize};

use crate::beams::{Mesh, Rotation, SectionVariation, Station};
use crate::geometry::{Curve, Vec2};

/// How a beam moves when the scene starts: a rigid motion.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct StartMotion {
    /// The velocity of the point `about` [length/time].
    pub velocity: Vec2,
    /// The rate of rotation of the beam at the start [1/time].
    pub spin: f64,
    /// The point the beam turns about; its centre of mass when not given [length].
    pub about: Option<Vec2>,
}

impl Default for StartMotion {
    fn default() -> Self {
        Self { velocity: Vec2::zeros(), spin: 0.0, about: None }
    }
}

/// A beam of a scene.
#[derive(Debug, Clone, Serialize, Deserialize)]
pub struct BeamDefinition {
    /// The name of the beam in messages and reports.
    pub name: String,
    /// The axis of the beam [length], stress-free as drawn.
    pub axis: Curve,
    /// The mesh of the beam: basis and quadrature.
    pub mesh: Mesh,
    /// The sections along the beam: stiffness and inertia.
    pub section: SectionVariation,
    /// How the beam moves at the start.
    pub motion: StartMotion,
}

impl BeamDefinition {
    /// Returns a beam that is at rest at the start of the scene.
    pub fn new(
        name: impl Into<String>,
        axis: Curve,
        mesh: Mesh,
        section: impl Into<SectionVariation>,
    ) -> Self {
        let motion = StartMotion::default();
        Self { name: name.into(), axis, mesh, section: section.into(), motion }
    }

    /// The mass of the beam, without what stands on it [mass].
    pub fn mass(&self) -> f64 {
        self.section.mean().mass_per_length * self.axis.length()
    }

    /// Whether the beam moves when the scene starts.
    pub fn starts_in_motion(&self) -> bool {
        self.motion.velocity != Vec2::zeros() || self.motion.spin != 0.0
    }
}

/// A particle of a scene: a point that moves by itself; its mass is one of the masses of the scene.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct ParticleDefinition {
    /// The name of the particle in messages and reports.
    pub name: String,
    /// The place where the particle starts [length].
    pub position: Vec2,
}

/// A rigid body of a scene: a centre of mass and points around it; mass and inertia are one of the masses of the scene.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct RigidBodyDefinition {
    /// The name of the rigid body in messages and reports.
    pub name: String,
    /// The place of the centre of mass where the body starts [length].
    pub position: Vec2,
    /// The angle by which the frame of the body is turned where it starts [rad].
    pub angle: f64,
    /// The points of the body with their names, in its own frame, counted from the centre of mass [length].
    pub points: Vec<(String, Vec2)>,
    /// The corners of the polygon as which pictures show the body, in its own frame, counted from the centre of mass [length]; none to show it by its points.
    pub outline: Vec<Vec2>,
    /// How the body moves at the start.
    pub motion: StartMotion,
}

impl RigidBodyDefinition {
    /// The number of the point of a name among the control points of the body: 0, the centre of mass, for one that lies there.
    pub fn control_point(&self, name: &str) -> Option<usize> {
        let (at, (_, place)) = self.points.iter().enumerate().find(|(_, (own, _))| own == name)?;
        Some(if *place == Vec2::zeros() { 0 } else { at + 1 })
    }

    /// The places of the control points at the start: the centre of mass, then the points [length].
    pub fn control_points(&self) -> Vec<Vec2> {
        let frame = Rotation::by(self.angle);
        let points = self.points.iter().map(|(_, place)| self.position + frame.to_space(*place));
        std::iter::once(self.position).chain(points).collect()
    }

    /// The numbers of the points that are off the centre of mass, which rigid links hold to it, among the control points.
    pub fn links(&self) -> impl Iterator<Item = usize> + '_ {
        let points = self.points.iter().enumerate();
        points.filter(|(_, (_, place))| *place != Vec2::zeros()).map(|(at, _)| at + 1)
    }

    /// What is wrong with the outline, if something is: a polygon has three corners, and a point off the centre of mass tells pictures how it is turned.
    pub fn outline_refused(&self) -> Option<&'static str> {
        match self.outline.len() {
            0 => None,
            1 | 2 => Some("a polygon has three corners or more"),
            _ if self.links().next().is_none() => Some(
                "pictures see by a point off its centre how it is turned, and it has none; give it one",
            ),
            _ => None,
        }
    }

    /// Whether the body moves when the scene starts.
    pub fn starts_in_motion(&self) -> bool {
        self.motion.velocity != Vec2::zeros() || self.motion.spin != 0.0
    }

    /// The distance of the point that is farthest from the centre of mass [length].
    pub fn size(&self) -> f64 {
        self.points.iter().map(|(_, place)| place.norm()).fold(0.0, f64::max)
    }
}

/// A velocity at the start of the node at a station alone.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct StationVelocity {
    /// The station whose node has the velocity.
    pub station: Station,
    /// The velocity of the node at the start [length/time].
    pub velocity: Vec2,
    /// The rate of rotation of the node at the start [1/time]; as the beam has it when not given.
    pub spin: Option<f64>,
}
