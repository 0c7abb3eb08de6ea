//! Rigid links: what holds the points of rigid bodies to their centres.

mod all;
mod rigid_link;

pub use all::RigidLinks;
pub use rigid_link::{ArmRule, RigidLink};
