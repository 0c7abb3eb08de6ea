//! Levers: what holds the points of rigid bodies to their centres.

mod all;
mod lever;

pub use all::Levers;
pub use lever::{Lever, Leverage};
