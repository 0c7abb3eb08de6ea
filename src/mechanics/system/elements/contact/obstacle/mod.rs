//! Obstacles that are fixed to the ground, and their contact with beams, particles and points of rigid bodies.
//!
//! Submodules: `definition` (scene object), `point` (one contact point), `friction`, and `forces` (all contact points).

mod definition;
mod forces;
mod friction;
mod point;

pub use definition::{Obstacle, ObstacleShape};
