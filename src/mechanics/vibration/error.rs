//! Errors of modal analysis.

fn range(available: usize) -> String {
    match available {
        0 => ": all movements are fixed or prescribed".to_owned(),
        _ => format!("; request 1 to {available}"),
    }
}

/// Error of a failed computation of modes.
#[expect(missing_docs, reason = "the messages describe the variants and their fields")]
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum VibrationError {
    #[error("{requested} modes requested, but the scene has {available}, one per degree of freedom with inertia{}", range(*available))]
    Count { requested: usize, available: usize },
    #[error(
        "follower load '{load}' makes the stiffness unsymmetric, and vibration may be unstable (flutter); give the load a fixed direction, or simulate the motion"
    )]
    Follower { load: String },
    #[error(
        "the modes did not converge in {restarts} restarts of the Lanczos method; request a few more or fewer modes, or use a coarser mesh"
    )]
    NotConverged { restarts: usize },
    #[error(
        "the scene has {unknowns} unknowns, but damped modes are available up to 240; use a coarser mesh, or damping_ratios of undamped modes (first order in the damping)"
    )]
    LargeDamped { unknowns: usize },
    #[error(
        "the scene has degrees of freedom without inertia, or sliders, for which damped modes are not available; give every part inertia, or use damping_ratios of undamped modes (first order in the damping)"
    )]
    LightDamped,
    #[error(
        "the damped modes were not found: damping and stiffness differ too much in magnitude; use a coarser mesh or less damping, replace very strong dampers by joints or supports, or use damping_ratios of undamped modes (first order in the damping)"
    )]
    Damping,
    #[error(
        "mode {modes} (from 0) is inaccurate because of rounding: its residual is {residual:.1e}, but at most 1e-6 is allowed; request at most {modes} modes, use a coarser mesh, or reduce the largest stiffness or increase the smallest inertia"
    )]
    BelowRounding {
        modes: usize,
        /// Residual of the first inaccurate mode [-].
        residual: f64,
    },
    #[error(
        "modes may be missing below those that were found, because of rounding; use a coarser mesh, or reduce the largest stiffness or increase the smallest inertia"
    )]
    Uncounted,
    #[error("{requested} eigenvalues requested, but only {available} were found; request fewer")]
    FewEigenvalues { requested: usize, available: usize },
    #[error("{0}")]
    NoForces(String),
    #[error("interrupted during the search for modes")]
    Interrupted,
    #[error(
        "a degree of freedom without inertia is unstable in this configuration, so that there are no modes; give sections a rotary inertia, or use a smaller load"
    )]
    Indefinite,
    #[error(
        "the stiffness or the inertia of the scene is not finite; check stiffness, masses and units"
    )]
    NotFinite,
}
