//! Why no equilibrium was found.

use crate::loads::LoadError;
use crate::model::ModelError;
use crate::newton::NewtonError;

/// An equilibrium that was not found.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum StaticsError {
    /// A scene that cannot be built.
    #[error(transparent)]
    Model(#[from] ModelError),
    /// A load without a value.
    #[error("load '{load}': {source}")]
    Load {
        /// Its name.
        load: String,
        /// Why.
        source: LoadError,
    },
    /// Nothing acts.
    #[error("no load acts at t = {time}: with nothing to carry, the scene rests as it is drawn")]
    NoLoad {
        /// When loads were taken.
        time: f64,
    },
    /// A joint that statics does not know.
    #[error("slider '{slider}': equilibrium of sliding joints is not built")]
    Slider {
        /// Its name.
        slider: String,
    },
    /// A number out of its range.
    #[error("{name} is {value}, but must be {allowed}")]
    Value {
        /// The setting.
        name: &'static str,
        /// Its value.
        value: f64,
        /// What it may be.
        allowed: &'static str,
    },
    /// A scene that moves without resistance.
    #[error(
        "'{scene}' is not held: {movements} of its movements meet no resistance as it is drawn"
    )]
    Loose {
        /// Its name.
        scene: String,
        /// How many.
        movements: usize,
    },
    /// No equilibrium near the last one.
    #[error("no equilibrium of '{scene}' was found near that at load factor {reached}: {reason}")]
    Lost {
        /// Its name.
        scene: String,
        /// The last load factor with an equilibrium [-].
        reached: f64,
        /// Why the next one was missed.
        reason: Box<Miss>,
    },
    /// Somebody stopped it.
    #[error("stopped at load factor {reached}")]
    Interrupted {
        /// The last load factor with an equilibrium [-].
        reached: f64,
    },
}

/// Why a step found no equilibrium.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum Miss {
    /// Newton's method found none.
    #[error(transparent)]
    Newton(#[from] NewtonError),
    /// It found one far away.
    #[error("the next one is far away, as where a structure snaps through")]
    Far,
}
