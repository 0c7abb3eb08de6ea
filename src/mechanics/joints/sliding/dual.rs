//! Dual numbers: values with the derivatives that the equations of a contact need (forward differentiation).

use std::ops::{Add, Mul, Neg, Sub};

use super::contact::PathVector;
use super::{Contact, ContactUnknowns, Equation, Unit};
use crate::geometry::Vec2;

/// Number of derivatives of a dual number: one for each variable of the contact equations.
pub(super) const ALL_SLOPES: usize = 11;

/// Number of derivatives of a dual number that is only a value.
/// Values and dual numbers are computed by the same operations, so that both agree to the last bit.
pub(super) const NO_SLOPES: usize = 0;

const OFFSET: usize = 0;
const TANGENT: usize = 2;
const SWING: usize = 4;
const FORCE: usize = 6;
const COUPLE: usize = 8;
const WAY: usize = 10;

/// Number with its derivatives with respect to the variables of the contact equations.
/// The number of derivatives is [`ALL_SLOPES`] or [`NO_SLOPES`].
#[derive(Debug, Clone, Copy)]
pub(super) struct Dual<const SLOPES: usize> {
    pub value: f64,
    slopes: [f64; SLOPES],
}

#[derive(Debug, Clone, Copy)]
pub(super) struct DualVector<const SLOPES: usize> {
    pub x: Dual<SLOPES>,
    pub y: Dual<SLOPES>,
}

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
            offset: DualVector::variable(offset, OFFSET),
            tangent: DualVector::variable(contact.tangent(), TANGENT),
            tangent_change: DualVector::variable(contact.tangent_change(), SWING),
            force: DualVector::variable(constant(force), FORCE),
            couple: DualVector::variable(constant(couple), COUPLE),
            increment: Dual::path_dual(way, 1.0),
        }
    }
}

impl<const SLOPES: usize> Dual<SLOPES> {
    pub fn constant(value: f64) -> Self {
        Self { value, slopes: [0.0; SLOPES] }
    }

    pub fn path_dual(value: f64, by_way: f64) -> Self {
        let mut jet = Self::constant(value);
        jet.add_slope(WAY, by_way);
        jet
    }

    fn add_slope(&mut self, at: usize, slope: f64) {
        if let Some(own) = self.slopes.get_mut(at) {
            *own += slope;
        }
    }

    pub fn inverse(self) -> Self {
        let value = 1.0 / self.value;
        Self { value, slopes: self.slopes.map(|slope| -slope * value * value) }
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

impl<const SLOPES: usize> Add for Dual<SLOPES> {
    type Output = Self;

    fn add(self, other: Self) -> Self {
        let slopes = std::array::from_fn(|k| self.slopes[k] + other.slopes[k]);
        Self { value: self.value + other.value, slopes }
    }
}

impl<const SLOPES: usize> Neg for Dual<SLOPES> {
    type Output = Self;

    fn neg(self) -> Self {
        self * -1.0
    }
}

impl<const SLOPES: usize> Sub for Dual<SLOPES> {
    type Output = Self;

    fn sub(self, other: Self) -> Self {
        self + -other
    }
}

impl<const SLOPES: usize> Mul for Dual<SLOPES> {
    type Output = Self;

    fn mul(self, other: Self) -> Self {
        let (by_self, by_other) = (self * other.value, other * self.value);
        Self { value: by_self.value, ..by_self + by_other }
    }
}

impl<const SLOPES: usize> Mul<f64> for Dual<SLOPES> {
    type Output = Self;

    fn mul(self, factor: f64) -> Self {
        Self { value: self.value * factor, slopes: self.slopes.map(|slope| slope * factor) }
    }
}

impl<const SLOPES: usize> DualVector<SLOPES> {
    pub fn constant(value: Vec2) -> Self {
        Self { x: Dual::constant(value.x), y: Dual::constant(value.y) }
    }

    fn variable(vector: PathVector, first: usize) -> Self {
        let component = |value: f64, by_way: f64, at: usize| {
            let mut jet = Dual::path_dual(value, by_way);
            jet.add_slope(at, 1.0);
            jet
        };
        Self {
            x: component(vector.value.x, vector.by_end.x, first),
            y: component(vector.value.y, vector.by_end.y, first + 1),
        }
    }

    pub fn value(&self) -> Vec2 {
        Vec2::new(self.x.value, self.y.value)
    }

    pub fn dot(&self, other: &Self) -> Dual<SLOPES> {
        self.x * other.x + self.y * other.y
    }

    pub fn cross(&self, other: &Self) -> Dual<SLOPES> {
        self.x * other.y - self.y * other.x
    }

    pub fn turned(&self) -> Self {
        Self { x: -self.y, y: self.x }
    }

    pub fn with_products([a, b]: [Self; 2], [alpha, beta]: [Dual<SLOPES>; 2]) -> Self {
        let determinant = a.cross(&b).inverse();
        (a.turned() * beta - b.turned() * alpha) * determinant
    }
}

impl<const SLOPES: usize> Add for DualVector<SLOPES> {
    type Output = Self;

    fn add(self, other: Self) -> Self {
        Self { x: self.x + other.x, y: self.y + other.y }
    }
}

impl<const SLOPES: usize> Sub for DualVector<SLOPES> {
    type Output = Self;

    fn sub(self, other: Self) -> Self {
        Self { x: self.x - other.x, y: self.y - other.y }
    }
}

impl<const SLOPES: usize> Mul<Dual<SLOPES>> for DualVector<SLOPES> {
    type Output = Self;

    fn mul(self, factor: Dual<SLOPES>) -> Self {
        Self { x: self.x * factor, y: self.y * factor }
    }
}

impl<const SLOPES: usize> Mul<f64> for DualVector<SLOPES> {
    type Output = Self;

    fn mul(self, factor: f64) -> Self {
        Self { x: self.x * factor, y: self.y * factor }
    }
}
