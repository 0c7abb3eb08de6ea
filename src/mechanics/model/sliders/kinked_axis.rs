//! The axis of a master as the contact force of a slider kinks it, beyond what the mesh of the master knows.

use std::sync::Arc;

use crate::geometry::{Passage, PiecewisePolynomial, Vec2};
use crate::joints::Kink;

/// Where the kink length is less than this part of the master, a contact force moves nothing.
const RIGID: f64 = 1e-14;

/// What a contact force does to the axis of its master: it moves the axis by `g p/GA` where it acts.
#[derive(Debug, Clone)]
pub struct KinkedAxis {
    /// The kink length `g(ξ)` of the mesh of the master [length].
    length: Arc<PiecewisePolynomial>,
    /// `1/GA` of the master [1/force].
    compliance: f64,
    /// A kink length that is none [length].
    none: f64,
    /// `g`, its first and its second derivative by `ξ` where the slider is [length].
    here: [f64; 3],
    /// The contact force `p` on the master at present [force].
    pub force: Vec2,
}

impl KinkedAxis {
    /// The axis of a master of such a length as drawn and shear stiffness, without a contact force.
    pub fn new(kink_length: Arc<PiecewisePolynomial>, length: f64, shear_stiffness: f64) -> Self {
        Self {
            length: kink_length,
            compliance: 1.0 / shear_stiffness,
            none: RIGID * length,
            here: [0.0; 3],
            force: Vec2::zeros(),
        }
    }

    /// The kink of the axis of the master in a step in which the slave moves along a passage.
    pub fn along(&self, passage: &Passage) -> Kink {
        Kink { along: passage.along(&self.length), compliance: self.compliance, before: self.force }
    }

    /// Looks at the place where the passage ends.
    pub fn arrive(&mut self, passage: &Passage) {
        self.here = passage.at_end(&self.length);
    }

    /// Takes the contact force `p1 = 2 λ - p0` at the end of a step, at which the axis has [arrived](Self::arrive); where the axis does not
    /// give way, nothing tells it from the mean `λ` of the step [force].
    pub fn advance(&mut self, mean: Vec2) {
        self.force = if self.gives() { mean * 2.0 - self.force } else { mean };
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
        let across = self.force - along(self.force);
        let pull = 0.5 * self.here[1] * self.compliance * across.norm_squared();
        self.force = across - tangent * (pull / tangent.norm_squared());
    }

    /// Whether a contact force moves the axis where the slider is.
    pub fn gives(&self) -> bool {
        self.here[0] > self.none
    }

    /// How far the axis is moved, `g p/GA` [length].
    pub fn offset(&self) -> Vec2 {
        self.force * (self.here[0] * self.compliance)
    }

    /// The derivative of [`offset`](Self::offset) by `ξ`, and half its second one along itself, `½ g g'' |p|²/GA²`.
    pub fn slopes(&self) -> (Vec2, f64) {
        let [length, slope, bend] = self.here;
        let force = self.force * self.compliance;
        (force * slope, 0.5 * length * bend * force.norm_squared())
    }

    /// The compliance `g/GA` [length/force], the derivative of [`offset`](Self::offset) by `ξ` [length], and the second one of the energy for a
    /// given force, `½ g'' |p|²/GA` [energy].
    pub fn at_rest(&self) -> (f64, Vec2, f64) {
        let [length, slope, bend] = self.here;
        let force = self.force * self.compliance;
        let compliance = if self.gives() { length * self.compliance } else { 0.0 };
        (compliance, force * slope, 0.5 * bend * force.dot(&self.force))
    }

    /// The energy of the kink, `½ g |p|²/GA` [energy].
    pub fn energy(&self) -> f64 {
        0.5 * self.force.dot(&self.offset())
    }
}
