//! Friction of a slider along its master: state between steps, and transitions between slip and stick.

use super::SliderContact;
use super::static_friction::{StaticFriction, StickingForces};
use crate::geometry::{Vec2, cross};
use crate::integrators::Interval;
use crate::joints::{Friction, FrictionForces, FrictionMode, Slider};
use crate::system::bodies::Body;

/// Largest velocity along the master that counts as zero at the end of a slip, as a fraction of the velocity at the start of the step.
/// With a zero limit, the step after the end of the slip could be too short for an accurate energy balance.
const STOPPED: f64 = 1e-6;

/// Rounding error of velocities, as a fraction of the length of the master divided by the duration of the step.
const ROUNDING: f64 = 1e-14;

/// Shortest step in which friction acts, as a fraction of the longest step so far.
/// The forces of a very short step consist of rounding errors.
const NEGLIGIBLE: f64 = 1e-7;

/// Longest step in which the friction force may be kept constant, as a fraction of the longest step so far.
/// The friction force is kept constant if a step with the friction law has no solution.
const FIXED_BELOW: f64 = 1.0 / 16.0;

/// Number of recent transitions between slip and stick below which steps end at transitions.
/// Each transition increases the number by one, and each accepted step or substep reduces it by one.
const MOST_TRANSITIONS: usize = 8;

/// Transition between slip and stick at the end of an attempted step.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum FrictionTransition {
    SlipEnds {
        reversed: f64,
    },
    /// The friction force that sticking requires exceeds the friction limit.
    SlipStarts {
        /// Excess at the end of the step [force]; zero if the step has to be repeated with slip.
        excess: f64,
    },
}

#[derive(Debug, Clone)]
pub struct SliderFriction {
    /// Coefficient of friction [-].
    coefficient: f64,
    /// Static friction; `None` if the coefficients of slip and stick are equal.
    static_friction: Option<StaticFriction>,
    pub mode: FrictionMode,
    /// Velocity of the slave at the start of the step [length/time].
    slave_velocity: Vec2,
    /// Velocities of the control points of the master at the start of the step [length/time].
    master_velocities: Vec<Vec2>,
    /// Velocity of the slave relative to the master, component along the master, at the start of the step [length/time].
    start_velocity_along: f64,
    /// Velocity of the slave relative to the master, component across the master, at the start of the step [length/time].
    start_velocity_across: f64,
    pub inertia_across: f64,
    duration: f64,
    /// Duration of the longest step so far [time].
    longest: f64,
    forces: FrictionForces,
    /// Mean force on the master along the tangent of the master in the last step [force].
    force: f64,
    transitions: usize,
    /// Friction force that replaces the friction law in the present step [force]; `None` if the law applies.
    fixed_force: Option<f64>,
    /// Number of accepted steps with a constant friction force.
    pub fixed_steps: usize,
}

impl SliderFriction {
    pub fn of(slider: &Slider) -> Self {
        let larger = slider.static_friction.filter(|coefficient| *coefficient > slider.friction);
        Self {
            coefficient: slider.friction,
            static_friction: larger.map(StaticFriction::new),
            mode: FrictionMode::Stick,
            slave_velocity: Vec2::zeros(),
            master_velocities: Vec::new(),
            start_velocity_along: 0.0,
            start_velocity_across: 0.0,
            inertia_across: 0.0,
            duration: f64::INFINITY,
            longest: 0.0,
            forces: FrictionForces::default(),
            force: 0.0,
            transitions: 0,
            fixed_force: None,
            fixed_steps: 0,
        }
    }

    pub(super) fn freeze(&mut self) -> bool {
        let FrictionMode::Slip(sign) = self.mode else { return false };
        let is_short = self.duration <= FIXED_BELOW * self.longest;
        if !is_short || !self.acts() || self.fixed_force.is_some() {
            return false;
        }
        self.fixed_force = Some(sign * self.force.abs());
        true
    }

    pub(super) fn unfreeze(&mut self) {
        self.fixed_force = None;
    }

