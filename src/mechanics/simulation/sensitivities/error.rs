//! Reasons for missing derivatives.

use crate::integrators::StepError;

/// Reason why a run has no derivatives with respect to parameters.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum DerivativeError {
    /// Variable steps.
    #[error(
        "derivatives by parameters need steps of a fixed size, and a tolerance gives steps that jump when a parameter changes"
    )]
    Adaptive,
    /// Method without derivatives.
    #[error(
        "derivatives by parameters are found with energy_momentum and fourth_order, not with {method}"
    )]
    Method {
        /// Name of the method.
        method: &'static str,
    },
    /// Scene with a controller.
    #[error("'{name}' is steered by a controller, whose answers have no derivatives by parameters")]
    Steered {
        /// Name of the controlled load or drive.
        name: String,
    },
    /// Recorded mean of a joint force, which is accumulated along the run.
    #[error("'{sensor}' is the mean over a step, which has no derivatives by parameters")]
    Mean {
        /// Name of the column.
        sensor: String,
    },
    /// Parameter that changes the structure of the scene.
    #[error(
        "the scene at '{parameter}' plus or minus {distance:e} has another number of unknowns or sliders: only numbers of a scene may depend on a parameter"
    )]
    Form {
        /// Name of the parameter.
        parameter: String,
        /// Perturbation in the units of the parameter.
        distance: f64,
    },
    /// Parameter that shifts times of jumps or kinks of loads.
    #[error(
        "times at which something jumps, bends or lets go depend on '{parameter}', where derivatives jump: give times that do not"
    )]
    Times {
        /// Name of the parameter.
        parameter: String,
    },
    /// Event at a time that depends on parameters.
    #[error(
        "there are no derivatives from t = {time} on: {event}, at a time that depends on the parameters, where derivatives jump"
    )]
    Event {
        /// Time of the event [time].
        time: f64,
        /// Description of the event.
        event: &'static str,
    },
    /// Run that was changed other than by steps.
    #[error(
        "there are no derivatives after {way}: they are found with the steps of the run itself"
    )]
    Way {
        /// Description of the change.
        way: &'static str,
    },
    /// Perturbed step that was not solved.
    #[error("there are no derivatives from t = {time} on: beside the run {source}")]
    NoStep {
        /// End of the last step with derivatives [time].
        time: f64,
        /// Reason.
        source: Box<StepError>,
    },
    /// Run that was started without derivatives.
    #[error("the simulation was started without this parameter")]
    None,
}
