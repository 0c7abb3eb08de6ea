//! History of a run, step by step.

use serde::{Deserialize, Serialize};

use super::columns::{self, Column, ExtraColumn};
use crate::geometry::{Vec2, larger, smaller};
use crate::system::Measures;

/// Row of the history: energy and momenta at the end of a step, and statistics of the solver in this step.
#[derive(Debug, Clone, Copy, PartialEq, Default, Serialize, Deserialize)]
pub struct Sample {
    /// Energies, momenta, work and impulses at the end of the step.
    pub measures: Measures,
    /// Length of the step [time]; zero in the first row.
    pub dt: f64,
    /// Number of Newton iterations of the step. For variable steps, the iterations of the whole step and its two halves are added.
    pub newton_iterations: usize,
    /// Number of failed attempts at the step.
    pub retries: usize,
    /// Energy that dampers returned in the backward substep of the fourth-order method [energy]. This energy is not stored in files.
    #[serde(skip)]
    pub returned: f64,
}

/// Quantity that is constant if the energy, momentum or angular momentum supplied by loads and supports is subtracted.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Invariant {
    /// Energy `E` of the scene minus the work `W` of loads, drives and wind plus the dissipated energy `D` [energy].
    Energy,
    /// Momentum `p` minus the impulse of all external forces [mass·length/time].
    Momentum,
    /// Angular momentum `L` minus the angular impulse of all external forces [mass·length²/time].
    AngularMomentum,
    /// Largest distance between the partners of a joint, of a slider or of a rigid link [length].
    Gap,
}

impl Invariant {
    /// All invariants with their names.
    pub const ALL: [(&'static str, Self); 4] = [
        ("energy", Self::Energy),
        ("momentum", Self::Momentum),
        ("angular_momentum", Self::AngularMomentum),
        ("gap", Self::Gap),
    ];

    /// Value of the invariant in a row. A scalar invariant is the first component of the vector.
    pub fn value(self, row: &Measures) -> Vec2 {
        match self {
            Self::Energy => Vec2::new(row.energy.total() - row.work + row.dissipated, 0.0),
            Self::Momentum => row.momentum - row.impulse,
            Self::AngularMomentum => Vec2::new(row.angular_momentum - row.angular_impulse, 0.0),
            Self::Gap => Vec2::new(row.gap, 0.0),
        }
    }

    /// Description of the invariant in words and symbols, such as `energy E - W + D`.
    pub fn describe(self) -> &'static str {
        match self {
            Self::Energy => "energy E - W + D",
            Self::Momentum => "momentum p - ∫F dt",
            Self::AngularMomentum => "angular momentum L - ∫M dt",
            Self::Gap => "gap of joints",
        }
    }
}

/// Properties of a scene from which the smallest reference values of energy and momenta are computed. Drifts are fractions of reference values.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct DriftScales {
    /// Mass of the whole scene [mass].
    pub mass: f64,
    /// Length scale of the scene [length]; zero if the scene has no length scale, for example a single particle at the origin.
    pub length: f64,
    /// Rounding error of the strain energy [energy], which is the smallest scale of energy drifts.
    pub rounding_energy: f64,
}

/// History of a run: one row for each recorded time, in the order of time.
#[derive(Debug, Clone, Default)]
pub struct History {
    samples: Vec<Sample>,
    extra_columns: Vec<ExtraColumn>,
    extra: Vec<f64>,
    scales: DriftScales,
}

impl History {
    /// Standard columns.
    pub const COLUMNS: &'static [Column] = columns::FIXED;

    /// Creates an empty history with columns in addition to [`COLUMNS`](Self::COLUMNS).
    pub fn new(scales: DriftScales, extra_columns: Vec<ExtraColumn>) -> Self {
        Self { samples: Vec::new(), extra_columns, extra: Vec::new(), scales }
    }

    pub(crate) fn reserve(&mut self, rows: usize) {
        self.samples.reserve(rows);
        self.extra.reserve(rows * self.extra_columns.len());
    }

