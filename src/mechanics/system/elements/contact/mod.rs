//! Compliant contact: the contact force follows from a potential of the gap.

mod between_bodies;
mod disc_path;
mod friction;
mod law;
mod normal_force;
mod obstacle;
mod state;
mod target;

pub use between_bodies::{ContactMember, PairContact};
use disc_path::DiscPath;
use friction::sticking_damping;
pub(super) use friction::{NormalContact, PointFriction, SlipTrial};
use law::{ContactLaw, LEAST_RESTITUTION, damping_factor};
use normal_force::{ContactTime, GapChange, NormalForce, NormalLaw, SOFT};
pub use obstacle::{Obstacle, ObstacleShape};
pub use state::{ContactState, Penetration};
pub use target::ContactTarget;
use target::contact_parameters;
