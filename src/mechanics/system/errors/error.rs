//! What can be wrong with a scene.

use super::{SliderError, TrackError};
use crate::beams::BeamError;
use crate::geometry::GeometryError;
use crate::loads::LoadError;

/// A scene that cannot be described or built.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum SystemError {
    /// There is nothing to simulate.
    #[error("the scene '{scene}' has no beams, no particles and no bodies")]
    Empty {
        /// The name of the scene with nothing in it.
        scene: String,
    },
    /// A name that nobody could read or type.
    #[error("{name:?} is no name for a {kind}: {why}; use letters, numbers and spaces")]
    Unnamed {
        /// The kind of thing that should have the unreadable name.
        kind: &'static str,
        /// The unreadable name.
        name: String,
        /// The reason why the name cannot be read.
        why: &'static str,
    },
    /// Two things of a scene with the same name.
    #[error("the scene already has a {kind} '{name}'; give this {new} another name")]
    DuplicateName {
        /// The kind of thing that has the name already.
        kind: &'static str,
        /// The kind of thing that should have the name as well.
        new: &'static str,
        /// The name that two things would share.
        name: String,
    },
    /// A station off its beam.
    #[error("station {station} is outside [0, {length}] of beam '{beam}'")]
    StationOutside {
        /// The name of the beam whose station was asked for.
        beam: String,
        /// The arc length asked for, which is off the beam [length].
        station: f64,
        /// The length of the beam whose station was asked for [length].
        length: f64,
    },
    /// An outline of a rigid body that cannot be drawn.
    #[error("the outline of body '{body}' cannot be drawn: {why}")]
    Outline {
        /// The name of the rigid body.
        body: String,
        /// Why.
        why: &'static str,
    },
    /// A point that a rigid body does not have.
    #[error("body '{body}' has no point '{point}'; it has {}", if known.is_empty() { "none but its centre" } else { known })]
    NoPoint {
        /// The name of the rigid body.
        body: String,
        /// The name that was asked for.
        point: String,
        /// The names of its points, in words.
        known: String,
    },
    /// Rigid bodies that are held more often than they can move.
    #[error(
        "body '{body}' is held more often than it can move: joints of its points ask for the same twice, and their forces are not determined; remove one of them, or let a beam take the place of a body"
    )]
    HeldTwice {
        /// The name of a rigid body whose forces are not determined.
        body: String,
    },
    /// A rigid body without inertia whose angle nothing holds.
    #[error(
        "body '{body}' has no inertia, and nothing holds its angle or acts on it beside its centre, so that nothing determines how it turns"
    )]
    Inertialess {
        /// The name of the body that turns against nothing.
        body: String,
    },
    /// A rigid body without mass that nothing holds.
    #[error(
        "body '{body}' has no mass, and nothing holds it, so that nothing determines how it moves"
    )]
    Massless {
        /// The name of the body that moves against nothing.
        body: String,
    },
    /// A start velocity of a single point of a rigid body.
    #[error("{object}: the points of a body move with it")]
    PointAlone {
        /// The start velocity of the point, in words.
        object: String,
    },
    /// Section forces of a particle, which has no section.
    #[error("{body} has no cross section")]
    NoSection {
        /// The particle whose section forces were asked for, in words.
        body: String,
    },
    /// Forces at a moment at which there are none.
    #[error("forces and accelerations at t = {time} cannot be had: {reason}")]
    NoInstant {
        /// When.
        time: f64,
        /// Why.
        reason: String,
    },
    /// A quantity to record that there is not.
    #[error("there is no quantity '{name}' to record: {why}")]
    NoSensor {
        /// What was asked for.
        name: String,
        /// What is wrong with it.
        why: String,
    },
    /// A quantity that is recorded already.
    #[error("'{name}' is a column of the history already; give this one another name")]
    DuplicateSensor {
        /// Its name.
        name: String,
    },
    /// A joint that would tie a place to itself.
    #[error("{joint}: both stations are the same place of {body}; a joint needs two places")]
    JointWithItself {
        /// The name of the joint that would tie a place to itself.
        joint: String,
        /// The beam or particle that would be tied to itself, in words.
        body: String,
    },
    /// A spring that can do nothing.
    #[error(
        "{spring}: it would act from {from} to {to}, {why}, and can do nothing; give one of both another place"
    )]
    IdleSpring {
        /// The spring that can do nothing, in words.
        spring: String,
        /// Where it would begin, in words.
        from: String,
        /// Where it would end, in words.
        to: String,
        /// Why it can do nothing.
        why: &'static str,
    },
    /// A table of a spring whose elongations do not rise.
    #[error(
        "{object}: the elongation at index {index} of its table is {elongation}, and the one before is {before}: they must rise from point to point"
    )]
    TableOrder {
        /// The spring with the table, in words.
        object: String,
        /// The index of the point whose elongation does not rise, from 0.
        index: usize,
        /// The elongation there [length, rad].
        elongation: f64,
        /// The elongation of the point before [length, rad].
        before: f64,
    },
    /// A joint whose partners do not meet.
    #[error(
        "{joint}: its stations at {from} and {to} are {gap} apart; they must lie at the same place when the scene starts: move one of them"
    )]
    OpenJoint {
        /// The name of the joint whose partners do not meet.
        joint: String,
        /// The first partner of the joint in words.
        from: String,
        /// The second partner of the joint in words.
        to: String,
        /// The distance between the partners that do not meet [length].
        gap: f64,
    },
    /// A joint of a place whose movement is already tied in that way.
    #[error("{joint}: {place} is already {how}; remove one of the two joints")]
    AlreadyTied {
        /// The name of the joint that would tie a place again.
        joint: String,
        /// The place that is tied already, in words.
        place: String,
        /// What ties the place already, in words.
        how: String,
    },
    /// A damper whose law pushes at some rate, or at rest.
    #[error("{damper}: {feeding}")]
    FeedingDamper {
        /// The damper whose law pushes, in words.
        damper: String,
        /// Where it does, and what should be given, in words.
        feeding: String,
    },
    /// Something that would hold what a drive moves.
    #[error(
        "the {component} of {place} is given by '{drive}' already: it cannot be held besides; give or hold each movement once"
    )]
    HeldAndDriven {
        /// The component that is given, in words.
        component: &'static str,
        /// The place that is moved, in words.
        place: String,
        /// The name of the drive.
        drive: String,
    },
    /// A motion that is given to what is held, or moved by another drive, already.
    #[error(
        "{drive}: the {component} of {place} is {how} already; give or hold each movement once"
    )]
    AlreadyDriven {
        /// The name of the drive that cannot have its place.
        drive: String,
        /// The component that is held or given already, in words.
        component: &'static str,
        /// The place whose motion should be given, in words.
        place: String,
        /// Held or given, in words.
        how: &'static str,
    },
    /// A given motion that does not begin where its station is.
    #[error(
        "{drive}: its {component} is {value} at t = 0, but a given motion is counted from the place as drawn and begins with 0"
    )]
    DriveStart {
        /// The name of the drive whose motion begins elsewhere.
        drive: String,
        /// The component in words.
        component: &'static str,
        /// The value at the start [length, rad].
        value: f64,
    },
    /// A given motion that jumps.
    #[error(
        "{drive}: its {component} jumps by {jump} at t = {time}, but a given motion has to be continuous"
    )]
    DriveJump {
        /// The name of the drive whose motion jumps.
        drive: String,
        /// The component in words.
        component: &'static str,
        /// The time of the jump [time].
        time: f64,
        /// How far it jumps [length, rad].
        jump: f64,
    },
    /// A given motion without a value.
    #[error("{drive}: {source}")]
    DriveValue {
        /// The name of the drive whose motion has no value.
        drive: String,
        /// Why it has none.
        source: LoadError,
    },
    /// Something that would let go a second time.
    #[error("'{name}' lets go already; it can do so once: remove one of the two releases")]
    ReleasedTwice {
        /// What lets go already.
        name: String,
    },
    /// A scene in which everything is held: nothing moves.
    #[error("the scene '{scene}' has nothing that can move: every unknown is held by a support")]
    NothingMoves {
        /// The name of the scene in which nothing moves.
        scene: String,
    },
    /// Start velocities that tied things do not share.
    #[error(
        "{body} starts with a velocity of {velocity} at its {place}, but {other}; give it a start velocity that fits"
    )]
    StartVelocity {
        /// The beam or particle whose start velocity does not fit, in words.
        body: String,
        /// The component and place whose start velocity does not fit, in words.
        place: String,
        /// The start velocity that does not fit [length/time, or 1/time for a rotation].
        velocity: f64,
        /// What the place is tied to, with its velocity, in words.
        other: String,
    },
    /// A joint, load, inertia or spin that would turn a particle.
    #[error("{object}: a particle does not turn")]
    ParticleTurned {
        /// The joint, load, inertia or spin that would turn a particle, in words.
        object: String,
        /// The thing that would turn the particle.
        by: Turning,
    },
    /// A sliding joint that is impossible.
    #[error(transparent)]
    Slider(Box<SliderError>),
    /// A track that is impossible.
    #[error(transparent)]
    Track(Box<TrackError>),
    /// A number of a scene that is out of its range.
    #[error("{object}: {name} is {value}, but must be {allowed}")]
    Value {
        /// The object to which the refused number belongs, in words.
        object: String,
        /// The name of the refused property.
        name: &'static str,
        /// The value of the refused property, in its unit.
        value: f64,
        /// The values that the refused property may have, in words.
        allowed: &'static str,
    },
    /// A stored part of a scene that refers to something that is not there.
    #[error("{object} is on {kind} number {index}, but the scene has only {count}")]
    Missing {
        /// The part of the scene that refers to something missing, in words.
        object: &'static str,
        /// The kind of the thing that is missing.
        kind: &'static str,
        /// The index of the thing that is missing.
        index: usize,
        /// The number of things of that kind in the scene.
        count: usize,
    },
    /// A stored state that is not one of the model.
    #[error("the state does not fit the scene: {reason}")]
    State {
        /// Why the stored state does not fit the model.
        reason: &'static str,
    },
    /// A beam that cannot be put on its mesh.
    #[error("beam '{beam}': {source}")]
    Beam {
        /// The name of the beam that cannot be put on its mesh.
        beam: String,
        /// The reason why the beam cannot be put on its mesh.
        source: BeamError,
    },
}

/// The thing that would turn a particle.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Turning {
    /// A rigid joint would turn the particle.
    RigidJoint,
    /// The rotary inertia of a point mass would turn with the particle.
    RotaryInertia,
    /// A moment, or a force that follows a section, would turn the particle.
    Load,
    /// A spin at the start would turn the particle.
    Spin,
    /// A torsion spring.
    TorsionSpring,
    /// A drive would give the particle an angle.
    Drive,
}

impl SystemError {
    /// For `map_err`: makes a geometry error one of a beam, by its name.
    pub(in crate::system) fn geometry(beam: &str) -> impl Fn(GeometryError) -> Self + '_ {
        move |source| Self::Beam { beam: beam.to_owned(), source: source.into() }
    }

    /// For `map_err`: makes an error of a beam one of the model, by the beam's name.
    pub(in crate::system) fn beam(name: &str) -> impl Fn(BeamError) -> Self + '_ {
        move |source| Self::Beam { beam: name.to_owned(), source }
    }
}

/// Refuses numbers that are not finite; they are a property, of a name, of an object in words.
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
