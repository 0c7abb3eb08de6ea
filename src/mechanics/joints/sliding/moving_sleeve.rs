//! Law of a sleeve without length in a step: the axis of the master passes through the slave, and its section turns with the slave.
//!
//! Derivation: docs/theory.md, section 14.2.

use super::contact::AXES;
use super::{CONTACT_UNKNOWNS, Conserving, Contact, Equation, SlidingLaw, Unit};
use crate::elementary::{square, tan};
use crate::geometry::{cross, perpendicular};

/// Largest magnitude of `x` for which `tan(x)/x` is computed from its power series [rad].
const SMALL: f64 = 0.02;

/// Rotations of a sleeve and of its master in a step.
/// An array of two numbers contains a value and its derivative with respect to the parameter of the master at the end of the path.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SleeveTurn {
    /// Factor `σ` in the relation `Δω = tan(σ Δθ)/σ` between rotation increments and angles; zero if they are equal [-].
    pub tangent_factor: f64,
    /// Rotation increment of the slave [rad].
    pub own: f64,
    /// Rotation increment of the master at the end of the path [rad].
    pub end: [f64; 2],
    /// Mean derivative of the rotation increment of the master over the path [rad].
    pub twist: [f64; 2],
    /// Mean derivative over the path of the angle that the master has at the start of the step [rad].
    pub bend: [f64; 2],
}

/// Derivatives of the equations of a sleeve with respect to rotation increments.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct RotationSlopes {
    /// Derivatives with respect to the rotation increment of the slave.
    pub by_slave: [f64; CONTACT_UNKNOWNS],
    /// Derivatives with respect to the rotation increment of the master at the end of the path.
    pub by_end: [f64; CONTACT_UNKNOWNS],
    /// Derivatives with respect to the mean derivative of the rotation increment over the path.
    pub by_twist: [f64; CONTACT_UNKNOWNS],
}

/// Law of a sleeve in a step. Energy, linear and angular momentum are conserved for any step size.
///
/// The unknown `couple.x` is the couple of the sleeve on the master.
/// The unknown `couple.y` is the moment on the slave that balances the moment of the contact forces.
/// Both are divided by [`Contact::length`].
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum MovingSleeve {
    /// The sleeve slides along its master without friction.
    Sliding,
    /// The sleeve is held at its place on the master.
    Held,
}

/// Increment of rotation by sliding, divided by the change of the angle along the path, with its derivatives.
struct SlidRatio {
    value: f64,
    by_own: f64,
    by_end: f64,
    by_increment: f64,
}

impl SleeveTurn {
    /// Derivative of the angle of the master at the end of a step in which the sleeve does not slide [rad].
    pub(super) fn end_slope(&self) -> f64 {
        self.bend[0] + self.twist[0]
    }

    fn ratio(&self, increment: f64) -> SlidRatio {
        let Self {
            own,
            end: [end, end_slope],
            bend: [bend, bend_slope],
            tangent_factor: factor,
            ..
        } = *self;
        let [ratio, slope] = tangent_ratio(factor * increment * bend);
        let square = square(factor);
        let product = 1.0 + square * own * end;
        let (by_own, by_end) = (square * end * ratio, square * own * ratio);
        let by_angle = factor * slope * product * (bend + increment * bend_slope);
        SlidRatio {
            value: ratio * product,
            by_own,
            by_end,
            by_increment: by_angle + by_end * end_slope,
        }
    }
}

/// Value and derivative of `tan(x)/x`.
fn tangent_ratio(x: f64) -> [f64; 2] {
    let y = square(x);
    if x.abs() < SMALL {
        let value = 1.0 + y * (1.0 / 3.0 + y * (2.0 / 15.0 + y * (17.0 / 315.0)));
        let slope = x * (2.0 / 3.0 + y * (8.0 / 15.0 + y * (34.0 / 105.0)));
        return [value, slope];
    }
    let tangent = tan(x);
    [tangent / x, (1.0 + square(tangent)) / x - tangent / y]
}

