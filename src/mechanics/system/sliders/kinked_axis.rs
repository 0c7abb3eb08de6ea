//! Kink of the axis of a master at its slider: jump of the tangent under the contact force. The mesh of the master does not represent the kink.

use std::sync::Arc;

use crate::beams::Section;
use crate::geometry::{ContactPath, PiecewisePolynomial, Vec2};
use crate::joints::{Kink, KinkMotion, KinkState};

/// Largest kink length at which the axis counts as rigid at the slider, as a fraction of the length of the master.
/// The kink length is the displacement of the axis at the slider, divided by the ratio of contact force to shear stiffness.
const RIGID: f64 = 1e-14;

/// First upper limit of the speed of a slider whose kink follows the contact force, as a fraction of the speed of shear waves.
/// Above this limit, the kink is kept constant. Near the speed of shear waves, the stiffness of a moving kink is nearly zero.
const FASTEST: f64 = 0.8;

/// Second upper limit of the speed of a slider whose kink follows the contact force, as a fraction of the critical speed of the kink.
/// At the critical speed, the stiffness of the kink is zero. The critical speed is the shear wave speed divided by the square root of [`MasterKink::inertia`].
const FASTEST_ON_MESH: f64 = 0.9;

/// Smallest kink length at which a kink varies with the contact force, as a fraction of the largest kink length in the middle of the master.
/// Near the ends of a master, the kink length is smaller, and kinks are therefore kept constant.
const BESIDE_END: f64 = 0.1;

/// Upper limit of the speed of a slider whose new kink starts with the jump that the contact force causes.
/// It is a fraction of the smaller of the two limits set by [`FASTEST`] and [`FASTEST_ON_MESH`].
/// At and above this limit, a new kink starts without a jump.
const SLOW: f64 = 0.25;

/// Smallest kink length at which a kink that moves away from an end varies, as a fraction of the limit set by [`BESIDE_END`].
/// Below this kink length, rounding errors of positions would determine the kink, which is therefore kept constant.
const FROM_END: f64 = 0.01;

/// Largest contact force that determines a new kink, as a fraction of `GA` [-]. Larger forces are due to vibrations that the steps do not resolve.
const LARGEST_START: f64 = 0.02;

#[derive(Debug, Clone)]
pub struct MasterKink {
    pub length: Arc<PiecewisePolynomial>,
    pub arc: Arc<PiecewisePolynomial>,
    /// Correction factor of the kinetic energy of a moving kink [-].
    pub inertia: f64,
}

/// Kink of the axis of a master: jump of its tangent under the contact force. The kink displaces the axis at the slider.
/// The kink length is this displacement, divided by the ratio of contact force to shear stiffness.
#[derive(Debug, Clone)]
pub struct KinkedAxis {
    length: Arc<PiecewisePolynomial>,
    arc: Arc<PiecewisePolynomial>,
    compliance: f64,
    inverse_square_speed: f64,
    /// Upper limit of the slider speed [length/time]. Above this limit, the kink is kept constant instead of varying with the contact force.
    fastest: f64,
    /// Kink length up to which the axis counts as rigid [length].
    none: f64,
    /// Kink length below which the kink is kept constant instead of varying with the contact force [length].
    least: f64,
    is_frozen: bool,
    compliance_derivatives: [f64; 3],
    stretch: f64,
    duration: f64,
    jump: Vec2,
    speed: f64,
}

impl KinkedAxis {
    pub fn new(kink: MasterKink, length: f64, section: &Section) -> Self {
        let compliance = 1.0 / section.shear_stiffness;
        Self {
            arc: kink.arc,
            compliance,
            inverse_square_speed: kink.inertia * section.mass_per_length * compliance,
            fastest: FASTEST.min(FASTEST_ON_MESH / kink.inertia.sqrt())
                / (section.mass_per_length * compliance).sqrt(),
            none: RIGID * length,
            least: BESIDE_END * kink.length.largest_in_middle(),
            is_frozen: false,
            length: kink.length,
            compliance_derivatives: [0.0; 3],
            stretch: 0.0,
            duration: f64::INFINITY,
            jump: Vec2::zeros(),
            speed: 0.0,
        }
    }

    pub fn begin_step(&mut self, duration: f64, rate: f64) {
        self.duration = duration;
        if !self.is_heavy() {
            self.speed = self.stretch * rate;
        }
    }

    pub fn fastest(&self) -> f64 {
        self.fastest
    }

    /// Returns true if the kink is kept constant: close to an end, at speeds close to the speed of shear waves, or after a call of `freeze`.
    pub fn is_frozen(&self) -> bool {
        let [length, slope, _] = self.compliance_derivatives;
        let leaves =
            slope * self.speed > 0.0 && self.jump != Vec2::zeros() && self.is_slow(self.speed);
        let least = if leaves { FROM_END * self.least } else { self.least };
        self.is_frozen || length < least || self.speed.abs() > self.fastest
    }

    /// Returns true if a new kink may be initialised with the contact force at the given speed along the master [length/time].
    /// For faster sliders, the contact force is due to waves that the time steps do not resolve.
    pub fn is_slow(&self, speed: f64) -> bool {
        speed.abs() < SLOW * self.fastest
    }

