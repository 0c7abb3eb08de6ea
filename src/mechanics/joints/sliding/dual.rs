//! Variables of the equations of a sliding contact as dual numbers.

use super::contact::PathVector;
use super::{Contact, ContactUnknowns, Equation, Unit};
use crate::geometry::{Dual, DualVector, Vec2};

/// Number of derivatives of a dual number: one for each variable of the contact equations.
pub(super) const ALL_SLOPES: usize = 11;

/// Number of derivatives if only the values of the equations are needed.
pub(super) const NO_SLOPES: usize = 0;

const OFFSET: usize = 0;
const TANGENT: usize = 2;
const SWING: usize = 4;
const FORCE: usize = 6;
const COUPLE: usize = 8;
const WAY: usize = 10;

#[derive(Debug, Clone, Copy)]
pub(super) struct ContactDuals<const SLOPES: usize> {
    pub offset: DualVector<SLOPES>,
    pub tangent: DualVector<SLOPES>,
    pub tangent_change: DualVector<SLOPES>,
    pub force: DualVector<SLOPES>,
    pub couple: DualVector<SLOPES>,
    pub increment: Dual<SLOPES>,
}

impl<const SLOPES: usize> ContactDuals<SLOPES> {
    pub fn of(contact: &Contact<'_>) -> Self {
        let ContactUnknowns { force, couple, increment: way } = contact.unknowns;
        let end = contact.end_point();
        let offset = PathVector { value: contact.slave_movement - end.value, by_end: -end.by_end };
        let constant = |value: Vec2| PathVector { value, by_end: Vec2::zeros() };
        Self {
            offset: path_variable(offset, OFFSET),
            tangent: path_variable(contact.tangent(), TANGENT),
            tangent_change: path_variable(contact.tangent_change(), SWING),
            force: path_variable(constant(force), FORCE),
            couple: path_variable(constant(couple), COUPLE),
            increment: path_dual(way, 1.0),
        }
    }
}

pub(super) fn path_dual<const SLOPES: usize>(value: f64, by_way: f64) -> Dual<SLOPES> {
    let mut dual = Dual::constant(value);
    dual.add_slope(WAY, by_way);
    dual
}

fn path_variable<const SLOPES: usize>(vector: PathVector, first: usize) -> DualVector<SLOPES> {
    let component = |value: f64, by_way: f64, at: usize| {
        let mut dual = path_dual(value, by_way);
        dual.add_slope(at, 1.0);
        dual
    };
    DualVector {
        x: component(vector.value.x, vector.by_end.x, first),
        y: component(vector.value.y, vector.by_end.y, first + 1),
    }
}

impl Dual<ALL_SLOPES> {
    pub fn vanishes(self, unit: Unit) -> Equation {
        let pair = |at: usize| Vec2::new(self.slopes[at], self.slopes[at + 1]);
        Equation {
            by_slave: pair(OFFSET),
            by_end: -pair(OFFSET),
            by_difference: pair(TANGENT) * 0.5 + pair(SWING) * 0.25,
            by_unknowns: ContactUnknowns {
                force: pair(FORCE),
                couple: pair(COUPLE),
                increment: self.slopes[WAY],
            },
            ..Equation::new(self.value, unit)
        }
    }
}
