//! Reasons for missing derivatives.

use crate::integrators::StepError;

/// Reason why a run has no derivatives with respect to parameters.
#[expect(missing_docs, reason = "the messages describe the variants and their fields")]
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum DerivativeError {
    #[error(
        "derivatives with respect to parameters need a fixed step size, but the steps are adaptive"
    )]
    Adaptive,
    #[error(
        "derivatives with respect to parameters are available with energy_momentum and fourth_order, not with {method}"
    )]
    Method { method: &'static str },
    #[error(
        "'{name}' has a controller, whose output has no derivatives with respect to parameters"
    )]
    Controlled { name: String },
    #[error(
        "'{sensor}' is a mean over a step, which has no derivatives with respect to parameters"
    )]
    Mean { sensor: String },
    #[error(
        "the number of unknowns, sliders or contacts between bodies changes when '{parameter}' changes by {distance:e}: only numerical values of a scene may depend on a parameter, and contacts must open and close in the same steps"
    )]
    Form { parameter: String, distance: f64 },
    #[error(
        "times of jumps, kinks or releases depend on '{parameter}', so that derivatives are discontinuous; give times that do not depend on it"
    )]
    Times { parameter: String },
    #[error(
        "there are no derivatives after t = {time}: {event}, at a time that depends on the parameters, where derivatives are discontinuous"
    )]
    Event {
        /// Time of the event [time].
        time: f64,
        event: &'static str,
    },
    #[error(
        "there are no derivatives after {change}: they are computed during the steps of an uninterrupted run"
    )]
    NotSupported { change: &'static str },
    #[error(
        "there are no derivatives after t = {time}: with a slightly changed parameter {source}"
    )]
    NoStep {
        /// End of the last step with derivatives [time].
        time: f64,
        source: Box<StepError>,
    },
    #[error("the simulation was started without derivatives with respect to this parameter")]
    None,
}
