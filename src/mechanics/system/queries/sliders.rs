//! Queries of the sliders of a model.

use crate::geometry::Vec2;
use crate::integrators::Mechanism;
use crate::joints::EndAction;
use crate::system::System;
use crate::system::sliders::{MasterLimit, SliderState};

impl System {
    /// Names of the sliders, in the order of the scene.
    pub fn slider_names(&self) -> impl Iterator<Item = &str> {
        self.sliders().iter().map(|slider| slider.name.as_str())
    }

    /// State of a slider: sliding, held at a stop, in flight, or released.
    pub fn slider_state(&self, slider: usize) -> SliderState {
        self.slider(slider).state
    }

    /// Name of the limit at which a slider is held: `start` or `end` of its master or track, or a `seam` of the track.
    pub fn slider_held_by(&self, slider: usize) -> Option<&'static str> {
        self.slider(slider).held_by(self.bodies())
    }

    pub(crate) fn slider_beam(&self, slider: usize) -> usize {
        self.slider(slider).connection.master
    }

    /// Largest number of spans of the master that a slider has passed in one step [-].
    pub fn most_spans(&self, slider: usize) -> f64 {
        self.slider(slider).most_spans
    }

    /// Largest ratio of step length to impact duration at a bounce of a slider [-]; zero for rigid impacts.
    pub fn impacts_per_step(&self, slider: usize) -> f64 {
        self.slider(slider).impacts_per_step
    }

    /// Number of steps in which the friction force was kept constant, because the step had no solution with the law of friction.
    pub fn steps_with_fixed_friction(&self, slider: usize) -> usize {
        self.slider(slider).friction.as_ref().map_or(0, |friction| friction.fixed_steps)
    }

    /// Largest speed along the master at which the kink varies with the contact force [length/time]; `None` for rules without a kink.
    /// A kink is the jump of the tangent of the master under the contact force.
    pub(crate) fn kink_speed_limit(&self, slider: usize) -> Option<f64> {
        self.slider(slider).kink_speed_limit()
    }

    /// Mean force of a slider on its master in the last step [force].
    ///
    /// Before the first step, the present contact force is returned. After a release of the slider, the contact force is zero.
    pub fn contact_force(&self, slider: usize) -> Vec2 {
        self.slider(slider).contact_force()
    }

    /// Mean couple of a sleeve on its master in the last step [force·length], counter-clockwise; zero for other sliders.
    ///
    /// Before the first step, and in an equilibrium, the present couple is returned. After a release of the sleeve, the couple is zero.
    pub fn sleeve_couple(&self, slider: usize) -> f64 {
        self.slider(slider).mean_couple()
    }

    /// Angle of a sleeve minus that of its master, relative to the initial difference [rad]; zero for other sliders.
    ///
    /// The angle of the master is interpolated from the rotations of its control points. It differs from the angle of the section
    /// by an error of second order in the step size and in the span length.
    pub fn sleeve_rotation_gap(&self, slider: usize) -> f64 {
        self.slider(slider).rotation_gap()
    }

    /// Present contact force of a slider [force], determined from the kink of its master, if the kink varies with the contact force.
    /// Without a kink, or with a constant kink, the function returns the [`contact_force`](Self::contact_force) of the slider.
    pub fn kink_force(&self, slider: usize) -> Vec2 {
        self.slider(slider).force_of_state()
    }

    /// Mean friction force of a slider on its master in the last step [force], positive towards the end of the master; `None` without friction.
    pub fn friction_force(&self, slider: usize) -> Option<f64> {
        self.slider(slider).friction_force()
    }

    /// Distance of a slave from the axis of its master [length]; `None` for a slider that never leaves its master.
    /// The distance of the slave is positive on the side to which the slider can lift off, and zero in contact.
    pub fn flight_gap(&self, slider: usize) -> Option<f64> {
        self.slider(slider).flight_gap(self.bodies())
    }

    /// Number of attempted steps in which a slider that only pushes stayed in contact under a tensile force.
    /// Such a slider stays in contact after too many take-offs and landings within a step.
    pub fn steps_with_kept_contact(&self, slider: usize) -> usize {
        self.slider(slider).unilateral.as_ref().map_or(0, |contact| contact.kept_steps)
    }

    /// Position of a slider along its undeformed master or track, from 0 to 1, plus completed rounds on a closed track [-].
    pub fn slider_position(&self, slider: usize) -> f64 {
        self.slider(slider).position()
    }

    /// Arc length of a slider from the start of its undeformed master or track, including completed rounds on a closed track [length].
    pub fn slider_arc_length(&self, slider: usize) -> f64 {
        self.slider(slider).arc_length()
    }

    /// Speed of a slider along its undeformed master or track, positive towards the end, zero if held or released [length/time].
    pub fn slider_speed(&self, slider: usize) -> f64 {
        self.slider(slider).speed(self.bodies(), self.rates())
    }

    /// Friction limit minus the force along the master at the start of the last attempted step [force].
    /// The result is zero for a slider that slips or has no static friction.
    pub(crate) fn sticking_reserve(&self, slider: usize) -> f64 {
        self.slider(slider).sticking_reserve()
    }

    pub(crate) fn slip_speed(&self, slider: usize) -> f64 {
        self.slider(slider).slip_speed()
    }

    /// Distance of a slider from a limit, as a fraction of the parameter range of its master [-].
    pub(crate) fn distance_to(&self, limit: MasterLimit) -> f64 {
        self.slider(limit.slider).distance_to(limit.end)
    }

    /// Returns true if a slider is at a limit.
    pub fn is_at(&self, limit: MasterLimit) -> bool {
        self.slider(limit.slider).is_at(limit.end)
    }

    pub(crate) fn end_action(&self, slider: usize) -> EndAction {
        self.slider(slider).ends
    }

    /// Coefficient of restitution at the ends of the master of a slider [-].
    pub fn restitution(&self, slider: usize) -> f64 {
        self.slider(slider).restitution
    }
}
