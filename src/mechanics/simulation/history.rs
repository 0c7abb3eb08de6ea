//! What a run was like, step by step.

use serde::{Deserialize, Serialize};

use super::columns::{self, Column, ExtraColumn};
use crate::geometry::{Vec2, larger, smaller};
use crate::system::Measures;

/// A row of the history: what was measured at the end of a step, and what the step took.
#[derive(Debug, Clone, Copy, PartialEq, Default, Serialize, Deserialize)]
pub struct Sample {
    /// Energy, momenta and what was exchanged, measured at the end of the step.
    pub measures: Measures,
    /// The length of the step that led to this row; zero in the first row [time].
    pub dt: f64,
    /// Newton iterations of the step that led to this row; where steps vary in size those of its three solves together.
    pub newton_iterations: usize,
    /// The number of failed tries before the step that led to this row.
    pub retries: usize,
}

/// A quantity that should not change, loads and supports accounted for.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Invariant {
    /// `E - W + D`
    Energy,
    /// The momentum without impulses, `p - ∫ F dt` [mass·length/time].
    Momentum,
    /// The angular momentum without angular impulses, `L - ∫ M dt` [mass·length²/time].
    AngularMomentum,
    /// The largest distance between the partners of a joint [length].
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

    /// The value of the invariant in a row: a vector for the momentum, else in the first component.
    pub fn value(self, row: &Measures) -> Vec2 {
        match self {
            Self::Energy => Vec2::new(row.energy.total() - row.work + row.dissipated, 0.0),
            Self::Momentum => row.momentum - row.impulse,
            Self::AngularMomentum => Vec2::new(row.angular_momentum - row.angular_impulse, 0.0),
            Self::Gap => Vec2::new(row.gap, 0.0),
        }
    }

    /// The invariant in words and symbols.
    pub fn describe(self) -> &'static str {
        match self {
            Self::Energy => "energy E - W + D",
            Self::Momentum => "momentum p - ∫F dt",
            Self::AngularMomentum => "angular momentum L - ∫M dt",
            Self::Gap => "gap of joints",
        }
    }
}

/// What the drift of a quantity is relative to when the rows themselves give no scale.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct DriftScales {
    /// The mass of the whole scene [mass].
    pub mass: f64,
    /// A length of the scene [length]; zero when it has none, such as a lone particle at the origin.
    pub length: f64,
    /// The energy that rounding of the strains stands for [energy]: no drift is relative to less.
    pub rounding_energy: f64,
}

/// The history of a run: rows of what was measured, in the order of time.
#[derive(Debug, Clone, Default)]
pub struct History {
    samples: Vec<Sample>,
    extra_columns: Vec<ExtraColumn>,
    /// The values of the extra columns, row after row.
    extra: Vec<f64>,
    scales: DriftScales,
}

impl History {
    /// The columns that every history has.
    pub const COLUMNS: &'static [Column] = columns::FIXED;

    /// An empty history with columns of its own besides [`COLUMNS`](Self::COLUMNS).
    pub fn new(scales: DriftScales, extra_columns: Vec<ExtraColumn>) -> Self {
        Self { samples: Vec::new(), extra_columns, extra: Vec::new(), scales }
    }

    /// Makes room for `rows` rows of the history to come.
    pub fn reserve(&mut self, rows: usize) {
        self.samples.reserve(rows);
        self.extra.reserve(rows * self.extra_columns.len());
    }

    /// Appends a row to the history: the sample, and a value for each of the extra columns in their order.
    ///
    /// # Panics
    /// When there are more or fewer values than extra columns.
    pub fn push(&mut self, sample: Sample, extra: impl Iterator<Item = f64>) {
        self.samples.push(sample);
        self.extra.extend(extra);
        let expected = self.samples.len() * self.extra_columns.len();
        assert_eq!(self.extra.len(), expected, "a row has one value for each extra column");
    }

    /// Forgets all but the first `rows` rows of the history.
    pub fn truncate(&mut self, rows: usize) {
        self.samples.truncate(rows);
        self.extra.truncate(rows * self.extra_columns.len());
    }

    /// How many columns it has besides those of every history.
    pub(super) fn extra_width(&self) -> usize {
        self.extra_columns.len()
    }

    /// Fills in one of the extra columns of the last row, by its number among these.
    pub(super) fn fill_in(&mut self, column: usize, value: f64) {
        if let Some(first) = self.extra.len().checked_sub(self.extra_columns.len()) {
            self.extra[first + column] = value;
        }
    }

    /// The values of the extra columns of the history, row after row.
    pub(super) fn extra_values(&self) -> &[f64] {
        &self.extra
    }

    /// A history with the same columns and other rows; none when these do not have a value for each extra column.
    pub(super) fn with_rows(&self, samples: Vec<Sample>, extra: Vec<f64>) -> Option<Self> {
        let fits = samples.len().checked_mul(self.extra_columns.len()) == Some(extra.len());
        let extra_columns = self.extra_columns.clone();
        fits.then_some(Self { samples, extra_columns, extra, scales: self.scales })
    }

