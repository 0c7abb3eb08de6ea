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
pub struct SleeveRotations {
    /// Factor `σ` in the relation `Δω = tan(σ Δθ)/σ` between rotation increments and angles; zero if they are equal [-].
    pub tangent_factor: f64,
    /// Rotation increment of the slave [rad].
    pub slave: f64,
    /// Rotation increment of the master at the end of the path [rad].
    pub master: [f64; 2],
    /// Mean derivative of the rotation increment of the master over the path [rad].
    pub increment_slope: [f64; 2],
    /// Mean derivative over the path of the angle that the master has at the start of the step [rad].
    pub angle_slope: [f64; 2],
}

/// Derivatives of the equations of a sleeve with respect to rotation increments.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct RotationSlopes {
    /// Derivatives with respect to the rotation increment of the slave.
    pub by_slave: [f64; CONTACT_UNKNOWNS],
    /// Derivatives with respect to the rotation increment of the master at the end of the path.
    pub by_end: [f64; CONTACT_UNKNOWNS],
    /// Derivatives with respect to the mean derivative of the rotation increment over the path.
    pub by_increment_slope: [f64; CONTACT_UNKNOWNS],
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

/// Rotation increment due to sliding, divided by the change of the angle along the path, with its derivatives.
struct SlidingRatio {
    value: f64,
    by_slave: f64,
    by_master: f64,
    by_increment: f64,
}

impl SleeveRotations {
    /// Derivative of the angle of the master at the end of a step in which the sleeve does not slide [rad].
    pub(super) fn end_slope(&self) -> f64 {
        self.angle_slope[0] + self.increment_slope[0]
    }

    fn ratio(&self, increment: f64) -> SlidingRatio {
        let Self { slave, master: [master, master_slope], tangent_factor: factor, .. } = *self;
        let [angle_slope, angle_bend] = self.angle_slope;
        let [ratio, slope] = tangent_ratio(factor * increment * angle_slope);
        let square = square(factor);
        let product = 1.0 + square * slave * master;
        let (by_slave, by_master) = (square * master * ratio, square * slave * ratio);
        let by_angle = factor * slope * product * (angle_slope + increment * angle_bend);
        let by_increment = by_angle + by_master * master_slope;
        SlidingRatio { value: ratio * product, by_slave, by_master, by_increment }
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
        let rotations = contact.sleeve.as_ref()?;
        let (length, unknowns) = (contact.length, contact.unknowns);
        let (ratio, [slope, _]) = (rotations.ratio(unknowns.increment), rotations.angle_slope);
        let slid = unknowns.increment * slope;
        let (couple, moment) = match self {
            Self::Sliding => {
                let change = contact.tangent_change().value;
                (unknowns.couple.x, cross(change, unknowns.force) / length)
            }
            Self::Held => (0.0, 0.0),
        };
        let rows = |angle: f64, along: f64| [0.0, 0.0, length * angle, 0.0, along];
        Some(RotationSlopes {
            by_slave: rows(1.0 - slid * ratio.by_slave, couple * slope * ratio.by_slave - moment),
            by_end: rows(-1.0 - slid * ratio.by_master, couple * slope * ratio.by_master),
            by_increment_slope: rows(0.0, 0.5 * couple),
        })
    }
}

impl SlidingLaw for MovingSleeve {
    fn equations(&self, contact: &Contact<'_>) -> [Equation; CONTACT_UNKNOWNS] {
        let Some(rotations) = &contact.sleeve else { return Conserving.equations(contact) };
        let [gap_x, gap_y] = contact.closed();
        let ratio = rotations.ratio(contact.unknowns.increment);
        let rotation = equal_rotations(contact, rotations, &ratio);
        let along = match self {
            Self::Sliding => work_free(contact, rotations, &ratio),
            Self::Held => contact.no_increment(),
        };
        [gap_x, gap_y, rotation, balanced_moment(contact), along]
    }
}

/// Equation of equal rotations of the sleeve and of the master where the sleeve is.
fn equal_rotations(
    contact: &Contact<'_>,
    rotations: &SleeveRotations,
    ratio: &SlidingRatio,
) -> Equation {
    let (length, increment) = (contact.length, contact.unknowns.increment);
    let SleeveRotations { slave, master: [master, master_slope], .. } = *rotations;
    let [slope, bend] = rotations.angle_slope;
    let slid = increment * slope * ratio.value;
    let by_increment =
        (slope + increment * bend) * ratio.value + increment * slope * ratio.by_increment;
    let mut equation = Equation::new(length * (slave - master - slid), Unit::Length);
    equation.by_unknowns.increment = -length * (master_slope + by_increment);
    equation
}

/// Equation of the moment on the slave: the contact forces have no moment in a step.
fn balanced_moment(contact: &Contact<'_>) -> Equation {
    let (scale, change) = (1.0 / contact.length, contact.tangent_change());
    let (force, increment) = (contact.unknowns.force, contact.unknowns.increment);
    let moment = cross(change.value, force);
    let value = contact.unknowns.couple.y + increment * moment * scale;
    let mut equation = Equation::new(value, Unit::Force);
    equation.by_difference = perpendicular(force) * (-0.25 * increment * scale);
    equation.by_unknowns.force = perpendicular(change.value) * (increment * scale);
    equation.by_unknowns.couple = AXES[1];
    equation.by_unknowns.increment = (moment + increment * cross(change.by_end, force)) * scale;
    equation
}

/// Sliding equation: the contact force and both moments together do no work.
fn work_free(contact: &Contact<'_>, rotations: &SleeveRotations, ratio: &SlidingRatio) -> Equation {
    let (scale, change) = (1.0 / contact.length, contact.tangent_change());
    let (force, couple) = (contact.unknowns.force, contact.unknowns.couple.x);
    let SleeveRotations { slave, increment_slope: [twist, twist_slope], .. } = *rotations;
    let [slope, bend] = rotations.angle_slope;
    let curvature = 0.5 * twist + slope * ratio.value;
    let by_increment = 0.5 * twist_slope + bend * ratio.value + slope * ratio.by_increment;
    let mut equation = contact.frictionless(contact.tangent());
    equation.value += couple * curvature - slave * cross(change.value, force) * scale;
    equation.by_difference = (force * 0.5 + perpendicular(force) * (0.25 * slave)) * scale;
    equation.by_unknowns.force -= perpendicular(change.value) * (slave * scale);
    equation.by_unknowns.couple.x = curvature;
    equation.by_unknowns.increment +=
        couple * by_increment - slave * cross(change.by_end, force) * scale;
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
