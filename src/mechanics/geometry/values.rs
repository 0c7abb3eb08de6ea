//! Basis functions that are nonzero at a parameter, with all derivatives.

use super::{MAX_DEGREE, Vec2};

/// Largest number of nonzero functions on a span, and largest number of derivative orders.
const WIDTH: usize = MAX_DEGREE + 1;

/// One value for each nonzero function of a span. Only the first `degree + 1` values are used.
pub(super) type FunctionRow = [f64; WIDTH];

const ZERO: FunctionRow = [0.0; WIDTH];

/// The `degree + 1` nonzero basis functions of one span at one parameter, with all their derivatives with respect to ξ [-].
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct BasisValues {
    /// Index of the first nonzero basis function.
    pub first: usize,
    degree: usize,
    /// Derivatives of the basis functions with respect to ξ. Row `k` contains the derivatives of order `k`.
    rows: [FunctionRow; WIDTH],
}

impl BasisValues {
    pub(super) fn zeros(first: usize, degree: usize) -> Self {
        Self { first, degree, rows: [ZERO; WIDTH] }
    }

    pub(crate) fn constant(index: usize) -> Self {
        let mut values = Self::zeros(index, 0);
        values.rows[0][0] = 1.0;
        values
    }

    pub(super) fn rows_mut(&mut self) -> &mut [FunctionRow] {
        &mut self.rows[..=self.degree]
    }

    /// Values of the `degree + 1` nonzero basis functions. The values sum to one.
    pub fn values(&self) -> &[f64] {
        self.derivatives(0)
    }

    /// First derivatives of the `degree + 1` nonzero basis functions with respect to the parameter. The derivatives sum to zero.
    pub fn slopes(&self) -> &[f64] {
        self.derivatives(1)
    }

    /// Derivatives of the given `order` of the `degree + 1` nonzero basis functions with respect to ξ; zero for orders above the degree.
    pub fn derivatives(&self, order: usize) -> &[f64] {
        let row = if order <= self.degree { &self.rows[order] } else { &ZERO };
        &row[..=self.degree]
    }

    /// Derivative of the given order of a curve with one point per basis function, in the unit of the points.
    ///
    /// # Panics
    /// Panics if there are fewer points than basis functions.
    pub(crate) fn combine(&self, order: usize, points: &[Vec2]) -> Vec2 {
        combine(order, self.derivatives(order), &points[self.first..])
    }
}

fn combine(order: usize, derivatives: &[f64], points: &[Vec2]) -> Vec2 {
    let points = &points[..derivatives.len()];
    // The derivatives sum to zero, so the origin affects only the rounding error, which is smallest for an origin near the points.
    let origin = if order == 0 { Vec2::zeros() } else { points[0] };
    derivatives.iter().zip(points).map(|(n, point)| *n * (point - origin)).sum()
}

pub(super) const LOW_ORDERS: usize = 3;

#[derive(Debug, Clone, Copy)]
pub(super) struct LowDerivatives<const WIDTH: usize> {
    pub first: usize,
    degree: usize,
    rows: [[f64; WIDTH]; LOW_ORDERS + 1],
}

impl<const WIDTH: usize> LowDerivatives<WIDTH> {
    pub fn zeros(first: usize, degree: usize) -> Self {
        Self { first, degree, rows: [[0.0; WIDTH]; LOW_ORDERS + 1] }
    }

    pub fn rows_mut(&mut self) -> &mut [[f64; WIDTH]] {
        &mut self.rows
    }

    pub fn values(&self) -> &[f64] {
        self.derivatives(0)
    }

    pub fn slopes(&self) -> &[f64] {
        self.derivatives(1)
    }

    pub fn bends(&self) -> &[f64] {
        self.derivatives(2)
    }

    fn derivatives(&self, order: usize) -> &[f64] {
        &self.rows[order][..=self.degree]
    }

    pub fn combine(&self, points: &[Vec2]) -> [Vec2; 3] {
        [0, 1, 2].map(|order| combine(order, self.derivatives(order), &points[self.first..]))
    }

    pub fn of_function(&self, at: usize) -> [f64; LOW_ORDERS + 1] {
        self.rows.map(|row| row[at])
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn derivatives_above_the_degree_are_zero() {
        let mut values = BasisValues::zeros(4, 2);
        values.rows_mut().fill([7.0; WIDTH]);
        assert_eq!(values.values(), [7.0; 3]);
        assert_eq!(values.derivatives(2), [7.0; 3]);
        assert_eq!(values.derivatives(3), [0.0; 3]);
        assert_eq!(values.derivatives(1000), [0.0; 3]);
    }

    #[test]
    fn combination_uses_the_control_points_of_the_span() {
        let mut values = BasisValues::zeros(1, 1);
        values.rows_mut()[0][..2].copy_from_slice(&[0.25, 0.75]);
        values.rows_mut()[1][..2].copy_from_slice(&[-1.0, 1.0]);
        let points = [Vec2::new(9.0, 9.0), Vec2::new(0.0, 4.0), Vec2::new(4.0, 0.0)];
        assert_eq!(values.combine(0, &points), Vec2::new(3.0, 1.0));
        assert_eq!(values.combine(1, &points), Vec2::new(4.0, -4.0));
    }
}
