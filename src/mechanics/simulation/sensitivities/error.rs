//! Reasons for missing derivatives.

use crate::integrators::StepError;

/// Reason why a run has no derivatives with respect to parameters.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum DerivativeError {
    /// Variable steps.
    #[error(
        "derivatives with respect to parameters need a fixed step size, but the steps are adaptive"
    )]
    Adaptive,
    /// Method without derivatives.
    #[error(
        "derivatives with respect to parameters are available with energy_momentum and fourth_order, not with {method}"
    )]
    Method {
        /// Name of the method.
        method: &'static str,
    },
    /// Scene with a controller.
    #[error(
        "'{name}' has a controller, whose output has no derivatives with respect to parameters"
    )]
    Controlled {
        /// Name of the controlled load or drive.
        name: String,
    },
    /// Recorded mean of a joint force, which is accumulated along the run.
    #[error(
        "'{sensor}' is a mean over a step, which has no derivatives with respect to parameters"
    )]
    Mean {
        /// Name of the column.
        sensor: String,
    },
    /// Parameter that changes the structure of the scene.
    #[error(
        "the number of unknowns or sliders changes when '{parameter}' changes by {distance:e}: only numerical values of a scene may depend on a parameter"
    )]
    Form {
        /// Name of the parameter.
        parameter: String,
        /// Perturbation in the units of the parameter.
        distance: f64,
    },
    /// Parameter that changes the times of jumps or kinks of loads.
    #[error(
        "times of jumps, kinks or releases depend on '{parameter}', so that derivatives are discontinuous; give times that do not depend on it"
    )]
    Times {
        /// Name of the parameter.
        parameter: String,
    },
    /// Event whose time depends on parameters.
    #[error(
        "there are no derivatives after t = {time}: {event}, at a time that depends on the parameters, where derivatives are discontinuous"
    )]
    Event {
        /// Time of the event [time].
        time: f64,
        /// Description of the event.
        event: &'static str,
    },
    /// Run that was changed in another way than by steps.
    #[error(
        "there are no derivatives after {change}: they are computed during the steps of an uninterrupted run"
    )]
    NotSupported {
        /// Description of the change.
        change: &'static str,
    },
    /// Perturbed step that was not solved.
    #[error(
        "there are no derivatives after t = {time}: with a slightly changed parameter {source}"
    )]
    NoStep {
        /// End of the last step with derivatives [time].
        time: f64,
        /// Reason.
        source: Box<StepError>,
    },
    /// Run that was started without derivatives.
    #[error("the simulation was started without derivatives with respect to this parameter")]
    None,
}
