//! The contact of a slider in one step: where the master passes, and the forces on both.

use super::{Equation, Unit};
use crate::geometry::{Passage, Vec2};

/// The number of unknowns of a contact: `λ` and `η` with two components each, and `Δξ`.
pub const CONTACT_UNKNOWNS: usize = 5;

/// The unknowns of a contact.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ContactUnknowns {
    /// `λ`: the force on the master; `-λ` acts on the slave [force].
    pub force: Vec2,
    /// `η`: with `Δξ D_i η` the forces on the master that balance the angular momentum [force].
    pub couple: Vec2,
    /// `Δξ`: the way along the parameter of the master [-].
    pub way: f64,
}

impl ContactUnknowns {
    /// As they stand in a vector of unknowns.
    pub fn of([force_x, force_y, couple_x, couple_y, way]: [f64; CONTACT_UNKNOWNS]) -> Self {
        Self { force: Vec2::new(force_x, force_y), couple: Vec2::new(couple_x, couple_y), way }
    }

    /// In the order of a vector of unknowns.
    pub fn to_array(&self) -> [f64; CONTACT_UNKNOWNS] {
        [self.force.x, self.force.y, self.couple.x, self.couple.y, self.way]
    }
}

/// What the laws of sliding are made of, with places counted from where the slave starts the step.
///
/// The forces are the same in all laws: the slave gets `-λ`, control point `i` of the master `B̄_i λ - Δξ D_i η`.
#[derive(Debug, Clone, Copy)]
pub struct Contact<'a> {
    passage: &'a Passage,
    /// `λ`, `η`, `Δξ`
    pub unknowns: ContactUnknowns,
    /// The length of the master for a parameter of one; makes equations lengths and forces [length].
    pub length: f64,
    /// `Δx_s` [length]
    pub slave_moved: Vec2,
    /// `Σ B_i(ξ0) x_i0`: the gap at the start [length].
    pub start_gap: Vec2,
    /// `Σ D_i x_i0` and its derivative by `ξ1` [length].
    pub start_tangent: (Vec2, Vec2),
    /// `Σ B_i(ξ1) x_i1` and its derivative by `ξ1` [length].
    pub end_point: (Vec2, Vec2),
    /// `Σ B̄_i x̄_i` and its derivative by `ξ1` [length].
    pub mean_point: (Vec2, Vec2),
    /// `τ = Σ D_i x̄_i` and its derivative by `ξ1` [length].
    pub tangent: (Vec2, Vec2),
    /// `d = ¼ Σ D_i Δx_i` and its derivative by `ξ1` [length].
    pub swing: (Vec2, Vec2),
}

impl<'a> Contact<'a> {
    /// The contact on the way of a `passage`. `before` are the control points of the master in its window, counted from the
    /// slave, and `moved` how they move in the step.
    pub fn new(
        passage: &'a Passage,
        before: &[Vec2],
        moved: &[Vec2],
        slave_moved: Vec2,
        unknowns: ContactUnknowns,
        length: f64,
    ) -> Self {
        let sum = |weights: &[f64], share: f64| -> Vec2 {
            let points = before.iter().zip(moved);
            weights.iter().zip(points).map(|(w, (x, moved))| (x + moved * share) * *w).sum()
        };
        let movement = |weights: &[f64]| -> Vec2 {
            weights.iter().zip(moved).map(|(w, moved)| moved * *w).sum()
        };
        let (difference, change) = (passage.difference(), passage.change());
        Self {
            passage,
            unknowns,
            length,
            slave_moved,
            start_gap: sum(passage.start(), 0.0),
            start_tangent: (sum(difference, 0.0), sum(change, 0.0)),
            end_point: (sum(passage.end(), 1.0), sum(passage.slope(), 1.0)),
            mean_point: (sum(passage.mean(), 0.5), sum(passage.slope(), 0.5) * 0.5),
            tangent: (sum(difference, 0.5), sum(change, 0.5)),
            swing: (movement(difference) * 0.25, movement(change) * 0.25),
        }
    }

    /// The first control point of the window.
    pub fn first(&self) -> usize {
        self.passage.first()
    }

    /// The forces on the control points of the master in the window of the passage.
    pub fn master_forces(&self) -> impl Iterator<Item = Vec2> + '_ {
        let ContactUnknowns { force, couple, way } = self.unknowns;
        let weights = self.passage.mean().iter().zip(self.passage.difference());
        weights.map(move |(mean, difference)| force * *mean - couple * (way * difference))
    }

    /// The derivatives of the forces on the master: by `λ` and by `η` a factor each, by `Δξ` a force.
    pub fn master_force_slopes(&self) -> impl Iterator<Item = (f64, f64, Vec2)> + '_ {
        let ContactUnknowns { force, couple, way } = self.unknowns;
        let by_way = force * 0.5 - couple;
        let weights =
            self.passage.mean().iter().zip(self.passage.difference()).zip(self.passage.slope());
        weights.map(move |((mean, difference), slope)| (*mean, -way * difference, by_way * *slope))
    }

    /// `B_i(ξ1)`, `B̄_i` and `D_i` of the control points in the window.
    pub fn weights(&self) -> impl Iterator<Item = (f64, f64, f64)> + '_ {
        let mean_and_difference = self.passage.mean().iter().zip(self.passage.difference());
        let weights = self.passage.end().iter().zip(mean_and_difference);
        weights.map(|(end, (mean, difference))| (*end, *mean, *difference))
    }

    /// `x_s1 = Σ B_i(ξ1) x_i1`: the gap at the end of the step is closed (paper, equation 15).
    pub(super) fn closed(&self) -> [Equation; 2] {
        let (point, tangent) = self.end_point;
        let gap = self.slave_moved - point;
        [Vec2::x(), Vec2::y()].map(|axis| {
            let mut equation = Equation::new(gap.dot(&axis), Unit::Length);
            equation.by_slave = axis;
            equation.by_end = -axis;
            equation.by_unknowns[4] = -tangent.dot(&axis);
            equation
        })
    }

    /// `η = 0`
    pub(super) fn no_couple(&self) -> [Equation; 2] {
        let couple = self.unknowns.couple;
        [
            Equation::vanishing(2, couple.x, 1.0, Unit::Force),
            Equation::vanishing(3, couple.y, 1.0, Unit::Force),
        ]
    }
}
