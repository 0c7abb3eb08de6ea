//! Obstacles that are fixed to the ground, and their contact with beams, particles and points of rigid bodies.
//!
//! Submodules: `definition` (scene object), `point` (one contact point), `slip` (slip along the surface), and `forces` (all contact points).

mod definition;
mod forces;
mod point;
mod slip;

pub use definition::{Obstacle, ObstacleShape};
