//! Equilibrium of a scene under its loads: in steps of the load, or along the path of equilibria through its limit points.

mod balance;
mod equilibrium;
mod error;
mod loading;
mod path;
mod settling;
mod tracer;
mod trial;

pub use equilibrium::{Equilibrium, Stability};
pub use error::{InTime, Miss, StaticsError};
pub use loading::{ArcLength, Control, Loading};
pub use path::{Path, PathPoint};
