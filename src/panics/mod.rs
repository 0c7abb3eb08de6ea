//! Catches panics, which are internal errors.

mod caught;

pub use caught::{caught, silence};
