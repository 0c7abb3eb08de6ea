//! Sliders that only push: take-off, landing, and the impact across the master at a landing.

use super::System;
use super::impact::{ImpactDirection, ImpactImpulses, ImpactLaw};
use super::rigidity::Deformation;
use super::stop_impact::{ImpactContact, NEGLIGIBLE_SPEED, RIGID};
use crate::geometry::Vec2;
use crate::integrators::Overshoot;
use crate::linalg::LinearError;
use crate::system::SystemError;
use crate::system::sliders::{ContactChange, SliderEvent};

/// Largest contact force that counts as zero, as a fraction of the forces of the step.
const TENSILE: f64 = 1e-10;

/// Largest distance from the axis, as a fraction of the contact's length scale, at which sliders count as landing simultaneously [-].
const TOGETHER: f64 = 1e-12;

impl System {
    /// Checks the present contact forces of sliders that only push, at the end of a step that has converged.
    /// A slider with a tensile contact force takes off. The step is then repeated with a shorter length.
    /// If a step has to end at the take-off of a slider, the contact force of this slider at the end of the step must be zero.
    ///
    /// # Errors
    /// Fails if a slider takes off before the end of the step, or if it misses the take-off at which the step has to end.
    pub(super) fn check_contact_forces(&mut self) -> Result<(), Overshoot> {
        if !self.sliders.iter().any(|slider| slider.may_take_off()) {
            return Ok(());
        }
        if self.compute_present_forces().is_err() {
            return Ok(());
        }
        for at in 0..self.sliders.len() {
            if !self.sliders[at].may_take_off() {
                continue;
            }
            let push = self.computed_push(at);
            let (event, relative) = (SliderEvent::TakeOff(at), self.step.relative_force(push));
            let is_missed = self.sliders.target() == Some(event) && relative > TENSILE;
            let is_tensile = relative < -TENSILE;
            if is_tensile && self.sliders[at].has_many_events() {
                self.sliders[at].count_kept_step();
            } else if is_tensile || is_missed {
                return Err(Overshoot { event: event.number(), distance: -push });
            }
        }
        Ok(())
    }

    /// Present force with which a slider pushes its master [force]; zero if the contact force is not determined.
    pub(crate) fn push(&mut self, slider: usize) -> f64 {
        if self.compute_present_forces().is_err() {
            return 0.0;
        }
        self.computed_push(slider)
    }

    fn computed_push(&self, slider: usize) -> f64 {
        let across = self.sliders[slider].across(&self.bodies);
        let contacts = self.step.present.as_ref().map(|present| &present.contacts);
        contacts.map_or(0.0, |contacts| -contacts[slider].force.dot(&across))
    }

    /// Distance of a slider in flight from the axis of its master, as a fraction of the length scale of the contact [-].
    pub(crate) fn relative_gap(&mut self, slider: usize) -> f64 {
        self.sliders[slider].relative_gap(&self.bodies)
    }

    pub(crate) fn approaches_axis(&self, slider: usize) -> bool {
        self.speed_across(slider) < 0.0
    }

    pub(in crate::system) fn follow_masters(&mut self) {
        let Self { sliders, bodies, .. } = self;
        sliders.iter_mut().for_each(|slider| slider.move_to_nearest_point(bodies));
    }

    pub(crate) fn clear_contact_events(&mut self) {
        self.sliders.iter_mut().for_each(|slider| slider.clear_events());
    }

    /// Take-off, landing, bounce, or passage beyond an end of the master, of a slider since the last call; `None` without such a change.
    pub(crate) fn take_contact_change(&mut self, slider: usize) -> Option<ContactChange> {
        self.sliders[slider].take_contact_change()
    }

    pub(crate) fn take_off(&mut self, slider: usize) {
        self.sliders[slider].take_off();
        self.motion.accelerations.mark_unknown();
    }

