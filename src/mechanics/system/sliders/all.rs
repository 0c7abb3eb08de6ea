//! All sliders of a model.

use std::ops::{Deref, DerefMut};

use super::master_curve::END_TOLERANCE;
use super::slider_contact::FrictionTransition;
use super::{MasterEnd, MasterLimit, Passing, SliderContact, SliderEvent, SliderState};
use crate::beams::{RotationIncrement, SpanStiffness};
use crate::geometry::larger;
use crate::integrators::{Interval, IntervalEnd, Overshoot};
use crate::joints::{CONTACT_UNKNOWNS, EndAction, Wrench};
use crate::linalg::{BlockLayout, Border, BorderShape};
use crate::system::bodies::Body;
use crate::system::errors::{SliderError, SystemError};

#[derive(Default)]
pub struct Sliders {
    all: Vec<SliderContact>,
    blocks: Option<BlockLayout>,
    target: Option<SliderEvent>,
}

impl Deref for Sliders {
    type Target = [SliderContact];

    fn deref(&self) -> &[SliderContact] {
        &self.all
    }
}

impl DerefMut for Sliders {
    fn deref_mut(&mut self) -> &mut [SliderContact] {
        &mut self.all
    }
}

impl Sliders {
    pub fn new(all: Vec<SliderContact>, blocks: Option<BlockLayout>) -> Self {
        Self { all, blocks, target: None }
    }

    pub fn renumber(&mut self, blocks: Option<BlockLayout>) {
        self.blocks = blocks;
    }

    pub fn blocks(&self) -> Option<&BlockLayout> {
        self.blocks.as_ref()
    }

    /// Sets the slider event at which steps must end; `None` for regular steps.
    pub fn set_target(&mut self, event: Option<SliderEvent>) {
        self.target = event;
    }

    /// Number of contact unknowns, and an upper bound of the number of nonzero derivatives of the contact equations.
    pub fn border(&self) -> BorderShape {
        BorderShape {
            width: CONTACT_UNKNOWNS * self.len(),
            row_entries: self.iter().map(SliderContact::row_entries).sum(),
        }
    }

    pub fn begin_step(
        &mut self,
        bodies: &[Body],
        rates: &[f64],
        step: (Interval, RotationIncrement),
    ) {
        self.iter_mut().for_each(|slider| slider.begin_step(bodies, rates, step));
    }

    pub fn freeze_contacts(&mut self) -> bool {
        self.iter_mut().fold(false, |any, slider| slider.freeze() | any)
    }

    pub fn unfreeze_contacts(&mut self) {
        self.iter_mut().for_each(SliderContact::unfreeze);
    }

    pub fn predict(
        &self,
        bodies: &[Body],
        rates: &[f64],
        interval: Interval,
        unknowns: &mut [f64],
    ) {
        self.iter().for_each(|slider| slider.predict(bodies, rates, interval, unknowns));
    }

    pub fn add<P: Passing>(
        &mut self,
        bodies: &[Body],
        movements: usize,
        increments: &[f64],
        unknowns: &[f64],
        out: &mut [f64],
    ) -> f64 {
        self.iter_mut().fold(0.0, |largest, slider| {
            larger(largest, slider.add::<P>(bodies, movements, increments, unknowns, out))
        })
    }

    pub fn add_linearised<P: Passing>(
        &mut self,
        bodies: &[Body],
        movements: usize,
        increments: &[f64],
        unknowns: &[f64],
        out: &mut [f64],
        border: &mut Border,
    ) {
        for slider in self.iter_mut() {
            slider.add_linearised::<P>(bodies, movements, increments, unknowns, out, border);
        }
    }

    pub fn predict_unchanged(&self, unknowns: &mut [f64]) {
        self.iter().for_each(|slider| slider.predict_unchanged(unknowns));
    }

    /// Holds sliders that the present iterate of a static solution moves beyond stops. Releases sliders whose stop force is tensile.
    /// The returned flag is true if the state of a slider has changed.
    /// If a slider would leave its master, the error contains the slider and the end of the master.
    pub fn update_stop_contacts(
        &mut self,
        bodies: &[Body],
        movements: &[f64],
        unknowns: &[f64],
    ) -> Result<bool, (usize, MasterEnd)> {
        let mut changed = false;
        for (index, slider) in self.iter_mut().enumerate() {
            if let Some(end) = slider.passed_end(unknowns) {
                let goes_on = slider.seam(bodies, end).is_some();
                if slider.ends == EndAction::Release && !goes_on {
                    return Err((index, end));
                }
                slider.hold_at(end);
                changed = true;
            } else if slider.is_pulled(bodies, movements, unknowns) {
                slider.change_sides(bodies);
                slider.state = SliderState::Sliding;
                changed = true;
            }
        }
        Ok(changed)
    }

