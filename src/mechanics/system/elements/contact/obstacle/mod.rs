//! Obstacles that are fixed to the ground, and their contact with beams, particles and points of rigid bodies.
//!
//! The definition of an obstacle is in `definition`, friction in `friction`, one contact point in `point`, and the sum over all points in `forces`.

mod definition;
mod forces;
mod friction;
mod point;

pub use definition::{Obstacle, ObstacleShape};
