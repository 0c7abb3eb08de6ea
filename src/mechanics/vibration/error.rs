//! Errors of modal analysis.

fn range(available: usize) -> String {
    match available {
        0 => ": all of it is held or driven".to_owned(),
        _ => format!("; ask for 1 to {available}"),
    }
}

/// Failed search for modes.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum VibrationError {
    /// Number of modes outside its range.
    #[error("{asked} modes were asked for, but the scene has {available}, one for each movement with inertia{}", range(*available))]
    Count {
        /// Requested number of modes.
        asked: usize,
        /// Number of modes of the scene.
        available: usize,
    },
    /// Follower load, which makes the stiffness unsymmetric.
    #[error(
        "load '{load}' turns with the beam: its stiffness is not symmetric, and the vibration may grow by itself; give it a fixed direction, or simulate"
    )]
    Follower {
        /// Name of the load.
        load: String,
    },
    /// Search that did not converge.
    #[error(
        "the modes did not settle in {restarts} restarts of the search; ask for a few more or fewer of them, or take a coarser mesh"
    )]
    Unsettled {
        /// Number of restarts.
        restarts: usize,
    },
    /// Damped modes of a large scene.
    #[error(
        "the scene has {unknowns} unknowns, and damped modes are found with up to 240: take a coarser mesh; damping_ratios of modes are right to first order in the damping"
    )]
    LargeDamped {
        /// Number of unknowns of the scene.
        unknowns: usize,
    },
    /// Damped modes of a scene with a part without inertia.
    #[error(
        "something in the scene moves without inertia, or slides, and may creep in ways that its modes do not tell: give it inertia; damping_ratios of modes are right to first order in the damping"
    )]
    LightDamped,
    /// Damped modes that were not found.
    #[error(
        "the damped modes of the scene are not found: its damping and its stiffness are too far apart for a matrix of both; take a coarser mesh or less damping, join or hold what a damper of that strength holds as good as rigidly, or simulate and fit the decay; damping_ratios of modes are right to first order in the damping"
    )]
    Damping,
    /// Modes that are lost in rounding.
    #[error(
        "rounding hides mode {modes}, counted from 0: its residual is {residual:.1e}, more than 1e-6; of modes below it there are {modes}: ask for no more, take a coarser mesh, or make the largest stiffness or the smallest inertia less extreme"
    )]
    Hidden {
        /// Number of modes below the first lost one.
        modes: usize,
        /// Residual of the first lost mode [-].
        residual: f64,
    },
    /// Count of modes that is falsified by rounding.
    #[error(
        "rounding hides how many modes there are below those that were found; take a coarser mesh, or make the largest stiffness or the smallest inertia less extreme"
    )]
    Uncounted,
    /// Forces of the present configuration that are undetermined.
    #[error("{0}")]
    NoForces(String),
    /// Search stopped by the caller.
    #[error("stopped while modes were looked for")]
    Interrupted,
    /// Stiffness that no multiple of the inertia makes positive definite.
    #[error(
        "a movement without inertia is unstable in this configuration: it has no modes; give sections a rotary inertia, or take a smaller load"
    )]
    Indefinite,
    /// Stiffness or inertia that is not finite.
    #[error(
        "the stiffness or the inertia of the scene is not finite; check stiffness, masses and units"
    )]
    NotFinite,
}