    pub fn accept_static_positions(
        &mut self,
        bodies: &[Body],
        movements: &[f64],
        unknowns: &[f64],
    ) {
        for slider in self.iter_mut() {
            slider.rotate_sleeve(bodies, movements);
            slider.accept_static_position(unknowns);
        }
    }

    pub fn movements_held(&self) -> usize {
        self.iter().map(SliderContact::movements_held).sum()
    }

    pub fn for_each_static_stiffness(
        &self,
        bodies: &[Body],
        count: usize,
        rigid: f64,
        take: &mut dyn FnMut(&[usize], &SpanStiffness),
    ) {
        for (index, slider) in self.iter().enumerate() {
            slider.static_stiffness(bodies, count + index, rigid, take);
        }
    }

    pub fn violation(&self, equations: &[f64], relative: impl Fn(f64) -> f64) -> f64 {
        self.iter().fold(0.0, |largest, slider| {
            let (length, force) = slider.violation(equations);
            larger(largest, larger(length, relative(force)))
        })
    }

    /// Checks that a step with the given unknowns may be accepted, and records tensile stop forces.
    ///
    /// # Errors
    /// Fails if a slider passes an end of its master, or if it misses the event at which the step has to end.
    /// Also fails if a stop force becomes tensile, if a slider with friction begins to slip or to stick, or if a slider in flight lands.
    pub fn check(&mut self, unknowns: &[f64], ending: IntervalEnd) -> Result<(), Overshoot> {
        let mut furthest: Option<Overshoot> = None;
        let aim = self.target.filter(|_| ending == IntervalEnd::Step);
        let limits = (0..self.len()).flat_map(MasterLimit::both);
        for limit in limits.filter(|limit| self[limit.slider].is_sliding()) {
            let distance = self[limit.slider].overshoot(unknowns, limit.end);
            let event = SliderEvent::Limit(limit);
            let overshoot = Overshoot { event: event.number(), distance };
            if aim == Some(event) && distance.abs() > END_TOLERANCE {
                return Err(overshoot);
            }
            if distance > END_TOLERANCE && furthest.is_none_or(|other| distance > other.distance) {
                furthest = Some(overshoot);
            }
        }
        let other = self.friction_overshoot(unknowns, aim).or_else(|| self.landing_overshoot(aim));
        if let Some(overshoot) = other {
            return Err(furthest.unwrap_or(overshoot));
        }
        self.iter_mut().for_each(|slider| slider.record_tension(ending));
        let pulled = self.iter().position(|slider| slider.is_pulled);
        let leaves = pulled.and_then(|slider| match self[slider].state {
            SliderState::Held(end) => Some(MasterLimit { slider, end }),
            SliderState::Sliding | SliderState::Separated | SliderState::Released => None,
        });
        let leaves = leaves
            .map(|limit| Overshoot { event: SliderEvent::Limit(limit).number(), distance: 0.0 });
        furthest.or(leaves).map_or(Ok(()), Err)
    }

    fn friction_overshoot(&self, unknowns: &[f64], aim: Option<SliderEvent>) -> Option<Overshoot> {
        let mut starts = None;
        for (index, slider) in self.iter().enumerate() {
            let [end, start] = [SliderEvent::SlipEnd(index), SliderEvent::SlipStart(index)];
            if aim == Some(end) {
                if let Some(distance) = slider.missed_slip_end(unknowns) {
                    return Some(Overshoot { event: end.number(), distance });
                }
                continue;
            }
            match slider.friction_transition(unknowns) {
                Some(FrictionTransition::SlipEnds { reversed: distance }) => {
                    return Some(Overshoot { event: end.number(), distance });
                }
                Some(FrictionTransition::SlipStarts { excess: distance }) => {
                    starts = starts.or(Some(Overshoot { event: start.number(), distance }));
                }
                None if aim == Some(start) => {
                    let missed = slider.missed_slip_start().map(|reserve| -reserve);
                    let missed =
                        missed.map(|distance| Overshoot { event: start.number(), distance });
                    starts = starts.or(missed);
                }
                None => {}
            }
        }
        starts
    }

