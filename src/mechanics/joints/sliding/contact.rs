//! Contact of a slider in a step: path along the master, and forces on slave and master.

use super::{Equation, Friction, SleeveRotations, Unit};
use crate::geometry::{ContactPath, FunctionOnPath, Vec2};

/// Number of unknowns of a contact: two components of the force, two components of the couple, and the sliding increment.
pub const CONTACT_UNKNOWNS: usize = 5;

/// Unknowns of a sliding contact in a step. The type is also used for derivatives with respect to these unknowns.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ContactUnknowns {
    /// Contact force `λ` on the master; the force `-λ` acts on the slave [force].
    pub force: Vec2,
    /// Factor of additional forces on the control points of the master [force]: `η`, or `χ` with a kink (docs/theory.md, sections 10 and 10.1).
    /// The sum of these forces is zero. Their moment balances the moment of the contact forces, so that angular momentum is conserved.
    /// For a sleeve, the components are moments divided by a length instead (see [`super::RestingSleeve`] and [`super::MovingSleeve`]).
    pub couple: Vec2,
    /// Sliding increment: change of the position of the slave in the step, measured by the parameter of the master [-].
    pub increment: f64,
}

pub(super) const AXES: [Vec2; 2] = [Vec2::new(1.0, 0.0), Vec2::new(0.0, 1.0)];

const NONE: ContactUnknowns =
    ContactUnknowns { force: Vec2::new(0.0, 0.0), couple: Vec2::new(0.0, 0.0), increment: 0.0 };

impl ContactUnknowns {
    /// Zero force, couple and sliding increment.
    pub fn zeros() -> Self {
        NONE
    }

    /// Creates the unknowns from a vector: force, couple and sliding increment.
    pub fn of([force_x, force_y, couple_x, couple_y, increment]: [f64; CONTACT_UNKNOWNS]) -> Self {
        Self {
            force: Vec2::new(force_x, force_y),
            couple: Vec2::new(couple_x, couple_y),
            increment,
        }
    }

    /// Returns the unknowns as a vector: force, couple and sliding increment.
    pub fn to_array(&self) -> [f64; CONTACT_UNKNOWNS] {
        [self.force.x, self.force.y, self.couple.x, self.couple.y, self.increment]
    }
}

/// Position or tangent vector on the path of a slave along its master, with its derivative [length].
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PathVector {
    /// Position or tangent vector on the path [length].
    pub value: Vec2,
    /// Derivative of `value` with respect to the parameter of the master at the end of the path [length].
    pub by_end: Vec2,
}

/// Kink of the axis of a master: jump of its tangent under the contact force.
/// The mesh does not represent this jump (docs/theory.md, section 10.1).
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Kink {
    /// Kink length of the master, as a function along the path of the slave [length].
    /// The kink length is the shear stiffness times the additional deflection per unit force that the mesh does not represent.
    pub along: FunctionOnPath,
    /// Compliance of the master in shear: inverse of its shear stiffness [1/force].
    pub compliance: f64,
    /// Jump of the tangent at the start of the step, given as the force that would cause this jump statically [force].
    pub before: Vec2,
    /// Motion of the kink along the master.
    pub motion: KinkMotion,
}

/// Kink of a master at the end of a step.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct KinkState {
    /// Jump of the tangent at the kink, given as the force that would cause this jump statically [force].
    pub jump: Vec2,
    /// Speed of the kink along the undeformed axis of the master [length/time].
    pub speed: f64,
}

/// Motion of a kink along its master in a step. A moving kink has a kinetic energy.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct KinkMotion {
    /// Arc length of the undeformed master, as a function along the path of the slave [length].
    pub arc: FunctionOnPath,
    /// Speed of the kink at the start of the step [length/time].
    pub speed: f64,
    /// Inverse square of the shear wave speed, times the factor of the kinetic energy of the kink (`MissedKink::inertia`) [time²/length²].
    pub inverse_square_speed: f64,
    /// Duration of the step [time].
    pub duration: f64,
}

