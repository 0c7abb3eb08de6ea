//! What a run was like, step by step.

use crate::geometry::{Vec2, larger};
use crate::model::Measures;

/// A row of the history: what was measured at the end of a step, and what the step took.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Sample {
    /// Energy, momenta and what was exchanged.
    pub measures: Measures,
    /// The length of the step; zero in the first row [time].
    pub dt: f64,
    /// Newton iterations of the step.
    pub newton_iterations: usize,
    /// Failed tries before the step.
    pub retries: usize,
}

/// A quantity that should not change, loads and supports accounted for.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Invariant {
    /// `E - W`
    Energy,
    /// `p - ∫ F dt`
    Momentum,
    /// `L - ∫ M dt`
    AngularMomentum,
    /// The largest distance between the partners of a joint.
    Gap,
}

impl Invariant {
    /// All of them with their names.
    pub const ALL: [(&'static str, Self); 4] = [
        ("energy", Self::Energy),
        ("momentum", Self::Momentum),
        ("angular_momentum", Self::AngularMomentum),
        ("gap", Self::Gap),
    ];

    /// Its value: a vector for the momentum, else in the first component.
    pub fn value(self, row: &Measures) -> Vec2 {
        match self {
            Self::Energy => Vec2::new(row.energy.total() - row.work, 0.0),
            Self::Momentum => row.momentum - row.impulse,
            Self::AngularMomentum => Vec2::new(row.angular_momentum - row.angular_impulse, 0.0),
            Self::Gap => Vec2::new(row.gap, 0.0),
        }
    }

    /// In words and symbols.
    pub fn describe(self) -> &'static str {
        match self {
            Self::Energy => "energy E - W",
            Self::Momentum => "momentum p - ∫F dt",
            Self::AngularMomentum => "angular momentum L - ∫M dt",
            Self::Gap => "gap of joints",
        }
    }
}

/// A column of the history.
#[derive(Debug, Clone, Copy)]
pub struct Column {
    /// Its name.
    pub name: &'static str,
    /// Its dimension.
    pub dimension: &'static str,
    /// Its value in a row.
    pub value: fn(&Sample) -> f64,
}

/// What the drift of a quantity is relative to when the rows themselves give no scale.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Scales {
    /// The mass of everything.
    pub mass: f64,
    /// A length of the scene.
    pub length: f64,
    /// The energy that rounding of the strains stands for: no drift is relative to less.
    pub rounding_energy: f64,
}

/// Rows in the order of time.
#[derive(Debug, Clone, Default)]
pub struct History {
    samples: Vec<Sample>,
    scales: Scales,
}

