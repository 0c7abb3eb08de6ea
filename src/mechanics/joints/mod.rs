//! Joints, and the laws of contact between sliders and their masters.

mod joint;
mod release;
mod slider;
mod sliding;
mod track;
mod wrench;

pub use joint::{Component, Components, Joint, JointKind, Partner};
pub use release::{Releasable, Release, Trigger};
pub use slider::{EndAction, Restraint, Side, Slider, StartVelocities};
pub use sliding::{
    AtStop, CONTACT_UNKNOWNS, Conserving, Contact, ContactUnknowns, Equation, Exact, Friction,
    FrictionForces, FrictionMode, Frozen, HeldSlider, Kink, KinkMotion, KinkState, Kinked,
    MasterAtSleeve, MovingSleeve, PathVector, Relaxed, Released, Resting, RestingSleeve,
    RotationSlopes, RuleClaims, RuleEntry, SLIDING_RULES, SleeveOffset, SleeveRotations,
    SlidingLaw, SlidingRule, Unit,
};
pub use track::{Track, TrackBeam, TrackDirection, TrackEnd};
pub use wrench::Wrench;