/// Kinematics of a sliding contact in a step. All positions are relative to the position of the slave at the start of the step.
/// The contact force acts on the master, and the opposite force acts on the slave.
#[derive(Debug, Clone, Copy)]
pub struct Contact<'a> {
    /// Path of the slave along the master.
    pub path: &'a ContactPath,
    /// Control points with nonzero basis functions on the path, relative to the slave, and their increments in the step [length].
    pub master: (&'a [Vec2], &'a [Vec2]),
    /// Displacement of the slave in the step [length].
    pub slave_movement: Vec2,
    /// Unknowns of the contact: force, couple and sliding increment.
    pub unknowns: ContactUnknowns,
    /// Kink of the axis of the master under the contact force; `None` for sliding laws without a kink.
    pub kink: Option<Kink>,
    /// Friction of the slider along the master; `None` without friction.
    pub friction: Option<Friction<'a>>,
    /// Rotations of a sleeve and its master in the step; `None` for other sliders.
    pub sleeve: Option<SleeveRotations>,
    /// Mean length of the master per unit of its parameter [length]. The contact equations are divided by this length.
    pub length: f64,
}

impl Contact<'_> {
    #[inline]
    fn sum(&self, weights: &[f64], share: f64) -> Vec2 {
        let (before, moved) = self.master;
        let points = before.iter().zip(moved);
        weights.iter().zip(points).map(|(w, (x, moved))| (x + moved * share) * *w).sum()
    }

    #[inline]
    fn movement(&self, weights: &[f64]) -> Vec2 {
        let (_, moved) = self.master;
        weights.iter().zip(moved).map(|(w, moved)| moved * *w).sum()
    }

    /// Vector from the slave to its position on the master at the start of the step [length]; zero if the gap is closed.
    pub fn start_gap(&self) -> Vec2 {
        self.sum(self.path.start(), 0.0)
    }

    /// Mean tangent of the path, in the configuration of the master at the start of the step [length].
    pub fn start_tangent(&self) -> PathVector {
        let value = self.sum(self.path.difference(), 0.0);
        PathVector { value, by_end: self.sum(self.path.change(), 0.0) }
    }

    /// Position on the master at the end of the path, in the configuration at the end of the step [length].
    #[inline]
    pub fn end_point(&self) -> PathVector {
        let value = self.sum(self.path.end(), 1.0);
        PathVector { value, by_end: self.sum(self.path.slope(), 1.0) }
    }

    /// Product of the contact force on the master, the tangent of the master at the end of the step, and `outward` [force·length].
    /// For a sleeve, the product of the couple and the derivative of the angle of the master is added.
    /// The result is positive if the slave pushes the master outwards, at the end of the master at which the slider is.
    /// The argument `outward` is the sign of the parameter change towards this end.
    pub fn outward_push(&self, outward: f64) -> f64 {
        let push = self.unknowns.force.dot(&self.end_point().by_end) * outward;
        match &self.sleeve {
            Some(rotations) => {
                push + self.unknowns.couple.x * self.length * rotations.end_slope() * outward
            }
            None => push,
        }
    }

    pub(super) fn end_bend(&self) -> Vec2 {
        self.sum(self.path.change(), 1.0)
    }

    /// Position on the master, averaged over the path and over the step [length].
    pub fn mean_point(&self) -> PathVector {
        let value = self.sum(self.path.mean(), 0.5);
        PathVector { value, by_end: self.sum(self.path.slope(), 0.5) * 0.5 }
    }

    /// Mean tangent of the path, in the mean configuration of the master [length].
    #[inline]
    pub fn tangent(&self) -> PathVector {
        let value = self.sum(self.path.difference(), 0.5);
        PathVector { value, by_end: self.sum(self.path.change(), 0.5) }
    }

    /// Quarter of the change of the mean tangent in the step [length].
    #[inline]
    pub fn tangent_change(&self) -> PathVector {
        let value = self.movement(self.path.difference()) * 0.25;
        PathVector { value, by_end: self.movement(self.path.change()) * 0.25 }
    }

    /// First control point of the master whose basis function is nonzero on the path.
    pub fn first(&self) -> usize {
        self.path.first()
    }

    /// Factor of the additional forces on the master, and the factor of the divided differences in these forces.
    /// A sleeve has no additional forces, because its moments act on rotations.
    fn additional_forces(&self) -> (Vec2, f64) {
        let couple = self.unknowns.couple;
        match (&self.sleeve, &self.kink) {
            (Some(_), _) => (Vec2::zeros(), 0.0),
            (None, Some(_)) => (couple, 1.0),
            (None, None) => (couple, self.unknowns.increment),
        }
    }

    /// Contact forces on the control points of the master whose basis functions are nonzero on the path [force].
    pub fn master_forces(&self) -> impl Iterator<Item = Vec2> + '_ {
        let force = self.unknowns.force;
        let (couple, share) = self.additional_forces();
        let weights = self.path.mean().iter().zip(self.path.difference());
        weights.map(move |(mean, difference)| force * *mean - couple * (share * difference))
    }

    /// Derivatives of the contact forces on the control points of the master with respect to the contact unknowns.
    /// The first two numbers of a tuple, times the identity matrix, are the derivatives with respect to `force` and `couple`.
    /// The vector is the derivative with respect to the sliding increment.
    pub fn master_force_slopes(&self) -> impl Iterator<Item = (f64, f64, Vec2)> + '_ {
        let force = self.unknowns.force;
        let (couple, share) = self.additional_forces();
        let weights = self.path.mean().iter().zip(self.path.difference());
        let slopes = self.path.slope().iter().zip(self.path.change());
        weights.zip(slopes).map(move |((mean, difference), (slope, change))| {
            let by_way = match self.kink {
                None => (force * 0.5 - couple) * *slope,
                Some(_) => force * (0.5 * slope) - couple * *change,
            };
            (*mean, -share * difference, by_way)
        })
    }

    /// Weights of the control points of the master [-]: at the end of the path, averaged over the path, and as divided differences.
    pub fn weights(&self) -> impl Iterator<Item = (f64, f64, f64)> + '_ {
        let mean_and_difference = self.path.mean().iter().zip(self.path.difference());
        let weights = self.path.end().iter().zip(mean_and_difference);
        weights.map(|(end, (mean, difference))| (*end, *mean, *difference))
    }

    /// Equations of a closed gap at the end of the step (Sibileau & Muñoz, equation 15).
    pub(super) fn closed(&self) -> [Equation; 2] {
        let point = self.end_point();
        let gap = self.slave_movement - point.value;
        AXES.map(|axis| Equation {
            by_slave: axis,
            by_end: -axis,
            by_unknowns: ContactUnknowns { increment: -point.by_end.dot(&axis), ..NONE },
            ..Equation::new(gap.dot(&axis), Unit::Length)
        })
    }

    pub(super) fn closed_on_kink(&self, force: Vec2, factor: f64) -> [Equation; 2] {
        let mut equations = self.closed();
        if let Some(kink) = &self.kink {
            let offset = force * kink.compliance;
            for (equation, axis) in equations.iter_mut().zip(AXES) {
                equation.value -= kink.along.end * offset.dot(&axis);
                equation.by_unknowns.force -= axis * (factor * kink.compliance * kink.along.end);
                equation.by_unknowns.increment -= kink.along.slope * offset.dot(&axis);
            }
        }
        equations
    }

    pub(super) fn no_couple(&self) -> [Equation; 2] {
        AXES.map(|axis| Equation {
            by_unknowns: ContactUnknowns { couple: axis, ..NONE },
            ..Equation::new(self.unknowns.couple.dot(&axis), Unit::Force)
        })
    }

    pub(super) fn no_force(&self) -> [Equation; 2] {
        AXES.map(|axis| Equation {
            by_unknowns: ContactUnknowns { force: axis, ..NONE },
            ..Equation::new(self.unknowns.force.dot(&axis), Unit::Force)
        })
    }

    pub(super) fn no_increment(&self) -> Equation {
        Equation {
            by_unknowns: ContactUnknowns { increment: self.length, ..NONE },
            ..Equation::new(self.length * self.unknowns.increment, Unit::Length)
        }
    }

    pub(super) fn frictionless(&self, direction: PathVector) -> Equation {
        let (force, scale) = (self.unknowns.force, 1.0 / self.length);
        let way = force.dot(&direction.by_end) * scale;
        Equation {
            by_unknowns: ContactUnknowns { force: direction.value * scale, increment: way, ..NONE },
            ..Equation::new(force.dot(&direction.value) * scale, Unit::Force)
        }
    }
}