    /// The rows of the history, without their extra columns.
    pub fn samples(&self) -> &[Sample] {
        &self.samples
    }

    /// The rows of the history between two times, ends included.
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

    /// Name and dimension of each column of the history, the extra ones last.
    pub fn columns(&self) -> impl Iterator<Item = (&str, &'static str)> {
        let fixed = Self::COLUMNS.iter().map(|column| (column.name, column.dimension));
        let extra = self.extra_columns.iter().map(|column| (&*column.name, column.dimension));
        fixed.chain(extra)
    }

    /// The dimension of a column of the history by its name; none where there is no such column.
    pub fn dimension(&self, name: &str) -> Option<&'static str> {
        self.columns().find(|(other, _)| *other == name).map(|(_, dimension)| dimension)
    }

    /// The values of a column of the history by its name, one for each row; none where there is no such column.
    pub fn column(&self, name: &str) -> Option<Vec<f64>> {
        if let Some(column) = Self::COLUMNS.iter().find(|column| column.name == name) {
            return Some(self.samples.iter().map(column.value).collect());
        }
        let index = self.extra_columns.iter().position(|column| column.name == name)?;
        let rows = self.extra.chunks_exact(self.extra_columns.len());
        Some(rows.map(|row| row[index]).collect())
    }

    /// The values of a column by its name, each replaced by the mean of it and the value in the row before. The first value stays, and
    /// the first after the start: what belongs to a step, such as a contact force, has no value at the start.
    ///
    /// This removes a sawtooth, an alternation from step to step. A mean belongs to the middle of its step.
    pub fn averaged(&self, name: &str) -> Option<Vec<f64>> {
        let mut column = self.column(name)?;
        for row in (1..column.len()).rev().filter(|row| self.samples[row - 1].dt > 0.0) {
            column[row] = 0.5 * (column[row - 1] + column[row]);
        }
        Some(column)
    }

    /// How far an invariant is from its value in the first row, row by row: relative to the largest energy, momentum or
    /// angular momentum of these rows; the gap as a length.
    ///
    /// The scale of the momenta includes `sqrt(2 m K)`, so that a body whose momentum is zero has one too, and all
    /// impulses exchanged, also those of loads and supports that balance.
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

    /// What a change of an invariant is relative to.
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

    /// The largest rise of `E - W + D` above an earlier value, relative as the [`drifts`](Self::drifts) are; NaN when an energy is
    /// NaN or there is no row.
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

    /// The largest drift of an invariant over all rows of the history, relative as the [`drifts`](Self::drifts) are; NaN when one is NaN or
    /// there is no row.
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

    /// The extra columns hold 10, 20, … in the first row, 11, 21, … in the second.
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
            history.push(Sample { measures, dt: 1.0, newton_iterations: 3, retries: 0 }, extra);
        }
        history
    }

    #[test]
    fn drift_is_relative_to_the_largest_energy_and_windows_start_anew() {
        let history = history(&[2.0, 4.0, 4.0]);
        assert_eq!(history.drift(Invariant::Energy), 0.5);
        assert_eq!(history.between(1.0, f64::INFINITY).drift(Invariant::Energy), 0.0);
        assert_eq!(history.column("kinetic"), Some(vec![2.0, 4.0, 4.0]));
        assert_eq!(history.column("kinetics"), None);
    }

    #[test]
    fn the_energy_grows_above_any_earlier_value() {
        assert_eq!(history(&[4.0, 1.0, 3.0, 2.0, 2.5]).energy_growth(), 0.5);
        assert_eq!(history(&[4.0, 3.0, 3.0]).energy_growth(), 0.0);
        assert!(history(&[1.0, f64::NAN, 1.0]).energy_growth().is_nan());
        assert!(history(&[]).energy_growth().is_nan());
    }

    #[test]
    fn a_lost_run_has_no_small_drift() {
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
    fn extra_columns_are_named_after_the_others() {
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
    fn a_row_with_a_value_too_few_is_a_mistake() {
        let mut history = history_with(slider_columns(), &[]);
        history.push(Sample::default(), std::iter::once(1.0));
    }

    #[test]
    fn a_mean_of_two_rows_removes_a_sawtooth() {
        let rows = history(&[1.0, 3.0, 1.0, 3.0]);
        assert_eq!(rows.averaged("kinetic"), Some(vec![1.0, 2.0, 2.0, 2.0]));
        assert_eq!(history(&[]).averaged("kinetic"), Some(vec![]));
        let rows = history_with(slider_columns(), &[0.0; 3]);
        assert_eq!(rows.averaged("slider.force"), Some(vec![20.0, 20.5, 21.5]));
        assert_eq!(rows.averaged("slider"), None);
    }
}
