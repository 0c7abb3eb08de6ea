//! The state of a slider in numbers.

use super::Sliding;
use crate::joints::{CONTACT_UNKNOWNS, ContactUnknowns};
use crate::model::sliders::{KinkedAxis, SliderState};

impl Sliding {
    /// How many numbers a slider saves, the parameter first.
    pub const SAVED: usize = 10 + CONTACT_UNKNOWNS;

    /// Appends the numbers of the slider; its state is no number.
    pub fn save(&self, numbers: &mut Vec<f64>) {
        numbers.extend([self.parameter, self.most_spans, self.blows_in_a_step]);
        numbers.extend(self.unknowns.to_array());
        let kink = self.kinked_axis.as_ref().map_or([0.0; 3], KinkedAxis::numbers);
        numbers.extend(kink);
        numbers.extend([self.stored, self.lost, self.left_at, f64::from(u8::from(self.clings))]);
    }

    /// Takes state and numbers of the slider back, in the order in which these were appended.
    pub fn restore(&mut self, state: SliderState, next: &mut dyn FnMut() -> f64) {
        self.state = state;
        let parameter = next();
        (self.most_spans, self.blows_in_a_step) = (next(), next());
        self.unknowns = ContactUnknowns::of(std::array::from_fn(|_| next()));
        let kink = std::array::from_fn(|_| next());
        self.kinked_axis.iter_mut().for_each(|axis| axis.take(kink));
        (self.stored, self.lost, self.left_at) = (next(), next(), next());
        self.clings = next() != 0.0;
        self.stand_at(parameter);
    }
}
