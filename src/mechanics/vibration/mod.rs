//! Small vibrations about a configuration: natural frequencies and mode shapes.

mod damped;
mod dense;
mod elastic;
mod error;
mod lanczos;
mod modes;
mod pencil;
mod quadratic;
mod refinement;
mod resolvent;
mod search;

pub use damped::DampedMode;
pub use error::VibrationError;
pub(crate) use modes::loose_movements;
pub use modes::{Mode, Modes};
