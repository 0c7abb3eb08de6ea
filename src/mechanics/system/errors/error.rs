//! Errors of the description of a scene.

use super::{SliderError, TrackError, plural, rounded};
use crate::beams::BeamError;
use crate::geometry::GeometryError;
use crate::loads::LoadError;

/// Error in the description or assembly of a scene.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum SystemError {
    /// Scene without bodies.
    #[error("the scene '{scene}' has no beams, no particles and no bodies")]
    Empty {
        /// Name of the empty scene.
        scene: String,
    },
    /// Assembly that was stopped.
    #[error("interrupted during the assembly of the scene '{scene}'")]
    Interrupted {
        /// Name of the scene.
        scene: String,
    },
    /// Name that is empty or cannot be read or typed.
    #[error("{name:?} cannot be the name of a {kind}: {reason}; use letters, digits and spaces")]
    Unnamed {
        /// Kind of the object.
        kind: &'static str,
        /// Rejected name.
        name: String,
        /// Reason.
        reason: &'static str,
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
    #[error("station {station} is outside the length of beam '{beam}', [0, {}]", rounded(*length))]
    StationOutside {
        /// Name of the beam.
        beam: String,
        /// Requested arc length [length].
        station: f64,
        /// Length of the beam [length].
        length: f64,
    },
    /// Outline of a rigid body that cannot be drawn.
    #[error("the outline of body '{body}' cannot be drawn: {reason}")]
    Outline {
        /// Name of the rigid body.
        body: String,
        /// Reason.
        reason: &'static str,
    },
    /// Unknown point of a rigid body.
    #[error("body '{body}' has no point '{point}'; it has {}", if known.is_empty() { "only its centre" } else { known })]
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
        "body '{body}' is statically overdetermined: joints at its points restrain the same movement twice, and their forces are undetermined; remove one of the joints, or replace a body by a beam"
    )]
    HeldTwice {
        /// Name of a rigid body whose constraint forces are undetermined.
        body: String,
    },
    /// Rigid body without inertia and without restraint of its angle.
    #[error(
        "body '{body}' has no rotary inertia, and no joint or force outside its centre determines its rotation"
    )]
    NoInertia {
        /// Name of the body.
        body: String,
    },
    /// Rigid body without mass and without restraint.
    #[error("body '{body}' has no mass and no joint, so that its motion is undetermined")]
    Massless {
        /// Name of the body.
        body: String,
    },
    /// Start velocity of a single point of a rigid body.
    #[error(
        "{object}: a point of a rigid body has no start velocity of its own; set that of the body"
    )]
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
    #[error("forces and accelerations at t = {time} are undetermined: {reason}")]
    NoInstant {
        /// The time [time].
        time: f64,
        /// Reason.
        reason: String,
    },
    /// Unknown quantity.
    #[error("there is no quantity '{name}' to record: {reason}")]
    NoSensor {
        /// Requested name.
        name: String,
        /// Reason.
        reason: String,
    },
    /// Quantity that is recorded already.
    #[error("the history already has a column '{name}'; give this one another name")]
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
        "{spring}: it acts from {from} to {to}, {reason}, so that it has no effect; move one of its ends"
    )]
    ImmovableSpring {
        /// Description of the spring.
        spring: String,
        /// Description of its start.
        from: String,
        /// Description of its end.
        to: String,
        /// Reason.
        reason: &'static str,
    },
    /// Table of a spring whose elongations do not increase.
    #[error(
        "{object}: the elongation at index {index} of its table is {elongation}, but the previous one is {before}; elongations must increase"
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
        "{joint}: its stations at {from} and {to} are {} apart, but must be at the same place at the start; move one of them", rounded(*gap)
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
    #[error("{joint}: {place} is already {existing}; remove one of the two joints")]
    AlreadyTied {
        /// Name of the joint.
        joint: String,
        /// Description of the place.
        place: String,
        /// Existing joint or support of the place.
        existing: String,
    },
    /// Damping law that adds energy at some rate, or has a force at zero rate.
    #[error("{damper}: {active_range}")]
    ActiveDamper {
        /// Description of the damper.
        damper: String,
        /// Range of rates in which the law adds energy, and advice for correcting it.
        active_range: String,
    },
    /// Support of a component that a drive prescribes.
    #[error(
        "the {component} of {place} is already prescribed by '{drive}' and cannot also be fixed; prescribe or fix each component once"
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
        "{drive}: the {component} of {place} is already {existing}; prescribe or fix each component once"
    )]
    AlreadyDriven {
        /// Name of the rejected drive.
        drive: String,
        /// Component.
        component: &'static str,
        /// Description of the place.
        place: String,
        /// The word `fixed` or `prescribed`, or another reason.
        existing: &'static str,
    },
    /// Prescribed motion that does not start at its station.
    #[error(
        "{drive}: its {component} is {value} at t = 0, but must be 0: a prescribed motion is relative to the initial position"
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
        "{drive}: its {component} jumps by {} at t = {time}, but a prescribed motion must be continuous", rounded(*jump)
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
    #[error("'{name}' already has a release; remove one of the two releases")]
    ReleasedTwice {
        /// Name of the object.
        name: String,
    },
    /// Scene in which all degrees of freedom are fixed.
    #[error(
        "the scene '{scene}' has no free degree of freedom: all are fixed by supports or prescribed; remove a support"
    )]
    NothingMoves {
        /// Name of the scene.
        scene: String,
    },
    /// Start velocities that contradict each other.
    #[error(
        "{body} has the start velocity {} at its {place}, but {other}; give it a compatible start velocity", rounded(*velocity)
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
    #[error("{object}: a particle has no rotation")]
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
    /// Law with too few points.
    #[error("{object}: {name} has {}, but must have at least two points", plural(*points, "point"))]
    FewPoints {
        /// Description of the object.
        object: String,
        /// Name of the property.
        name: &'static str,
        /// Number of points.
        points: usize,
    },
    /// Stored part of a scene that refers to a missing object.
    #[error("{object} refers to {kind} number {index} (from 0), but the scene has only {count}")]
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

/// Object that would rotate a particle, which has no rotation.
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
