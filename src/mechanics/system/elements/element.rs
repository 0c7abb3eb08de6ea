//! The elements of a scene as they are described, and what their descriptions offer to a model.

use serde::{Deserialize, Serialize};

use super::point_mass::NodalMass;
use super::{Drag, ExternalForce, InternalForce, MaterialDamping, PointMass, Spring};
use crate::beams::{BodyDynamics, BodyPoint, Mesh, SectionVariation, Station};
use crate::geometry::GeometryError;
use crate::loads::{Load, Schedule};
use crate::system::SystemError;

/// An element of a scene: something with mass on a body, or something that puts forces on bodies.
///
/// A further kind is a variant, and a file in `model/elements` with its [`ElementDef`] and what it is built into: a [`ExternalForce`], or a
/// [`InternalForce`](super::InternalForce).
#[derive(Debug, Clone, Serialize, Deserialize)]
pub enum Element {
    /// The element is a mass at a station.
    PointMass(PointMass),
    /// A load: a force, a moment or a force per length that follows a schedule.
    Load(Load),
    /// A spring, a damper or a tendon.
    Spring(Spring),
    /// The damping of the material of a beam.
    Damping(MaterialDamping),
    /// Drag of air or water.
    Drag(Drag),
}

impl Element {
    /// What it is, in a word.
    pub fn kind(&self) -> &'static str {
        match self {
            Self::PointMass(_) => "mass",
            Self::Load(_) => "load",
            Self::Spring(_) => "spring",
            Self::Damping(_) => "damping",
            Self::Drag(_) => "drag",
        }
    }

    /// Its name, if it has one.
    pub(in crate::system) fn name_mut(&mut self) -> Option<&mut String> {
        match self {
            Self::PointMass(_) => None,
            Self::Load(load) => Some(&mut load.name),
            Self::Spring(spring) => Some(&mut spring.name),
            Self::Damping(damping) => Some(&mut damping.name),
            Self::Drag(drag) => Some(&mut drag.name),
        }
    }

    /// The element as what every kind of element can be asked.
    pub(in crate::system) fn description(&self) -> &dyn ElementDef {
        match self {
            Self::PointMass(mass) => mass,
            Self::Load(load) => load,
            Self::Spring(spring) => spring,
            Self::Damping(damping) => damping,
            Self::Drag(drag) => drag,
        }
    }
}

/// A kind of element as a scene describes it.
pub trait ElementDef {
    /// Checks the numbers and the stations of an element.
    ///
    /// # Errors
    /// When a number is out of its range, or a station is none of the scene.
    fn check(&self, setting: &dyn SceneChecks) -> Result<(), SystemError>;

    /// The stations at which the element needs a node of the mesh.
    fn nodes(&self) -> Vec<Station> {
        Vec::new()
    }

    /// Stations whose movements it ties together, however far apart they are: the order of the unknowns keeps them near each other.
    fn coupled(&self) -> Vec<Station> {
        Vec::new()
    }

    /// The schedule that the element follows, with the element's name; steps end where a schedule jumps or bends.
    fn schedule(&self) -> Option<(&str, &Schedule)> {
        None
    }

    /// Builds the element into a model: what it is there.
    ///
    /// # Errors
    /// When it cannot act where it is.
    fn build(&self, site: &dyn AssemblyContext) -> Result<BuiltElement, SystemError>;
}

/// What becomes of an element in a model.
pub enum BuiltElement {
    /// The element becomes a part of the inertia.
    Mass(NodalMass),
    /// The element becomes forces on bodies.
    Force(Box<dyn ExternalForce>),
    /// What resists movements of bodies.
    Resistance(Box<dyn InternalForce>),
}

/// What the check of an element may ask of its scene.
pub trait SceneChecks {
    /// A station of the scene in words.
    fn describe(&self, station: &Station) -> String;

    /// Refuses a station that is none of the scene; `object` is what is there, in words.
    ///
    /// # Errors
    /// When there is no such body, or the station lies outside its beam.
    fn check_station(&self, object: &'static str, station: &Station) -> Result<(), SystemError>;
}

/// What an element may ask of the model that it is built into.
pub trait AssemblyContext {
    /// The place of a station on the mesh of its body.
    ///
    /// # Errors
    /// When the station lies outside its beam.
    fn place(&self, station: &Station) -> Result<BodyPoint, SystemError>;

    /// The place of a beam at a parameter of its mesh.
    ///
    /// # Errors
    /// When the parameter lies outside the mesh.
    fn place_at(&self, beam: usize, parameter: f64) -> Result<BodyPoint, SystemError>;

    /// The mesh of a beam, by its index.
    fn mesh(&self, beam: usize) -> &Mesh;

    /// The sections along a beam, by its index.
    fn variation(&self, beam: usize) -> &SectionVariation;

    /// A body at its start, by its index: beams come first, then particles, then rigid bodies.
    fn body(&self, index: usize) -> &dyn BodyDynamics;

    /// Wraps an error of geometry as one of a beam, by its index.
    fn wrong(&self, beam: usize, error: GeometryError) -> SystemError;
}
