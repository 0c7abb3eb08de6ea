//! Constraints with force unknowns: inclined rollers, and rigid links between the points of rigid bodies and their centres.

mod all;
mod inclined_roller;
mod rigid_link;

pub use all::Links;
pub use inclined_roller::InclinedRoller;
pub use rigid_link::{ArmRule, RigidLink};
