//! What an element that puts forces on bodies offers to the steps of a model.

use super::WorkAndImpulse;
use crate::beams::{Collocation, RotationIncrement};
use crate::integrators::{Interval, Method, Stage};
use crate::linalg::BandedMatrix;
use crate::loads::LoadError;
use crate::system::bodies::Body;

/// The shares of a step at which the forces of a stage are taken. At the ends of a step increments of the angle itself are interpolated.
pub fn collocation(stage: Stage) -> Collocation {
    let (tau, sigma, rotations) = match stage {
        Stage::Start => (0.0, 0.0, RotationIncrement::Angle),
        Stage::Midpoint => (0.5, 0.5, RotationIncrement::TangentScaled),
        Stage::DampedMidpoint(chi) => (0.5, 0.5 + 0.5 * chi, RotationIncrement::TangentScaled),
        Stage::End => (1.0, 1.0, RotationIncrement::Angle),
    };
    Collocation { configuration: tau, stress: sigma, rotations }
}

/// The iterate of a step, in which an element is asked for its forces.
#[derive(Clone, Copy)]
pub struct TrialState<'a> {
    /// The beams, then the particles of the model, at the start of the step.
    pub bodies: &'a [Body],
    /// The stage of the step at which forces are taken.
    pub stage: Stage,
    /// The movements of the unknowns from the start of the step on [length, rad].
    pub increments: &'a [f64],
    /// The factor by which forces are multiplied [-].
    pub weight: f64,
}

/// What a load with a name has given.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct LoadAccount {
    /// The work of the load since the start [energy].
    pub work: f64,
    /// The size of the load in the last step: force, moment, or force per length, mean over the step.
    pub value: f64,
}

/// An element that puts forces on bodies: a load, a weight, a spring.
///
/// In a step it is asked for its forces in every iterate, and at the end for what it exchanged: an element with a potential gives
/// forces that do exactly the work by which its energy changes (a discrete gradient), and keeps that energy; what other elements give
/// is work. What an element does not have, it need not implement. It is called by dynamic dispatch, once an element and iterate.
pub trait ExternalForce {
    /// The name of the element in messages.
    fn name(&self) -> &str;

    /// Prepares a step that takes forces at the given stages: evaluates what depends on time only.
    ///
    /// # Errors
    /// When it has no finite value.
    fn begin_step(&mut self, _interval: Interval, _stages: &[Stage]) -> Result<(), LoadError> {
        Ok(())
    }

    /// Gives the element the value that it has just after a time, at the end of any movement.
    ///
    /// # Errors
    /// When it has no finite value then.
    fn hold_at(&mut self, _time: f64) -> Result<(), LoadError> {
        Ok(())
    }

    /// Whether the element may have another value just after a time than just before it.
    fn may_jump_at(&self, _time: f64) -> bool {
        false
    }

    /// Subtracts the forces on bodies in an iterate; gives the largest force and the largest moment of the whole element on a control point.
    fn subtract_from(&mut self, at: TrialState<'_>, out: &mut [f64]) -> (f64, f64);

    /// Adds the derivative of minus the element's forces by the increments to the tangent; there are `_unknowns` increments.
    fn add_tangent(&self, _at: TrialState<'_>, _unknowns: usize, _tangent: &mut BandedMatrix) {}

    /// What the element gave in the step of the movements that the bodies gathered last; the change of its own energy is no work.
    fn exchange(&self, bodies: &[Body], duration: f64) -> WorkAndImpulse;

    /// The energy that is stored in the element at the start of the step, if it has one [energy].
    fn energy(&self, _bodies: &[Body]) -> Option<f64> {
        None
    }

    /// What the element gave, if it has a name by which that is kept.
    fn account(&self) -> Option<LoadAccount> {
        None
    }

    /// Whether the element's forces turn with a section, so that they have no potential.
    fn turns(&self) -> bool {
        false
    }

    /// The number of sections whose angle the element follows.
    fn followed_sections(&self) -> usize {
        0
    }

    /// Lets the element accept the movements that the bodies gathered last.
    fn advance(&mut self, _bodies: &[Body], _rotations: RotationIncrement) {}

    /// Appends the state of the element at the start of a step.
    fn save(&self, _state: &mut Vec<f64>) {}

    /// Takes the state of the element back, in the order in which it was appended.
    fn restore(&mut self, _next: &mut dyn FnMut() -> f64) {}

    /// How a step uses the element, in words, with any of these methods.
    fn explain(&self, methods: &[Method]) -> String;

    /// The number of functions of scripts that the element calls.
    fn functions(&self) -> usize {
        0
    }
}
