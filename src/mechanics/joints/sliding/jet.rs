//! Numbers with their derivatives by what an equation of a contact depends on (forward differentiation).

use std::ops::{Add, Mul, Neg, Sub};

use super::contact::WayVector;
use super::{Contact, ContactUnknowns, Equation, Unit};
use crate::geometry::Vec2;

/// How many numbers an equation of a contact depends on: offset of the slave, tangent, swing, `λ`, couple and way.
const COUNT: usize = 11;

const OFFSET: usize = 0;
const TANGENT: usize = 2;
const SWING: usize = 4;
const FORCE: usize = 6;
const COUPLE: usize = 8;
const WAY: usize = 10;

/// A number of a contact with its derivatives by the offset of the slave from the smooth axis, the mean tangent `τ` and the swing `d` of the master, the
/// force `λ`, the couple and the way `Δξ`.
#[derive(Debug, Clone, Copy)]
pub(super) struct Jet {
    pub value: f64,
    slopes: [f64; COUNT],
}

/// A vector of a contact with the derivatives of both components.
#[derive(Debug, Clone, Copy)]
pub(super) struct JetVector {
    x: Jet,
    y: Jet,
}

/// What the equations of a contact are made of.
#[derive(Debug, Clone, Copy)]
pub(super) struct ContactJets {
    /// How far the slave is from the smooth axis at the end of the step, `x_s1 - Σ B_i(ξ1) x_i1` [length].
    pub offset: JetVector,
    /// The mean tangent `τ` [length].
    pub tangent: JetVector,
    /// The swing `d` [length].
    pub swing: JetVector,
    /// The contact force `λ` on the master [force].
    pub force: JetVector,
    /// The couple of the contact [force].
    pub couple: JetVector,
    /// The way `Δξ` [-].
    pub way: Jet,
}

impl ContactJets {
    pub fn of(contact: &Contact<'_>) -> Self {
        let ContactUnknowns { force, couple, way } = contact.unknowns;
        let end = contact.end_point();
        let offset = WayVector { value: contact.slave_moved - end.value, by_way: -end.by_way };
        let constant = |value: Vec2| WayVector { value, by_way: Vec2::zeros() };
        Self {
            offset: JetVector::variable(offset, OFFSET),
            tangent: JetVector::variable(contact.tangent(), TANGENT),
            swing: JetVector::variable(contact.swing(), SWING),
            force: JetVector::variable(constant(force), FORCE),
            couple: JetVector::variable(constant(couple), COUPLE),
            way: Jet::along_way(way, 1.0),
        }
    }
}

impl Jet {
    pub fn constant(value: f64) -> Self {
        Self { value, slopes: [0.0; COUNT] }
    }

    /// A number that depends on the way only, with its derivative by that.
    pub fn along_way(value: f64, by_way: f64) -> Self {
        let mut slopes = [0.0; COUNT];
        slopes[WAY] = by_way;
        Self { value, slopes }
    }

    pub fn inverse(self) -> Self {
        let value = 1.0 / self.value;
        Self { value, slopes: self.slopes.map(|slope| -slope * value * value) }
    }

    /// The equation that the number vanishes.
    pub fn vanishes(self, unit: Unit) -> Equation {
        let pair = |at: usize| Vec2::new(self.slopes[at], self.slopes[at + 1]);
        Equation {
            by_slave: pair(OFFSET),
            by_end: -pair(OFFSET),
            by_difference: pair(TANGENT) * 0.5 + pair(SWING) * 0.25,
            by_unknowns: ContactUnknowns {
                force: pair(FORCE),
                couple: pair(COUPLE),
                way: self.slopes[WAY],
            },
            ..Equation::new(self.value, unit)
        }
    }
}

impl Add for Jet {
    type Output = Self;

    fn add(self, other: Self) -> Self {
        let slopes = std::array::from_fn(|k| self.slopes[k] + other.slopes[k]);
        Self { value: self.value + other.value, slopes }
    }
}

impl Neg for Jet {
    type Output = Self;

    fn neg(self) -> Self {
        self * -1.0
    }
}

impl Sub for Jet {
    type Output = Self;

    fn sub(self, other: Self) -> Self {
        self + -other
    }
}

impl Mul for Jet {
    type Output = Self;

    fn mul(self, other: Self) -> Self {
        let (by_self, by_other) = (self * other.value, other * self.value);
        Self { value: by_self.value, ..by_self + by_other }
    }
}

impl Mul<f64> for Jet {
    type Output = Self;

    fn mul(self, factor: f64) -> Self {
        Self { value: self.value * factor, slopes: self.slopes.map(|slope| slope * factor) }
    }
}

impl JetVector {
    pub fn constant(value: Vec2) -> Self {
        Self { x: Jet::constant(value.x), y: Jet::constant(value.y) }
    }

    fn variable(vector: WayVector, first: usize) -> Self {
        let component = |value: f64, by_way: f64, at: usize| {
            let mut jet = Jet::along_way(value, by_way);
            jet.slopes[at] += 1.0;
            jet
        };
        Self {
            x: component(vector.value.x, vector.by_way.x, first),
            y: component(vector.value.y, vector.by_way.y, first + 1),
        }
    }

    pub fn value(&self) -> Vec2 {
        Vec2::new(self.x.value, self.y.value)
    }

    pub fn dot(&self, other: &Self) -> Jet {
        self.x * other.x + self.y * other.y
    }

    pub fn cross(&self, other: &Self) -> Jet {
        self.x * other.y - self.y * other.x
    }

    /// The vector turned by a right angle, `J a`.
    pub fn turned(&self) -> Self {
        Self { x: -self.y, y: self.x }
    }

    /// The equations that both components vanish.
    pub fn vanish(self, unit: Unit) -> [Equation; 2] {
        [self.x.vanishes(unit), self.y.vanishes(unit)]
    }

    /// The vector `p` with `a·p = α` and `b·p = β`.
    pub fn with_products([a, b]: [Self; 2], [alpha, beta]: [Jet; 2]) -> Self {
        let determinant = a.cross(&b).inverse();
        (a.turned() * beta - b.turned() * alpha) * determinant
    }
}

impl Add for JetVector {
    type Output = Self;

    fn add(self, other: Self) -> Self {
        Self { x: self.x + other.x, y: self.y + other.y }
    }
}

impl Sub for JetVector {
    type Output = Self;

    fn sub(self, other: Self) -> Self {
        Self { x: self.x - other.x, y: self.y - other.y }
    }
}

impl Mul<Jet> for JetVector {
    type Output = Self;

    fn mul(self, factor: Jet) -> Self {
        Self { x: self.x * factor, y: self.y * factor }
    }
}

impl Mul<f64> for JetVector {
    type Output = Self;

    fn mul(self, factor: f64) -> Self {
        Self { x: self.x * factor, y: self.y * factor }
    }
}
