//! What can be wrong with a sliding joint.

use std::fmt;

/// The parts of a slider in words, for messages.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct SliderParts {
    /// The name of the slider.
    pub slider: String,
    /// The slave of the slider, the point that slides, in words.
    pub slave: String,
    /// What the slider slides on, in words: `beam 'rod'`, `track 'ring'`.
    pub guide: String,
}

/// The place of a beam or a track that is nearest to a point.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Approach {
    /// The point lies on it.
    On {
        /// The place of the point, as a part of the length of what it is on [-].
        place: f64,
        /// What it is on: a beam or a track.
        guide: &'static str,
    },
    /// The point does not lie on it.
    Apart {
        /// The place that is nearest to the point, as a part of the length of what it is on [-].
        place: f64,
        /// What it is on: a beam or a track.
        guide: &'static str,
        /// How far that is [length].
        distance: f64,
    },
}

impl fmt::Display for Approach {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::On { place, guide } => {
                write!(f, "it lies on that {guide} at {place} of its length")
            }
            Self::Apart { place, guide, distance } => {
                write!(
                    f,
                    "the {guide} comes no nearer than {distance:.3e}, at {place} of its length"
                )
            }
        }
    }
}

/// A sliding joint that cannot be described or built.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum SliderError {
    /// A slider whose slave is a part of its master.
    #[error(
        "slider '{}': {} is on the {} itself; a beam cannot slide on itself, choose another beam",
        _0.slider, _0.slave, _0.guide
    )]
    OnItself(SliderParts),
    /// A slider whose slave is not on its master.
    #[error(
        "slider '{}': {} is at {from}, {gap:.3e} from its place {to} on the {}; {nearest}",
        parts.slider, parts.slave, parts.guide
    )]
    Open {
        /// The slider whose slave is not on its master.
        parts: SliderParts,
        /// The place of the slave, in words.
        from: String,
        /// The place on the master where the slave should be, in words.
        to: String,
        /// The distance of the slave from that place on the master [length].
        gap: f64,
        /// The place where the beam comes nearest to the slave.
        nearest: Approach,
    },
    /// A slider whose slave slides on the same master already.
    #[error(
        "slider '{}': {} already slides on the {}; remove one of the two sliders",
        _0.slider, _0.slave, _0.guide
    )]
    Twice(SliderParts),
    /// A slider whose slave is tied to its master as well.
    #[error(
        "slider '{}': {} is also joined to the {}, on which it then cannot slide; remove the joint or the slider",
        _0.slider, _0.slave, _0.guide
    )]
    Tied(SliderParts),
    /// A slider on a track under a rule that is for one beam.
    #[error("slider '{}': the {rule} rule is for one beam: at the seams of the {} {why}", parts.slider, parts.guide)]
    RuleOfOneBeam {
        /// The slider on a track.
        parts: SliderParts,
        /// The name of the rule that is for one beam.
        rule: &'static str,
        /// What happens at seams under that rule, in words.
        why: &'static str,
    },
    /// A coefficient of restitution that is none.
    #[error("slider '{slider}': a restitution of {restitution} is outside [0, 1]")]
    Restitution {
        /// The name of the slider with such a coefficient.
        slider: String,
        /// The coefficient of restitution that is none [-].
        restitution: f64,
    },
    /// Start velocities with which a slider would leave its master.
    #[error(
        "slider '{slider}': at the start its point moves across its beam with a speed of {speed}"
    )]
    LeavesMaster {
        /// The name of the slider with such start velocities.
        slider: String,
        /// The speed of the slave relative to its master, across it [length/time].
        speed: f64,
    },
    /// A slider between places that are held already.
    #[error(
        "slider '{}': {} and its place on the {} are both held already, so that the contact force is not determined; remove the slider or a support",
        _0.slider, _0.slave, _0.guide
    )]
    HeldBesides(SliderParts),
    /// Sliders that do not determine their forces.
    #[error(
        "the sliders '{sliders}' hold each other: their contact forces are not determined; remove one of them, or a support"
    )]
    Overdetermined {
        /// The names of the sliders whose forces are not determined.
        sliders: String,
    },
}
