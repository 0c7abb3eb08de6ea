//! Solution of the equations of motion at the present time: accelerations, and forces of supports, joints and contacts.
//!
//! With every time integration method, these accelerations and forces are accurate to second order and depend on the present state only.
//! Unlike forces averaged over two steps, they contain vibrations that the time steps do not resolve.

use super::impact::ImpactDirection;
use super::{Reactions, System};
use crate::beams::{BodyPoint, Movement};
use crate::geometry::Vec2;
use crate::integrators::{Inertia, Mechanism, Stage};
use crate::joints::Wrench;
use crate::linalg::{BandedLu, LinearError};
use crate::system::elements::{TrialState, collocation};
use crate::system::links::InclinedRoller;
use crate::system::state::{ContactResponse, PresentForces};
use crate::system::{SliderState, SystemError};

/// Accelerations and forces at one time.
#[derive(Debug, Clone, PartialEq)]
pub struct Instant {
    accelerations: Vec<f64>,
    reactions: Reactions,
    /// Force and couple of each slave on its master [force, force·length].
    contacts: Vec<Wrench>,
}

impl Instant {
    /// Accelerations of the unknowns [length/time², 1/time²], with the forces of rigid links and rollers at their unknowns [force].
    pub fn accelerations(&self) -> &[f64] {
        &self.accelerations
    }

    /// Forces of joints and supports at the present time.
    pub fn reactions(&self) -> &Reactions {
        &self.reactions
    }

    /// Force of a slider on its master [force].
    pub fn contact(&self, slider: usize) -> Vec2 {
        self.contacts[slider].force
    }

    /// Force of a slider on its master, with the couple of a sleeve [force, force·length]. The couple of other sliders is zero.
    pub fn wrench(&self, slider: usize) -> Wrench {
        self.contacts[slider]
    }
}

impl System {
    /// Computes the accelerations and forces at the present time, with loads just after this time.
    ///
    /// # Errors
    /// Fails if a load has no value, or if the contact forces are not determined.
    pub fn instant(&mut self) -> Result<Instant, SystemError> {
        let mut present = self.step.present.take().unwrap_or_default();
        self.bodies.write_by_control_point(&self.motion.rates, &mut present.rates);
        let joined = self.bodies.number_separately();
        let mut apart = vec![0.0; joined.iter().map(|body| 3 * body.len()).sum()];
        let added = self.add_present_forces(&present.rates, &mut apart);
        let own = self.bodies.number_as(joined);
        added?;

        let degrees: Vec<usize> = self
            .bodies
            .iter()
            .flat_map(|body| body.degrees_of_freedom.iter().flatten())
            .copied()
            .collect();
        present.residual.clear();
        present.residual.resize(self.degrees_of_freedom(), 0.0);
        degrees.iter().zip(&apart).for_each(|(&at, force)| present.residual[at] += force);
        self.solve_present_forces(&mut present)?;
        let (accelerations, contacts) = (present.accelerations.clone(), present.contacts.clone());
        self.step.present = Some(present);

        let joined = self.bodies.number_as(own);
        let of_all: Vec<f64> =
            degrees.iter().map(|&at| accelerations.get(at).copied().unwrap_or(0.0)).collect();
        self.add_inertia(1.0, &of_all, &mut apart);
        self.links.transmit(&self.bodies, &accelerations, &mut apart);
        for (slider, force) in self.sliders.iter().zip(&contacts) {
            slider.transmit(&self.bodies, *force, &mut apart);
        }
        self.bodies.number_as(joined);
        let multiplier =
            |roller: &InclinedRoller| roller.unknown.map_or(0.0, |at| accelerations[at]);
        let across: Vec<f64> = self.links.all_rollers().iter().map(multiplier).collect();
        Ok(Instant {
            reactions: self.reactions_from_residuals(&apart, &across),
            accelerations,
            contacts,
        })
    }

    pub(super) fn compute_present_forces(&mut self) -> Result<(), SystemError> {
        let mut present = self.step.present.take().unwrap_or_default();
        present.residual.clear();
        present.residual.resize(self.degrees_of_freedom(), 0.0);
        self.bodies.write_by_control_point(&self.motion.rates, &mut present.rates);
        let PresentForces { rates, residual, .. } = &mut *present;
        let solved = self
            .add_present_forces(rates, residual)
            .and_then(|()| self.solve_present_forces(&mut present));
        self.step.present = Some(present);
        solved
    }

    fn no_instant(&self, reason: String) -> SystemError {
        SystemError::NoInstant { time: self.motion.time, reason }
    }

    fn add_present_forces(
        &mut self,
        rates: &[Vec<Movement>],
        out: &mut [f64],
    ) -> Result<(), SystemError> {
        let evaluated = self.elements.evaluate_after(self.motion.time);
        evaluated.map_err(|(load, source)| self.no_instant(format!("{load}: {source}")))?;
        self.bodies.add_forces(collocation(Stage::Start), &[], 1.0, out);
        let at =
            TrialState { bodies: &self.bodies, stage: Stage::End, increments: &[], weight: 1.0 };
        self.elements.subtract_from(at, out);
        self.elements.add_resistance_at_start(&self.bodies, rates, out);
        Ok(())
    }

