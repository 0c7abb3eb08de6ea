//! Panics: catching and reporting of internal errors.

mod caught;

pub use caught::{caught, silence};
