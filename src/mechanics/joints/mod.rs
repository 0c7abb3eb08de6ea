//! Joints: which movements are tied, to what, and where; and the laws of joints that slide.

mod joint;
mod release;
mod slider;
mod sliding;
mod track;

pub use joint::{Component, Components, Joint, JointKind, Partner};
pub use release::{Hold, Release, Trigger};
pub use slider::{EndAction, Slider, StartVelocities};
pub use sliding::{
    CONTACT_UNKNOWNS, Conserving, Contact, ContactUnknowns, Equation, Exact, Frozen, Held, Kink,
    KinkMotion, KinkState, Kinked, Leaning, Relaxed, Released, Resting, RuleClaims, RuleEntry,
    SLIDING_RULES, SlidingLaw, SlidingRule, Unit, WayVector,
};
pub use track::{Course, Heading, Leg, Track};
