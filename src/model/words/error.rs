//! What can be wrong with a scene.

use super::SliderError;
use crate::beams::BeamError;
use crate::geometry::GeometryError;

/// A scene that cannot be described or built.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum ModelError {
    /// There is nothing to simulate.
    #[error(
        "the scene '{scene}' has no beams and no particles; add one with scene.beam(#{{ axis: …, section: … }}) or scene.particle([x, y], mass)"
    )]
    Empty {
        /// Its name.
        scene: String,
    },
    /// A name that nobody could read.
    #[error("{name:?} is no name for a {kind}: {why}; use letters, numbers and spaces")]
    Unnamed {
        /// What should be called that.
        kind: &'static str,
        /// The name.
        name: String,
        /// Why it cannot be read.
        why: &'static str,
    },
    /// Two things of the same name.
    #[error("the scene already has a {kind} '{name}'; give this {new} another name")]
    DuplicateName {
        /// What is called that.
        kind: &'static str,
        /// What should be called that as well.
        new: &'static str,
        /// The name.
        name: String,
    },
    /// A station off its beam.
    #[error(
        "station {station} is outside [0, {length}] of beam '{beam}'; use beam.end for its end"
    )]
    StationOutside {
        /// The beam.
        beam: String,
        /// The arc length asked for.
        station: f64,
        /// The length of the beam.
        length: f64,
    },
    /// Section forces of what has no section.
    #[error("{body} has no cross section: give a station of a beam")]
    NoSection {
        /// The particle.
        body: String,
    },
    /// A joint of a place with itself.
    #[error("{joint}: both stations are the same place of {body}; a joint needs two places")]
    JointWithItself {
        /// The joint.
        joint: String,
        /// The beam or particle.
        body: String,
    },
    /// Partners that do not meet.
    #[error(
        "{joint}: its stations at {from} and {to} are {gap} apart; they must lie at the same place when the scene starts: move one of them"
    )]
    OpenJoint {
        /// The joint.
        joint: String,
        /// One place.
        from: String,
        /// The other.
        to: String,
        /// The distance.
        gap: f64,
    },
    /// A place whose movement is already tied in that way.
    #[error("{joint}: {place} is already {how}; remove one of the two joints")]
    AlreadyTied {
        /// The joint.
        joint: String,
        /// The place.
        place: String,
        /// By what.
        how: String,
    },
    /// Everything is held.
    #[error("the scene '{scene}' has nothing that can move: every unknown is held by a support")]
    NothingMoves {
        /// Its name.
        scene: String,
    },
    /// Start velocities that tied things do not share.
    #[error(
        "{body} starts with a velocity of {velocity} at its {place}, but {other}; give it a start velocity that fits"
    )]
    StartVelocity {
        /// The beam or particle.
        body: String,
        /// Which component of which place.
        place: String,
        /// Its value.
        velocity: f64,
        /// What it is tied to.
        other: String,
    },
    /// A joint, load, inertia or spin that would turn a particle.
    #[error("{object}: a particle does not turn; {advice}")]
    ParticleTurned {
        /// What would turn it.
        object: String,
        /// What would be right.
        advice: &'static str,
    },
    /// A sliding joint that cannot be.
    #[error(transparent)]
    Slider(Box<SliderError>),
    /// A number that is out of range.
    #[error("{object}: {name} is {value}, but must be {allowed}")]
    Value {
        /// What it belongs to.
        object: String,
        /// The property.
        name: &'static str,
        /// Its value.
        value: f64,
        /// What it may be.
        allowed: &'static str,
    },
    /// A stored part of a scene that is about something that is not there.
    #[error("{object} is on {kind} number {index}, but the scene has only {count}")]
    Missing {
        /// What is about it.
        object: &'static str,
        /// The kind of what is missing.
        kind: &'static str,
        /// Its index.
        index: usize,
        /// How many there are.
        count: usize,
    },
    /// A stored state that is none of the model.
    #[error("the state does not fit the scene: {reason}")]
    State {
        /// What does not fit.
        reason: &'static str,
    },
    /// A beam that cannot be put on its mesh.
    #[error("beam '{beam}': {source}")]
    Beam {
        /// The beam.
        beam: String,
        /// Why.
        source: BeamError,
    },
}

impl ModelError {
    /// For `map_err`: a geometry error of a beam.
    pub(in crate::model) fn geometry(beam: &str) -> impl Fn(GeometryError) -> Self + '_ {
        move |source| Self::Beam { beam: beam.to_owned(), source: source.into() }
    }

    /// Something wrong with a beam.
    pub(in crate::model) fn beam(name: &str) -> impl Fn(BeamError) -> Self + '_ {
        move |source| Self::Beam { beam: name.to_owned(), source }
    }
}

/// Refuses numbers that are not finite: a property of an object.
pub fn finite(object: &str, name: &'static str, values: &[f64]) -> Result<(), ModelError> {
    match values.iter().find(|value| !value.is_finite()) {
        Some(&value) => {
            let allowed = "a finite number";
            Err(ModelError::Value { object: object.to_owned(), name, value, allowed })
        }
        None => Ok(()),
    }
}

impl From<SliderError> for ModelError {
    fn from(error: SliderError) -> Self {
        Self::Slider(Box::new(error))
    }
}
