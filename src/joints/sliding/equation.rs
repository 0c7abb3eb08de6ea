//! One equation of a contact, with its derivatives.

use super::ContactUnknowns;
use crate::geometry::Vec2;

/// What the value of an equation is measured in.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Unit {
    /// A distance.
    Length,
    /// A force.
    Force,
}

/// `value = 0`, and how the value changes with what moves.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Equation {
    /// What should vanish.
    pub value: f64,
    /// What it is measured in.
    pub unit: Unit,
    /// Its derivative by the movement of the slave.
    pub by_slave: Vec2,
    /// Its derivative by the movement of control point `i` of the master is `B_i(ξ1)` times this,
    pub by_end: Vec2,
    /// plus `B̄_i` times this,
    pub by_mean: Vec2,
    /// plus `D_i` times this.
    pub by_difference: Vec2,
    /// Its derivatives by `λ`, `η` and `Δξ`.
    pub by_unknowns: ContactUnknowns,
}

impl Equation {
    /// An equation that depends on nothing yet.
    pub(super) fn new(value: f64, unit: Unit) -> Self {
        Self {
            value,
            unit,
            by_slave: Vec2::zeros(),
            by_end: Vec2::zeros(),
            by_mean: Vec2::zeros(),
            by_difference: Vec2::zeros(),
            by_unknowns: ContactUnknowns::zeros(),
        }
    }

    /// The derivative by a control point of the master with these `B_i(ξ1)`, `B̄_i` and `D_i`.
    pub fn by_master(&self, (end, mean, difference): (f64, f64, f64)) -> Vec2 {
        self.by_end * end + self.by_mean * mean + self.by_difference * difference
    }
}
