//! Law of a sleeve without length in an equilibrium: the axis of the master passes through the slave, at a constant angle to it.

use super::contact::AXES;
use super::{
    AtStop, CONTACT_UNKNOWNS, Contact, Equation, Resting, RotationSlopes, SlidingLaw, Unit,
};
use crate::geometry::{Vec2, cross, perpendicular};

/// Angle between a sleeve and its master, and the missing compliance: the compliance of the master that its mesh does not represent.
/// An array of three numbers contains a missing compliance, and its first and second derivatives with respect to the parameter of the master.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct MasterAtSleeve {
    /// Angle of the sleeve minus the angle of the master on its mesh, relative to the initial difference [rad].
    pub gap: f64,
    /// First and second derivatives of the angle of the master with respect to its parameter [rad].
    pub slopes: [f64; 2],
    /// Unit vector along the sleeve [-].
    pub along: Vec2,
    /// Missing compliance: displacement across the sleeve per force across the sleeve [length/force].
    pub transverse: [f64; 3],
    /// Missing compliance: rotation per force across the sleeve, equal to the displacement per couple [1/force].
    pub coupling: [f64; 3],
    /// Missing compliance: rotation per couple [1/(force·length)].
    pub rotation: [f64; 3],
    /// Missing compliance: displacement along the sleeve per force along the sleeve [length/force].
    pub axial: [f64; 3],
}

/// Law of a sleeve in an equilibrium. The potential energy is stationary (docs/theory.md, section 14.2).
///
/// The unknown `couple.x` is the couple of the sleeve on the master.
/// The unknown `couple.y` is the moment of the contact force on the slave about the axis that the mesh represents.
/// Both unknowns are moments divided by [`Contact::length`].
#[derive(Debug, Clone, Copy)]
pub struct RestingSleeve {
    /// Angle and compliance of the master at the sleeve.
    pub master: MasterAtSleeve,
    /// Sliding increment to the stop that holds the sleeve [-]; `None` if the sleeve slides.
    pub stop: Option<f64>,
}

/// Part of the displacement and rotation of the axis at a sleeve that the mesh does not represent.
/// The type is also used for derivatives of this part with respect to the parameter of the master.
#[derive(Debug, Clone, Copy)]
pub struct SleeveOffset {
    /// Displacement [length].
    pub displacement: Vec2,
    /// Rotation [rad].
    pub rotation: f64,
    /// Derivatives of displacement and rotation with respect to the angle of the sleeve, for a constant force.
    pub by_angle: (Vec2, f64),
}

impl MasterAtSleeve {
    /// Displacement and rotation that the mesh does not represent, due to a force and a couple on the master.
    /// For `order` 1 or 2, the result is the derivative of this order with respect to the parameter of the master.
    pub fn offset(&self, (force, moment): (Vec2, f64), order: usize) -> SleeveOffset {
        let (along, normal) = (self.along, perpendicular(self.along));
        let (across, tension) = (force.dot(&normal), force.dot(&along));
        let (transverse, axial) = (self.transverse[order], self.axial[order]);
        let coupling = self.coupling[order];
        let raised = transverse * across + coupling * moment;
        let stretched = axial * tension;
        let displaced =
            normal * (stretched - transverse * tension) + along * (axial * across - raised);
        SleeveOffset {
            displacement: normal * raised + along * stretched,
            rotation: coupling * across + self.rotation[order] * moment,
            by_angle: (displaced, -coupling * tension),
        }
    }
}

impl RestingSleeve {
    fn moment(&self, contact: &Contact<'_>) -> f64 {
        contact.unknowns.couple.x * contact.length
    }

    fn offset(&self, contact: &Contact<'_>, order: usize) -> SleeveOffset {
        self.master.offset((contact.unknowns.force, self.moment(contact)), order)
    }

    fn by_force(&self, axis: Vec2) -> Vec2 {
        let MasterAtSleeve { along, transverse, axial, .. } = self.master;
        let normal = perpendicular(along);
        normal * (transverse[0] * axis.dot(&normal)) + along * (axial[0] * axis.dot(&along))
    }

