//! Obstacles that are fixed to the ground, and their contact with beams, particles and points of rigid bodies.

mod definition;
mod forces;
mod point;
mod slip;

pub use definition::{Obstacle, ObstacleShape};