    /// Appends a row. `extra` contains the values of the additional columns in their order.
    ///
    /// # Panics
    /// Panics if the number of values differs from the number of additional columns.
    pub fn push(&mut self, sample: Sample, extra: impl Iterator<Item = f64>) {
        self.samples.push(sample);
        self.extra.extend(extra);
        let expected = self.samples.len() * self.extra_columns.len();
        assert_eq!(self.extra.len(), expected, "a row has one value for each extra column");
    }

    /// Keeps only the first `rows` rows of the history.
    pub fn truncate(&mut self, rows: usize) {
        self.samples.truncate(rows);
        self.extra.truncate(rows * self.extra_columns.len());
    }

    pub(super) fn extra_width(&self) -> usize {
        self.extra_columns.len()
    }

    pub(super) fn fill_in(&mut self, column: usize, value: f64) {
        if let Some(first) = self.extra.len().checked_sub(self.extra_columns.len()) {
            self.extra[first + column] = value;
        }
    }

    pub(super) fn extra_values(&self) -> &[f64] {
        &self.extra
    }

    pub(super) fn with_rows(&self, samples: Vec<Sample>, extra: Vec<f64>) -> Option<Self> {
        let fits = samples.len().checked_mul(self.extra_columns.len()) == Some(extra.len());
        let extra_columns = self.extra_columns.clone();
        fits.then_some(Self { samples, extra_columns, extra, scales: self.scales })
    }

    /// Rows of the history, without additional columns.
    pub fn samples(&self) -> &[Sample] {
        &self.samples
    }

    /// Returns the rows between two times, including rows at these times.
    pub fn between(&self, from: f64, to: f64) -> Self {
        let steps = self.samples.iter().map(|row| row.dt).filter(|dt| *dt > 0.0);
        let slack = 1e-9 * steps.reduce(f64::min).unwrap_or(0.0);
        let width = self.extra_columns.len();
        let mut inside = Self::new(self.scales, self.extra_columns.clone());
        for (index, row) in self.samples.iter().enumerate() {
            if row.measures.time >= from - slack && row.measures.time <= to + slack {
                inside.push(*row, self.extra[index * width..][..width].iter().copied());
            }
        }
        inside
    }

    /// Names and dimensions of the columns. The additional columns follow the standard columns.
    pub fn columns(&self) -> impl Iterator<Item = (&str, &'static str)> {
        let fixed = Self::COLUMNS.iter().map(|column| (column.name, column.dimension));
        let extra = self.extra_columns.iter().map(|column| (&*column.name, column.dimension));
        fixed.chain(extra)
    }

