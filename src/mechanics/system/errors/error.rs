//! Errors in the definition of a scene.

use super::{SliderError, TrackError, plural, rounded, with_article};
use crate::beams::BeamError;
use crate::geometry::GeometryError;
use crate::loads::LoadError;

/// Error in the definition or assembly of a scene.
#[expect(missing_docs, reason = "the messages describe the variants and their fields")]
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum SystemError {
    #[error("the scene '{scene}' has no beams, no particles and no bodies")]
    Empty { scene: String },
    #[error("interrupted during the assembly of the scene '{scene}'")]
    Interrupted { scene: String },
    #[error(
        "{name:?} cannot be the name of {}: {reason}; use letters, digits and spaces",
        with_article(kind)
    )]
    Unnamed { kind: &'static str, name: String, reason: &'static str },
    #[error("the scene already has {} '{name}'; give this {new} another name", with_article(kind))]
    DuplicateName { kind: &'static str, new: &'static str, name: String },
    #[error("station {station} is outside the length of beam '{beam}', [0, {}]", rounded(*length))]
    StationOutside { beam: String, station: f64, length: f64 },
    #[error("the outline of body '{body}' cannot be drawn: {reason}")]
    Outline { body: String, reason: &'static str },
    #[error("body '{body}' has no point '{point}'; it has {}", if known.is_empty() { "only its centre" } else { known })]
    NoPoint { body: String, point: String, known: String },
    #[error(
        "body '{body}' is statically overdetermined: joints at its points restrain the same movement twice, and their forces are undetermined; remove one of the joints, or replace a body by a beam"
    )]
    HeldTwice { body: String },
    #[error(
        "body '{body}' has no rotary inertia, and no joint or force outside its centre determines its rotation"
    )]
    NoInertia { body: String },
    #[error("body '{body}' has no mass and no joint, so that its motion is undetermined")]
    Massless { body: String },
    #[error(
        "{object}: a point of a rigid body has no start velocity of its own; set that of the body"
    )]
    PointAlone { object: String },
    #[error("{object}: {body} is listed twice; list each body once")]
    RepeatedBody { object: String, body: String },
    #[error(
        "{object}: at the start, a point of {body} coincides with the axis or the centre of a body that it touches, so that the contact force has no direction; move one of them"
    )]
    NoContactDirection { object: String, body: String },
    #[error(
        "{object} has friction, but {first} and {second} are particles: they do not rotate, so their friction would not conserve angular momentum; use rigid bodies, or list them in a contact without friction"
    )]
    FrictionOfParticles { object: String, first: String, second: String },
    #[error("{body} has no cross section")]
    NoSection { body: String },
    #[error("forces and accelerations at t = {time} are undetermined: {reason}")]
    NoInstant { time: f64, reason: String },
    #[error("there is no quantity '{name}' to record: {reason}")]
    NoSensor { name: String, reason: String },
    #[error("the history already has a column '{name}'; give this one another name")]
    DuplicateSensor { name: String },
    #[error("{joint}: both stations are the same place of {body}; a joint needs two places")]
    JointWithItself { joint: String, body: String },
    #[error(
        "{spring}: it acts from {from} to {to}, {reason}, so that it has no effect; move one of its ends"
    )]
    ImmovableSpring { spring: String, from: String, to: String, reason: &'static str },
    #[error(
        "{object}: the elongation at index {index} of its table is {elongation}, but the previous one is {before}; elongations must increase"
    )]
    TableOrder { object: String, index: usize, elongation: f64, before: f64 },
    #[error(
        "{joint}: its stations at {from} and {to} are {} apart, but must be at the same place at the start; move one of them", rounded(*gap)
    )]
    OpenJoint { joint: String, from: String, to: String, gap: f64 },
    #[error("{joint}: {place} is already {existing}; remove one of the two joints")]
    AlreadyTied { joint: String, place: String, existing: String },
    #[error("{damper}: {active_range}")]
    ActiveDamper { damper: String, active_range: String },
    #[error(
        "the {component} of {place} is already prescribed by '{drive}' and cannot also be fixed; prescribe or fix each component once"
    )]
    HeldAndDriven { component: &'static str, place: String, drive: String },
    #[error(
        "{drive}: the {component} of {place} is already {existing}; prescribe or fix each component once"
    )]
    AlreadyDriven { drive: String, component: &'static str, place: String, existing: &'static str },
    #[error(
        "{drive}: its {component} is {value} at t = 0, but must be 0: a prescribed motion is relative to the initial position"
    )]
    DriveStart { drive: String, component: &'static str, value: f64 },
    #[error(
        "{drive}: its {component} jumps by {} at t = {time}, but a prescribed motion must be continuous", rounded(*jump)
    )]
    DriveJump { drive: String, component: &'static str, time: f64, jump: f64 },
    #[error("{drive}: {source}")]
    DriveValue { drive: String, source: LoadError },
    #[error("{spring}: {name}: {source}")]
    RestValue { spring: String, name: &'static str, source: LoadError },
    #[error("'{name}' already has a release; remove one of the two releases")]
    ReleasedTwice { name: String },
    #[error(
        "the scene '{scene}' has no free degree of freedom: all are fixed by supports or prescribed; remove a support"
    )]
    NothingMoves { scene: String },
    #[error(
        "{body} has the start velocity {} at its {place}, but {other}; give it a compatible start velocity", rounded(*velocity)
    )]
    StartVelocity { body: String, place: String, velocity: f64, other: String },
    #[error("{object}: a particle has no rotation")]
    ParticleTurned { object: String, by: Turning },
    #[error(transparent)]
    Slider(Box<SliderError>),
    #[error(transparent)]
    Track(Box<TrackError>),
    #[error("{object}: {name} is {value}, but must be {allowed}")]
    Value { object: String, name: &'static str, value: f64, allowed: &'static str },
    #[error("{object}: {name} has {}, but must have at least two points", plural(*points, "point"))]
    FewPoints { object: String, name: &'static str, points: usize },
    #[error("{object} refers to {kind} number {index} (from 0), but the scene has only {count}")]
    Missing { object: &'static str, kind: &'static str, index: usize, count: usize },
    #[error("the state does not fit the scene: {reason}")]
    State { reason: &'static str },
    #[error("beam '{beam}': {source}")]
    Beam { beam: String, source: BeamError },
}

/// Definition that needs a rotation, but was given for a particle, which has none.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Turning {
    /// Rigid joint.
    RigidJoint,
    /// Rotary inertia of a point mass.
    RotaryInertia,
    /// Moment or follower force.
    Load,
    /// Initial angular velocity.
    Spin,
    /// Torsion spring, torsion damper or brake.
    TorsionSpring,
    /// Prescribed angle.
    Drive,
}

impl SystemError {
    pub(in crate::system) fn geometry(beam: &str) -> impl Fn(GeometryError) -> Self + '_ {
        move |source| Self::Beam { beam: beam.to_owned(), source: source.into() }
    }

    pub(in crate::system) fn beam(name: &str) -> impl Fn(BeamError) -> Self + '_ {
        move |source| Self::Beam { beam: name.to_owned(), source }
    }
}

pub fn finite(object: &str, name: &'static str, values: &[f64]) -> Result<(), SystemError> {
    match values.iter().find(|value| !value.is_finite()) {
        Some(&value) => {
            let allowed = "a finite number";
            Err(SystemError::Value { object: object.to_owned(), name, value, allowed })
        }
        None => Ok(()),
    }
}

impl From<TrackError> for SystemError {
    fn from(error: TrackError) -> Self {
        Self::Track(Box::new(error))
    }
}

impl From<SliderError> for SystemError {
    fn from(error: SliderError) -> Self {
        Self::Slider(Box::new(error))
    }
}
