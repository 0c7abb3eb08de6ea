//! What acts on the bodies: masses and loads.

mod load;
mod point_mass;

pub(super) use load::{Action, AppliedLoad, Exchange, Follower, Pattern, collocation};
pub(super) use point_mass::Lump;
