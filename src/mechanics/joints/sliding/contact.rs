//! The contact of a slider in one step: where the master passes, and the forces on both.

use super::{Equation, Unit};
use crate::geometry::{ContactPath, FunctionOnPath, Vec2};

/// The number of unknowns of a contact: `λ` and `η` with two components each, and `Δξ`.
pub const CONTACT_UNKNOWNS: usize = 5;

/// The unknowns of a sliding contact in a step, or a derivative by each of them.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ContactUnknowns {
    /// The contact force `λ` on the master; `-λ` acts on the slave [force].
    pub force: Vec2,
    /// The couple of the contact, `η` or, with a kink, `χ`: with `Δξ D_i η` or `D_i χ` the forces on the master that balance the angular momentum [force].
    pub couple: Vec2,
    /// The way `Δξ` of the slave along the parameter of the master in the step [-].
    pub way: f64,
}

/// The unit vectors of the two axes [-]: the components of a vector are its products with these.
pub(super) const AXES: [Vec2; 2] = [Vec2::new(1.0, 0.0), Vec2::new(0.0, 1.0)];

/// No force, no couple, no way; and derivatives by none of them.
const NONE: ContactUnknowns =
    ContactUnknowns { force: Vec2::new(0.0, 0.0), couple: Vec2::new(0.0, 0.0), way: 0.0 };

impl ContactUnknowns {
    /// The unknowns of a contact without force, couple and way.
    pub fn zeros() -> Self {
        NONE
    }

    /// The unknowns of a contact as they stand in a vector of unknowns: `λ` and `η` with two components each, and `Δξ`.
    pub fn of([force_x, force_y, couple_x, couple_y, way]: [f64; CONTACT_UNKNOWNS]) -> Self {
        Self { force: Vec2::new(force_x, force_y), couple: Vec2::new(couple_x, couple_y), way }
    }

    /// The unknowns of the contact in the order of a vector of unknowns: `λ` and `η` with two components each, and `Δξ`.
    pub fn to_array(&self) -> [f64; CONTACT_UNKNOWNS] {
        [self.force.x, self.force.y, self.couple.x, self.couple.y, self.way]
    }
}

/// A place or direction on the way of a slave along its master, with its derivative by the end `ξ1` of the way [length].
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PathVector {
    /// The place or direction itself [length].
    pub value: Vec2,
    /// The derivative of the place or direction by the end `ξ1` of the way [length].
    pub by_way: Vec2,
}

/// How the contact force kinks the axis of the master where the slave is, beyond what its mesh knows: by `g a` across it, with the jump `a = p/GA` of the
/// tangent.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Kink {
    /// The kink length `g` of the master along the way of the slave [length].
    pub along: FunctionOnPath,
    /// The compliance `1/GA` of the master [1/force].
    pub compliance: f64,
    /// The jump of the tangent at the start of the step, as the force `p0 = GA a0` that makes it where the kink does not move [force].
    pub before: Vec2,
    /// How the kink moves along the master.
    pub motion: KinkMotion,
}

/// The kink of a master at the end of a step.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct KinkState {
    /// The jump of the tangent, as the force `p = GA a` that makes it where the kink does not move [force].
    pub jump: Vec2,
    /// The speed `v` along the undeformed axis of the master [length/time].
    pub speed: f64,
}

/// How a kink moves along its master in a step: with a speed `v` along the undeformed axis it has the kinetic energy `½ ρA g |a|² v²`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct KinkMotion {
    /// The arc length `s` of the undeformed master along the way of the slave [length].
    pub arc: FunctionOnPath,
    /// The speed `v0` at the start of the step [length/time].
    pub speed: f64,
    /// `μ ρA/GA`, one over the square of the speed of shear waves but for what the mesh misses of the motion [time²/length²].
    pub slowness: f64,
    /// The duration `Δt` of the step [time].
    pub duration: f64,
}

