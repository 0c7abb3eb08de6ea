//! The axis of a master as the contact force of a slider kinks it, beyond what the mesh of the master knows.

use std::sync::Arc;

use crate::beams::Section;
use crate::geometry::{ContactPath, PiecewisePolynomial, Vec2};
use crate::joints::{Kink, KinkMotion, KinkState};

/// Where the kink length is less than this part of the master, a contact force moves nothing.
const RIGID: f64 = 1e-14;

/// The largest part of the speed of shear waves with which a kink follows its force: beyond, little of its stiffness `GA - ρA v²` is left.
const FASTEST: f64 = 0.8;

/// The largest part of the speed `√(GA/μρA)`, at which nothing is left of that stiffness on the mesh of the master.
const FASTEST_ON_MESH: f64 = 0.9;

/// Where the kink length is less than this part of what it is inside a mesh, beside an end, the kink no longer follows its force.
const BESIDE_END: f64 = 0.1;

/// What the mesh of a master misses of the kink that a contact force makes, for all sliders on it.
#[derive(Debug, Clone)]
pub struct MasterKink {
    /// The kink length `g(ξ)` [length].
    pub length: Arc<PiecewisePolynomial>,
    /// The arc length `s(ξ)` [length].
    pub arc: Arc<PiecewisePolynomial>,
    /// How much heavier the kink is on its way than its length tells, `μ` [-].
    pub inertia: f64,
}

/// What a contact force does to the axis of its master: it moves the axis by `g p/GA` where it acts.
#[derive(Debug, Clone)]
pub struct KinkedAxis {
    /// The kink length `g(ξ)` of the mesh of the master [length].
    length: Arc<PiecewisePolynomial>,
    /// The arc length `s(ξ)` of the master [length].
    arc: Arc<PiecewisePolynomial>,
    /// `1/GA` of the master [1/force].
    compliance: f64,
    /// `μ ρA/GA` of the master [time²/length²].
    slowness: f64,
    /// The speed up to which the kink follows its force [length/time].
    fastest: f64,
    /// A kink length that is none [length].
    none: f64,
    /// The kink length from which on the kink follows its force [length].
    least: f64,
    /// Whether the kink stays as it is in the present step for want of another solution.
    is_kept: bool,
    /// `g`, its first and its second derivative by `ξ` where the slider is [length].
    here: [f64; 3],
    /// The length of the master for a unit of ξ where the slider is [length].
    stretch: f64,
    /// The duration of the step [time].
    duration: f64,
    /// The jump of the tangent of the master where the slider is, as the force `p = GA a` that makes it where the kink does not move [force].
    jump: Vec2,
    /// The speed `v` of the kink along the master [length/time].
    speed: f64,
}

impl KinkedAxis {
    /// The axis of a master of such a length as drawn, without a contact force, by what its mesh misses and by its section.
    pub fn new(kink: MasterKink, length: f64, section: &Section) -> Self {
        let compliance = 1.0 / section.shear_stiffness;
        Self {
            arc: kink.arc,
            compliance,
            slowness: kink.inertia * section.mass_per_length * compliance,
            fastest: FASTEST.min(FASTEST_ON_MESH / kink.inertia.sqrt())
                / (section.mass_per_length * compliance).sqrt(),
            none: RIGID * length,
            least: BESIDE_END * kink.length.largest_in_middle(),
            is_kept: false,
            length: kink.length,
            here: [0.0; 3],
            stretch: 0.0,
            duration: f64::INFINITY,
            jump: Vec2::zeros(),
            speed: 0.0,
        }
    }

    /// Begins a step of such a duration [time], in which a kink without a mass has such a rate `dξ/dt` [1/time].
    pub fn begin_step(&mut self, duration: f64, rate: f64) {
        self.duration = duration;
        if !self.is_heavy() {
            self.speed = self.stretch * rate;
        }
    }

    /// The speed along the master up to which the kink follows its force [length/time].
    pub fn fastest(&self) -> f64 {
        self.fastest
    }

    /// Whether the kink stays as it is, whatever the contact force: beside an end, where it is nearly as fast as shear waves, and where it is kept.
    pub fn is_frozen(&self) -> bool {
        self.is_kept || self.here[0] < self.least || self.speed.abs() > self.fastest
    }

    /// Keeps the kink as it is in steps to come; gives whether that is another law for the next step.
    pub fn keep(&mut self) -> bool {
        let changes = !self.is_frozen();
        self.is_kept = true;
        changes
    }

    /// Lets the kink follow its force again.
    pub fn follow(&mut self) {
        self.is_kept = false;
    }

