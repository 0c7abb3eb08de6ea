//! Small vibration about a configuration: natural frequencies and their shapes.

mod error;
mod modes;
mod pencil;
mod reduced;
mod subspace;

pub use error::VibrationError;
pub use modes::{Mode, Modes, loose_movements};
