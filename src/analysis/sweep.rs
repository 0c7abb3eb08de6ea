//! Sweeps: tables of runs with parameters and results.

use std::collections::{BTreeMap, HashMap};

use crate::sampling::{VarianceShare, grid_indices, rank_indices, saltelli_indices};

#[derive(Clone, Debug, PartialEq)]
pub struct SweptParameter {
    pub name: String,
    pub values: SweptValues,
}

#[derive(Clone, Debug, PartialEq)]
pub enum SweptValues {
    Levels { labels: Vec<String>, numbers: Option<Vec<f64>>, choice: Choice },
    Numbers(Vec<f64>),
}

#[derive(Clone, Debug, PartialEq)]
pub enum Choice {
    Grid(usize),
    Drawn(Vec<u32>),
}

impl SweptValues {
    /// Level index of a row; `None` if the parameter has a separate number for each row.
    pub fn level(&self, row: usize) -> Option<usize> {
        match self {
            Self::Levels { labels, choice: Choice::Grid(rows), .. } => {
                Some(row / rows % labels.len())
            }
            Self::Levels { choice: Choice::Drawn(drawn), .. } => Some(drawn[row] as usize),
            Self::Numbers(_) => None,
        }
    }

    /// Numeric value of the parameter in a row; `None` if the value is not a number.
    pub fn number(&self, row: usize) -> Option<f64> {
        match self {
            Self::Levels { numbers, .. } => numbers.as_ref()?.get(self.level(row)?).copied(),
            Self::Numbers(numbers) => Some(numbers[row]),
        }
    }

    /// Label of the level in a row; `None` if the parameter has a separate number for each row.
    pub fn label(&self, row: usize) -> Option<&str> {
        match self {
            Self::Levels { labels, .. } => labels.get(self.level(row)?).map(String::as_str),
            Self::Numbers(_) => None,
        }
    }

    pub fn in_words(&self, row: usize, write: impl Fn(f64) -> String) -> String {
        let label = || self.label(row).unwrap_or_default().to_owned();
        self.number(row).map_or_else(label, write)
    }
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum RowLayout {
    Grid,
    Points,
    Saltelli,
}

#[derive(Clone, Debug, PartialEq)]
pub struct SweepDesign {
    pub parameters: Vec<SweptParameter>,
    pub rows: usize,
    pub arrangement: RowLayout,
}

#[derive(Clone, Debug, Default)]
pub struct SweepResults {
    pub names: Vec<String>,
    /// Columns of numbers in the order of the names; NaN in failed rows.
    columns: Vec<Vec<f64>>,
    reasons: FailureReasons,
}

#[derive(Clone, Debug, Default)]
struct FailureReasons {
    texts: Vec<String>,
    known: HashMap<String, u32>,
    of_rows: BTreeMap<u32, u32>,
}

#[derive(Clone, Debug)]
pub struct Sweep {
    pub name: String,
    pub design: SweepDesign,
    pub results: SweepResults,
}

#[derive(Clone, Copy, Debug, PartialEq)]
pub enum SweepColumn<'s> {
    Parameter(&'s SweptValues),
    Result(&'s [f64]),
}

impl SweepColumn<'_> {
    /// Number in a row of this column; NaN if the cell does not contain a number.
    pub fn number(&self, row: usize) -> f64 {
        match self {
            Self::Parameter(values) => values.number(row).unwrap_or(f64::NAN),
            Self::Result(numbers) => numbers[row],
        }
    }
}

impl SweepResults {
    pub fn begin(&mut self, names: Vec<String>, rows: usize) {
        self.columns = vec![vec![f64::NAN; rows]; names.len()];
        self.names = names;
    }

    pub fn find(&mut self, row: usize, values: &[f64]) {
        for (column, value) in self.columns.iter_mut().zip(values) {
            column[row] = *value;
        }
    }

    pub fn fail(&mut self, row: usize, reason: &str) {
        let FailureReasons { texts, known, of_rows } = &mut self.reasons;
        let number = *known.entry(reason.to_owned()).or_insert_with(|| {
            texts.push(reason.to_owned());
            texts.len() as u32 - 1
        });
        of_rows.insert(row as u32, number);
    }

    pub fn failure(&self, row: usize) -> Option<&str> {
        let number = self.reasons.of_rows.get(&(row as u32))?;
        Some(&self.reasons.texts[*number as usize])
    }

    pub fn failures(&self) -> impl ExactSizeIterator<Item = (usize, &str)> {
        let FailureReasons { texts, of_rows, .. } = &self.reasons;
        of_rows.iter().map(|(row, number)| (*row as usize, texts[*number as usize].as_str()))
    }

    pub fn column(&self, name: &str) -> Option<&[f64]> {
        let at = self.names.iter().position(|known| known == name)?;
        self.columns.get(at).map(Vec::as_slice)
    }

