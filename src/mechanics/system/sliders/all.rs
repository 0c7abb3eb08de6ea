//! All sliders of a model.

use std::ops::{Deref, DerefMut};

use super::master_curve::LANDED;
use super::{MasterEnd, MasterLimit, Passing, SliderContact, SliderState};
use crate::beams::SpanStiffness;
use crate::geometry::{Vec2, larger};
use crate::integrators::{Interval, IntervalEnd, Overshoot};
use crate::joints::{CONTACT_UNKNOWNS, EndAction};
use crate::linalg::{BlockLayout, Border, BorderShape};
use crate::system::bodies::Body;
use crate::system::errors::{SliderError, SystemError};

/// The sliders of a model, in the order of the scene; it derefs to the slice of them.
#[derive(Default)]
pub struct Sliders {
    all: Vec<SliderContact>,
    /// Their contacts, where they are eliminated one by one.
    blocks: Option<BlockLayout>,
    /// The limit at which the next step is to end.
    aim: Option<MasterLimit>,
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
    /// The sliders of a model, given in the order of the scene, with their contacts as blocks if these are eliminated one by one.
    pub fn new(all: Vec<SliderContact>, blocks: Option<BlockLayout>) -> Self {
        Self { all, blocks, aim: None }
    }

    /// Takes the blocks that the contacts are with other numbers of the movements.
    pub fn renumber(&mut self, blocks: Option<BlockLayout>) {
        self.blocks = blocks;
    }

    /// The contacts as blocks of unknowns, if they are eliminated one by one.
    pub fn blocks(&self) -> Option<&BlockLayout> {
        self.blocks.as_ref()
    }

    /// Makes steps end at a limit, or lets them go where they lead again.
    pub fn aim_at(&mut self, limit: Option<MasterLimit>) {
        self.aim = limit;
    }

    /// How many unknowns the contacts add, and how many entries their equations may have.
    pub fn border(&self) -> BorderShape {
        BorderShape {
            width: CONTACT_UNKNOWNS * self.len(),
            row_entries: self.iter().map(SliderContact::row_entries).sum(),
        }
    }

    /// Begins a step.
    pub fn begin_step(&mut self, bodies: &[Body], rates: &[f64], interval: Interval) {
        self.iter_mut().for_each(|slider| slider.begin_step(bodies, rates, interval));
    }

    /// Keeps the kinks of all masters as they are in steps to come; gives whether that is another law for the next step.
    pub fn keep_kinks(&mut self) -> bool {
        self.iter_mut().fold(false, |any, slider| slider.keep_kink() | any)
    }

    /// Lets the kinks of all masters follow contact forces again.
    pub fn let_kinks_follow(&mut self) {
        self.iter_mut().for_each(SliderContact::let_kink_follow);
    }

    /// Guesses the unknowns of all contacts for a step: every slider slides on as it does.
    pub fn predict(
        &self,
        bodies: &[Body],
        rates: &[f64],
        interval: Interval,
        unknowns: &mut [f64],
    ) {
        self.iter().for_each(|slider| slider.predict(bodies, rates, interval, unknowns));
    }

    /// Adds the forces and the equations of all contacts to a residual; gives the largest force of a contact [force].
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

    /// Adds the forces and the equations of all contacts to a residual, and their derivatives to the tangent.
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

    /// Guesses the unknowns of all contacts for a movement between two places at rest: nothing changes.
    pub fn stay(&self, unknowns: &mut [f64]) {
        self.iter().for_each(|slider| slider.stay(unknowns));
    }

    /// Lets sliders lean on stops that a movement with these unknowns passes, and leave stops that would have to pull; whether any did. What must leave
    /// its master has no rest: its index and the end.
    pub fn settle_on_stops(
        &mut self,
        bodies: &[Body],
        movements: &[f64],
        unknowns: &[f64],
    ) -> Result<bool, (usize, MasterEnd)> {
        let mut changed = false;
        for (index, slider) in self.iter_mut().enumerate() {
            if let Some(end) = slider.passes(unknowns) {
                let goes_on = slider.seam(bodies, end).is_some();
                if slider.ends == EndAction::Release && !goes_on {
                    return Err((index, end));
                }
                slider.hold(end);
                changed = true;
            } else if slider.is_pulled(bodies, movements, unknowns) {
                slider.change_sides(bodies);
                slider.state = SliderState::Sliding;
                changed = true;
            }
        }
        Ok(changed)
    }

    /// Leaves all sliders where a movement between two places at rest has led them; the bodies are there already.
    pub fn rest(&mut self, unknowns: &[f64]) {
        self.iter_mut().for_each(|slider| slider.rest(unknowns));
    }

    /// How many movements all contacts take from slaves and masters.
    pub fn movements_held(&self) -> usize {
        self.iter().map(SliderContact::movements_held).sum()
    }

    /// Gives how all contacts resist small movements, were they as stiff as that where nothing gives way [force/length]; the unknowns of their
    /// places on masters stand behind so many.
    pub fn each_at_rest(
        &self,
        bodies: &[Body],
        count: usize,
        rigid: f64,
        take: &mut dyn FnMut(&[usize], &SpanStiffness),
    ) {
        for (index, slider) in self.iter().enumerate() {
            slider.at_rest(bodies, count + index, rigid, take);
        }
    }

    /// The largest violation of an equation of a contact: of lengths relative to the lengths met, of forces as `relative` has it [-].
    pub fn violation(&self, equations: &[f64], relative: impl Fn(f64) -> f64) -> f64 {
        self.iter().fold(0.0, |largest, slider| {
            let (length, force) = slider.violation(equations);
            larger(largest, larger(length, relative(force)))
        })
    }

