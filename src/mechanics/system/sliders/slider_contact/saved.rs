//! State of a slider as a list of numbers.

use std::iter::once;

use super::SliderContact;
use crate::geometry::Vec2;
use crate::joints::{CONTACT_UNKNOWNS, ContactUnknowns};
use crate::system::sliders::{KinkedAxis, SliderState};
use crate::system::step_mean::StepMean;

const ROUTE: usize = 3;

const UNILATERAL: usize = 2;

impl SliderContact {
    pub fn saved(&self) -> usize {
        let of_route = if self.is_on_track() { ROUTE } else { 0 };
        let of_friction = self.friction.as_ref().map_or(0, |friction| friction.numbers().count());
        let of_side = if self.unilateral.is_some() { UNILATERAL } else { 0 };
        let of_sleeve = self.sleeve.as_ref().map_or(0, |sleeve| 1 + sleeve.numbers().count());
        13 + of_friction + of_side + of_sleeve + CONTACT_UNKNOWNS + of_route
    }

    pub fn is_valid(&self, numbers: &[f64]) -> bool {
        let (parameter, rail) = (numbers[0], &self.master);
        match (&self.track, numbers.last_chunk::<ROUTE>()) {
            (Some(route), Some(own)) => {
                route.stored_segment(*own).is_some_and(|leg| leg.master.has(parameter))
            }
            _ => rail.has(parameter),
        }
    }

    pub fn save(&self, numbers: &mut Vec<f64>) {
        numbers.extend([self.parameter, self.most_spans, self.impacts_per_step]);
        numbers.extend(self.unknowns.to_array());
        let StepMean { value: mean, covered } = self.mean_force;
        numbers.extend([mean.force.x, mean.force.y, covered]);
        let kink = self.kinked_axis.as_ref().map_or([0.0; 3], KinkedAxis::numbers);
        numbers.extend(kink);
        numbers.extend([
            self.stop_energy,
            self.lost_energy,
            self.stop_left_at,
            f64::from(u8::from(self.stop_may_pull)),
        ]);
        numbers.extend(self.friction.iter().flat_map(|friction| friction.numbers()));
        numbers.extend(self.unilateral.iter().flat_map(|contact| contact.numbers()));
        let of_sleeve = self.sleeve.iter();
        numbers.extend(of_sleeve.flat_map(|sleeve| once(mean.couple).chain(sleeve.numbers())));
        numbers.extend(self.track.iter().flat_map(|route| route.numbers()));
    }

    pub fn restore(&mut self, state: SliderState, next: &mut dyn FnMut() -> f64) {
        self.state = state;
        let parameter = next();
        (self.most_spans, self.impacts_per_step) = (next(), next());
        self.unknowns = ContactUnknowns::of(std::array::from_fn(|_| next()));
        let mean = Vec2::new(next(), next()).into();
        self.mean_force = StepMean { value: mean, covered: next() };
        let kink = std::array::from_fn(|_| next());
        self.kinked_axis.iter_mut().for_each(|axis| axis.restore(kink));
        (self.stop_energy, self.lost_energy, self.stop_left_at) = (next(), next(), next());
        self.stop_may_pull = next() != 0.0;
        if let Some(friction) = &mut self.friction {
            friction.restore(next);
        }
        if let Some(contact) = &mut self.unilateral {
            contact.restore(std::array::from_fn(|_| next()));
        }
        if let Some(sleeve) = &mut self.sleeve {
            self.mean_force.value.couple = next();
            sleeve.restore(next);
        }
        if let Some(route) = &mut self.track {
            route.restore(std::array::from_fn(|_| next()));
            self.set_master();
        }
        self.set_parameter(parameter);
    }
}
