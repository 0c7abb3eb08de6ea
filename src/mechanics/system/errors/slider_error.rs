//! Errors of sliding joints.

use std::fmt;

use super::rounded;

/// Descriptions of a slider, its slave and its master.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct SliderParts {
    /// Name of the slider.
    pub slider: String,
    /// Description of the slave.
    pub slave: String,
    /// Description of the master, such as `beam 'rod'` or `track 'ring'`.
    pub guide: String,
}

/// Point of a beam or track that is nearest to a given point.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Approach {
    /// The point lies on the beam or track.
    On {
        /// Relative position of the point along the master [-].
        place: f64,
        /// The word `beam` or `track`.
        guide: &'static str,
    },
    /// The point does not lie on the beam or track.
    Distant {
        /// Relative position of the nearest point along the master [-].
        place: f64,
        /// The word `beam` or `track`.
        guide: &'static str,
        /// Distance to the nearest point [length].
        distance: f64,
    },
}

impl fmt::Display for Approach {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::On { place, guide } => {
                write!(f, "it lies on that {guide} at {} of its length", rounded(*place))
            }
            Self::Distant { place, guide, distance } => {
                write!(
                    f,
                    "the nearest point of the {guide} is {} away, at {} of its length",
                    rounded(*distance),
                    rounded(*place)
                )
            }
        }
    }
}

/// Error for a sliding joint that cannot be defined or built.
#[expect(missing_docs, reason = "the messages describe the variants and their fields")]
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum SliderError {
    #[error(
        "slider '{}': {} is a part of the {}; a beam cannot slide on itself, choose another beam",
        _0.slider, _0.slave, _0.guide
    )]
    SlaveOnMaster(SliderParts),
    #[error(
        "slider '{}': {} is at {from}, {} from its place {to} on the {}; {nearest}",
        parts.slider, parts.slave, rounded(*gap), parts.guide
    )]
    Open { parts: SliderParts, from: String, to: String, gap: f64, nearest: Approach },
    #[error(
        "slider '{}': {} already slides on the {}; remove one of the two sliders",
        _0.slider, _0.slave, _0.guide
    )]
    Duplicate(SliderParts),
    #[error(
        "slider '{}': {} is also joined to the {} and cannot slide on it; remove the joint or the slider",
        _0.slider, _0.slave, _0.guide
    )]
    AlreadyJoined(SliderParts),
    #[error("slider '{}': the {rule} rule is available for single beams only: at the seams of the {} {behaviour}", parts.slider, parts.guide)]
    RuleOfOneBeam { parts: SliderParts, rule: &'static str, behaviour: &'static str },
    #[error("slider '{slider}': restitution is {restitution}, but must be from 0 to 1")]
    Restitution { slider: String, restitution: f64 },
    #[error("slider '{slider}': friction is {friction}, but must be zero or more")]
    Friction { slider: String, friction: f64 },
    #[error(
        "slider '{slider}': static_friction is {static_friction}, but must be at least friction, which is {friction}"
    )]
    StaticFriction { slider: String, static_friction: f64, friction: f64 },
    #[error(
        "slider '{slider}': friction is available with the conserving rule only, not with the {rule} rule"
    )]
    FrictionRule { slider: String, rule: &'static str },
    #[error("slider '{slider}': a side is not available {what}; {remedy}, or remove the side")]
    SideWith { slider: String, what: &'static str, remedy: &'static str },
    #[error("slider '{slider}': a sleeve is not available {what}; {remedy}")]
    SleeveWith { slider: String, what: &'static str, remedy: &'static str },
    #[error(
        "slider '{}': {} is {} away from the {}, but not on its {side} side; move it there or choose the other side",
        parts.slider, parts.slave, rounded(*gap), parts.guide
    )]
    OtherSide { parts: SliderParts, side: &'static str, gap: f64 },
    #[error(
        "slider '{slider}': at the start its point moves across its beam with a velocity of {}", rounded(*speed)
    )]
    LeavesMaster { slider: String, speed: f64 },
    #[error(
        "slider '{}': {} and its place on the {} are both fixed, so that the contact force is undetermined; remove the slider or a support",
        _0.slider, _0.slave, _0.guide
    )]
    OverConstrained(SliderParts),
    #[error(
        "the sliders '{sliders}' restrain the same movement: their contact forces are undetermined; remove one of them, or a support"
    )]
    Overdetermined { sliders: String },
}
