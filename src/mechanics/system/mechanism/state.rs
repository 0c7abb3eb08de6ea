//! Saving and restoring the state of a mechanism bit for bit.

use serde::{Deserialize, Serialize};

use super::System;
use crate::integrators::Checkpoint;
use crate::system::SystemError;
use crate::system::sliders::SliderState;
use crate::system::state::Prediction;

/// State of a [`System`], which can be restored in the same system.
/// The state of a system determines the later motion, and contains the accumulated work and impulse.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
pub struct SystemState {
    numbers: Vec<f64>,
    prediction: Prediction,
    knows_accelerations: bool,
    sliders: Vec<SliderState>,
    contacts: Vec<f64>,
}

impl SystemState {
    /// Returns an empty state with the capacity for the numbers and slider states of this state.
    pub fn blank(&self) -> Self {
        Self {
            numbers: Vec::with_capacity(self.numbers.len()),
            sliders: Vec::with_capacity(self.sliders.len()),
            ..Self::default()
        }
    }

    pub(crate) fn is_shaped_like(&self, other: &Self) -> bool {
        self.numbers.len() == other.numbers.len()
            && self.sliders.len() == other.sliders.len()
            && self.contacts.len() == other.contacts.len()
    }

    pub(crate) fn displace(&mut self, from: &Self, change: &[f64], amount: f64) {
        let Self { numbers, prediction: trend, knows_accelerations, sliders, contacts } = self;
        numbers.clear();
        let moved = |(own, by): (&f64, &f64)| own + amount * by;
        let (of_numbers, of_contacts) = change.split_at(from.numbers.len().min(change.len()));
        numbers.extend(from.numbers.iter().zip(of_numbers).map(moved));
        (*trend, *knows_accelerations) = (from.prediction, from.knows_accelerations);
        sliders.clear();
        sliders.extend_from_slice(&from.sliders);
        contacts.clear();
        contacts.extend(from.contacts.iter().zip(of_contacts).map(moved));
    }

    pub(crate) fn change_from(&self, other: &Self, distance: f64, change: &mut Vec<f64>) {
        let per_unit = |(own, other): (&f64, &f64)| match own == other || own.is_nan() {
            true => 0.0,
            false => (own - other) / distance,
        };
        change.clear();
        change.extend(self.numbers.iter().zip(&other.numbers).map(per_unit));
        change.extend(self.contacts.iter().zip(&other.contacts).map(per_unit));
    }

    /// Heap memory of the state [bytes].
    pub fn bytes(&self) -> usize {
        (self.numbers.capacity() + self.contacts.capacity()) * size_of::<f64>()
            + self.sliders.capacity() * size_of::<SliderState>()
    }
}

impl System {
    /// Returns the state of the model.
    pub fn state(&self) -> SystemState {
        let mut state = SystemState::default();
        self.write_state(&mut state);
        state.numbers.shrink_to_fit();
        state
    }

    /// Writes the [`state`](Self::state) to a buffer. If the buffer already holds a state of this model, only additional contacts are allocated.
    pub(crate) fn write_state(&self, state: &mut SystemState) {
        let SystemState { numbers, prediction: trend, knows_accelerations, sliders, contacts } =
            state;
        numbers.clear();
        self.exchanged.save(numbers);
        self.motion.save(numbers);
        self.bodies.save(numbers);
        self.elements.save(numbers);
        self.links.save(numbers);
        self.supports.prescribed().save(numbers);
        self.motion.accelerations.save(numbers);
        self.sliders.save(numbers);
        *trend = self.motion.trend();
        *knows_accelerations = self.motion.accelerations.are_known();
        sliders.clear();
        sliders.extend(self.sliders.states());
        contacts.clear();
        self.elements.save_contacts(contacts);
    }

    /// Restores a [`state`](Self::state) of this model bit for bit.
    ///
    /// # Panics
    /// Panics if the given state does not belong to this model.
    pub fn restore(&mut self, state: &SystemState) {
        let mut numbers = state.numbers.iter().copied();
        let next = &mut || numbers.next().expect("the state is one of this model");
        self.exchanged.restore(next);
        self.motion.restore(state.prediction, next);
        self.bodies.restore(next);
        self.elements.restore(next);
        self.links.restore(next);
        self.supports.prescribed_mut().restore(next);
        self.motion.accelerations.restore(state.knows_accelerations, next);
        self.sliders.restore(&state.sliders, next);
        assert!(numbers.next().is_none(), "the state is one of this model");
        let contacts = self.elements.restore_contacts(&self.bodies, &state.contacts);
        contacts.expect("the state is one of this model");
    }

    pub(crate) fn restore_checked(&mut self, state: &SystemState) -> Result<(), SystemError> {
        let refused = |reason: &'static str| SystemError::State { reason };
        let numbers = &state.numbers;
        let own = self.state();
        if numbers.len() != own.numbers.len() || state.sliders.len() != own.sliders.len() {
            return Err(refused("it has a different number of values"));
        }
        let mut all = numbers.iter().chain(&state.contacts);
        if !all.all(|number| number.is_finite()) {
            return Err(refused("it has a value that is not finite"));
        }
        let states = self.sliders.iter().zip(&state.sliders);
        let mut in_flight = states.filter(|(_, state)| **state == SliderState::Separated);
        if in_flight.any(|(slider, _)| slider.unilateral.is_none()) {
            return Err(refused("a slider without a side is in flight"));
        }
        let of_sliders = &numbers[numbers.len() - self.sliders.saved()..];
        if !self.sliders.fit(of_sliders) {
            return Err(refused("a slider is outside its beam"));
        }
        if self.elements.restore_contacts(&self.bodies, &state.contacts).is_none() {
            return Err(refused("its contacts are not contacts of this scene"));
        }
        self.restore(state);
        Ok(())
    }
}

impl Checkpoint for System {
    fn save_state(&mut self) {
        let mut kept = std::mem::take(&mut self.saved_state);
        self.write_state(&mut kept);
        self.saved_state = kept;
    }

    fn restore_state(&mut self) {
        let kept = std::mem::take(&mut self.saved_state);
        self.restore(&kept);
        self.saved_state = kept;
    }
}
