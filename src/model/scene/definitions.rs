//! Beams, particles and start velocities as a scene describes them.

use serde::{Deserialize, Serialize};

use crate::beams::{Mesh, Section, Station};
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
    /// The section of the beam: stiffness and inertia.
    pub section: Section,
    /// How the beam moves at the start.
    pub motion: StartMotion,
}

impl BeamDefinition {
    /// The mass of the beam, without what stands on it [mass].
    pub fn mass(&self) -> f64 {
        self.section.mass_per_length * self.axis.length()
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
