//! A sweep: a table of runs, with the parameters of each and what was found in it.

use std::collections::{BTreeMap, HashMap};

use crate::sampling::{VarianceShare, shares_by_rank, shares_of_grid, shares_of_saltelli};

/// A parameter of a sweep with its values.
#[derive(Clone, Debug, PartialEq)]
pub struct SweptParameter {
    /// The name of the parameter.
    pub name: String,
    /// The values that the parameter takes.
    pub values: SweptValues,
}

/// The values of a parameter of a sweep.
#[derive(Clone, Debug, PartialEq)]
pub enum SweptValues {
    /// One of few, which need not be numbers.
    Levels {
        /// A label for each of them.
        labels: Vec<String>,
        /// The numbers that they are, where all of them are numbers.
        numbers: Option<Vec<f64>>,
        /// Which of them each row has.
        choice: Choice,
    },
    /// A number for each row.
    Numbers(Vec<f64>),
}

/// Which of its levels a parameter has in each row.
#[derive(Clone, Debug, PartialEq)]
pub enum Choice {
    /// Those of a full grid: each for so many rows, one after another and again from the start.
    Grid(usize),
    /// That of each row.
    Drawn(Vec<u32>),
}

impl SweptValues {
    /// The number of the level of a row; none where the parameter has a number of its own for each row.
    pub fn level(&self, row: usize) -> Option<usize> {
        match self {
            Self::Levels { labels, choice: Choice::Grid(rows), .. } => {
                Some(row / rows % labels.len())
            }
            Self::Levels { choice: Choice::Drawn(drawn), .. } => Some(drawn[row] as usize),
            Self::Numbers(_) => None,
        }
    }

    /// The value of a row as a number; none where it is something else.
    pub fn number(&self, row: usize) -> Option<f64> {
        match self {
            Self::Levels { numbers, .. } => numbers.as_ref()?.get(self.level(row)?).copied(),
            Self::Numbers(numbers) => Some(numbers[row]),
        }
    }

    /// The label of the level of a row; none where the parameter has a number of its own for each row.
    pub fn label(&self, row: usize) -> Option<&str> {
        match self {
            Self::Levels { labels, .. } => labels.get(self.level(row)?).map(String::as_str),
            Self::Numbers(_) => None,
        }
    }

    /// The value of a row in words: its number, written so, or the label of its level.
    pub fn in_words(&self, row: usize, write: impl Fn(f64) -> String) -> String {
        let label = || self.label(row).unwrap_or_default().to_owned();
        self.number(row).map_or_else(label, write)
    }
}

/// How the rows of a sweep lie among all that they could be.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum RowLayout {
    /// Every value with every other.
    Grid,
    /// Points that are independent of one another, or more even than that.
    Points,
    /// Blocks of points that differ in one parameter each, for Sobol' indices.
    Saltelli,
}

/// What a sweep goes through: its parameters, and the number of its rows.
#[derive(Clone, Debug, PartialEq)]
pub struct SweepDesign {
    /// The parameters, in the order of their names.
    pub parameters: Vec<SweptParameter>,
    /// How many runs there are.
    pub rows: usize,
    /// How they are arranged.
    pub arrangement: RowLayout,
}

/// What was found in the rows of a sweep: a column of numbers for each result, and the reasons of rows that failed.
#[derive(Clone, Debug, Default)]
pub struct SweepResults {
    /// The names of the results, which all runs give.
    pub names: Vec<String>,
    /// A column for each name; not-a-number in rows that failed.
    columns: Vec<Vec<f64>>,
    reasons: FailureReasons,
}

/// Reasons of failures, each kept once.
#[derive(Clone, Debug, Default)]
struct FailureReasons {
    texts: Vec<String>,
    known: HashMap<String, u32>,
    of_rows: BTreeMap<u32, u32>,
}

/// A finished sweep.
#[derive(Clone, Debug)]
pub struct Sweep {
    /// The name of the sweep and of its files.
    pub name: String,
    /// What it went through.
    pub design: SweepDesign,
    /// What was found.
    pub results: SweepResults,
}

/// What a row shows under a name.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum SweepColumn<'s> {
    /// Values of a parameter.
    Parameter(&'s SweptValues),
    /// Results.
    Result(&'s [f64]),
}

impl SweepColumn<'_> {
    /// The value of a row as a number: not-a-number where it has none.
    pub fn number(&self, row: usize) -> f64 {
        match self {
            Self::Parameter(values) => values.number(row).unwrap_or(f64::NAN),
            Self::Result(numbers) => numbers[row],
        }
    }
}

impl SweepResults {
    /// Begins the table of so many rows with the names of the results, when the first run has told them.
    pub fn begin(&mut self, names: Vec<String>, rows: usize) {
        self.columns = vec![vec![f64::NAN; rows]; names.len()];
        self.names = names;
    }

    /// Writes down what was found in a row, in the order of the names.
    pub fn find(&mut self, row: usize, values: &[f64]) {
        for (column, value) in self.columns.iter_mut().zip(values) {
            column[row] = *value;
        }
    }

