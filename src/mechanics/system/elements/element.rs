//! Elements of a scene, and the interface of their definitions.

use serde::{Deserialize, Serialize};

use super::point_mass::NodalMass;
use super::{
    ContactTarget, Drag, ExternalForce, InternalForce, MaterialDamping, Obstacle, PairContact,
    PointMass, Spring,
};
use crate::beams::{BodyDynamics, BodyIndex, BodyPoint, Mesh, SectionVariation, Station};
use crate::geometry::GeometryError;
use crate::loads::{Load, Schedule};
use crate::system::SystemError;

/// Element of a scene: a mass on a body, or forces on bodies.
///
/// A new type of element needs a variant of `Element` and a file in `system/elements` with its [`ElementDef`].
#[derive(Debug, Clone, Serialize, Deserialize)]
pub enum Element {
    /// Mass at a station.
    PointMass(PointMass),
    /// Force, moment or force per length that follows a schedule.
    Load(Load),
    /// Spring, damper, tendon or brake.
    Spring(Spring),
    /// Material damping of a beam.
    Damping(MaterialDamping),
    /// Drag in air or water.
    Drag(Drag),
    /// Obstacle fixed to the ground.
    Obstacle(Obstacle),
    /// Contact between bodies.
    Contact(PairContact),
}

impl Element {
    /// Name of the element type for messages, such as `spring`.
    pub fn kind(&self) -> &'static str {
        match self {
            Self::PointMass(_) => "mass",
            Self::Load(_) => "load",
            Self::Spring(_) => "spring",
            Self::Damping(_) => "damping",
            Self::Drag(_) => "drag",
            Self::Obstacle(_) => "obstacle",
            Self::Contact(_) => "contact",
        }
    }

    pub(in crate::system) fn name_mut(&mut self) -> Option<&mut String> {
        match self {
            Self::PointMass(_) => None,
            Self::Load(load) => Some(&mut load.name),
            Self::Spring(spring) => Some(&mut spring.name),
            Self::Damping(damping) => Some(&mut damping.name),
            Self::Drag(drag) => Some(&mut drag.name),
            Self::Obstacle(obstacle) => Some(&mut obstacle.name),
            Self::Contact(contact) => Some(&mut contact.name),
        }
    }

    pub(in crate::system) fn description(&self) -> &dyn ElementDef {
        match self {
            Self::PointMass(mass) => mass,
            Self::Load(load) => load,
            Self::Spring(spring) => spring,
            Self::Damping(damping) => damping,
            Self::Drag(drag) => drag,
            Self::Obstacle(obstacle) => obstacle,
            Self::Contact(contact) => contact,
        }
    }
}

pub trait ElementDef {
    /// Checks the numbers and the stations of the element.
    ///
    /// # Errors
    /// Fails if a number is out of range or a station of the element does not exist.
    fn check(&self, setting: &dyn SceneChecks) -> Result<(), SystemError>;

    /// Stations of the element that need a node of the mesh.
    fn nodes(&self) -> Vec<Station> {
        Vec::new()
    }

    /// Groups of stations that the element couples.
    fn coupled(&self, _scene: &dyn SceneChecks) -> Vec<Vec<Station>> {
        Vec::new()
    }

    /// Name and schedule of the element; `None` without a schedule. Steps end at jumps of the schedule and of its derivative.
    fn schedule(&self) -> Option<(&str, &Schedule)> {
        None
    }

    /// Builds the element for a model.
    ///
    /// # Errors
    /// Fails if the element cannot be applied at its station.
    fn build(&self, site: &dyn AssemblyContext) -> Result<BuiltElement, SystemError>;
}

pub enum BuiltElement {
    PointMass(NodalMass),
    Force(Box<dyn ExternalForce>),
    Resistance(Box<dyn InternalForce>),
}

pub trait SceneChecks {
    /// All beams and particles of the scene.
    fn contact_targets(&self) -> Vec<ContactTarget>;

    fn describe(&self, station: &Station) -> String;

    /// Returns true if a joint or a slider connects the bodies `a` and `b`, or if they are points of the same body.
    fn are_connected(&self, a: BodyIndex, b: BodyIndex) -> bool;

    /// Checks that a station exists. `object` describes the object at the station, for the error message.
    ///
    /// # Errors
    /// Fails if the body of the station does not exist, or the station lies outside its beam.
    fn check_station(&self, object: &'static str, station: &Station) -> Result<(), SystemError>;
}

/// Model queries for the construction of an element.
pub trait AssemblyContext {
    /// Returns the point on the mesh for a station.
    ///
    /// # Errors
    /// Fails if the station lies outside its beam.
    fn place(&self, station: &Station) -> Result<BodyPoint, SystemError>;

    /// Returns the point on a beam for a parameter of its mesh.
    ///
    /// # Errors
    /// Fails if the parameter lies outside the mesh.
    fn place_at(&self, beam: usize, parameter: f64) -> Result<BodyPoint, SystemError>;

    fn scene(&self) -> &dyn SceneChecks;

    fn mesh(&self, beam: usize) -> &Mesh;

    fn variation(&self, beam: usize) -> &SectionVariation;

    /// Body in its initial state. Body indices count beams first, then particles, then rigid bodies.
    fn body(&self, index: usize) -> &dyn BodyDynamics;

    fn wrong(&self, beam: usize, error: GeometryError) -> SystemError;
}
