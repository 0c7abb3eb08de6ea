//! What acts on the bodies: point masses, weight, loads, springs and supports. A further kind of element is a file here and a variant of
//! [`Element`].

mod all;
mod damping_law;
mod drag;
mod drag_forces;
mod drag_law;
mod drive;
mod element;
mod elongation;
mod exchange;
mod follower;
mod force_element;
mod hidden_force;
mod load;
mod material_damping;
mod pace;
mod pattern;
mod point_mass;
mod prescribed_movements;
mod resistance;
mod restoring;
mod sampling;
mod spring;
mod spring_at_rest;
mod spring_damper;
mod supports;
mod weight;

pub use all::Elements;
pub use damping_law::DampingLaw;
pub use drag::{Drag, Dragged};
pub use drag_law::SpeedLaw;
pub use drive::{Drive, DriveKind};
pub use element::{Element, Setting, Site};
pub use exchange::Exchange;
pub use force_element::{ForceElement, Iterate, LoadAccount, collocation};
pub use material_damping::MaterialDamping;
pub use point_mass::PointMass;
pub use prescribed_movements::{DriveState, PrescribedMovement, PrescribedMovements};
pub use resistance::{Resistance, Stretched};
pub use restoring::RestoringLaw;
pub use spring::{Anchor, Origin, Spring, SpringKind};
pub use supports::{Support, Supports};
pub use weight::Weight;