    /// Writes down why a row failed.
    pub fn fail(&mut self, row: usize, reason: &str) {
        let FailureReasons { texts, known, of_rows } = &mut self.reasons;
        let number = *known.entry(reason.to_owned()).or_insert_with(|| {
            texts.push(reason.to_owned());
            texts.len() as u32 - 1
        });
        of_rows.insert(row as u32, number);
    }

    /// Why a row failed, if it did.
    pub fn failure(&self, row: usize) -> Option<&str> {
        let number = self.reasons.of_rows.get(&(row as u32))?;
        Some(&self.reasons.texts[*number as usize])
    }

    /// The rows that failed, with their reasons.
    pub fn failures(&self) -> impl ExactSizeIterator<Item = (usize, &str)> {
        let FailureReasons { texts, of_rows, .. } = &self.reasons;
        of_rows.iter().map(|(row, number)| (*row as usize, texts[*number as usize].as_str()))
    }

    /// The column of a result.
    pub fn column(&self, name: &str) -> Option<&[f64]> {
        let at = self.names.iter().position(|known| known == name)?;
        self.columns.get(at).map(Vec::as_slice)
    }

    /// The results of a row, in the order of the names; not-a-number where it failed.
    pub fn row(&self, row: usize) -> impl Iterator<Item = f64> {
        self.columns.iter().map(move |column| column[row])
    }
}

impl Sweep {
    /// The values under a name: those of a parameter, or results.
    pub fn column(&self, name: &str) -> Option<SweepColumn<'_>> {
        let of = self.design.parameters.iter().find(|of| of.name == name);
        let own = of.map(|of| SweepColumn::Parameter(&of.values));
        own.or_else(|| self.results.column(name).map(SweepColumn::Result))
    }

    /// All names of columns: parameters, then results.
    pub fn names(&self) -> impl Iterator<Item = &str> {
        let parameters = self.design.parameters.iter().map(|of| of.name.as_str());
        parameters.chain(self.results.names.iter().map(String::as_str))
    }

    /// From how many rows it is told what a result depends on: those that came to their end; of a Saltelli design the blocks none of whose rows failed.
    pub fn telling_rows(&self, result: &str) -> usize {
        let results = self.results.column(result).unwrap_or_default();
        let is_whole = |rows: &&[f64]| rows.iter().all(|x| x.is_finite());
        let block = match self.design.arrangement {
            RowLayout::Saltelli => self.design.parameters.len() + 2,
            RowLayout::Grid | RowLayout::Points => 1,
        };
        results.chunks_exact(block).filter(is_whole).count() * block
    }

    /// How much of the variance of a result each parameter explains, in the order of the parameters; none where it does not vary, where rows of a grid
    /// failed, or where there are too few points.
    pub fn shares(&self, result: &str) -> Option<Vec<VarianceShare>> {
        let results = self.results.column(result)?;
        let parameters = &self.design.parameters;
        match self.design.arrangement {
            RowLayout::Grid => {
                let length = |of: &SweptParameter| match &of.values {
                    SweptValues::Levels { labels, .. } => labels.len(),
                    SweptValues::Numbers(numbers) => numbers.len(),
                };
                let lengths: Vec<usize> = parameters.iter().map(length).collect();
                results.iter().all(|x| x.is_finite()).then(|| shares_of_grid(&lengths, results))?
            }
            RowLayout::Saltelli => shares_of_saltelli(parameters.len(), results),
            RowLayout::Points => {
                let place = |of: &SweptParameter, row: usize| {
                    of.values.number(row).or_else(|| Some(of.values.level(row)? as f64))
                };
                let of_parameter = |of: &SweptParameter| {
                    let places = (0..self.design.rows).map(|row| place(of, row).unwrap_or(0.0));
                    shares_by_rank(&places.collect::<Vec<_>>(), results)
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
    fn the_last_parameter_of_a_grid_goes_fastest() {
        let sweep = sweep();
        assert_eq!(sweep.results.column("sum").unwrap(), [1.0, 2.0, 3.0, 2.0, 3.0, 4.0]);
        assert_eq!(sweep.design.parameters[0].values.label(4), Some("2"));
        assert!(sweep.names().eq(["a", "b", "sum"]));
        let shares = sweep.shares("sum").unwrap();
        // Variances 1/4 and 2/3 of an additive function.
        assert!((shares[0].first - 3.0 / 11.0).abs() < 1e-15, "{shares:?}");
        assert_eq!(shares[1].total.map(|x| (x - 8.0 / 11.0).abs() < 1e-15), Some(true));
    }

    #[test]
    fn rows_that_failed_have_reasons_and_no_numbers() {
        let mut sweep = sweep();
        sweep.results.fail(2, "lost");
        sweep.results.find(2, &[f64::NAN]);
        sweep.results.fail(0, "lost");
        assert_eq!(sweep.results.failure(2), Some("lost"));
        assert_eq!(sweep.results.failure(1), None);
        assert!(sweep.results.failures().eq([(0, "lost"), (2, "lost")]));
        assert!(sweep.shares("sum").is_none());
        assert_eq!(sweep.telling_rows("sum"), 5);
        sweep.design.arrangement = RowLayout::Saltelli;
        // Two parameters: blocks of four rows, of which the first has a failed one, and the second is cut off.
        assert_eq!(sweep.telling_rows("sum"), 0);
    }
}
