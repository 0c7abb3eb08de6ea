//! Why modes were not found.

/// Modes that were not found.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum VibrationError {
    /// None or too many were asked for.
    #[error(
        "{asked} modes were asked for, but the scene has {available}, one for each movement with inertia; ask for 1 to {available}"
    )]
    Count {
        /// How many.
        asked: usize,
        /// How many there are.
        available: usize,
    },
    /// A joint that lets places move along a beam.
    #[error(
        "slider '{slider}': modes of scenes with sliding joints are not built; replace it by a hinge where it is"
    )]
    Slider {
        /// Its name.
        slider: String,
    },
    /// A load that turns with a section: its vibration has no modes of this kind.
    #[error(
        "load '{load}' turns with the beam: its stiffness is not symmetric, and the vibration may grow by itself; give it a fixed direction, or simulate"
    )]
    Follower {
        /// Its name.
        load: String,
    },
    /// A search that went on and on.
    #[error(
        "the modes did not settle in {restarts} restarts of the search; ask for a few more or fewer of them, or take a coarser mesh"
    )]
    Unsettled {
        /// How many.
        restarts: usize,
    },
    /// Rounding hides some.
    #[error(
        "rounding hides mode {modes}, counted from 0: its residual is {residual:.1e}, more than 1e-6; of modes below it there are {modes}: ask for no more, take a coarser mesh, or make the largest stiffness or the smallest inertia less extreme"
    )]
    Hidden {
        /// So many are below the first that is hidden.
        modes: usize,
        /// Its residual.
        residual: f64,
    },
    /// A count that rounding makes.
    #[error(
        "rounding hides how many modes there are below those that were found; take a coarser mesh, or make the largest stiffness or the smallest inertia less extreme"
    )]
    Uncounted,
    /// Somebody stopped it.
    #[error("stopped while modes were looked for")]
    Interrupted,
    /// A stiffness that no inertia makes positive.
    #[error(
        "a movement without inertia is unstable in this configuration: it has no modes; give sections a rotary inertia, or take a smaller load"
    )]
    Indefinite,
    /// Numbers that are not finite.
    #[error(
        "the stiffness or the inertia of the scene is not finite; check stiffness, masses and units"
    )]
    NotFinite,
}
