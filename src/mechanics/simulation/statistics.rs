//! Statistics of a column over time: extremes, means, derivatives and crossings.
//!
//! Columns are interpolated linearly between rows. Integrals are exact for linear interpolation.

/// Time series of a quantity, with nondecreasing times.
#[derive(Debug, Clone, PartialEq)]
pub struct TimeSeries {
    /// Times of the values [time].
    pub times: Vec<f64>,
    /// Values, one for each time.
    pub values: Vec<f64>,
}

/// Summary statistics of a quantity over time.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Summary {
    /// Smallest value of the quantity.
    pub min: f64,
    /// Time at which the smallest value first occurs [time].
    pub min_at: f64,
    /// Largest value of the quantity.
    pub max: f64,
    /// Time at which the largest value first occurs [time].
    pub max_at: f64,
    /// Time average `∫ f dt / T` of the quantity `f` over the duration `T`.
    pub mean: f64,
    /// Root mean square `√(∫ f² dt / T)` of the quantity `f` over the duration `T`.
    pub rms: f64,
    /// Integral `∫ f dt` of the quantity `f` over time.
    pub integral: f64,
}

impl TimeSeries {
    /// Extremes, means and integral of the column; `None` if the column is empty. If any value is NaN, all results except the times are NaN.
    pub fn summary(&self) -> Option<Summary> {
        let first = (*self.values.first()?, *self.times.first()?);
        let rows = || self.values.iter().copied().zip(self.times.iter().copied());
        let extreme =
            |is_better: fn(f64, f64) -> bool| {
                rows().fold(first, |best, row| {
                    if is_better(row.0, best.0) || row.0.is_nan() { row } else { best }
                })
            };
        let ((min, min_at), (max, max_at)) = (extreme(|a, b| a < b), extreme(|a, b| a > b));
        let (mut integral, mut square, mut duration) = (0.0, 0.0, 0.0);
        for (dt, a, b) in self.pieces() {
            integral += 0.5 * dt * (a + b);
            square += dt * (a * a + a * b + b * b) / 3.0;
            duration += dt;
        }
        let (mean, rms) = match duration {
            0.0 => (first.0, first.0.abs()),
            duration => (integral / duration, (square / duration).sqrt()),
        };
        Some(Summary { min, min_at, max, max_at, mean, rms, integral })
    }

    fn pieces(&self) -> impl Iterator<Item = (f64, f64, f64)> + '_ {
        let pairs = self.times.windows(2).zip(self.values.windows(2));
        pairs.map(|(times, values)| (times[1] - times[0], values[0], values[1]))
    }

    /// First derivative with respect to time at every row, accurate to second order also for uneven spacing.
    /// The derivative at a row is the slope of the parabola through the row and its neighbours.
    /// In the first and the last row, the parabola passes through the row and the next two rows on its side.
    /// A jump consists of two rows of equal time. Each row of a jump uses the rows on its side of the jump.
    /// With two rows only, the derivative is their difference quotient. For a single row, it is NaN.
    pub fn derivative(&self) -> Vec<f64> {
        let count = self.values.len();
        let slope = |a: usize, b: usize| {
            (self.values[b] - self.values[a]) / (self.times[b] - self.times[a])
        };
        let step = |a: usize, b: usize| self.times[b] - self.times[a];
        let joined = |a: usize, b: usize| step(a, b) > 0.0;
        let parabola = |a: usize, b: usize, c: usize, at: usize| {
            let (before, behind) = (slope(a, b), slope(b, c));
            let bend = (behind - before) / step(a, c);
            before + bend * (2.0 * self.times[at] - self.times[a] - self.times[b])
        };
        let at = |row: usize| {
            let has_before = row > 0 && joined(row - 1, row);
            let has_behind = row + 1 < count && joined(row, row + 1);
            match (has_before, has_behind) {
                (true, true) => parabola(row - 1, row, row + 1, row),
                (false, true) if row + 2 < count && joined(row + 1, row + 2) => {
                    parabola(row, row + 1, row + 2, row)
                }
                (true, false) if row > 1 && joined(row - 2, row - 1) => {
                    parabola(row - 2, row - 1, row, row)
                }
                (false, true) => slope(row, row + 1),
                (true, false) => slope(row - 1, row),
                (false, false) => f64::NAN,
            }
        };
        (0..count).map(at).collect()
    }

    /// Times at which the column crosses a level in either direction. A value that touches the level is not a crossing.
    pub fn crossings(&self, level: f64) -> Vec<f64> {
        let mut found = Vec::new();
        let (mut side, mut on_level) = (0.0, None);
        let mut before: Option<(f64, f64)> = None;
        for (&time, &value) in self.times.iter().zip(&self.values) {
            let above = value - level;
            if above == 0.0 {
                on_level = on_level.or(Some(time));
            } else {
                if above * side < 0.0 {
                    let between = |(t, v): (f64, f64)| t + (time - t) * v / (v - above);
                    found.push(on_level.unwrap_or_else(|| before.map_or(time, between)));
                }
                (side, on_level) = (above.signum(), None);
            }
            before = Some((time, above));
        }
        found
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn series(rows: &[(f64, f64)]) -> TimeSeries {
        let (times, values) = rows.iter().copied().unzip();
        TimeSeries { times, values }
    }

    #[test]
    fn summary_of_a_piecewise_linear_series_is_exact() {
        let of = series(&[(0.0, 0.0), (1.0, 2.0), (3.0, -2.0), (3.0, 1.0), (4.0, 1.0)]);
        let Summary { min, min_at, max, max_at, mean, rms, integral } = of.summary().unwrap();
        assert_eq!((min, min_at, max, max_at), (-2.0, 3.0, 2.0, 1.0));
        assert_eq!((integral, mean), (2.0, 0.5));
        let square = 4.0 / 3.0 + 2.0 * 4.0 / 3.0 + 1.0;
        assert!((rms - (square / 4.0_f64).sqrt()).abs() < 1e-15);
        assert_eq!(series(&[]).summary(), None);
        assert_eq!(series(&[(1.0, -3.0)]).summary().map(|of| (of.mean, of.rms)), Some((-3.0, 3.0)));
        let lost = series(&[(0.0, 1.0), (1.0, f64::NAN), (2.0, 1.0)]).summary().unwrap();
        assert!(lost.min.is_nan() && lost.max.is_nan() && lost.mean.is_nan());
    }

    #[test]
    fn derivative_of_a_parabola_is_exact_at_uneven_rows() {
        let times = [0.0, 0.3, 0.4, 1.0, 1.5];
        let of = series(&times.map(|t| (t, 2.0 * t * t - t)));
        for (found, t) in of.derivative().iter().zip(times) {
            assert!((found - (4.0 * t - 1.0)).abs() < 1e-13, "{found} at {t}");
        }
        let jump = series(&[(0.0, 0.0), (1.0, 1.0), (1.0, 5.0), (2.0, 3.0)]);
        assert_eq!(jump.derivative(), [1.0, 1.0, -2.0, -2.0]);
        assert!(series(&[(0.0, 1.0)]).derivative()[0].is_nan());
    }

    #[test]
    fn touching_a_level_is_not_a_crossing() {
        let of =
            series(&[(0.0, -1.0), (1.0, 1.0), (2.0, 0.0), (3.0, 1.0), (4.0, 0.0), (5.0, -2.0)]);
        assert_eq!(of.crossings(0.0), [0.5, 4.0]);
        assert_eq!(of.crossings(-1.5), [4.75]);
        assert_eq!(of.crossings(9.0), [0.0; 0]);
    }
}