    pub(super) fn in_step(&self, window: std::ops::Range<usize>) -> Option<Friction<'_>> {
        let master_velocities = self.master_velocities.get(window).filter(|_| self.acts())?;
        Some(Friction {
            coefficient: self.coefficient,
            mode: self.mode,
            slave_velocity: self.slave_velocity,
            master_velocities,
            start_velocity_across: self.start_velocity_across,
            inertia_across: self.inertia_across,
            duration: self.duration,
            fixed_force: self.fixed_force,
        })
    }

    fn acts(&self) -> bool {
        self.duration >= NEGLIGIBLE * self.longest
    }

    fn cuts_steps(&self) -> bool {
        self.transitions < MOST_TRANSITIONS
    }

    /// Sign of the slip, or zero for a sticking slider.
    fn mode_number(&self) -> f64 {
        match self.mode {
            FrictionMode::Slip(sign) => sign,
            FrictionMode::Stick => 0.0,
        }
    }

    fn set_mode_number(&mut self, number: f64) {
        self.mode =
            if number == 0.0 { FrictionMode::Stick } else { FrictionMode::Slip(number.signum()) };
        self.transitions = 0;
    }

    pub(super) fn numbers(&self) -> impl Iterator<Item = f64> {
        let sticking = self.static_friction.as_ref().map(StaticFriction::numbers);
        let own = [self.mode_number(), self.force, self.longest, self.transitions as f64];
        own.into_iter().chain(sticking.into_iter().flatten())
    }

    pub(super) fn restore(&mut self, next: &mut dyn FnMut() -> f64) {
        self.set_mode_number(next());
        (self.force, self.longest) = (next(), next());
        self.transitions = next() as usize;
        if let Some(of) = &mut self.static_friction {
            of.restore(std::array::from_fn(|_| next()));
        }
    }

    fn change_mode(&mut self, mode: FrictionMode) {
        self.mode = mode;
        self.transitions += 1;
        self.static_friction.iter_mut().for_each(StaticFriction::clear);
    }

    /// Static friction with the forces of the attempted step; `None` without static friction or if the slider slips.
    fn sticking(&self) -> Option<(&StaticFriction, StickingForces)> {
        let of = self.static_friction.as_ref().filter(|_| self.mode == FrictionMode::Stick)?;
        let FrictionForces { along, across, tangent, .. } = self.forces;
        let [along, across] = [along / tangent, across / tangent];
        Some((of, StickingForces { along, across, duration: self.duration }))
    }
}

impl SliderContact {
    /// Mean friction force on the master in the last step [force], positive towards the end of the master; `None` without friction.
    pub fn friction_force(&self) -> Option<f64> {
        let friction = self.friction.as_deref()?;
        Some(if self.is_sliding() { friction.force } else { 0.0 })
    }

    pub fn active_friction(&self) -> Option<&SliderFriction> {
        self.friction.as_deref().filter(|_| self.is_sliding())
    }

    fn friction_in_step(&self) -> Option<&SliderFriction> {
        self.active_friction().filter(|friction| friction.acts())
    }

    pub(super) fn begin_friction(&mut self, bodies: &[Body], rates: &[f64], interval: Interval) {
        if self.active_friction().is_none() {
            return;
        }
        let (along, velocity) = (self.along(bodies), self.relative_velocity(bodies, rates));
        let slave = self.slave_velocity(bodies, rates);
        let master = &bodies[self.connection.master];
        let count = master.dynamics.control_points().len();
        let Some(friction) = &mut self.friction else { return };
        friction.start_velocity_along = along.dot(&velocity);
        friction.start_velocity_across = cross(along, velocity);
        friction.duration = interval.duration();
        friction.longest = friction.longest.max(interval.duration());
        friction.slave_velocity = slave;
        friction.master_velocities.clear();
        friction.master_velocities.extend((0..count).map(|at| master.vector_at(at, rates)));
    }

    pub(super) fn record_friction(&mut self, forces: Option<FrictionForces>) {
        if let (Some(friction), Some(forces)) = (&mut self.friction, forces) {
            friction.forces = forces;
        }
    }

    pub(super) fn dissipate(&mut self, increment: f64) {
        if self.friction_in_step().is_none() {
            return;
        }
        if let Some(friction) = &mut self.friction {
            self.lost_energy += increment * friction.forces.along;
            friction.force = friction.forces.along / friction.forces.tangent;
            friction.fixed_steps += usize::from(friction.fixed_force.is_some());
            let sticking = friction.sticking().map(|(_, step)| step);
            if let (Some(step), Some(of)) = (sticking, &mut friction.static_friction) {
                of.advance(step);
            }
        }
    }

    pub(super) fn count_friction_step(&mut self) {
        if let Some(friction) = &mut self.friction {
            friction.transitions = friction.transitions.saturating_sub(1);
        }
    }

