//! Small vibrations about a configuration, natural frequencies and mode shapes; and the eigenvalue problem of linear buckling.

mod buckling;
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
mod shapes;

pub use buckling::CriticalLoad;
pub(crate) use buckling::{CriticalLoads, critical_loads};
pub use damped::DampedMode;
pub use error::VibrationError;
pub(crate) use modes::loose_movements;
pub use modes::{Mode, Modes};
pub use shapes::ModeShapes;
