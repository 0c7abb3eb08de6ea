//! Elements that act on bodies: point masses, weight, loads, springs and supports.
//! A new type of element needs a file in this folder and a variant of [`Element`].

mod all;
mod brake;
mod branch;
mod contact;
mod contact_watch;
mod coordinate;
mod damping_law;
mod drag;
mod drag_forces;
mod drag_law;
mod drag_point;
mod drive;
mod element;
mod elongation;
mod external_force;
mod follower;
mod internal_force;
mod law_range;
mod load;
mod load_vector;
mod material_damping;
mod mixed_force;
mod motion_curvature;
mod point_damper;
mod point_mass;
mod prescribed_movements;
mod rate_history;
mod sampling;
mod schedule_check;
mod spring;
mod spring_at_rest;
mod spring_damper;
mod spring_law;
mod supports;
mod weight;
mod work_and_impulse;
mod zero_length_spring;

pub use all::Elements;
pub use brake::BrakeLaw;
pub use branch::{Along, Branch};
pub use contact::{
    ContactMember, ContactState, ContactTarget, Obstacle, ObstacleShape, PairContact, Penetration,
};
pub use contact_watch::ShortBounce;
pub use damping_law::DampingLaw;
pub use drag::{Drag, Dragged};
pub use drag_law::SpeedLaw;
pub use drive::{Drive, DriveKind};
pub use element::{AssemblyContext, Element, ElementDef, SceneChecks};
pub use external_force::{ExternalForce, LoadAccount, TrialState, collocation};
pub use internal_force::{InternalForce, SpringTrialState};
pub use law_range::{LawArgument, OutsideLaw};
pub use material_damping::MaterialDamping;
pub use motion_curvature::MotionCurvature;
pub use point_mass::PointMass;
pub use prescribed_movements::{DriveState, PrescribedMovement, PrescribedMovements};
pub use schedule_check::{ScheduleCheck, UnsampledChange};
pub use spring::{Anchor, Origin, Spring, SpringKind};
pub use spring_law::SpringLaw;
pub use supports::{Support, Supports};
pub use weight::Weight;
pub use work_and_impulse::WorkAndImpulse;
