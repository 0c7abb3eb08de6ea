//! Laws of sliding joints: equations of a closed gap, and equations of sliding.
//!
//! The unknowns of a slider in a step are the contact force on the master, the couple, and the sliding increment.
//! All laws apply the same forces to slave and master (see [`Contact`]). The laws differ in the five equations for the unknowns.

mod conserving;
mod contact;
mod dual;
mod equation;
mod exact;
mod friction;
mod frozen;
mod held;
mod kink_on_path;
mod kinked;
mod law;
mod moving_sleeve;
mod relaxed;
mod released;
mod resting;
mod rule;
mod sleeve;

pub use conserving::Conserving;
pub use contact::{
    CONTACT_UNKNOWNS, Contact, ContactUnknowns, Kink, KinkMotion, KinkState, PathVector,
};
pub use equation::{Equation, Unit};
pub use exact::Exact;
pub use friction::{Friction, FrictionForces, FrictionMode};
pub use frozen::Frozen;
pub use held::HeldSlider;
pub use kinked::Kinked;
pub use law::SlidingLaw;
pub use moving_sleeve::{MovingSleeve, RotationSlopes, SleeveRotations};
pub use relaxed::Relaxed;
pub use released::Released;
pub use resting::{AtStop, Resting};
pub use rule::{RuleClaims, RuleEntry, SLIDING_RULES, SlidingRule};
pub use sleeve::{MasterAtSleeve, RestingSleeve, SleeveOffset};
