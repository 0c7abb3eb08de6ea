//! Beams, particles and start velocities as a scene describes them.

use serde::{Deserialize, Serialize};

use crate::beams::{Mesh, Section, Station};
use crate::geometry::{Curve, Vec2};

/// How a beam moves when the scene starts: a rigid motion.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct StartMotion {
    /// The velocity of the point `about` [length/time].
    pub velocity: Vec2,
    /// The rate of rotation [1/time].
    pub spin: f64,
    /// The point it turns about; its centre of mass when not given.
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
    /// Its name in messages and reports.
    pub name: String,
    /// Its axis, stress-free as drawn.
    pub axis: Curve,
    /// Basis and quadrature.
    pub mesh: Mesh,
    /// Stiffness and inertia.
    pub section: Section,
    /// How it moves at the start.
    pub motion: StartMotion,
}

impl BeamDefinition {
    /// Its mass, without what stands on it [mass].
    pub fn mass(&self) -> f64 {
        self.section.mass_per_length * self.axis.length()
    }

    /// Whether it moves when the scene starts.
    pub fn starts_in_motion(&self) -> bool {
        self.motion.velocity != Vec2::zeros() || self.motion.spin != 0.0
    }
}

/// A point that moves by itself; its mass is one of the masses of the scene.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct ParticleDefinition {
    /// Its name in messages and reports.
    pub name: String,
    /// Where it starts [length].
    pub position: Vec2,
}

/// A velocity at the start of the node at a station alone.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct StationVelocity {
    /// Where.
    pub station: Station,
    /// [length/time]
    pub velocity: Vec2,
    /// [1/time]; as the beam has it when not given.
    pub spin: Option<f64>,
}
