//! Looking at the sliders of a model.

use crate::geometry::Vec2;
use crate::integrators::Mechanism;
use crate::joints::EndAction;
use crate::system::System;
use crate::system::sliders::{MasterLimit, SliderState};

impl System {
    /// The names of the sliders, in the order of the scene.
    pub fn slider_names(&self) -> impl Iterator<Item = &str> {
        self.sliders().iter().map(|slider| slider.name.as_str())
    }

    /// What a slider does at present, by its index: slide, rest at a stop, or fly free.
    pub fn slider_state(&self, slider: usize) -> SliderState {
        self.slider(slider).state
    }

    /// On what a slider leans, if it does: the `start` or the `end` of its master or its track, or a `seam` of that.
    pub fn slider_leans_on(&self, slider: usize) -> Option<&'static str> {
        self.slider(slider).leans_on(self.bodies())
    }

    /// The beam on which a slider is at present, by the indices of both.
    pub fn slider_beam(&self, slider: usize) -> usize {
        self.slider(slider).connection.master
    }

    /// The most spans of its master that a slider passed in a step so far [-].
    pub fn most_spans(&self, slider: usize) -> f64 {
        self.slider(slider).most_spans
    }

    /// How many times as long as its blow a step was, at the bounce of a slider where that is most; zero where nothing gave way [-].
    pub fn blows_in_a_step(&self, slider: usize) -> f64 {
        self.slider(slider).blows_in_a_step
    }

    /// The speed along its master up to which the kink under a slider follows the contact force, with the kinked rule [length/time].
    pub fn fastest_on_kink(&self, slider: usize) -> Option<f64> {
        self.slider(slider).fastest_on_kink()
    }

    /// The force of a slider on its master [force]; the slave gets the opposite. With the kinked rule, where the kink is not kept, it is the one at present, else the
    /// mean of the last step.
    ///
    /// Zero before the first step and after a release.
    pub fn contact_force(&self, slider: usize) -> Vec2 {
        self.slider(slider).contact_force()
    }

    /// The place of a slider along its master or its track as drawn: 0 at its start, 1 at its end; round a closed track it counts on [-].
    pub fn slider_position(&self, slider: usize) -> f64 {
        self.slider(slider).position()
    }

    /// How far a slider is from the start of its master or its track, as drawn; turns of a closed track count [length].
    pub fn slider_arc_length(&self, slider: usize) -> f64 {
        self.slider(slider).arc_length()
    }

    /// How much of its master or its track, as drawn, a slider passes in a unit of time, positive towards the end of that [length/time].
    ///
    /// The speed is that of the present velocities; zero for a slider that is held or released.
    pub fn slider_speed(&self, slider: usize) -> f64 {
        self.slider(slider).speed(self.bodies(), self.rates())
    }

    /// How far a slider is from a limit, as a part of the parameters of its master [-].
    pub fn distance_to(&self, limit: MasterLimit) -> f64 {
        self.slider(limit.slider).distance_to(limit.end)
    }

    /// Whether a slider is at a limit.
    pub fn is_at(&self, limit: MasterLimit) -> bool {
        self.slider(limit.slider).is_at(limit.end)
    }

    /// What a slider is to do at the ends of its master.
    pub fn end_action(&self, slider: usize) -> EndAction {
        self.slider(slider).ends
    }

    /// The coefficient of restitution with which a slider bounces off the ends of its master [-].
    pub fn restitution(&self, slider: usize) -> f64 {
        self.slider(slider).restitution
    }
}