    /// Results of a row, in the order of the names; NaN if the row failed.
    pub fn row(&self, row: usize) -> impl Iterator<Item = f64> {
        self.columns.iter().map(move |column| column[row])
    }
}

impl Sweep {
    pub fn column(&self, name: &str) -> Option<SweepColumn<'_>> {
        let of = self.design.parameters.iter().find(|of| of.name == name);
        let own = of.map(|of| SweepColumn::Parameter(&of.values));
        own.or_else(|| self.results.column(name).map(SweepColumn::Result))
    }

    pub fn names(&self) -> impl Iterator<Item = &str> {
        let parameters = self.design.parameters.iter().map(|of| of.name.as_str());
        parameters.chain(self.results.names.iter().map(String::as_str))
    }

    pub fn usable_rows(&self, result: &str) -> usize {
        let results = self.results.column(result).unwrap_or_default();
        let is_whole = |rows: &&[f64]| rows.iter().all(|x| x.is_finite());
        let block = match self.design.arrangement {
            RowLayout::Saltelli => self.design.parameters.len() + 2,
            RowLayout::Grid | RowLayout::Points => 1,
        };
        results.chunks_exact(block).filter(is_whole).count() * block
    }

    /// Fraction of the variance of a result that each parameter explains.
    /// The fractions are `None` if the result is unknown or constant, some rows of a grid failed, or there are too few points.
    pub fn variance_fractions(&self, result: &str) -> Option<Vec<VarianceShare>> {
        let results = self.results.column(result)?;
        let parameters = &self.design.parameters;
        match self.design.arrangement {
            RowLayout::Grid => {
                let length = |of: &SweptParameter| match &of.values {
                    SweptValues::Levels { labels, .. } => labels.len(),
                    SweptValues::Numbers(numbers) => numbers.len(),
                };
                let lengths: Vec<usize> = parameters.iter().map(length).collect();
                results.iter().all(|x| x.is_finite()).then(|| grid_indices(&lengths, results))?
            }
            RowLayout::Saltelli => saltelli_indices(parameters.len(), results),
            RowLayout::Points => {
                let place = |of: &SweptParameter, row: usize| {
                    of.values.number(row).or_else(|| Some(of.values.level(row)? as f64))
                };
                let of_parameter = |of: &SweptParameter| {
                    let places = (0..self.design.rows).map(|row| place(of, row).unwrap_or(0.0));
                    rank_indices(&places.collect::<Vec<_>>(), results)
                };
                parameters.iter().map(of_parameter).collect()
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn levels(numbers: &[f64], rows: usize) -> SweptValues {
        let labels = numbers.iter().map(f64::to_string).collect();
        SweptValues::Levels { labels, numbers: Some(numbers.to_vec()), choice: Choice::Grid(rows) }
    }

    fn sweep() -> Sweep {
        let parameter = |name: &str, values| SweptParameter { name: name.into(), values };
        let parameters = vec![
            parameter("a", levels(&[1.0, 2.0], 3)),
            parameter("b", levels(&[0.0, 1.0, 2.0], 1)),
        ];
        let design = SweepDesign { parameters, rows: 6, arrangement: RowLayout::Grid };
        let mut results = SweepResults::default();
        results.begin(vec!["sum".into()], 6);
        for row in 0..6 {
            let of = |at: usize| design.parameters[at].values.number(row).unwrap();
            results.find(row, &[of(0) + of(1)]);
        }
        Sweep { name: "sums".into(), design, results }
    }

    #[test]
    fn last_parameter_of_a_grid_varies_fastest() {
        let sweep = sweep();
        assert_eq!(sweep.results.column("sum").unwrap(), [1.0, 2.0, 3.0, 2.0, 3.0, 4.0]);
        assert_eq!(sweep.design.parameters[0].values.label(4), Some("2"));
        assert!(sweep.names().eq(["a", "b", "sum"]));
        let shares = sweep.variance_fractions("sum").unwrap();
        assert!((shares[0].first - 3.0 / 11.0).abs() < 1e-15, "{shares:?}");
        assert_eq!(shares[1].total.map(|x| (x - 8.0 / 11.0).abs() < 1e-15), Some(true));
    }

    #[test]
    fn failed_sweep_rows_have_reasons_and_are_not_used() {
        let mut sweep = sweep();
        sweep.results.fail(2, "lost");
        sweep.results.find(2, &[f64::NAN]);
        sweep.results.fail(0, "lost");
        assert_eq!(sweep.results.failure(2), Some("lost"));
        assert_eq!(sweep.results.failure(1), None);
        assert!(sweep.results.failures().eq([(0, "lost"), (2, "lost")]));
        assert!(sweep.variance_fractions("sum").is_none());
        assert_eq!(sweep.usable_rows("sum"), 5);
        sweep.design.arrangement = RowLayout::Saltelli;
        assert_eq!(sweep.usable_rows("sum"), 0);
    }
}
