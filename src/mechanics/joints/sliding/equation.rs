//! One equation of a contact, with its derivatives.

use super::ContactUnknowns;
use crate::geometry::Vec2;

/// The unit in which the value of an equation of a contact is measured.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Unit {
    /// The equation says that a distance vanishes [length].
    Length,
    /// The equation says that a force vanishes [force].
    Force,
}

/// An equation `value = 0` of a sliding contact, and how the value changes with what moves.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Equation {
    /// The value of the equation, which should vanish, in the equation's unit.
    pub value: f64,
    /// The unit of the value of the equation.
    pub unit: Unit,
    /// The derivative of the value by the movement of the slave.
    pub by_slave: Vec2,
    /// The part of the value's derivative by the movement of control point `i` of the master that `B_i(ξ1)` multiplies.
    pub by_end: Vec2,
    /// The part of the value's derivative by the movement of control point `i` of the master that `B̄_i` multiplies.
    pub by_mean: Vec2,
    /// The part of the value's derivative by the movement of control point `i` of the master that `D_i` multiplies.
    pub by_difference: Vec2,
    /// The derivatives of the value by the contact's unknowns `λ`, `η` and `Δξ`.
    pub by_unknowns: ContactUnknowns,
}

impl Equation {
    /// An equation `value = 0` that depends on nothing yet.
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

    /// The derivative of the value by the movement of a control point of the master with these `B_i(ξ1)`, `B̄_i` and `D_i`.
    pub fn by_master(&self, (end, mean, difference): (f64, f64, f64)) -> Vec2 {
        self.by_end * end + self.by_mean * mean + self.by_difference * difference
    }
}
