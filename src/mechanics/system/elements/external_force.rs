//! Interface of elements that apply forces to bodies.

use super::{UnsampledChange, WorkAndImpulse};
use crate::beams::{Collocation, RotationIncrement};
use crate::integrators::{Interval, Method, Stage};
use crate::linalg::BandedMatrix;
use crate::loads::LoadError;
use crate::system::bodies::Body;

/// Fractions of the step and type of rotation increments with which internal and external forces are evaluated at a stage.
pub fn collocation(stage: Stage) -> Collocation {
    let (tau, sigma, rotations) = match stage {
        Stage::Start => (0.0, 0.0, RotationIncrement::Angle),
        Stage::Midpoint => (0.5, 0.5, RotationIncrement::TangentScaled),
        Stage::DampedMidpoint(chi) => (0.5, 0.5 + 0.5 * chi, RotationIncrement::TangentScaled),
        Stage::End => (1.0, 1.0, RotationIncrement::Angle),
    };
    Collocation { configuration: tau, stress: sigma, rotations }
}

#[derive(Clone, Copy)]
pub struct TrialState<'a> {
    pub bodies: &'a [Body],
    pub stage: Stage,
    /// Increments of the unknowns since the start of the step [length, rad].
    pub increments: &'a [f64],
    /// Factor by which the forces are multiplied in the balance of the step [-].
    pub weight: f64,
}

/// Work and value of a named load.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct LoadAccount {
    /// Work of the load since the start [energy].
    pub work: f64,
    /// Mean value of the load in the last step [force, force·length, or force/length].
    pub value: f64,
}

/// Element that applies forces to bodies: a load or the weight.
///
/// If an element has a potential, the work of its forces is exactly the decrease of the potential (a discrete gradient).
pub trait ExternalForce {
    fn name(&self) -> &str;

    /// Prepares a step by evaluating time-dependent values.
    /// `_stages` lists the stages at which the integrator evaluates forces.
    fn begin_step(&mut self, _interval: Interval, _stages: &[Stage]) -> Result<(), LoadError> {
        Ok(())
    }

    /// Sets the longest interval in which a schedule is sampled with one set of points [time]. In longer steps, several intervals are sampled.
    fn sample_in_parts(&mut self, _longest: f64) {}

    /// Evaluates the element just after a time, for example at the end of a static load step.
    fn evaluate_after(&mut self, _time: f64) -> Result<(), LoadError> {
        Ok(())
    }

    /// Returns true if the value of the element may jump at the given time.
    fn may_jump_at(&self, _time: f64) -> bool {
        false
    }

    /// Largest change of the schedule between the samples of a step so far; `None` if the steps resolve the schedule.
    fn missed_change(&self) -> Option<UnsampledChange> {
        None
    }

    /// Subtracts the forces on bodies in an iterate from `out`.
    /// Returns the largest force and the largest moment on a control point.
    fn subtract_from(&mut self, at: TrialState<'_>, out: &mut [f64]) -> (f64, f64);

    /// Adds the tangent stiffness of the element to the tangent.
    /// The tangent stiffness is the negative derivative of the forces with respect to the increments.
    fn add_tangent(&self, _at: TrialState<'_>, _unknowns: usize, _tangent: &mut BandedMatrix) {}

    /// Work and impulse of the element in the step whose increments are stored in the bodies.
    /// The work in the result does not include changes of the potential.
    fn exchange(&self, bodies: &[Body], duration: f64) -> WorkAndImpulse;

    /// Potential energy at the start of the step [energy].
    fn energy(&self, _bodies: &[Body]) -> Option<f64> {
        None
    }

    /// Work and value of a named load; `None` for other elements.
    fn account(&self) -> Option<LoadAccount> {
        None
    }

    /// Returns true if the forces rotate with a section and therefore have no potential.
    fn turns(&self) -> bool {
        false
    }

    fn tracked_sections(&self) -> usize {
        0
    }

    /// Updates the element at the end of a step, from the increments stored in the bodies.
    fn advance(&mut self, _bodies: &[Body], _rotations: RotationIncrement) {}

    fn save(&self, _state: &mut Vec<f64>) {}

    fn restore(&mut self, _next: &mut dyn FnMut() -> f64) {}

    /// Text for `explain()` that describes the force and its evaluation by the given integration methods.
    fn explain(&self, methods: &[Method]) -> String;

    fn functions(&self) -> usize {
        0
    }
}