    fn closed(&self, contact: &Contact<'_>, equations: &mut [Equation; CONTACT_UNKNOWNS]) {
        let MasterAtSleeve { along, coupling, rotation, slopes, gap, .. } = self.master;
        let (normal, length) = (perpendicular(along), contact.length);
        let [offset, change] = [0, 1].map(|order| self.offset(contact, order));
        let [gap_x, gap_y, angle, ..] = equations;
        for (equation, axis) in [gap_x, gap_y].into_iter().zip(AXES) {
            equation.value -= offset.displacement.dot(&axis);
            equation.by_unknowns.force -= self.by_force(axis);
            equation.by_unknowns.couple.x -= coupling[0] * length * normal.dot(&axis);
            equation.by_unknowns.increment -= change.displacement.dot(&axis);
        }
        *angle = Equation::new(length * (gap - offset.rotation), Unit::Length);
        angle.by_unknowns.force = normal * (-length * coupling[0]);
        angle.by_unknowns.couple.x = -length * length * rotation[0];
        angle.by_unknowns.increment = -length * (slopes[0] + change.rotation);
    }

    fn balanced(&self, contact: &Contact<'_>) -> Equation {
        let (force, scale) = (contact.unknowns.force, 1.0 / contact.length);
        let [offset, change] = [0, 1].map(|order| self.offset(contact, order));
        let (by_sleeve, change) = (offset.by_angle.1, change.displacement);
        let offset = offset.displacement;
        let moment = contact.unknowns.couple.y + cross(offset, force) * scale;
        let mut equation = Equation::new(moment, Unit::Force);
        let [by_x, by_y] = AXES.map(|axis| cross(self.by_force(axis), force) + cross(offset, axis));
        equation.by_unknowns.force = Vec2::new(by_x, by_y) * scale;
        equation.by_unknowns.couple = Vec2::new(by_sleeve, 1.0);
        equation.by_unknowns.increment = cross(change, force) * scale;
        equation
    }

    /// Derivative of the work of the couple and of the missing compliance in sliding of the sleeve [force·length].
    /// The derivative has the order `order`, 1 or 2, and is taken with respect to the parameter of the master.
    fn work(&self, contact: &Contact<'_>, order: usize) -> f64 {
        let (force, moment) = (contact.unknowns.force, self.moment(contact));
        let offset = self.offset(contact, order);
        let of_offset = force.dot(&offset.displacement) + moment * offset.rotation;
        moment * self.master.slopes[order - 1] + 0.5 * of_offset
    }

    /// Adds the first derivative of the work of the couple and of the missing compliance to the equation of sliding without friction.
    fn slide(&self, contact: &Contact<'_>, equation: &mut Equation) {
        let (scale, change) = (1.0 / contact.length, self.offset(contact, 1));
        equation.value += self.work(contact, 1) * scale;
        equation.by_unknowns.force += change.displacement * scale;
        equation.by_unknowns.couple.x += self.master.slopes[0] + change.rotation;
        equation.by_unknowns.increment += self.work(contact, 2) * scale;
    }

    /// Configurational force on the stop that holds the sleeve, times the length of the master per unit of its parameter [force·length].
    /// The argument `outward` is the sign of the parameter change towards the end of the master at which the sleeve is.
    pub fn outward_push(&self, contact: &Contact<'_>, outward: f64) -> f64 {
        contact.outward_push(outward) + self.work(contact, 1) * outward
    }

    /// Derivatives of the equations with respect to rotation increments.
    pub fn rotation_slopes(&self, contact: &Contact<'_>) -> RotationSlopes {
        let (force, length) = (contact.unknowns.force, contact.length);
        let [offset, change] = [0, 1].map(|order| self.offset(contact, order));
        let (displaced, rotated) = offset.by_angle;
        let along = if self.stop.is_some() { 0.0 } else { 1.0 };
        RotationSlopes {
            by_slave: [
                -displaced.x,
                -displaced.y,
                length * (1.0 - rotated),
                cross(displaced, force) / length,
                along * cross(change.displacement, force) / length,
            ],
            by_end: [0.0, 0.0, -length, 0.0, 0.0],
            by_increment_slope: [0.0, 0.0, 0.0, 0.0, along * contact.unknowns.couple.x],
        }
    }
}

impl SlidingLaw for RestingSleeve {
    fn equations(&self, contact: &Contact<'_>) -> [Equation; CONTACT_UNKNOWNS] {
        let mut equations = match self.stop {
            Some(increment) => AtStop { increment }.equations(contact),
            None => Resting.equations(contact),
        };
        self.closed(contact, &mut equations);
        equations[3] = self.balanced(contact);
        if self.stop.is_none() {
            let [.., along] = &mut equations;
            self.slide(contact, along);
        }
        equations
    }
}
