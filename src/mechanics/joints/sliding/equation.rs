//! Equation of a sliding contact, with its derivatives.

use super::ContactUnknowns;
use crate::geometry::Vec2;

/// Unit of the value of a contact equation.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Unit {
    /// Unit of a length.
    Length,
    /// Unit of a force.
    Force,
}

/// Equation `value = 0` of a sliding contact, with its derivatives.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Equation {
    /// Value of the left-hand side in the unit of the equation.
    pub value: f64,
    /// Unit of the value.
    pub unit: Unit,
    /// Derivative of the value with respect to the displacement of the slave in the step [unit of the equation/length].
    pub by_slave: Vec2,
    /// Derivative of the value with respect to the end position of the slave on the master [unit of the equation/length].
    pub by_end: Vec2,
    /// Derivative of the value with respect to the mean position of the slave on the master [unit of the equation/length].
    pub by_mean: Vec2,
    /// Derivative of the value with respect to the mean tangent of the master [unit of the equation/length].
    pub by_difference: Vec2,
    /// Derivatives of the value with respect to the contact force, the couple and the sliding increment.
    pub by_unknowns: ContactUnknowns,
}

impl Equation {
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

    /// Derivative of the value with respect to the displacement of a control point of the master in the step.
    /// The argument `(end, mean, difference)` contains the weights of the control point in the order of `Contact::weights`.
    pub fn by_master(&self, (end, mean, difference): (f64, f64, f64)) -> Vec2 {
        self.by_end * end + self.by_mean * mean + self.by_difference * difference
    }
}