impl MovingSleeve {
    /// Derivatives of the equations with respect to rotation increments; `None` for a contact without a sleeve.
    pub fn rotation_slopes(self, contact: &Contact<'_>) -> Option<RotationSlopes> {
        let turn = contact.sleeve.as_ref()?;
        let (length, unknowns) = (contact.length, contact.unknowns);
        let (ratio, [bend, _]) = (turn.ratio(unknowns.increment), turn.bend);
        let slid = unknowns.increment * bend;
        let couple = if self == Self::Sliding { unknowns.couple.x } else { 0.0 };
        let swing = contact.tangent_change().value;
        let swing = if self == Self::Sliding { cross(swing, unknowns.force) / length } else { 0.0 };
        let rows = |angle: f64, along: f64| [0.0, 0.0, length * angle, 0.0, along];
        Some(RotationSlopes {
            by_slave: rows(1.0 - slid * ratio.by_own, couple * bend * ratio.by_own - swing),
            by_end: rows(-1.0 - slid * ratio.by_end, couple * bend * ratio.by_end),
            by_twist: rows(0.0, 0.5 * couple),
        })
    }
}

impl SlidingLaw for MovingSleeve {
    fn equations(&self, contact: &Contact<'_>) -> [Equation; CONTACT_UNKNOWNS] {
        let Some(turn) = &contact.sleeve else { return Conserving.equations(contact) };
        let [gap_x, gap_y] = contact.closed();
        let ratio = turn.ratio(contact.unknowns.increment);
        let along = match self {
            Self::Sliding => work_free(contact, turn, &ratio),
            Self::Held => contact.no_increment(),
        };
        [gap_x, gap_y, turned(contact, turn, &ratio), balanced_moment(contact), along]
    }
}

/// Equation of equal rotations of the sleeve and of the master where the sleeve is.
fn turned(contact: &Contact<'_>, turn: &SleeveTurn, ratio: &SlidRatio) -> Equation {
    let (length, increment) = (contact.length, contact.unknowns.increment);
    let SleeveTurn { own, end: [end, end_slope], bend: [bend, bend_slope], .. } = *turn;
    let slid = increment * bend * ratio.value;
    let by_increment =
        (bend + increment * bend_slope) * ratio.value + increment * bend * ratio.by_increment;
    let mut equation = Equation::new(length * (own - end - slid), Unit::Length);
    equation.by_unknowns.increment = -length * (end_slope + by_increment);
    equation
}

/// Equation of the moment on the slave: the contact forces have no moment in a step.
fn balanced_moment(contact: &Contact<'_>) -> Equation {
    let (scale, swing) = (1.0 / contact.length, contact.tangent_change());
    let (force, increment) = (contact.unknowns.force, contact.unknowns.increment);
    let moment = cross(swing.value, force);
    let value = contact.unknowns.couple.y + increment * moment * scale;
    let mut equation = Equation::new(value, Unit::Force);
    equation.by_difference = perpendicular(force) * (-0.25 * increment * scale);
    equation.by_unknowns.force = perpendicular(swing.value) * (increment * scale);
    equation.by_unknowns.couple = AXES[1];
    equation.by_unknowns.increment = (moment + increment * cross(swing.by_end, force)) * scale;
    equation
}

/// Sliding equation: the contact force and both moments together do no work.
fn work_free(contact: &Contact<'_>, turn: &SleeveTurn, ratio: &SlidRatio) -> Equation {
    let (scale, swing) = (1.0 / contact.length, contact.tangent_change());
    let (force, couple) = (contact.unknowns.force, contact.unknowns.couple.x);
    let SleeveTurn { own, twist: [twist, twist_slope], bend: [bend, bend_slope], .. } = *turn;
    let curvature = 0.5 * twist + bend * ratio.value;
    let change = 0.5 * twist_slope + bend_slope * ratio.value + bend * ratio.by_increment;
    let mut equation = contact.frictionless(contact.tangent());
    equation.value += couple * curvature - own * cross(swing.value, force) * scale;
    equation.by_difference = (force * 0.5 + perpendicular(force) * (0.25 * own)) * scale;
    equation.by_unknowns.force -= perpendicular(swing.value) * (own * scale);
    equation.by_unknowns.couple.x = curvature;
    equation.by_unknowns.increment += couple * change - own * cross(swing.by_end, force) * scale;
    equation
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn tangent_ratio_is_continuous_where_its_power_series_ends() {
        let [before, after] = [SMALL * (1.0 - 1e-9), SMALL].map(tangent_ratio);
        assert!((before[0] - after[0]).abs() < 1e-10);
        assert!((before[1] / after[1] - 1.0).abs() < 1e-8);
    }
}
