//! What ties beams to each other and to the ground.

mod joint;

pub use joint::{Component, Joint, JointKind, Partner};