impl History {
    /// The columns by name.
    pub const COLUMNS: &'static [Column] = &[
        Column { name: "t", dimension: "time", value: |row| row.measures.time },
        Column { name: "kinetic", dimension: "energy", value: |row| row.measures.energy.kinetic },
        Column { name: "strain", dimension: "energy", value: |row| row.measures.energy.strain },
        Column {
            name: "potential",
            dimension: "energy",
            value: |row| row.measures.energy.potential,
        },
        Column { name: "energy", dimension: "energy", value: |row| row.measures.energy.total() },
        Column { name: "work", dimension: "energy", value: |row| row.measures.work },
        Column {
            name: "momentum_x",
            dimension: "mass·length/time",
            value: |row| row.measures.momentum.x,
        },
        Column {
            name: "momentum_y",
            dimension: "mass·length/time",
            value: |row| row.measures.momentum.y,
        },
        Column {
            name: "impulse_x",
            dimension: "mass·length/time",
            value: |row| row.measures.impulse.x,
        },
        Column {
            name: "impulse_y",
            dimension: "mass·length/time",
            value: |row| row.measures.impulse.y,
        },
        Column {
            name: "angular_momentum",
            dimension: "mass·length²/time",
            value: |row| row.measures.angular_momentum,
        },
        Column {
            name: "angular_impulse",
            dimension: "mass·length²/time",
            value: |row| row.measures.angular_impulse,
        },
        Column { name: "gap", dimension: "length", value: |row| row.measures.gap },
        Column { name: "dt", dimension: "time", value: |row| row.dt },
        Column {
            name: "newton_iterations",
            dimension: "-",
            value: |row| row.newton_iterations as f64,
        },
        Column { name: "retries", dimension: "-", value: |row| row.retries as f64 },
    ];

    /// An empty history.
    pub fn new(scales: Scales) -> Self {
        Self { samples: Vec::new(), scales }
    }

    /// Makes room for rows to come.
    pub fn reserve(&mut self, rows: usize) {
        self.samples.reserve(rows);
    }

    /// Appends a row.
    pub fn push(&mut self, sample: Sample) {
        self.samples.push(sample);
    }

    /// The rows.
    pub fn samples(&self) -> &[Sample] {
        &self.samples
    }

    /// The rows between two times, ends included.
    pub fn between(&self, from: f64, to: f64) -> Self {
        let steps = self.samples.iter().map(|row| row.dt).filter(|dt| *dt > 0.0);
        let slack = 1e-9 * steps.reduce(f64::min).unwrap_or(0.0);
        let inside =
            |row: &&Sample| row.measures.time >= from - slack && row.measures.time <= to + slack;
        Self {
            samples: self.samples.iter().filter(inside).copied().collect(),
            ..Self::new(self.scales)
        }
    }

    /// A column by name.
    pub fn column(&self, name: &str) -> Option<Vec<f64>> {
        let column = Self::COLUMNS.iter().find(|column| column.name == name)?;
        Some(self.samples.iter().map(column.value).collect())
    }

    /// How far an invariant is from its value in the first row, row by row: relative to the largest energy, momentum or
    /// angular momentum of these rows; the gap as a length.
    ///
    /// The scale of the momenta includes `sqrt(2 m K)`, so that a body whose momentum is zero has one too, and all
    /// impulses exchanged, also those of loads and supports that balance.
    pub fn drifts(&self, invariant: Invariant) -> Vec<f64> {
        let Some(first) = self.samples.first().map(|row| row.measures) else { return Vec::new() };
        let largest = |value: &dyn Fn(&Measures) -> f64| {
            self.samples.iter().map(|row| value(&row.measures).abs()).fold(0.0, f64::max)
        };
        let Scales { mass, length, rounding_energy } = self.scales;
        let kinetic = largest(&|row| row.energy.kinetic).max(rounding_energy);
        let motion = (2.0 * mass * kinetic).sqrt();
        let scale = match invariant {
            Invariant::Energy => largest(&|row| row.energy.kinetic + row.energy.strain)
                .max(largest(&|row| row.energy.potential - first.energy.potential))
                .max(largest(&|row| row.work - first.work))
                .max(rounding_energy),
            Invariant::Momentum => {
                motion.max(largest(&|row| row.gross_impulse - first.gross_impulse))
            }
            Invariant::AngularMomentum => (motion * length)
                .max(largest(&|row| row.angular_momentum))
                .max(largest(&|row| row.gross_angular_impulse - first.gross_angular_impulse)),
            Invariant::Gap => 1.0,
        };
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

    /// The largest of the [`drifts`](Self::drifts); NaN when one is NaN or there is no row.
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
    use crate::model::Energy;

    fn history(energies: &[f64]) -> History {
        let mut history = History::new(Scales { mass: 1.0, length: 1.0, rounding_energy: 0.0 });
        for (index, &kinetic) in energies.iter().enumerate() {
            let measures = Measures {
                time: index as f64,
                energy: Energy { kinetic, ..Energy::default() },
                work: 1.0,
                ..Measures::default()
            };
            history.push(Sample { measures, dt: 1.0, newton_iterations: 3, retries: 0 });
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
    fn a_lost_run_has_no_small_drift() {
        assert!(history(&[1.0, f64::NAN, 1.0]).drift(Invariant::Energy).is_nan());
    }
}