    pub fn friction_transition(&self, unknowns: &[f64]) -> Option<FrictionTransition> {
        let friction = self.friction_in_step()?;
        let increment = self.read(unknowns).increment;
        let FrictionForces { along, across, end_velocity, .. } = friction.forces;
        match friction.mode {
            FrictionMode::Slip(sign) => {
                let is_against = sign * increment < 0.0;
                let reversed = -sign * end_velocity;
                let ends = friction.cuts_steps() && reversed > self.negligible_slip(friction);
                (is_against || ends).then_some(FrictionTransition::SlipEnds { reversed })
            }
            FrictionMode::Stick => {
                let excess = match friction.sticking() {
                    Some((of, step)) => of.excess(step),
                    None => (along.abs() > friction.coefficient * across.abs()).then_some(0.0),
                };
                let is_jammed = friction.transitions > 2 * MOST_TRANSITIONS;
                let excess = excess.filter(|_| !is_jammed)?;
                Some(FrictionTransition::SlipStarts { excess })
            }
        }
    }

    pub fn missed_slip_end(&self, unknowns: &[f64]) -> Option<f64> {
        let friction = self.friction_in_step()?;
        let FrictionMode::Slip(sign) = friction.mode else { return None };
        let (reversed, negligible) =
            (-sign * friction.forces.end_velocity, self.negligible_slip(friction));
        if sign * self.read(unknowns).increment < 0.0 {
            return Some(reversed.abs().max(negligible));
        }
        (reversed.abs() > negligible).then_some(reversed)
    }

    /// Friction limit minus the force along the master at the end of a step that was to end at the start of a slip [force].
    /// The result is `None` if the step ends at the start of the slip with sufficient accuracy.
    pub fn missed_slip_start(&self) -> Option<f64> {
        let (of, step) = self.friction_in_step()?.sticking()?;
        of.missed(step)
    }

    /// Friction limit minus the force along the master at the start of the step [force]; zero without static friction.
    pub fn sticking_reserve(&self) -> f64 {
        let friction = self.active_friction();
        friction.and_then(SliderFriction::sticking).map_or(0.0, |(of, _)| of.start_reserve())
    }

    /// Largest velocity along the master that counts as zero at the end of a slip [length/time].
    fn negligible_slip(&self, friction: &SliderFriction) -> f64 {
        STOPPED * friction.start_velocity_along.abs() + ROUNDING * self.size / friction.duration
    }

    /// Speed of the slip at the start of the step [length/time].
    pub fn slip_speed(&self) -> f64 {
        let friction = self.active_friction();
        friction.map_or(0.0, |friction| friction.mode_number() * friction.start_velocity_along)
    }

    /// Returns true if the velocity of the slider along the master is opposite to its slip.
    pub fn is_slip_reversed(&self, bodies: &[Body], rates: &[f64]) -> bool {
        let sign = self.active_friction().map_or(0.0, SliderFriction::mode_number);
        sign * self.along(bodies).dot(&self.relative_velocity(bodies, rates)) < 0.0
    }

    pub fn sticks(&self) -> bool {
        self.active_friction().is_some_and(|friction| friction.mode == FrictionMode::Stick)
    }

    pub fn slip_ratio(&self, sign: f64) -> f64 {
        let friction = self.active_friction();
        friction.map_or(0.0, |friction| sign * friction.mode_number() * friction.coefficient)
    }

    pub fn stick(&mut self) {
        if let Some(friction) = &mut self.friction {
            friction.change_mode(FrictionMode::Stick);
        }
    }

    pub fn slip(&mut self) {
        if let Some(friction) = &mut self.friction {
            friction.change_mode(FrictionMode::Slip(friction.forces.along.signum()));
        }
    }

    pub fn slip_if_overloaded(&mut self, along: f64, across: f64) -> bool {
        if !self.sticks() {
            return false;
        }
        let Some(friction) = &mut self.friction else { return false };
        // Sliders with static friction are excluded, because the search for events finds the starts of their slips.
        let is_overloaded =
            friction.static_friction.is_none() && along.abs() > friction.coefficient * across.abs();
        if is_overloaded {
            friction.set_mode_number(along.signum());
        }
        is_overloaded
    }

    /// Sets the mean friction force before the first step [force].
    pub fn start_friction_force(&mut self, force: f64) {
        self.friction.iter_mut().for_each(|friction| friction.force = force);
    }

    pub fn choose_friction_mode(&mut self, bodies: &[Body], rates: &[f64], negligible: f64) {
        if self.active_friction().is_none() {
            return;
        }
        let velocity = self.along(bodies).dot(&self.relative_velocity(bodies, rates));
        let number = if velocity.abs() > negligible { velocity.signum() } else { 0.0 };
        self.friction.iter_mut().for_each(|friction| friction.set_mode_number(number));
    }
}
