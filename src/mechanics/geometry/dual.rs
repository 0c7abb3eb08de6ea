//! Dual numbers: values with derivatives (forward differentiation).

use std::ops::{Add, Div, Mul, Neg, Sub};

use super::Vec2;

/// Number with its derivatives with respect to `SLOPES` variables.
///
/// Numbers with and without derivatives are computed by the same operations, so that their values agree to the last bit.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Dual<const SLOPES: usize> {
    pub value: f64,
    pub slopes: [f64; SLOPES],
}

#[derive(Debug, Clone, Copy)]
pub(crate) struct DualVector<const SLOPES: usize> {
    pub x: Dual<SLOPES>,
    pub y: Dual<SLOPES>,
}

impl<const SLOPES: usize> Dual<SLOPES> {
    pub fn constant(value: f64) -> Self {
        Self { value, slopes: [0.0; SLOPES] }
    }

    /// Dual number of the variable with the index `at`: its derivative with respect to this variable is one.
    pub fn variable(value: f64, at: usize) -> Self {
        let mut variable = Self::constant(value);
        variable.add_slope(at, 1.0);
        variable
    }

    pub fn add_slope(&mut self, at: usize, slope: f64) {
        if let Some(own) = self.slopes.get_mut(at) {
            *own += slope;
        }
    }

    pub fn inverse(self) -> Self {
        let value = 1.0 / self.value;
        Self { value, slopes: self.slopes.map(|slope| -slope * value * value) }
    }

    /// Square root. Its derivatives at zero are zero.
    pub fn sqrt(self) -> Self {
        let value = self.value.sqrt();
        let by = if value > 0.0 { 0.5 / value } else { 0.0 };
        Self { value, slopes: self.slopes.map(|slope| by * slope) }
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

impl<const SLOPES: usize> Div for Dual<SLOPES> {
    type Output = Self;

    fn div(self, other: Self) -> Self {
        let value = self.value / other.value;
        let (by_self, by_other) = (1.0 / other.value, -value / other.value);
        let slopes = std::array::from_fn(|k| by_self * self.slopes[k] + by_other * other.slopes[k]);
        Self { value, slopes }
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

    pub fn variable(value: Vec2, first: usize) -> Self {
        Self { x: Dual::variable(value.x, first), y: Dual::variable(value.y, first + 1) }
    }

    pub fn value(&self) -> Vec2 {
        Vec2::new(self.x.value, self.y.value)
    }

    pub fn dot(&self, other: &Self) -> Dual<SLOPES> {
        self.x * other.x + self.y * other.y
    }

    pub fn norm(&self) -> Dual<SLOPES> {
        self.dot(self).sqrt()
    }

    pub fn cross(&self, other: &Self) -> Dual<SLOPES> {
        self.x * other.y - self.y * other.x
    }

    pub fn turned(&self) -> Self {
        Self { x: -self.y, y: self.x }
    }

    /// Vector whose scalar products with two given vectors are `alpha` and `beta`.
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
