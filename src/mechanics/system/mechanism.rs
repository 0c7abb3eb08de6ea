//! Mechanism of a scene: bodies, elements, rigid links and sliders with their present motion.

mod acceleration;
mod energies;
mod failure_source;
mod friction;
mod impact;
mod impulses;
mod inertia;
mod instant;
mod kink_start;
mod measures;
mod reactions;
mod release;
mod rest;
mod rigidity;
mod seam_impact;
mod start_impact;
mod start_penetration;
mod state;
mod static_order;
mod step_power;
mod steps;
mod stiffness;
mod stop_impact;
mod unilateral;

pub use energies::BodyEnergy;
pub use instant::Instant;
pub use measures::{Energy, Measures};
pub use reactions::Reactions;
pub(in crate::system) use release::DofNumbers;
pub use rest::StaticForces;
pub use start_impact::StartImpact;
pub use state::SystemState;
pub use static_order::StaticOrder;
pub use stiffness::add_resistance;
pub use stop_impact::{Arriving, RESOLVED_IMPACT};

use impulses::ExchangeLedger;

use super::bodies::Bodies;
use super::elements::{Elements, InternalForce, Supports, WorkAndImpulse};
use super::links::Links;
use super::sliders::{MasterLimit, SliderContact, SliderEvent, Sliders};
use super::state::{MotionState, Resolution, StepMeasures, Unknowns};
use crate::loads::LoadError;

/// Mechanism of a scene with its state of motion, which an integrator advances.
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
    saved_state: SystemState,
}

impl System {
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
            saved_state: SystemState::default(),
        }
    }

    pub(super) fn begin(&mut self) {
        self.exchanged.total = WorkAndImpulse::default();
        let inertia = self.diagonal_of_inertia();
        self.elements.begin(&self.bodies, &inertia);
        self.motion.begin(inertia);
        let bodies = &self.bodies;
        let damped = self.elements.resistances().filter_map(InternalForce::damped_beam);
        let apart = damped.filter(|_| bodies.len() > 1);
        let unknowns = self.unknowns.count();
        let movements = |body: usize| bodies[body].degrees_of_freedom.below(unknowns);
        self.motion.measure_resolution_of(apart.map(|body| (body, movements(body))));
    }

    pub(super) fn set_prescribed_motion(&mut self, time: f64) -> Result<(), (String, LoadError)> {
        self.supports.prescribed_mut().begin_at(time)?;
        let first = self.unknowns.count();
        let prescribed = &self.supports.prescribed().in_step().rates;
        self.motion.rates[first..].copy_from_slice(prescribed);
        Ok(())
    }

    pub(super) fn set_rest_lengths(&mut self, time: f64) -> Result<(), (String, LoadError)> {
        self.elements.set_rest_lengths_at(time)
    }

    pub(super) fn bodies(&self) -> &Bodies {
        &self.bodies
    }

    /// Sets the longest interval in which a load schedule is sampled with one set of points [time]. In longer steps, several intervals are sampled.
    pub(crate) fn sample_loads_in_parts(&mut self, longest: f64) {
        self.elements.sample_in_parts(longest);
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

    /// Present time [time].
    pub fn time(&self) -> f64 {
        self.motion.time
    }

    /// Energy that dampers returned in the last step [energy]. It is zero for methods without substeps backwards in time.
    pub fn returned(&self) -> f64 {
        self.step.returned
    }

    /// Measures of the temporal resolution in the steps so far, used for warnings about too large steps.
    pub fn resolution(&self) -> &Resolution {
        self.motion.resolution()
    }

    pub(crate) fn resolution_by_beam(&self) -> impl Iterator<Item = (usize, &Resolution)> {
        self.motion.watched().iter().map(|one| (one.body, one.resolution()))
    }

    pub(crate) fn has_rigid_links(&self) -> bool {
        self.links.count() > 0
    }

    /// Total mass of bodies and point masses [mass].
    pub fn total_mass(&self) -> f64 {
        self.bodies.mass() + self.elements.mass()
    }

    /// Sets the number of threads for a large body or many bodies, and returns the largest number of threads in use.
    pub fn divide(&mut self, threads: usize) -> usize {
        self.bodies.divide(threads)
    }

    pub(crate) fn set_time(&mut self, time: f64) {
        self.motion.time = time;
    }

    /// Evaluates the loads and prescribed positions of a static solution just after a time.
    ///
    /// # Errors
    /// Returns the name of the load or drive without a finite value, and the error of its schedule.
    pub(crate) fn evaluate_loads_at(&mut self, time: f64) -> Result<(), (String, LoadError)> {
        self.supports.prescribed_mut().evaluate_after(time)?;
        self.set_rest_lengths(time)?;
        self.elements.evaluate_after(time)
    }

    pub(crate) fn set_target(&mut self, event: Option<SliderEvent>) {
        self.sliders.set_target(event);
    }

    /// Releases a slider from its master.
    pub fn release_slider(&mut self, slider: usize) {
        self.sliders[slider].release();
        self.motion.accelerations.mark_unknown();
    }

    /// Holds a slider at the stop at a limit until the stop force becomes tensile.
    pub fn hold_at_stop(&mut self, limit: MasterLimit) {
        let slider = &mut self.sliders[limit.slider];
        slider.hold_at(limit.end);
        slider.stop_may_pull = slider.stop_left_at == self.motion.time;
        self.motion.accelerations.mark_unknown();
    }

    /// Returns true if the present velocity of a slider at a limit points beyond the limit.
    /// The function returns false for a slider that has just left a stop, because its velocity is zero within rounding and has no definite sign.
    pub(crate) fn leads_beyond(&self, limit: MasterLimit) -> bool {
        let slider = &self.sliders[limit.slider];
        let rate = slider.rate(&self.bodies, &self.motion.rates);
        rate * limit.end.outward() > 0.0 && slider.stop_left_at != self.motion.time
    }
}
