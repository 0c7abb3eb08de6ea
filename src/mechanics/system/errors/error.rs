//! Errors of the description of a scene.

use super::{SliderError, TrackError};
use crate::beams::BeamError;
use crate::geometry::GeometryError;
use crate::loads::LoadError;

/// Scene that cannot be described or built.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum SystemError {
    /// Scene without bodies.
    #[error("the scene '{scene}' has no beams, no particles and no bodies")]
    Empty {
        /// Name of the empty scene.
        scene: String,
    },
    /// Name that is empty or cannot be read or typed.
    #[error("{name:?} is no name for a {kind}: {why}; use letters, numbers and spaces")]
    Unnamed {
        /// Kind of the object.
        kind: &'static str,
        /// Rejected name.
        name: String,
        /// Reason.
        why: &'static str,
    },
    /// Name used by two objects.
    #[error("the scene already has a {kind} '{name}'; give this {new} another name")]
    DuplicateName {
        /// Kind of the existing object.
        kind: &'static str,
        /// Kind of the new object.
        new: &'static str,
        /// Name of both.
        name: String,
    },
    /// Station outside its beam.
    #[error("station {station} is outside [0, {length}] of beam '{beam}'")]
    StationOutside {
        /// Name of the beam.
        beam: String,
        /// Requested arc length [length].
        station: f64,
        /// Length of the beam [length].
        length: f64,
    },
    /// Outline of a rigid body that cannot be drawn.
    #[error("the outline of body '{body}' cannot be drawn: {why}")]
    Outline {
        /// Name of the rigid body.
        body: String,
        /// Reason.
        why: &'static str,
    },
    /// Unknown point of a rigid body.
    #[error("body '{body}' has no point '{point}'; it has {}", if known.is_empty() { "none but its centre" } else { known })]
    NoPoint {
        /// Name of the rigid body.
        body: String,
        /// Requested name.
        point: String,
        /// List of its points.
        known: String,
    },
    /// Rigid bodies with redundant restraints.
    #[error(
        "body '{body}' is held more often than it can move: joints of its points ask for the same twice, and their forces are not determined; remove one of them, or let a beam take the place of a body"
    )]
    HeldTwice {
        /// Name of a rigid body whose constraint forces are undetermined.
        body: String,
    },
    /// Rigid body without inertia and without restraint of its angle.
    #[error(
        "body '{body}' has no inertia, and nothing holds its angle or acts on it beside its centre, so that nothing determines how it turns"
    )]
    Inertialess {
        /// Name of the body.
        body: String,
    },
    /// Rigid body without mass and without restraint.
    #[error(
        "body '{body}' has no mass, and nothing holds it, so that nothing determines how it moves"
    )]
    Massless {
        /// Name of the body.
        body: String,
    },
    /// Start velocity of a single point of a rigid body.
    #[error("{object}: the points of a body move with it")]
    PointAlone {
        /// Description of the start velocity.
        object: String,
    },
    /// Section forces of a particle, which has no section.
    #[error("{body} has no cross section")]
    NoSection {
        /// Description of the particle.
        body: String,
    },
    /// Forces at a time at which they are undetermined.
    #[error("forces and accelerations at t = {time} cannot be had: {reason}")]
    NoInstant {
        /// The time [time].
        time: f64,
        /// Reason.
        reason: String,
    },
    /// Unknown quantity.
    #[error("there is no quantity '{name}' to record: {why}")]
    NoSensor {
        /// Requested name.
        name: String,
        /// Reason.
        why: String,
    },
    /// Quantity that is recorded already.
    #[error("'{name}' is a column of the history already; give this one another name")]
    DuplicateSensor {
        /// Name of the column.
        name: String,
    },
    /// Joint that connects a place to itself.
    #[error("{joint}: both stations are the same place of {body}; a joint needs two places")]
    JointWithItself {
        /// Name of the joint.
        joint: String,
        /// Description of the body.
        body: String,
    },
    /// Spring without effect.
    #[error(
        "{spring}: it would act from {from} to {to}, {why}, and can do nothing; give one of both another place"
    )]
    IdleSpring {
        /// Description of the spring.
        spring: String,
        /// Description of its start.
        from: String,
        /// Description of its end.
        to: String,
        /// Reason.
        why: &'static str,
    },
    /// Table of a spring whose elongations do not increase.
    #[error(
        "{object}: the elongation at index {index} of its table is {elongation}, and the one before is {before}: they must rise from point to point"
    )]
    TableOrder {
        /// Description of the spring.
        object: String,
        /// Index of the point whose elongation does not increase, from 0.
        index: usize,
        /// Elongation of that point [length, rad].
        elongation: f64,
        /// Elongation of the previous point [length, rad].
        before: f64,
    },
    /// Joint whose partners do not meet.
    #[error(
        "{joint}: its stations at {from} and {to} are {gap} apart; they must lie at the same place when the scene starts: move one of them"
    )]
    OpenJoint {
        /// Name of the joint.
        joint: String,
        /// Description of the first partner.
        from: String,
        /// Description of the second partner.
        to: String,
        /// Distance between the partners [length].
        gap: f64,
    },
    /// Joint at a place that is joined or supported in the same way already.
    #[error("{joint}: {place} is already {how}; remove one of the two joints")]
    AlreadyTied {
        /// Name of the joint.
        joint: String,
        /// Description of the place.
        place: String,
        /// Existing joint or support of the place.
        how: String,
    },
    /// Damping law that adds energy at some rate, or has a force at rest.
    #[error("{damper}: {feeding}")]
    FeedingDamper {
        /// Description of the damper.
        damper: String,
        /// Range that adds energy, and how to correct it.
        feeding: String,
    },
    /// Support of a component that a drive prescribes.
    #[error(
        "the {component} of {place} is given by '{drive}' already: it cannot be held besides; give or hold each movement once"
    )]
    HeldAndDriven {
        /// Prescribed component.
        component: &'static str,
        /// Description of the place.
        place: String,
        /// Name of the drive.
        drive: String,
    },
    /// Prescribed motion of a component that is supported or prescribed already.
    #[error(
        "{drive}: the {component} of {place} is {how} already; give or hold each movement once"
    )]
    AlreadyDriven {
        /// Name of the rejected drive.
        drive: String,
        /// Component.
        component: &'static str,
        /// Description of the place.
        place: String,
        /// The word `held` or `given`.
        how: &'static str,
    },
    /// Prescribed motion that does not start at its station.
    #[error(
        "{drive}: its {component} is {value} at t = 0, but a given motion is counted from the place as drawn and begins with 0"
    )]
    DriveStart {
        /// Name of the drive.
        drive: String,
        /// Component.
        component: &'static str,
        /// Initial value [length, rad].
        value: f64,
    },
    /// Prescribed motion that jumps.
    #[error(
        "{drive}: its {component} jumps by {jump} at t = {time}, but a given motion has to be continuous"
    )]
    DriveJump {
        /// Name of the drive.
        drive: String,
        /// Component.
        component: &'static str,
        /// Time of the jump [time].
        time: f64,
        /// Size of the jump [length, rad].
        jump: f64,
    },
    /// Prescribed motion without a value.
    #[error("{drive}: {source}")]
    DriveValue {
        /// Name of the drive.
        drive: String,
        /// Reason.
        source: LoadError,
    },
    /// Object that is released twice.
    #[error("'{name}' lets go already; it can do so once: remove one of the two releases")]
    ReleasedTwice {
        /// Name of the object.
        name: String,
    },
    /// Scene without free movements.
    #[error("the scene '{scene}' has nothing that can move: every unknown is held by a support")]
    NothingMoves {
        /// Name of the scene.
        scene: String,
    },
    /// Start velocities that contradict each other.
    #[error(
        "{body} starts with a velocity of {velocity} at its {place}, but {other}; give it a start velocity that fits"
    )]
    StartVelocity {
        /// Description of the body.
        body: String,
        /// Component and place.
        place: String,
        /// Start velocity of the body there [length/time, or 1/time for a rotation].
        velocity: f64,
        /// Description of the contradicting velocity.
        other: String,
    },
    /// Joint, load, inertia or spin that would rotate a particle.
    #[error("{object}: a particle does not turn")]
    ParticleTurned {
        /// Description of the object.
        object: String,
        /// Cause of the rotation.
        by: Turning,
    },
    /// Invalid sliding joint.
    #[error(transparent)]
    Slider(Box<SliderError>),
    /// Invalid track.
    #[error(transparent)]
    Track(Box<TrackError>),
    /// Number outside its range.
    #[error("{object}: {name} is {value}, but must be {allowed}")]
    Value {
        /// Description of the object.
        object: String,
        /// Name of the property.
        name: &'static str,
        /// Rejected value.
        value: f64,
        /// Allowed values.
        allowed: &'static str,
    },
    /// Stored part of a scene that refers to a missing object.
    #[error("{object} is on {kind} number {index}, but the scene has only {count}")]
    Missing {
        /// Description of the part.
        object: &'static str,
        /// Kind of the missing object.
        kind: &'static str,
        /// Index of the missing object.
        index: usize,
        /// Number of objects of that kind in the scene.
        count: usize,
    },
    /// Stored state that does not fit the model.
    #[error("the state does not fit the scene: {reason}")]
    State {
        /// Reason.
        reason: &'static str,
    },
    /// Beam that does not fit its mesh.
    #[error("beam '{beam}': {source}")]
    Beam {
        /// Name of the beam.
        beam: String,
        /// Reason.
        source: BeamError,
    },
}

/// Cause of a rotation of a particle.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Turning {
    /// Rigid joint.
    RigidJoint,
    /// Rotary inertia of a point mass.
    RotaryInertia,
    /// Moment or follower force.
    Load,
    /// Start spin.
    Spin,
    /// Torsion spring.
    TorsionSpring,
    /// Prescribed angle.
    Drive,
}

impl SystemError {
    /// Returns a closure for `map_err` that attributes a geometry error to a beam.
    pub(in crate::system) fn geometry(beam: &str) -> impl Fn(GeometryError) -> Self + '_ {
        move |source| Self::Beam { beam: beam.to_owned(), source: source.into() }
    }

    /// Returns a closure for `map_err` that attributes an error to a beam.
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
