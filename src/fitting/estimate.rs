//! Uncertainty of the parameters of a fit.

use nalgebra::DMatrix;

use super::student_quantile;

#[derive(Clone, Debug, PartialEq)]
pub struct Estimate {
    /// Standard deviation of a weighted residual: `√(S/f)` with the sum of squares `S` and the degrees of freedom `f`.
    pub deviation: f64,
    /// Degrees of freedom: number of residuals minus number of free parameters.
    pub freedom: usize,
    pub covariance: Vec<Vec<f64>>,
}

impl Estimate {
    /// Estimate from the derivatives `J` of the weighted residuals at the minimum: covariance `s² (JᵀJ)⁻¹` with the residual variance `s²`.
    /// `squares` is the sum of the squared residuals. A parameter that is not `free`, because it is at a bound, counts as known.
    /// The estimate is `None` without degrees of freedom, or if columns of the derivatives are linearly dependent.
    /// Covariances of a parameter on which no residual depends are NaN.
    pub fn of(derivatives: &DMatrix<f64>, squares: f64, free: &[bool]) -> Option<Self> {
        let columns: Vec<usize> = (0..free.len()).filter(|at| free[*at]).collect();
        let freedom = derivatives.nrows().checked_sub(columns.len()).filter(|left| *left > 0)?;
        let chosen = derivatives.select_columns(&columns);
        // The columns are normalised, because the sizes of the parameters may differ by orders of magnitude.
        let sizes: Vec<f64> = chosen.column_iter().map(|column| column.norm()).collect();
        let scaled = DMatrix::from_fn(chosen.nrows(), chosen.ncols(), |row, column| {
            chosen[(row, column)] / sizes[column]
        });
        let factor = scaled.qr().r();
        let is_known = (0..columns.len()).all(|at| factor[(at, at)].abs() > 1e-10);
        let inverse = is_known.then(|| factor.try_inverse()).flatten()?;
        let product = &inverse * inverse.transpose();
        let variance = squares / freedom as f64;
        let mut covariance = vec![vec![0.0; free.len()]; free.len()];
        for (a, row) in columns.iter().enumerate() {
            for (b, column) in columns.iter().enumerate() {
                covariance[*row][*column] = variance * product[(a, b)] / (sizes[a] * sizes[b]);
            }
        }
        for at in (0..free.len()).filter(|at| derivatives.column(*at).iter().all(|of| *of == 0.0)) {
            covariance[at].fill(f64::NAN);
            covariance.iter_mut().for_each(|row| row[at] = f64::NAN);
        }
        Some(Self { deviation: variance.sqrt(), freedom, covariance })
    }

    /// Returns the standard error of a parameter; `None` if no residual depends on it.
    pub fn error(&self, parameter: usize) -> Option<f64> {
        Some(self.covariance[parameter][parameter].sqrt()).filter(|error| !error.is_nan())
    }

    /// Half width of the confidence interval of a parameter by Student's distribution; `None` if no residual depends on the parameter.
    /// `probability` is the confidence level, for example 0.95.
    pub fn half_width(&self, parameter: usize, probability: f64) -> Option<f64> {
        let quantile = student_quantile(0.5 + probability / 2.0, self.freedom as f64);
        Some(self.error(parameter)? * quantile)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn standard_errors_of_a_straight_line_agree_with_textbooks() {
        let x = [0.0, 1.0, 2.0, 3.0, 4.0];
        let derivatives =
            DMatrix::from_fn(5, 2, |row, column| if column == 0 { 1.0 } else { x[row] });
        let squares = 0.3;
        let found = Estimate::of(&derivatives, squares, &[true, true]).unwrap();
        let variance: f64 = squares / 3.0;
        let error = |at: usize| found.error(at).unwrap();
        assert!((error(1) - (variance / 10.0).sqrt()).abs() < 1e-14);
        assert!((error(0) - (variance * (1.0 / 5.0 + 4.0 / 10.0)).sqrt()).abs() < 1e-14);
        let widened = found.half_width(1, 0.95).unwrap() / error(1);
        assert!((widened - 3.182_446_305_284_26).abs() < 1e-9);
        let same = DMatrix::from_element(5, 2, 1.0);
        assert!(Estimate::of(&same, squares, &[true, true]).is_none());
        assert!(Estimate::of(&same, squares, &[true, false]).is_some());
        let without = DMatrix::from_fn(5, 2, |_, column| if column == 0 { 1.0 } else { 0.0 });
        let found = Estimate::of(&without, squares, &[true, false]).unwrap();
        assert!(found.error(0).is_some() && found.error(1).is_none());
    }
}
