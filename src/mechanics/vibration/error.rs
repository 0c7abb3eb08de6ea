//! Why modes were not found.

/// What may be asked for.
fn range(available: usize) -> String {
    match available {
        0 => ": all of it is held or driven".to_owned(),
        _ => format!("; ask for 1 to {available}"),
    }
}

/// Modes that were not found.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum VibrationError {
    /// No modes or too many were asked for.
    #[error("{asked} modes were asked for, but the scene has {available}, one for each movement with inertia{}", range(*available))]
    Count {
        /// The number of modes asked for.
        asked: usize,
        /// The number of modes that the scene has.
        available: usize,
    },
    /// A load that turns with a section, so that the vibration of its scene has no modes of this kind.
    #[error(
        "load '{load}' turns with the beam: its stiffness is not symmetric, and the vibration may grow by itself; give it a fixed direction, or simulate"
    )]
    Follower {
        /// The name of the load that turns with a section.
        load: String,
    },
    /// A search for modes that went on and on without settling.
    #[error(
        "the modes did not settle in {restarts} restarts of the search; ask for a few more or fewer of them, or take a coarser mesh"
    )]
    Unsettled {
        /// How often the search began anew.
        restarts: usize,
    },
    /// Damped modes of a large scene.
    #[error(
        "the scene has {unknowns} unknowns, and damped modes are found with up to 240: take a coarser mesh; damping_ratios of modes are right to first order in the damping"
    )]
    LargeDamped {
        /// The number of unknowns of the scene.
        unknowns: usize,
    },
    /// Damped modes of a scene in which something has no inertia.
    #[error(
        "something in the scene moves without inertia, or slides, and may creep in ways that its modes do not tell: give it inertia; damping_ratios of modes are right to first order in the damping"
    )]
    LightDamped,
    /// Damped modes that are not found.
    #[error(
        "the damped modes of the scene are not found: its damping and its stiffness are too far apart for a matrix of both; take a coarser mesh or less damping, join or hold what a damper of that strength holds as good as rigidly, or simulate and fit the decay; damping_ratios of modes are right to first order in the damping"
    )]
    Damping,
    /// Modes of which rounding hides some.
    #[error(
        "rounding hides mode {modes}, counted from 0: its residual is {residual:.1e}, more than 1e-6; of modes below it there are {modes}: ask for no more, take a coarser mesh, or make the largest stiffness or the smallest inertia less extreme"
    )]
    Hidden {
        /// The number of modes below the first that is hidden.
        modes: usize,
        /// The residual of the first mode that is hidden [-].
        residual: f64,
    },
    /// A count of modes that rounding falsifies.
    #[error(
        "rounding hides how many modes there are below those that were found; take a coarser mesh, or make the largest stiffness or the smallest inertia less extreme"
    )]
    Uncounted,
    /// Forces of the present moment that were not found.
    #[error("{0}")]
    NoForces(String),
    /// A search for modes that was stopped from outside.
    #[error("stopped while modes were looked for")]
    Interrupted,
    /// A stiffness that no multiple of the inertia makes positive definite.
    #[error(
        "a movement without inertia is unstable in this configuration: it has no modes; give sections a rotary inertia, or take a smaller load"
    )]
    Indefinite,
    /// A stiffness or inertia with numbers that are not finite.
    #[error(
        "the stiffness or the inertia of the scene is not finite; check stiffness, masses and units"
    )]
    NotFinite,
}