    /// Ends the flight of a slider, and of all sliders that land simultaneously. The length of the steps is `dt` [time].
    /// A slider that strikes its master bounces or stays in contact. A slider beyond an end of its master passes the axis without contact.
    pub(crate) fn land(&mut self, slider: usize, dt: f64) -> Result<(), SystemError> {
        let mut striking = Vec::new();
        self.sliders.iter_mut().for_each(|slider| slider.impulse = Vec2::zeros());
        for at in 0..self.sliders.len() {
            if !self.sliders[at].is_separated() {
                continue;
            }
            let approaches = self.approaches_axis(at);
            let Self { sliders, bodies, .. } = self;
            let together = approaches && sliders[at].relative_gap(bodies).abs() <= TOGETHER;
            if at != slider && !together {
                continue;
            }
            let is_inside = sliders[at].nearest_point(bodies, &[]).is_inside;
            if !is_inside {
                sliders[at].record_passage();
                continue;
            }
            sliders[at].record_landing();
            match approaches {
                true => striking.push(at),
                false => sliders[at].start_contact(),
            }
        }
        self.motion.accelerations.mark_unknown();
        if striking.is_empty() {
            return Ok(());
        }
        self.solve_landing(&striking, dt).map_err(|_| self.sliders.overdetermined())?;
        self.choose_friction_modes();
        self.leave_tensile_stops()
    }

    /// Computes the impact of sliders that strike their masters. A slider without rebound then slides along its master.
    /// A second impact with all deformations removes the remaining velocities of sliders without rebound.
    fn solve_landing(&mut self, striking: &[usize], dt: f64) -> Result<(), LinearError> {
        let restitution = |model: &Self, at: usize| match model.sliders[at].has_many_events() {
            true => 0.0,
            false => model.sliders[at].restitution,
        };
        let hits = self.landing_directions(striking, |model, at| {
            ImpactLaw::Restitution(restitution(model, at))
        });
        let resolved = Deformation::Resolved(RIGID * dt);
        self.apply_impulses(&hits, &[], [Deformation::All, resolved])?;
        let mut resting = striking.to_vec();
        resting.retain(|at| restitution(self, *at) == 0.0);
        if !resting.is_empty() {
            let hits = self.landing_directions(&resting, |_, _| ImpactLaw::Rest);
            self.apply_impulses(&hits, &[], [Deformation::All; 2])?;
        }
        resting.iter().for_each(|at| self.sliders[*at].start_contact());
        Ok(())
    }

    fn landing_directions(
        &self,
        landing: &[usize],
        law: impl Fn(&Self, usize) -> ImpactLaw,
    ) -> Vec<ImpactContact> {
        let across = |at: &usize| ImpactContact {
            direction: (*at, self.sliders[*at].across(&self.bodies).into()),
            law: law(self, *at),
        };
        landing.iter().map(across).chain(self.impulse_directions(|_, _| None)).collect()
    }

    /// Impact law across the master for a slider that is in contact during an impact.
    /// A slider that took off and landed too often within a step stays in contact, to prevent an endless alternation of two sliders.
    pub(super) fn law_across(&self, slider: usize) -> ImpactLaw {
        let slider = &self.sliders[slider];
        match slider.unilateral.is_some() && !slider.has_many_events() {
            true => ImpactLaw::Unilateral,
            false => ImpactLaw::Elastic,
        }
    }

    pub(super) fn separate_after_impact(
        &mut self,
        laws: impl Iterator<Item = (ImpactDirection, ImpactLaw)>,
        impulses: &ImpactImpulses,
    ) {
        let tolerance = NEGLIGIBLE_SPEED * self.fastest_speed();
        let of_impulses = impulses.values.iter().zip(&impulses.mean_velocities);
        for (((slider, _), law), (impulse, velocity)) in laws.zip(of_impulses) {
            if law == ImpactLaw::Unilateral && *impulse == 0.0 && *velocity > tolerance {
                self.take_off(slider);
            }
        }
    }
}