    /// Whether the kink has a mass, and with it a speed of its own.
    fn is_heavy(&self) -> bool {
        self.gives() && self.jump != Vec2::zeros()
    }

    /// The kink of the axis of the master in a step in which the slave moves along a passage.
    pub fn along(&self, passage: &ContactPath) -> Kink {
        let motion = KinkMotion {
            arc: passage.along(&self.arc),
            speed: self.speed,
            slowness: self.slowness,
            duration: self.duration,
        };
        let along = passage.along(&self.length);
        Kink { along, compliance: self.compliance, before: self.jump, motion }
    }

    /// Looks at the place where the passage ends.
    pub fn arrive(&mut self, passage: &ContactPath) {
        self.here = passage.at_end(&self.length);
        self.stretch = passage.at_end(&self.arc)[1];
    }

    /// Takes jump, as a force [force], and speed [length/time] at the end of a step with such a mean contact force `λ` [force], at which the axis has
    /// [arrived](Self::arrive); where the axis does not give way, nothing tells the force from the mean of the step.
    pub fn advance(&mut self, mean: Vec2, KinkState { jump, speed }: KinkState) {
        self.jump = if self.gives() { jump } else { mean };
        self.speed = speed;
    }

    /// Takes jump, as a force [force], and speed [length/time] at the end of a step in which the kink stayed as it was.
    pub fn turn(&mut self, KinkState { jump, speed }: KinkState) {
        (self.jump, self.speed) = (jump, speed);
    }

    /// Lets the axis be kinked by a force at rest [force].
    pub fn rest_under(&mut self, force: Vec2) {
        (self.jump, self.speed) = (force, 0.0);
    }

    /// Takes the kink away.
    pub fn straighten(&mut self) {
        self.rest_under(Vec2::zeros());
    }

    /// The state of the kink in numbers: its jump and its speed.
    pub fn numbers(&self) -> [f64; 3] {
        [self.jump.x, self.jump.y, self.speed]
    }

    /// Takes the state of the kink back from its numbers.
    pub fn take(&mut self, [x, y, speed]: [f64; 3]) {
        (self.jump, self.speed) = (Vec2::new(x, y), speed);
    }

    /// The contact force `λ = (GA - ρA v²) a` on the master [force].
    pub fn force(&self) -> Vec2 {
        self.jump * (1.0 - self.slowness * self.speed * self.speed)
    }

    /// Takes from the contact force what was that of a stop, along the tangent `x'` of the axis [length]: what is left has `p·x' + ½ g' |p|²/GA = 0`,
    /// but for the third power of `p`.
    ///
    /// Beside the end by rounding, where the axis gives way, the force is not touched: it is a matter of places there.
    pub fn leave_stop(&mut self, tangent: Vec2) {
        if self.gives() {
            return;
        }
        let along = |force: Vec2| tangent * (force.dot(&tangent) / tangent.norm_squared());
        let across = self.jump - along(self.jump);
        let pull = 0.5 * self.here[1] * self.compliance * across.norm_squared();
        self.jump = across - tangent * (pull / tangent.norm_squared());
    }

    /// Whether a contact force moves the axis where the slider is.
    pub fn gives(&self) -> bool {
        self.here[0] > self.none
    }

    /// How far the axis is moved, `g p/GA` [length].
    pub fn offset(&self) -> Vec2 {
        self.jump * (self.here[0] * self.compliance)
    }

    /// The derivative of [`offset`](Self::offset) by `ξ`, and half its second one along itself, `½ g g'' |p|²/GA²`.
    pub fn slopes(&self) -> (Vec2, f64) {
        let [length, slope, bend] = self.here;
        let force = self.jump * self.compliance;
        (force * slope, 0.5 * length * bend * force.norm_squared())
    }

    /// The compliance `g/GA` [length/force], the derivative of [`offset`](Self::offset) by `ξ` [length], and the second one of the energy for a
    /// given force, `½ g'' |p|²/GA` [energy].
    pub fn at_rest(&self) -> (f64, Vec2, f64) {
        let [length, slope, bend] = self.here;
        let force = self.jump * self.compliance;
        let compliance = if self.gives() { length * self.compliance } else { 0.0 };
        (compliance, force * slope, 0.5 * bend * force.dot(&self.jump))
    }

    /// The energy of the kink, `½ g |p|²/GA` [energy].
    pub fn energy(&self) -> f64 {
        0.5 * self.jump.dot(&self.offset())
    }

    /// The kinetic energy of the kink on its way, `½ ρA g |a|² v²` [energy].
    pub fn kinetic_energy(&self) -> f64 {
        self.slowness * self.speed * self.speed * self.energy()
    }
}
