//! Obstacles that are fixed to the ground, and their contact with beams, particles and points of rigid bodies.
//!
//! Contact is compliant: the contact force follows from a potential of the gap.
//! The definition of an obstacle is in `definition`, the law of the gap in `law`, friction in `friction`, one contact point in `point`, and the sum over all points in `forces`.

mod definition;
mod forces;
mod friction;
mod law;
mod normal_force;
mod point;

pub use definition::{ContactTarget, Obstacle, ObstacleShape};
pub(super) use definition::{LEAST_RESTITUTION, contact_parameters};
pub use forces::{ContactState, Penetration};
pub(super) use law::{ContactLaw, damping_factor};
pub(super) use normal_force::{ContactTime, GapChange, NormalForce, NormalLaw};
pub(super) use point::DiscPath;
