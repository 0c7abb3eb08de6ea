//! Equilibrium of a scene under its loads, found by load steps, or along the path of equilibria through limit points; linear buckling.

mod balance;
mod buckling;
mod continuation;
mod dynamic_relaxation;
mod equilibrium;
mod error;
mod loading;
mod path;
mod path_step;

pub use buckling::{Buckling, BucklingError, NonlinearPart};
pub use equilibrium::{Equilibrium, Stability};
pub use error::{InTime, StaticsError, StepFailure};
pub use loading::{ArcLength, Control, Loading};
pub use path::{EquilibriumPath, PathPoint};
