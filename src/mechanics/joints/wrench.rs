//! Force with a couple.

use std::ops::{Add, AddAssign, Mul, Neg, SubAssign};

use crate::geometry::Vec2;

/// Force with a couple, or a quantity that is conjugate to it.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Wrench {
    /// Force [force].
    pub force: Vec2,
    /// Couple, counter-clockwise [force·length].
    pub couple: f64,
}

impl Wrench {
    /// Sum of the products of forces and couples; the power, if the other quantity contains velocities.
    pub fn dot(&self, other: &Self) -> f64 {
        self.force.dot(&other.force) + self.couple * other.couple
    }
}

impl From<Vec2> for Wrench {
    fn from(force: Vec2) -> Self {
        Self { force, couple: 0.0 }
    }
}

impl Add for Wrench {
    type Output = Self;

    fn add(self, other: Self) -> Self {
        Self { force: self.force + other.force, couple: self.couple + other.couple }
    }
}

impl Mul<f64> for Wrench {
    type Output = Self;

    fn mul(self, factor: f64) -> Self {
        Self { force: self.force * factor, couple: self.couple * factor }
    }
}

impl Neg for Wrench {
    type Output = Self;

    fn neg(self) -> Self {
        Self { force: -self.force, couple: -self.couple }
    }
}

impl AddAssign for Wrench {
    fn add_assign(&mut self, other: Self) {
        *self = *self + other;
    }
}

impl SubAssign for Wrench {
    fn sub_assign(&mut self, other: Self) {
        *self += -other;
    }
}
