//! The model: bodies, elements, rigid links and sliders, their present motion, and what can be done with them.

mod acceleration;
mod energies;
mod failure_source;
mod impact;
mod impulses;
mod inertia;
mod instant;
mod measures;
mod order_at_rest;
mod reactions;
mod release;
mod rest;
mod rigidity;
mod seam_impact;
mod state;
mod steps;
mod stiffness;
mod stop_impact;

pub use energies::BodyEnergy;
pub use instant::Instant;
pub use measures::{Energy, Measures};
pub use order_at_rest::OrderAtRest;
pub use reactions::Reactions;
pub(in crate::system) use release::DofNumbers;
pub use rest::StaticForces;
pub use state::SystemState;
pub use stiffness::add_resistance;
pub use stop_impact::{Arriving, RESOLVED_BLOW};

use impulses::ExchangeLedger;

use super::bodies::Bodies;
use super::elements::{Elements, InternalForce, Supports, WorkAndImpulse};
use super::links::Links;
use super::sliders::{MasterLimit, SliderContact, Sliders};
use super::state::{MotionState, Resolution, StepMeasures, Unknowns};
use crate::loads::LoadError;

/// The mechanism of a scene: assembled, with its state of motion, and ready to be advanced by an integrator.
pub struct System {
    bodies: Bodies,
    elements: Elements,
    links: Links,
    sliders: Sliders,
    supports: Supports,
    unknowns: Unknowns,
    motion: MotionState,
    exchanged: ExchangeLedger,
    step: StepMeasures,
    /// A state to go back to, for methods whose steps have parts.
    kept: SystemState,
}

impl System {
    /// A model made of its groups, in the state at its start.
    pub(super) fn new(
        bodies: Bodies,
        elements: Elements,
        links: Links,
        sliders: Sliders,
        supports: Supports,
        unknowns: Unknowns,
        motion: MotionState,
    ) -> Self {
        let degrees_of_freedom = unknowns.count() + sliders.border().width + supports.count();
        Self {
            bodies,
            elements,
            links,
            sliders,
            supports,
            unknowns,
            motion,
            exchanged: ExchangeLedger::default(),
            step: StepMeasures::new(degrees_of_freedom),
            kept: SystemState::default(),
        }
    }

    /// Begins the motion: what supports gave to make velocities fit is not counted, and the first step is guessed from the rates
    /// as they are now.
    pub(super) fn begin(&mut self) {
        self.exchanged.total = WorkAndImpulse::default();
        let inertia = self.diagonal_of_inertia();
        self.motion.begin(inertia);
        // Alone, what all of the model does is what the body does.
        let bodies = &self.bodies;
        let damped = self.elements.resistances().filter_map(InternalForce::damped_beam);
        let apart = damped.filter(|_| bodies.len() > 1);
        let unknowns = self.unknowns.count();
        let movements = |body: usize| bodies[body].degrees_of_freedom.below(unknowns);
        self.motion.watch(apart.map(|body| (body, movements(body))));
    }

    /// Gives what is moved by functions of time the rates that these have just after a time, in a model that has not taken a step.
    pub(super) fn set_given_in_motion(&mut self, time: f64) -> Result<(), (String, LoadError)> {
        self.supports.prescribed_mut().begin_at(time)?;
        let first = self.unknowns.count();
        let prescribed = &self.supports.prescribed().in_step().rates;
        self.motion.rates[first..].copy_from_slice(prescribed);
        Ok(())
    }

    pub(super) fn bodies(&self) -> &Bodies {
        &self.bodies
    }

    pub(super) fn elements(&self) -> &Elements {
        &self.elements
    }

    pub(super) fn links(&self) -> &Links {
        &self.links
    }

    pub(super) fn supports(&self) -> &Supports {
        &self.supports
    }

    pub(super) fn unknown_movements(&self) -> &Unknowns {
        &self.unknowns
    }

    pub(super) fn sliders(&self) -> &Sliders {
        &self.sliders
    }

    pub(super) fn slider(&self, slider: usize) -> &SliderContact {
        &self.sliders[slider]
    }

    /// The time of the model's present state [time].
    pub fn time(&self) -> f64 {
        self.motion.time
    }

    /// How far the steps so far resolve the motion of the model.
    pub fn resolution(&self) -> &Resolution {
        self.motion.resolution()
    }

    /// How far the steps so far resolve the motion of each beam of a damped material, by its number; none where there is no other body.
    pub fn resolution_by_beam(&self) -> impl Iterator<Item = (usize, &Resolution)> {
        self.motion.watched().iter().map(|one| (one.body, one.resolution()))
    }

    /// Whether points of rigid bodies are joined by forces that are unknowns.
    pub fn has_rigid_links(&self) -> bool {
        self.links.count() > 0
    }

    /// The mass of all bodies and point masses [mass].
    pub fn total_mass(&self) -> f64 {
        self.bodies.mass() + self.elements.mass()
    }

    /// Lets up to `threads` threads work on a large body, or on many, from here on, with the same results; gives how many will at most.
    pub fn divide(&mut self, threads: usize) -> usize {
        self.bodies.divide(threads)
    }

    /// Moves the clock of the model to a time without moving anything else.
    pub fn pass_time_to(&mut self, time: f64) {
        self.motion.time = time;
    }

    /// Gives all loads the values that they have just after a time, and prescribed motions their places at rest.
    ///
    /// # Errors
    /// When one has no finite value then: its name, and why.
    pub fn hold_loads_at(&mut self, time: f64) -> Result<(), (String, LoadError)> {
        self.supports.prescribed_mut().hold_at(time)?;
        self.elements.hold_at(time)
    }

    /// Makes steps end where a slider reaches a limit of its master, or lets them go where they lead again.
    pub fn aim_at(&mut self, limit: Option<MasterLimit>) {
        self.sliders.aim_at(limit);
    }

    /// Lets a slider, by its index, leave its master.
    pub fn release(&mut self, slider: usize) {
        self.sliders[slider].release();
        self.motion.accelerations.forget();
    }

    /// Lets a slider rest against the stop at a limit, until the stop would have to pull.
    pub fn hold(&mut self, limit: MasterLimit) {
        let slider = &mut self.sliders[limit.slider];
        slider.hold(limit.end);
        slider.stop_may_pull = slider.left_at == self.motion.time;
        self.motion.accelerations.forget();
    }

    /// Whether the present velocities lead a slider beyond a limit at which it is.
    pub fn leads_beyond(&self, limit: MasterLimit) -> bool {
        let rate = self.sliders[limit.slider].rate(&self.bodies, &self.motion.rates);
        rate * limit.end.outward() > 0.0
    }
}