    /// Calls a function while the model stores the present forces of its rigid links instead of the forces of the last step.
    /// Before the first step, the stored forces of rigid links are zero.
    ///
    /// # Errors
    /// Fails in the same cases as [`instant`](Self::instant), if the model has rigid links.
    pub(crate) fn with_present_link_forces<T>(
        &mut self,
        look: impl FnOnce(&Self) -> T,
    ) -> Result<T, SystemError> {
        if self.links.count() == 0 {
            return Ok(look(self));
        }
        let now = self.instant()?;
        let force = |at: usize| now.accelerations[at];
        let forces = self.links.iter().map(|link| Vec2::from(link.unknowns.map(force)));
        let mut forces: Vec<Vec2> = forces.collect();
        self.links.exchange_forces(&mut forces);
        let seen = look(self);
        self.links.exchange_forces(&mut forces);
        Ok(seen)
    }

    fn solve_present_forces(&mut self, present: &mut PresentForces) -> Result<(), SystemError> {
        present.prescribed.clear();
        present.prescribed.extend(self.supports.prescribed().accelerations());
        if self.supports.prescribed().count() > 0 {
            let PresentForces { prescribed, residual, .. } = &mut *present;
            self.add_inertia(1.0, prescribed, residual);
        }
        for slider in self.sliders.iter().filter(|slider| slider.is_compliant()) {
            slider.transmit(&self.bodies, slider.force_of_state().into(), &mut present.residual);
        }
        self.solve_accelerations(present).map_err(|error| self.no_instant(error.to_string()))?;
        for (contact, slider) in present.contacts.iter_mut().zip(self.sliders.iter()) {
            if slider.is_compliant() {
                *contact += slider.force_of_state().into();
            }
        }
        Ok(())
    }

    /// Solves `M a + residual = Gᵀ λ` for the accelerations `a` and the contact forces `λ` on the slaves.
    /// `M` is the inertia matrix, and `Gᵀ` transmits contact forces to slaves and, with opposite sign, to masters.
    fn solve_accelerations(&mut self, present: &mut PresentForces) -> Result<(), LinearError> {
        let solver = self.take_inertia_solver()?;
        let (inertia, unknowns) = (solver.factors(), self.unknowns());
        let PresentForces { residual, prescribed, accelerations, contacts, directions, .. } =
            &mut *present;
        accelerations.clear();
        accelerations.extend(residual[..unknowns].iter().map(|force| -force));
        self.links.set_acceleration_bias(
            &self.bodies,
            &self.motion.rates,
            prescribed,
            accelerations,
        );
        inertia.solve(accelerations);
        accelerations.extend(prescribed.iter().skip(unknowns));
        contacts.clear();
        contacts.resize(self.sliders.len(), Wrench::default());
        directions.clear();
        directions.extend(self.sliders.directions(&self.bodies));
        if !present.directions.is_empty() {
            self.solve_contact_forces(&inertia, present)?;
            present.apply();
        }
        self.step.inertia_solver = Some(solver);
        Ok(())
    }

    fn solve_contact_forces(
        &self,
        inertia: &BandedLu<'_>,
        present: &mut PresentForces,
    ) -> Result<(), LinearError> {
        let PresentForces { directions, responses, .. } = &mut *present;
        if responses.len() < directions.len() {
            responses.resize_with(directions.len(), ContactResponse::default);
        }
        for (response, direction) in responses.iter_mut().zip(&*directions) {
            self.set_contact_response(inertia, *direction, response);
        }
        let carried = |(slider, unit): &ImpactDirection| {
            let slider = &self.sliders[*slider];
            match slider.state {
                SliderState::Sliding => slider.carried(&self.bodies, &self.motion.rates).dot(unit),
                SliderState::Held(_) | SliderState::Separated | SliderState::Released => 0.0,
            }
        };
        present.solve(carried)?;
        if self.add_slip_friction(inertia, present) { present.solve(carried) } else { Ok(()) }
    }

    fn set_contact_response(
        &self,
        inertia: &BandedLu<'_>,
        (slider, unit): ImpactDirection,
        response: &mut ContactResponse,
    ) {
        let sizes = [self.unknowns(), self.degrees_of_freedom()];
        response.set(unit, inertia, sizes, |forces| {
            self.sliders[slider].transmit(&self.bodies, unit, forces);
        });
    }

    /// Adds the friction of slipping sliders to `present`: a unit force across a master then also causes a friction force along the master.
    /// The direction of friction depends on the sign of the force across the master in the solution without friction.
    /// The returned flag is true if a slider slips.
    fn add_slip_friction(&self, inertia: &BandedLu<'_>, present: &mut PresentForces) -> bool {
        let PresentForces { directions, responses, magnitudes, .. } = present;
        let mut slips = false;
        for ((response, (slider, _)), force) in
            responses.iter_mut().zip(&*directions).zip(&*magnitudes)
        {
            let ratio = self.sliders[*slider].slip_ratio(-force.signum());
            if ratio != 0.0 {
                let (tangent, mut along) =
                    (self.sliders[*slider].along(&self.bodies), ContactResponse::default());
                self.set_contact_response(inertia, (*slider, tangent.into()), &mut along);
                response.add(ratio, &along);
                slips = true;
            }
        }
        slips
    }

    /// Acceleration of a point of a body [length/time²].
    pub fn acceleration(&self, now: &Instant, place: &BodyPoint) -> Vec2 {
        let [x, y, _] = self.bodies[place.body].at(place, &now.accelerations);
        Vec2::new(x, y)
    }
}