    fn landing_overshoot(&self, aim: Option<SliderEvent>) -> Option<Overshoot> {
        self.iter().enumerate().find_map(|(index, slider)| {
            let event = SliderEvent::Landing(index);
            let distance = match aim == Some(event) {
                true => slider.signed_depth(),
                false => slider.depth_at_landing(),
            };
            distance.map(|distance| Overshoot { event: event.number(), distance })
        })
    }

    pub fn target(&self) -> Option<SliderEvent> {
        self.target
    }

    /// Smallest ratio of chord to length of the path of a slider in the step, over all sliders [-].
    pub fn shortest_chord(&self) -> f64 {
        self.iter().map(SliderContact::chord).fold(f64::INFINITY, f64::min)
    }

    /// Evaluates all contacts at the end of an accepted step. The caller must not move the bodies before this call.
    pub fn evaluate_end(&mut self, bodies: &[Body], increments: &[f64], unknowns: &[f64]) {
        self.iter_mut().for_each(|slider| slider.evaluate_end(bodies, increments, unknowns));
    }

    pub fn advance(&mut self, unknowns: &[f64], interval: Interval) {
        self.iter_mut().for_each(|slider| slider.advance(unknowns, interval));
    }

    /// Largest distance between a slave and the contact point of its master [length].
    pub fn largest_gap(&self, bodies: &[Body]) -> f64 {
        self.iter().map(|slider| slider.gap(bodies).norm()).fold(0.0, larger)
    }

    /// Strain energy of kinks and energy stored in stops, on one body or on all bodies [energy].
    pub fn strain_energy(&self, of: Option<usize>) -> f64 {
        self.on_body(of).map(SliderContact::strain_energy).sum()
    }

    /// Kinetic energy of kinks on one body, or on all bodies [energy].
    pub fn kinetic_energy(&self, of: Option<usize>) -> f64 {
        self.on_body(of).map(SliderContact::kinetic_energy).sum()
    }

    fn on_body(&self, body: Option<usize>) -> impl Iterator<Item = &SliderContact> {
        self.iter().filter(move |slider| body.is_none_or(|body| slider.connection.master == body))
    }

    /// Index of a slider and unit wrench, for each component of a contact force that is an unknown at the present time [-].
    /// The component of a contact force across the master is an unknown, unless the slider slides on a compliant axis.
    /// The component of a contact force along the master is an unknown if the slider is held or sticks.
    /// The couple of a sleeve is an unknown.
    pub fn directions(&self, bodies: &[Body]) -> impl Iterator<Item = (usize, Wrench)> {
        self.iter().enumerate().flat_map(|(at, slider)| {
            let (has_across, has_along) = match slider.state {
                SliderState::Released | SliderState::Separated => (false, false),
                SliderState::Sliding if slider.is_compliant() => (false, false),
                SliderState::Sliding => (true, slider.sticks()),
                SliderState::Held(_) => (true, true),
            };
            let across = has_across.then(|| slider.across(bodies).into());
            let along = has_along.then(|| slider.along(bodies).into());
            let couple = slider.couple_direction(bodies);
            [across, along, couple].into_iter().flatten().map(move |wrench| (at, wrench))
        })
    }

    /// Energy lost by all sliders in impacts and by friction so far [energy].
    pub fn lost_energy(&self) -> f64 {
        self.iter().map(|slider| slider.lost_energy).fold(0.0, |sum, lost| sum + lost)
    }

    pub fn states(&self) -> impl Iterator<Item = SliderState> {
        self.iter().map(|slider| slider.state)
    }

    pub fn save(&self, numbers: &mut Vec<f64>) {
        self.iter().for_each(|slider| slider.save(numbers));
    }

    pub fn restore(&mut self, states: &[SliderState], next: &mut dyn FnMut() -> f64) {
        self.iter_mut().zip(states).for_each(|(slider, state)| slider.restore(*state, next));
    }

    pub fn fit(&self, numbers: &[f64]) -> bool {
        let mut left = numbers;
        self.iter().all(|slider| {
            let (own, rest) = left.split_at(slider.saved());
            left = rest;
            slider.is_valid(own)
        })
    }

    pub fn saved(&self) -> usize {
        self.iter().map(SliderContact::saved).sum()
    }

    pub fn overdetermined(&self) -> SystemError {
        let names: Vec<&str> = self.iter().map(|slider| slider.name.as_str()).collect();
        SliderError::Overdetermined { sliders: names.join("', '") }.into()
    }
}
