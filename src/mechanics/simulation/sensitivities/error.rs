//! Why there are no derivatives of a run.

use crate::integrators::StepError;

/// Why a run has no derivatives by parameters of its scene.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum DerivativeError {
    /// The steps of a run follow a tolerance.
    #[error(
        "derivatives by parameters need steps of a fixed size, and a tolerance gives steps that jump when a parameter changes"
    )]
    Adaptive,
    /// The method of a run takes no companions along.
    #[error(
        "derivatives by parameters are found with energy_momentum and fourth_order, not with {method}"
    )]
    Method {
        /// The method of the run.
        method: &'static str,
    },
    /// Something of a scene is steered from outside, step by step.
    #[error("'{name}' is steered by a controller, whose answers have no derivatives by parameters")]
    Steered {
        /// The load or drive of the scene that is steered.
        name: String,
    },
    /// A scene records the mean over a step of what a joint gives, which is summed up along the run itself.
    #[error("'{sensor}' is the mean over a step, which has no derivatives by parameters")]
    Mean {
        /// The recorded column.
        sensor: String,
    },
    /// A parameter changes the form of a scene.
    #[error(
        "the scene at '{parameter}' plus or minus {distance:e} has another number of unknowns or sliders: only numbers of a scene may depend on a parameter"
    )]
    Form {
        /// The parameter of the run that changes more than numbers.
        parameter: String,
        /// How far beside the run that is so, in the units of the parameter.
        distance: f64,
    },
    /// A parameter moves the times at which loads jump or bend.
    #[error(
        "times at which something jumps, bends or lets go depend on '{parameter}', where derivatives jump: give times that do not"
    )]
    Times {
        /// The parameter of the run that moves times.
        parameter: String,
    },
    /// Something happened at a time that depends on parameters.
    #[error(
        "there are no derivatives from t = {time} on: {event}, at a time that depends on the parameters, where derivatives jump"
    )]
    Event {
        /// The time of the run at which it happened [time].
        time: f64,
        /// What happened in the run, in words.
        event: &'static str,
    },
    /// The run went another way than by steps.
    #[error(
        "there are no derivatives after {way}: they are found with the steps of the run itself"
    )]
    Way {
        /// What was done with the run, in words.
        way: &'static str,
    },
    /// A step beside the run was not solved.
    #[error("there are no derivatives from t = {time} on: beside the run {source}")]
    NoStep {
        /// The end of the last step of the run with derivatives [time].
        time: f64,
        /// The reason why the step beside the run was not solved.
        source: Box<StepError>,
    },
    /// Nobody asked for derivatives at the start.
    #[error("the simulation was started without this parameter")]
    None,
}