    /// Converts the rate of the parameter of the master to a speed along the master [length/time].
    pub fn speed_of(&self, rate: f64) -> f64 {
        self.stretch * rate
    }

    pub fn freeze(&mut self) -> bool {
        let changes = !self.is_frozen();
        self.is_frozen = true;
        changes
    }

    pub fn unfreeze(&mut self) {
        self.is_frozen = false;
    }

    fn is_heavy(&self) -> bool {
        self.is_compliant() && self.jump != Vec2::zeros()
    }

    pub fn along(&self, passage: &ContactPath) -> Kink {
        let motion = KinkMotion {
            arc: passage.along(&self.arc),
            speed: self.speed,
            inverse_square_speed: self.inverse_square_speed,
            duration: self.duration,
        };
        let along = passage.along(&self.length);
        Kink { along, compliance: self.compliance, before: self.jump, motion }
    }

    pub fn accept_end(&mut self, passage: &ContactPath) {
        self.compliance_derivatives = passage.at_end(&self.length);
        self.stretch = passage.at_end(&self.arc)[1];
    }

    pub fn advance(&mut self, mean: Vec2, KinkState { jump, speed }: KinkState) {
        self.jump = if self.is_compliant() { jump } else { mean };
        self.speed = speed;
    }

    /// Sets the state of the kink at the end of a step in which the kink was kept constant.
    pub fn accept_frozen_jump(&mut self, KinkState { jump, speed }: KinkState) {
        (self.jump, self.speed) = (jump, speed);
    }

    /// Sets the kink to the state in which it is in equilibrium with a constant contact force [force].
    pub fn set_static_kink(&mut self, force: Vec2) {
        (self.jump, self.speed) = (force, 0.0);
    }

    pub fn straighten(&mut self) {
        self.set_static_kink(Vec2::zeros());
    }

    /// Numbers that `restore` reads: the components of the jump of the kink, and the speed of the kink.
    pub fn numbers(&self) -> [f64; 3] {
        [self.jump.x, self.jump.y, self.speed]
    }

    pub fn restore(&mut self, [x, y, speed]: [f64; 3]) {
        (self.jump, self.speed) = (Vec2::new(x, y), speed);
    }

    /// Contact force on the master, determined from the kink [force].
    pub fn force(&self) -> Vec2 {
        self.jump * (1.0 - self.inverse_square_speed * self.speed * self.speed)
    }

    /// Removes the component along the tangent of the axis, which is the force of a stop, from the contact force.
    ///
    /// If the axis is compliant, the contact force is not changed, because the displacement of the axis determines it.
    pub fn remove_stop_force(&mut self, tangent: Vec2) {
        if !self.is_compliant() {
            self.keep_force_across(tangent);
        }
    }

    /// Initialises the kink with the jump that the component of `force` [force] normal to `tangent` [length] causes.
    /// If the force is too large, the kink starts without load.
    pub fn load(&mut self, force: Vec2, tangent: Vec2) {
        let is_small = force.norm() * self.compliance < LARGEST_START;
        self.jump = if is_small { force } else { Vec2::zeros() };
        self.keep_force_across(tangent);
    }

    /// Computes the speed of the kink along the master from the rate of the parameter of the master [1/time].
    pub fn start_speed(&mut self, rate: f64) {
        self.speed = self.stretch * rate;
    }

    fn keep_force_across(&mut self, tangent: Vec2) {
        let along = |force: Vec2| tangent * (force.dot(&tangent) / tangent.norm_squared());
        let across = self.jump - along(self.jump);
        let pull = 0.5 * self.compliance_derivatives[1] * self.compliance * across.norm_squared();
        self.jump = across - tangent * (pull / tangent.norm_squared());
    }

    pub fn is_compliant(&self) -> bool {
        self.compliance_derivatives[0] > self.none
    }

    /// Displacement of the axis due to the kink [length].
    pub fn offset(&self) -> Vec2 {
        self.jump * (self.compliance_derivatives[0] * self.compliance)
    }

    /// Derivative of the displacement [`offset`](Self::offset) with respect to the parameter of the master [length].
    /// The second returned value is half the product of the displacement and its second derivative [length²].
    pub fn slopes(&self) -> (Vec2, f64) {
        let [length, slope, bend] = self.compliance_derivatives;
        let force = self.jump * self.compliance;
        (force * slope, 0.5 * length * bend * force.norm_squared())
    }

    pub fn static_compliance(&self) -> (f64, Vec2, f64) {
        let [length, slope, bend] = self.compliance_derivatives;
        let force = self.jump * self.compliance;
        let compliance = if self.is_compliant() { length * self.compliance } else { 0.0 };
        (compliance, force * slope, 0.5 * bend * force.dot(&self.jump))
    }

    pub fn energy(&self) -> f64 {
        0.5 * self.jump.dot(&self.offset())
    }

    pub fn kinetic_energy(&self) -> f64 {
        self.inverse_square_speed * self.speed * self.speed * self.energy()
    }
}
