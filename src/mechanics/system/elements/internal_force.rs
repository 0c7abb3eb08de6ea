//! Interface of elements that resist motion: springs, dampers, brakes, material damping, drag, obstacles and contacts between bodies.

use super::{
    Branch, ContactState, OutsideLaw, Penetration, RestMotion, ShortBounce, TrialState,
    WorkAndImpulse,
};
use crate::beams::{ForceSummary, Movement, SectionPlace, SpanStiffness};
use crate::geometry::Vec2;
use crate::integrators::Interval;
use crate::linalg::BandedMatrix;
use crate::loads::LoadError;
use crate::system::bodies::Body;

#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SpringTrialState {
    /// Length [length] or angle [rad] of the spring at the start of the step.
    pub elongation: f64,
    /// Force or moment in the last step, averaged over the step [force, force·length].
    pub force: f64,
    /// Stiffness of the spring at the start of the step; zero for a damper [force/length, force·length/rad].
    pub stiffness: f64,
}

/// Element that resists the motion of bodies and stores or dissipates energy.
///
/// The force of the element is an unknown. It is eliminated from the linearised equations, and corrected together with the increments.
/// The rounding error of the force is therefore smaller than the rounding error of the configuration times the stiffness.
/// The number of iterations does not increase with the stiffness of the element.
/// Each method is called dynamically, once per element and iterate.
pub trait InternalForce {
    fn name(&self) -> &str;

    /// Prepares the element for the start of a simulation.
    /// `inertia` is the diagonal of the inertia matrix, from which effective masses at points are computed.
    fn begin(&mut self, _bodies: &[Body], _inertia: &[f64]) {}

    /// Sets a prescribed rest length or rest angle to its value at a time, without work. Static solutions use this value for all load factors.
    ///
    /// # Errors
    /// Fails if the function of time has no finite value.
    fn set_rest_at(&mut self, _time: f64) -> Result<(), LoadError> {
        Ok(())
    }

    /// Returns true if the damping force may jump at a time.
    fn may_jump_at(&self, _time: f64) -> bool {
        false
    }

    /// Appends the data of the existing contacts of the element. The number of contacts changes during a simulation.
    fn save_contacts(&self, _contacts: &mut Vec<f64>) {}

    /// Restores the contacts of a saved state. The bodies must already be in this state.
    /// Returns `None` if the saved contacts do not belong to the element.
    fn restore_contacts(
        &mut self,
        _bodies: &[Body],
        _next: &mut dyn FnMut() -> Option<f64>,
    ) -> Option<()> {
        Some(())
    }

    /// Prepares a step that starts with the given rates of the unknowns. Iterations start with the forces of the last step.
    ///
    /// # Errors
    /// Fails if a schedule of the element has no valid value.
    fn begin_step(
        &mut self,
        interval: Interval,
        bodies: &[Body],
        rates: &[f64],
    ) -> Result<(), LoadError>;

    /// Prepares a static increment, such as a static load step, in which the element has no damping.
    fn begin_movement(&mut self, bodies: &[Body]);

    /// Discards the rates of the last step after a jump of the rates.
    fn clear_rate_history(&mut self) {}

