//! What ties movements by forces that are unknowns among them: rigid links, which hold the points of rigid bodies to their centres, and inclined rollers.

mod all;
mod inclined_roller;
mod rigid_link;

pub use all::Links;
pub use inclined_roller::InclinedRoller;
pub use rigid_link::{ArmRule, RigidLink};