    /// Dimension of a column with a given name; `None` for an unknown name.
    pub fn dimension(&self, name: &str) -> Option<&'static str> {
        self.columns().find(|(other, _)| *other == name).map(|(_, dimension)| dimension)
    }

    /// Values of a column with a given name; `None` for an unknown name.
    pub fn column(&self, name: &str) -> Option<Vec<f64>> {
        if let Some(column) = Self::COLUMNS.iter().find(|column| column.name == name) {
            return Some(self.samples.iter().map(column.value).collect());
        }
        let index = self.extra_columns.iter().position(|column| column.name == name)?;
        let rows = self.extra.chunks_exact(self.extra_columns.len());
        Some(rows.map(|row| row[index]).collect())
    }

    /// Values of a column, each averaged with the value of the previous row.
    /// The first two values are not averaged, because quantities of a step, such as contact forces, have no value at the start.
    ///
    /// The average removes oscillations from step to step, and approximates the value in the middle of the step.
    pub fn averaged(&self, name: &str) -> Option<Vec<f64>> {
        let mut column = self.column(name)?;
        for row in (1..column.len()).rev().filter(|row| self.samples[row - 1].dt > 0.0) {
            column[row] = 0.5 * (column[row - 1] + column[row]);
        }
        Some(column)
    }

    /// Difference of an invariant from its value in the first row, divided by a scale.
    /// For the gap, the gap of each row is returned without a scale [length].
    ///
    /// The scale of the energy is the largest energy or work of all rows, at least the rounding error of the strain energy.
    /// The scale of the momentum is the larger of the exchanged impulses and `sqrt(2 m K)`, with the mass `m` and the largest kinetic energy `K`.
    /// The scale of the angular momentum is the largest of the angular momenta, the exchanged angular impulses, and `sqrt(2 m K)` times a length.
    pub fn drifts(&self, invariant: Invariant) -> Vec<f64> {
        let Some(first) = self.samples.first().map(|row| row.measures) else { return Vec::new() };
        let scale = self.scale(invariant, &first);
        let change = |row: &Measures| match invariant {
            Invariant::Gap => row.gap,
            _ => (invariant.value(row) - invariant.value(&first)).norm(),
        };
        let relative = |row: &Sample| match change(&row.measures) {
            0.0 => 0.0,
            change => change / scale,
        };
        self.samples.iter().map(relative).collect()
    }

    fn scale(&self, invariant: Invariant, first: &Measures) -> f64 {
        let largest = |value: &dyn Fn(&Measures) -> f64| {
            self.samples.iter().map(|row| value(&row.measures).abs()).fold(0.0, f64::max)
        };
        let DriftScales { mass, length, rounding_energy } = self.scales;
        let kinetic = largest(&|row| row.energy.kinetic).max(rounding_energy);
        let motion = (2.0 * mass * kinetic).sqrt();
        let length = if length > 0.0 { length } else { largest(&|row| row.time) * motion / mass };
        match invariant {
            Invariant::Energy => {
                largest(&|row| row.energy.kinetic + row.energy.strain + row.energy.stored)
                    .max(largest(&|row| row.energy.potential - first.energy.potential))
                    .max(largest(&|row| row.work - first.work))
                    .max(rounding_energy)
            }
            Invariant::Momentum => {
                motion.max(largest(&|row| row.gross_impulse - first.gross_impulse))
            }
            Invariant::AngularMomentum => (motion * length)
                .max(largest(&|row| row.angular_momentum))
                .max(largest(&|row| row.gross_angular_impulse - first.gross_angular_impulse)),
            Invariant::Gap => 1.0,
        }
    }

    /// Largest increase of the energy balance `E - W + D` above an earlier value, divided by the scale of [`drifts`](Self::drifts).
    /// `E` is the energy, `W` the work of loads, drives and wind, and `D` the dissipated energy.
    /// The largest increase is NaN if an energy is NaN or the history has no rows.
    pub fn energy_growth(&self) -> f64 {
        let Some(first) = self.samples.first().map(|row| row.measures) else { return f64::NAN };
        let mut least = f64::INFINITY;
        let rises = self.samples.iter().map(|row| {
            let energy = Invariant::Energy.value(&row.measures).x;
            least = smaller(least, energy);
            energy - least
        });
        match rises.fold(0.0, larger) {
            0.0 => 0.0,
            rise => rise / self.scale(Invariant::Energy, &first),
        }
    }

    /// Largest of the [`drifts`](Self::drifts) of an invariant; NaN if a drift is NaN or the history has no rows.
    pub fn drift(&self, invariant: Invariant) -> f64 {
        if self.samples.is_empty() {
            return f64::NAN;
        }
        self.drifts(invariant).into_iter().fold(0.0, larger)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::system::Energy;

    fn history(energies: &[f64]) -> History {
        history_with(vec![], energies)
    }

    fn history_with(extra: Vec<ExtraColumn>, energies: &[f64]) -> History {
        let width = extra.len();
        let scales = DriftScales { mass: 1.0, length: 1.0, rounding_energy: 0.0 };
        let mut history = History::new(scales, extra);
        for (index, &kinetic) in energies.iter().enumerate() {
            let measures = Measures {
                time: index as f64,
                energy: Energy { kinetic, ..Energy::default() },
                work: 1.0,
                ..Measures::default()
            };
            let extra = (1..=width).map(|column| (10 * column + index) as f64);
            history.push(
                Sample { measures, dt: 1.0, newton_iterations: 3, ..Sample::default() },
                extra,
            );
        }
        history
    }

    #[test]
    fn energy_drift_is_relative_to_the_largest_energy_of_the_window() {
        let history = history(&[2.0, 4.0, 4.0]);
        assert_eq!(history.drift(Invariant::Energy), 0.5);
        assert_eq!(history.between(1.0, f64::INFINITY).drift(Invariant::Energy), 0.0);
        assert_eq!(history.column("kinetic"), Some(vec![2.0, 4.0, 4.0]));
        assert_eq!(history.column("kinetics"), None);
    }

    #[test]
    fn energy_growth_is_the_largest_rise_above_an_earlier_value() {
        assert_eq!(history(&[4.0, 1.0, 3.0, 2.0, 2.5]).energy_growth(), 0.5);
        assert_eq!(history(&[4.0, 3.0, 3.0]).energy_growth(), 0.0);
        assert!(history(&[1.0, f64::NAN, 1.0]).energy_growth().is_nan());
        assert!(history(&[]).energy_growth().is_nan());
    }

    #[test]
    fn drift_of_a_run_with_nan_energy_is_nan() {
        assert!(history(&[1.0, f64::NAN, 1.0]).drift(Invariant::Energy).is_nan());
    }
    fn slider_columns() -> Vec<ExtraColumn> {
        let column = |name: &str, dimension| ExtraColumn { name: name.to_owned(), dimension };
        vec![column("slider.position", "-"), column("slider.force", "force")]
    }

    #[test]
    fn extra_columns_are_found_by_name_and_kept_by_windows() {
        let history = history_with(slider_columns(), &[1.0, 2.0, 3.0]);
        assert_eq!(history.column("slider.position"), Some(vec![10.0, 11.0, 12.0]));
        assert_eq!(history.column("kinetic"), Some(vec![1.0, 2.0, 3.0]));
        assert_eq!(history.column("slider"), None);
        let window = history.between(1.0, 2.0);
        assert_eq!(window.column("slider.force"), Some(vec![21.0, 22.0]));
        assert_eq!(history.between(5.0, 6.0).column("slider.force"), Some(vec![]));
    }

    #[test]
    fn extra_columns_are_listed_after_the_standard_columns() {
        let history = history_with(slider_columns(), &[]);
        let names: Vec<_> = history.columns().map(|(name, _)| name).collect();
        assert_eq!(names[..2], ["t", "kinetic"]);
        assert_eq!(names[History::COLUMNS.len()..], ["slider.position", "slider.force"]);
        assert_eq!(history.dimension("slider.force"), Some("force"));
        assert_eq!(history.dimension("work"), Some("energy"));
        assert_eq!(history.dimension("slider.energy"), None);
    }

    #[test]
    #[should_panic(expected = "one value for each extra column")]
    fn row_with_a_missing_value_panics() {
        let mut history = history_with(slider_columns(), &[]);
        history.push(Sample::default(), std::iter::once(1.0));
    }

    #[test]
    fn mean_of_adjacent_rows_removes_alternating_values() {
        let rows = history(&[1.0, 3.0, 1.0, 3.0]);
        assert_eq!(rows.averaged("kinetic"), Some(vec![1.0, 2.0, 2.0, 2.0]));
        assert_eq!(history(&[]).averaged("kinetic"), Some(vec![]));
        let rows = history_with(slider_columns(), &[0.0; 3]);
        assert_eq!(rows.averaged("slider.force"), Some(vec![20.0, 20.5, 21.5]));
        assert_eq!(rows.averaged("slider"), None);
    }
}