    /// Whether a step with these unknowns, of such an ending, may be accepted.
    ///
    /// # Errors
    /// When a slider passes an end of its master, or does not come to that at which the step is to end.
    /// Or when a stop on which a slider leans would have to pull: all of these are noted.
    pub fn check(&mut self, unknowns: &[f64], ending: IntervalEnd) -> Result<(), Overshoot> {
        let mut furthest: Option<Overshoot> = None;
        let aim = self.aim.filter(|_| ending == IntervalEnd::OfStep);
        let limits = (0..self.len()).flat_map(MasterLimit::both);
        for limit in limits.filter(|limit| self[limit.slider].is_sliding()) {
            let distance = self[limit.slider].beyond(unknowns, limit.end);
            let overshoot = Overshoot { limit: limit.number(), distance };
            if aim == Some(limit) && distance.abs() > LANDED {
                return Err(overshoot);
            }
            if distance > LANDED && furthest.is_none_or(|other| distance > other.distance) {
                furthest = Some(overshoot);
            }
        }
        self.iter_mut().for_each(|slider| slider.note_pull(ending));
        let pulled = self.iter().position(|slider| slider.is_pulled);
        let leaves = pulled.and_then(|slider| match self[slider].state {
            SliderState::Held(end) => Some(MasterLimit { slider, end }),
            SliderState::Sliding | SliderState::Released => None,
        });
        let leaves = leaves.map(|limit| Overshoot { limit: limit.number(), distance: 0.0 });
        furthest.or(leaves).map_or(Ok(()), Err)
    }

    /// The shortest chord of the way of a slider, relative to the length of that way [-].
    pub fn shortest_chord(&self) -> f64 {
        self.iter().map(SliderContact::chord).fold(f64::INFINITY, f64::min)
    }

    /// Looks at all contacts at the end of a step that is accepted; the bodies are at its start still.
    pub fn close(&mut self, bodies: &[Body], increments: &[f64], unknowns: &[f64]) {
        self.iter_mut().for_each(|slider| slider.close(bodies, increments, unknowns));
    }

    /// Lets all sliders accept a step of such an ending; the bodies are at its end already.
    pub fn advance(&mut self, unknowns: &[f64], ending: IntervalEnd) {
        self.iter_mut().for_each(|slider| slider.advance(unknowns, ending));
    }

    /// The largest distance of a slave from its place on the master [length].
    pub fn largest_gap(&self, bodies: &[Body]) -> f64 {
        self.iter().map(|slider| slider.gap(bodies).norm()).fold(0.0, larger)
    }

    /// The energy of the kinks under all contact forces on a body, or on all bodies [energy].
    pub fn strain_energy(&self, of: Option<usize>) -> f64 {
        self.on(of).map(SliderContact::strain_energy).sum()
    }

    /// The energy with which the kinks under all contact forces on a body, or on all bodies, move along [energy].
    pub fn kinetic_energy(&self, of: Option<usize>) -> f64 {
        self.on(of).map(SliderContact::kinetic_energy).sum()
    }

    /// The sliders on a body, or all.
    fn on(&self, body: Option<usize>) -> impl Iterator<Item = &SliderContact> {
        self.iter().filter(move |slider| body.is_none_or(|body| slider.connection.master == body))
    }

    /// The directions [-] in which all contacts transmit forces at present, with the number of the slider: across masters that do not give way, and along
    /// them where sliders are held.
    pub fn directions(&self, bodies: &[Body]) -> Vec<(usize, Vec2)> {
        let of_slider = |(at, slider): (usize, &SliderContact)| {
            let (across, along) = (slider.across(bodies), slider.along(bodies));
            match slider.state {
                SliderState::Released => vec![],
                SliderState::Sliding if slider.gives_way() => vec![],
                SliderState::Sliding => vec![(at, across)],
                SliderState::Held(_) => vec![(at, across), (at, along)],
            }
        };
        self.iter().enumerate().flat_map(of_slider).collect()
    }

    /// What was lost in all blows of sliders against stops so far [energy].
    pub fn lost(&self) -> f64 {
        self.iter().map(|slider| slider.lost).fold(0.0, |sum, lost| sum + lost)
    }

    /// What each slider does at present, in order.
    pub fn states(&self) -> impl Iterator<Item = SliderState> {
        self.iter().map(|slider| slider.state)
    }

    /// Appends the numbers of all sliders; their states are no numbers.
    pub fn save(&self, numbers: &mut Vec<f64>) {
        self.iter().for_each(|slider| slider.save(numbers));
    }

    /// Takes states and numbers of all sliders back, in their order.
    pub fn restore(&mut self, states: &[SliderState], next: &mut dyn FnMut() -> f64) {
        self.iter_mut().zip(states).for_each(|(slider, state)| slider.restore(*state, next));
    }

    /// Whether stored numbers of sliders may be those of these sliders.
    pub fn fit(&self, numbers: &[f64]) -> bool {
        let mut left = numbers;
        self.iter().all(|slider| {
            let (own, rest) = left.split_at(slider.saved());
            left = rest;
            slider.may_be(own)
        })
    }

    /// How many numbers all sliders save.
    pub fn saved(&self) -> usize {
        self.iter().map(SliderContact::saved).sum()
    }

    /// The error of contact forces that are not determined.
    pub fn overdetermined(&self) -> SystemError {
        let names: Vec<&str> = self.iter().map(|slider| slider.name.as_str()).collect();
        SliderError::Overdetermined { sliders: names.join("', '") }.into()
    }
}