/// The kinematics of a sliding contact in a step, of which the laws of sliding are made, with places counted from where the slave starts.
///
/// The forces are the same in all laws: the slave gets `-λ`, control point `i` of the master `B̄_i λ - Δξ D_i η`, or `B̄_i λ - D_i χ` with a kink.
#[derive(Debug, Clone, Copy)]
pub struct Contact<'a> {
    /// The way of the slave along the master.
    pub passage: &'a ContactPath,
    /// The control points of the master in the window of the passage, counted from the slave, and how they move in the step
    /// [length].
    pub master: (&'a [Vec2], &'a [Vec2]),
    /// The movement `Δx_s` of the slave in the step [length].
    pub slave_moved: Vec2,
    /// The unknowns of the contact: `λ` [force], `η` [force] and `Δξ` [-].
    pub unknowns: ContactUnknowns,
    /// The kink of the master under the contact force, where the contact has one.
    pub kink: Option<Kink>,
    /// The length of the master for a parameter of one, by which equations become lengths and forces [length].
    pub length: f64,
}

impl Contact<'_> {
    /// `Σ w_i (x_i0 + share Δx_i)`
    #[inline]
    fn sum(&self, weights: &[f64], share: f64) -> Vec2 {
        let (before, moved) = self.master;
        let points = before.iter().zip(moved);
        weights.iter().zip(points).map(|(w, (x, moved))| (x + moved * share) * *w).sum()
    }

    /// `Σ w_i Δx_i`
    #[inline]
    fn movement(&self, weights: &[f64]) -> Vec2 {
        let (_, moved) = self.master;
        weights.iter().zip(moved).map(|(w, moved)| moved * *w).sum()
    }

    /// The gap between master and slave at the start of the step, `Σ B_i(ξ0) x_i0` counted from the slave [length].
    pub fn start_gap(&self) -> Vec2 {
        self.sum(self.passage.start(), 0.0)
    }

    /// The mean tangent `Σ D_i x_i0` of the way on the master as it is at the start of the step [length].
    pub fn start_tangent(&self) -> PathVector {
        let value = self.sum(self.passage.difference(), 0.0);
        PathVector { value, by_way: self.sum(self.passage.change(), 0.0) }
    }

    /// The place `Σ B_i(ξ1) x_i1` on the master at the end of the way and of the step [length].
    #[inline]
    pub fn end_point(&self) -> PathVector {
        let value = self.sum(self.passage.end(), 1.0);
        PathVector { value, by_way: self.sum(self.passage.slope(), 1.0) }
    }

    /// How much the slave pushes outwards at the end of the step, `λ·x'(ξ1)` times the sign of `dξ` with which it reaches an end [force·length].
    pub fn push(&self, outward: f64) -> f64 {
        self.unknowns.force.dot(&self.end_point().by_way) * outward
    }

    /// The sum `Σ ∂D_i/∂ξ1 x_i1` on the master at the end of the step: half of its second derivative, for a way of length zero [length].
    pub(super) fn end_bend(&self) -> Vec2 {
        self.sum(self.passage.change(), 1.0)
    }

    /// The mean place `Σ B̄_i x̄_i` of way and step on the master [length].
    pub fn mean_point(&self) -> PathVector {
        let value = self.sum(self.passage.mean(), 0.5);
        PathVector { value, by_way: self.sum(self.passage.slope(), 0.5) * 0.5 }
    }

    /// The mean tangent `τ = Σ D_i x̄_i` of the way on the master in its mean configuration [length].
    #[inline]
    pub fn tangent(&self) -> PathVector {
        let value = self.sum(self.passage.difference(), 0.5);
        PathVector { value, by_way: self.sum(self.passage.change(), 0.5) }
    }

    /// The swing `d = ¼ Σ D_i Δx_i` of the master along the way: a quarter of the change of its tangent [length].
    #[inline]
    pub fn swing(&self) -> PathVector {
        let value = self.movement(self.passage.difference()) * 0.25;
        PathVector { value, by_way: self.movement(self.passage.change()) * 0.25 }
    }

    /// The index of the first control point of the master in the window of the way.
    pub fn first(&self) -> usize {
        self.passage.first()
    }

    /// The factor of the couple in the forces on the master: the way `Δξ`, with which it grows; or one with a kink, as the offset of the slave is an arm of
    /// forces along the master on a way of any length.
    fn couple_share(&self) -> f64 {
        self.kink.map_or(self.unknowns.way, |_| 1.0)
    }

    /// The contact forces on the control points of the master in the window of the way [force], in order.
    pub fn master_forces(&self) -> impl Iterator<Item = Vec2> + '_ {
        let ContactUnknowns { force, couple, .. } = self.unknowns;
        let share = self.couple_share();
        let weights = self.passage.mean().iter().zip(self.passage.difference());
        weights.map(move |(mean, difference)| force * *mean - couple * (share * difference))
    }

    /// The derivatives of the contact forces on the control points of the master, in order: by `λ` and by `η` a factor each, by `Δξ` a force.
    pub fn master_force_slopes(&self) -> impl Iterator<Item = (f64, f64, Vec2)> + '_ {
        let ContactUnknowns { force, couple, .. } = self.unknowns;
        let share = self.couple_share();
        let weights = self.passage.mean().iter().zip(self.passage.difference());
        let slopes = self.passage.slope().iter().zip(self.passage.change());
        weights.zip(slopes).map(move |((mean, difference), (slope, change))| {
            let by_way = match self.kink {
                None => (force * 0.5 - couple) * *slope,
                Some(_) => force * (0.5 * slope) - couple * *change,
            };
            (*mean, -share * difference, by_way)
        })
    }

    /// The weights `B_i(ξ1)`, `B̄_i` and `D_i` of the control points of the master in the window of the way [-], in order.
    pub fn weights(&self) -> impl Iterator<Item = (f64, f64, f64)> + '_ {
        let mean_and_difference = self.passage.mean().iter().zip(self.passage.difference());
        let weights = self.passage.end().iter().zip(mean_and_difference);
        weights.map(|(end, (mean, difference))| (*end, *mean, *difference))
    }

    /// The equations of a gap that is closed at the end of the step: `x_s1 = Σ B_i(ξ1) x_i1` (paper, equation 15).
    pub(super) fn closed(&self) -> [Equation; 2] {
        let point = self.end_point();
        let gap = self.slave_moved - point.value;
        AXES.map(|axis| Equation {
            by_slave: axis,
            by_end: -axis,
            by_unknowns: ContactUnknowns { way: -point.by_way.dot(&axis), ..NONE },
            ..Equation::new(gap.dot(&axis), Unit::Length)
        })
    }

    /// The equations of a gap that is closed at the end of the step where a force kinks the axis: `x_s1 = Σ B_i(ξ1) x_i1 + g1 p1/GA`, for a force `p1` that follows
    /// `factor` times the contact force; those of [`closed`](Self::closed) without a kink.
    pub(super) fn closed_on_kink(&self, force: Vec2, factor: f64) -> [Equation; 2] {
        let mut equations = self.closed();
        if let Some(kink) = &self.kink {
            let offset = force * kink.compliance;
            for (equation, axis) in equations.iter_mut().zip(AXES) {
                equation.value -= kink.along.end * offset.dot(&axis);
                equation.by_unknowns.force -= axis * (factor * kink.compliance * kink.along.end);
                equation.by_unknowns.way -= kink.along.slope * offset.dot(&axis);
            }
        }
        equations
    }

    /// The equations `η = 0` of a contact without a couple.
    pub(super) fn no_couple(&self) -> [Equation; 2] {
        AXES.map(|axis| Equation {
            by_unknowns: ContactUnknowns { couple: axis, ..NONE },
            ..Equation::new(self.unknowns.couple.dot(&axis), Unit::Force)
        })
    }

    /// The equations `λ = 0` of a contact without a force.
    pub(super) fn no_force(&self) -> [Equation; 2] {
        AXES.map(|axis| Equation {
            by_unknowns: ContactUnknowns { force: axis, ..NONE },
            ..Equation::new(self.unknowns.force.dot(&axis), Unit::Force)
        })
    }

    /// The equation `Δξ = 0` of a slave that stays where it is on the master, times the length `ℓ`.
    pub(super) fn no_way(&self) -> Equation {
        Equation {
            by_unknowns: ContactUnknowns { way: self.length, ..NONE },
            ..Equation::new(self.length * self.unknowns.way, Unit::Length)
        }
    }

    /// The equation `λ·direction/ℓ = 0` of a contact without friction, for a direction that does not move with the master.
    pub(super) fn frictionless(&self, direction: PathVector) -> Equation {
        let (force, scale) = (self.unknowns.force, 1.0 / self.length);
        let way = force.dot(&direction.by_way) * scale;
        Equation {
            by_unknowns: ContactUnknowns { force: direction.value * scale, way, ..NONE },
            ..Equation::new(force.dot(&direction.value) * scale, Unit::Force)
        }
    }
}
