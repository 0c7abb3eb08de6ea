//! Solution of the equations of motion at the present time: accelerations, and forces of supports, joints and contacts.
//!
//! For every method, accelerations and forces are accurate to second order, and depend on the present state only.
//! Accelerations and forces contain unresolved vibrations. The mean over two consecutive steps does not contain them.

use super::impact::{ImpactDirection, ImpulseResponse};
use super::{Reactions, System};
use crate::beams::BodyPoint;
use crate::geometry::Vec2;
use crate::integrators::{Inertia, Mechanism, Stage};
use crate::linalg::{BandedLu, BandedMatrix, LinearError};
use crate::system::elements::{TrialState, collocation};
use crate::system::links::InclinedRoller;
use crate::system::{SliderState, SystemError};

/// Accelerations and forces at one time.
#[derive(Debug, Clone, PartialEq)]
pub struct Instant {
    accelerations: Vec<f64>,
    reactions: Reactions,
    /// Force of each slave on its master [force].
    contacts: Vec<Vec2>,
}

/// Force of a contact on its slave, with the resulting accelerations.
struct UnitForce {
    /// Force on the slave. Without friction, it has unit length [-].
    direction: Vec2,
    /// Accelerations of the unknowns per unit of the contact force.
    rates: Vec<f64>,
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
        self.contacts[slider]
    }
}

impl System {
    /// Computes the accelerations and forces at the present time, with loads just after this time. The state of motion is unchanged.
    ///
    /// # Errors
    /// Fails if a load has no value, or contact forces are not determined.
    pub fn instant(&mut self) -> Result<Instant, SystemError> {
        let time = self.motion.time;
        let refused = |reason: String| SystemError::NoInstant { time, reason };
        self.elements
            .evaluate_after(time)
            .map_err(|(load, source)| refused(format!("{load}: {source}")))?;
        let rates = self.bodies.by_control_point(&self.motion.rates);
        let joined = self.bodies.number_separately();
        let mut apart = vec![0.0; joined.iter().map(|body| 3 * body.len()).sum()];
        self.bodies.add_forces(collocation(Stage::Start), &[], 1.0, &mut apart);
        let at =
            TrialState { bodies: &self.bodies, stage: Stage::End, increments: &[], weight: 1.0 };
        self.elements.subtract_from(at, &mut apart);
        self.elements.add_resistance_at_start(&self.bodies, &rates, &mut apart);
        let own = self.bodies.number_as(joined);

        let degrees: Vec<usize> = self
            .bodies
            .iter()
            .flat_map(|body| body.degrees_of_freedom.iter().flatten())
            .copied()
            .collect();
        let mut residual = vec![0.0; self.degrees_of_freedom()];
        degrees.iter().zip(&apart).for_each(|(&at, force)| residual[at] += force);
        if self.supports.prescribed().count() > 0 {
            let prescribed = self.supports.prescribed().accelerations();
            self.add_inertia(1.0, &prescribed, &mut residual);
        }
        for slider in self.sliders.iter().filter(|slider| slider.is_compliant()) {
            slider.transmit(&self.bodies, slider.force_of_state(), &mut residual);
        }
        let (accelerations, mut contacts) =
            self.solve_accelerations(&residual).map_err(|error| refused(error.to_string()))?;
        for (contact, slider) in contacts.iter_mut().zip(self.sliders.iter()) {
            if slider.is_compliant() {
                *contact += slider.force_of_state();
            }
        }

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

    /// Solves the equations of motion for the accelerations and the forces on the masters.
    fn solve_accelerations(&self, residual: &[f64]) -> Result<(Vec<f64>, Vec<Vec2>), LinearError> {
        let mut accelerations: Vec<f64> =
            residual[..self.unknowns()].iter().map(|force| -force).collect();
        let prescribed = self.supports.prescribed().accelerations();
        self.links.set_acceleration_bias(
            &self.bodies,
            &self.motion.rates,
            &prescribed,
            &mut accelerations,
        );
        let mut inertia = self.banded_inertia();
        let inertia = inertia.factorise()?;
        inertia.solve(&mut accelerations);
        accelerations.extend(prescribed.into_iter().skip(self.unknowns()));
        let mut contacts = vec![Vec2::zeros(); self.sliders.len()];
        let directions = self.sliders.directions(&self.bodies);
        let answers = self.impulse_responses(&inertia, &directions);
        let count = answers.len();
        if count == 0 {
            return Ok((accelerations, contacts));
        }
        let wanted = answers.iter().zip(&directions).map(|(answer, (slider, unit))| {
            let slider = &self.sliders[*slider];
            let carried = match slider.state {
                SliderState::Sliding => slider.carried(&self.bodies, &self.motion.rates).dot(unit),
                SliderState::Held(_) | SliderState::Separated | SliderState::Released => 0.0,
            };
            carried - answer.velocity(&accelerations)
        });
        let wanted: Vec<f64> = wanted.collect();
        let solve = |units: &[UnitForce]| -> Result<Vec<f64>, LinearError> {
            let mut response = BandedMatrix::zeros(count, count - 1);
            for (row, answer) in answers.iter().enumerate() {
                for (column, unit) in units.iter().enumerate() {
                    response.add(row, column, answer.velocity(&unit.rates));
                }
            }
            let mut forces = wanted.clone();
            response.factorise()?.solve(&mut forces);
            Ok(forces)
        };
        let unit_force = |(answer, (_, unit)): (&ImpulseResponse, &ImpactDirection)| UnitForce {
            direction: *unit,
            rates: answer.rates.clone(),
        };
        let mut units: Vec<UnitForce> = answers.iter().zip(&directions).map(unit_force).collect();
        let mut forces = solve(&units)?;
        if self.add_slip_friction(&inertia, &directions, &forces, &mut units) {
            forces = solve(&units)?;
        }
        for ((force, unit), (slider, _)) in forces.iter().zip(&units).zip(&directions) {
            contacts[*slider] -= unit.direction * *force;
            let all = accelerations.iter_mut().zip(&unit.rates);
            all.for_each(|(acceleration, rate)| *acceleration += force * rate);
        }
        Ok((accelerations, contacts))
    }

    fn add_slip_friction(
        &self,
        inertia: &BandedLu<'_>,
        directions: &[ImpactDirection],
        forces: &[f64],
        units: &mut [UnitForce],
    ) -> bool {
        let ratio = |at: usize| self.sliders[directions[at].0].slip_ratio(-forces[at].signum());
        let slipping: Vec<usize> = (0..directions.len()).filter(|at| ratio(*at) != 0.0).collect();
        let sliders = slipping.iter().map(|at| directions[*at].0);
        let along: Vec<ImpactDirection> =
            sliders.map(|slider| (slider, self.sliders[slider].along(&self.bodies))).collect();
        let by_along = self.impulse_responses(inertia, &along);
        for ((at, (_, tangent)), answer) in slipping.iter().zip(&along).zip(&by_along) {
            let (unit, ratio) = (&mut units[*at], ratio(*at));
            unit.direction += tangent * ratio;
            let all = unit.rates.iter_mut().zip(&answer.rates);
            all.for_each(|(rate, along)| *rate += ratio * along);
        }
        !slipping.is_empty()
    }

    /// Acceleration of a point of a body [length/time²].
    pub fn acceleration(&self, now: &Instant, place: &BodyPoint) -> Vec2 {
        let [x, y, _] = self.bodies[place.body].at(place, &now.accelerations);
        Vec2::new(x, y)
    }
}