    /// Adds `at.weight` times the present forces on bodies to `out`.
    /// Returns the largest force and the largest difference between a force and its law.
    fn add_forces(&mut self, at: TrialState<'_>, out: &mut [f64]) -> ForceSummary;

    /// Adds `at.weight` times the forces and their derivatives with respect to the increments. Force unknowns are eliminated.
    fn add_linearised_forces(
        &mut self,
        at: TrialState<'_>,
        out: &mut [f64],
        unknowns: usize,
        tangent: &mut BandedMatrix,
    );

    /// Adds `weight` times the force corrections that would satisfy the force laws in the present iterate to `out`.
    /// The directions of the force corrections are those of the last linearisation.
    fn add_mismatch_forces(&self, bodies: &[Body], weight: f64, out: &mut [f64]);

    fn correct(&mut self, bodies: &[Body], correction: &[f64]);

    /// Work and impulse that the ground or a flowing medium exerts on the bodies through the element, in a step of length `duration`.
    /// The increments of the step must be stored in the bodies.
    fn exchange(&self, bodies: &[Body], duration: f64) -> WorkAndImpulse;

    /// Updates the element at the end of a step, from the increments stored in the bodies.
    fn advance(&mut self, bodies: &[Body]);

    /// Potential energy at the start of the step [energy].
    fn stored(&self) -> f64 {
        0.0
    }

    /// Dissipated energy since the start of the simulation [energy].
    fn dissipated(&self) -> f64;

    /// Work of the wind or of an actuator since the start [energy]; `None` for elements without external work.
    fn external_work(&self) -> Option<f64> {
        None
    }

    /// Elongation and force of a spring, damper or brake; `None` for other elements.
    fn stretched(&self) -> Option<SpringTrialState> {
        None
    }

    /// Prescribed rest length or rest angle of a spring; `None` if it is constant, and for other elements.
    fn rest_motion(&self) -> Option<&RestMotion> {
        None
    }

    /// State of the contact for obstacles and contacts between bodies; `None` for other elements.
    fn contact(&self) -> Option<ContactState> {
        None
    }

    /// Smallest gap of a contact at present, negative for a penetration [length]; `None` for other elements.
    fn smallest_gap(&self, _bodies: &[Body]) -> Option<f64> {
        None
    }

    fn penetrations(&self, _bodies: &[Body]) -> Vec<Penetration> {
        Vec::new()
    }

    /// Returns true if a point moves through the obstacle, or through the other body of a contact, on its straight path in the step.
    fn crosses(&self, _bodies: &[Body], _increments: &[f64]) -> bool {
        false
    }

    /// Branch of the spring law at the end of the last step; `None` for laws without sharp corners, or other elements.
    fn branch(&self, _bodies: &[Body], _rates: &[f64]) -> Option<Branch> {
        None
    }

    /// Calls `take` for each elongation or rate that has left the range of a law.
    fn each_outside_law(&self, _take: &mut dyn FnMut(OutsideLaw)) {}

    /// Bounce with the largest force among the bounces that the steps do not resolve.
    fn short_bounce(&self) -> Option<ShortBounce> {
        None
    }

    /// Damping force [force] and damping moment [force·length] at a section of a beam, computed from the given rates at the start of the step.
    /// Returns `None` if the element does not damp the beam.
    fn transmitted(
        &self,
        _bodies: &[Body],
        (_beam, _place): (usize, &SectionPlace),
        _rates: &[f64],
    ) -> Option<(Vec2, f64)> {
        None
    }

    fn damped_beam(&self) -> Option<usize> {
        None
    }

    /// Adds the forces at the start of the step, computed from the given rates.
    fn add_forces_at_start(&self, bodies: &[Body], rates: &[Vec<Movement>], out: &mut [f64]);

    /// Calls `take` with each damped rate at the start of the step, and with the damping coefficient of this rate for small rates.
    /// The dissipated power is the damping coefficient times the squared rate.
    /// The number and the order of the calls do not depend on the rates.
    fn each_damped_rate(&self, bodies: &[Body], rates: &[f64], take: &mut dyn FnMut(f64, f64));

    /// Calls `take` with the degrees of freedom of the element and its static stiffness.
    fn static_stiffness(&self, _bodies: &[Body], _take: &mut dyn FnMut(&[usize], &SpanStiffness)) {}

    /// Releases the element at the start of a step. The stored energy of a released element counts as dissipated.
    fn release(&mut self) {}

    /// Marks the element as released before a state with a released element is restored.
    fn detach(&mut self) {}

    /// Marks the element as attached before a state with an attached element is restored.
    fn attach(&mut self) {}

    fn save(&self, state: &mut Vec<f64>);

    fn restore(&mut self, next: &mut dyn FnMut() -> f64);

    /// Text for `explain()` that describes the force of the element and its evaluation in a step.
    fn explain(&self) -> String;
}
