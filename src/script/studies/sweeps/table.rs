//! Table of a sweep, for scripts, other programs and users.

use std::io;
use std::rc::Rc;

use rhai::{Dynamic, Map};

use super::design::SweepPlan;
use crate::analysis::{Sweep, SweepColumn, SweptValues};
use crate::output::{
    Cell, DataColumn, DataTable, DataValues, NpzArchive, NpzArray, TextTable, csv_cell,
    format_number, significant,
};

pub const FAILURE: &str = "failure";
const SHOWN: (usize, usize) = (12, 4);
const DIGITS: usize = 6;

pub struct FinishedSweep {
    pub sweep: Sweep,
    pub plan: SweepPlan,
}

#[derive(Clone)]
pub struct SweepTable {
    swept: Rc<FinishedSweep>,
    chosen: Option<Rc<Vec<u32>>>,
}

impl SweepTable {
    pub fn new(swept: Rc<FinishedSweep>) -> Self {
        Self { swept, chosen: None }
    }

    pub fn into_swept(self) -> Rc<FinishedSweep> {
        self.swept
    }

    pub fn sweep(&self) -> &Sweep {
        &self.swept.sweep
    }

    pub fn is_of_some_rows(&self) -> bool {
        self.chosen.is_some()
    }

    pub fn is_spread_by_ratios(&self, name: &str) -> bool {
        self.swept.plan.is_spread_by_ratios(name)
    }

    pub fn of_rows(&self, rows: Vec<u32>) -> Self {
        Self { swept: Rc::clone(&self.swept), chosen: Some(Rc::new(rows)) }
    }

    pub fn failures(&self) -> Self {
        let results = &self.sweep().results;
        self.of_rows(
            self.rows()
                .filter(|row| results.failure(*row).is_some())
                .map(|row| row as u32)
                .collect(),
        )
    }

    pub fn length(&self) -> usize {
        self.chosen.as_ref().map_or(self.sweep().design.rows, |chosen| chosen.len())
    }

    pub fn rows(&self) -> impl Iterator<Item = usize> + Clone + use<'_> {
        let chosen = self.chosen.as_deref();
        (0..self.length()).map(move |at| chosen.map_or(at, |chosen| chosen[at] as usize))
    }

    pub fn row(&self, row: usize) -> Map {
        let FinishedSweep { sweep, plan } = &*self.swept;
        let mut map = plan.values(row, &|_, _| None);
        match sweep.results.failure(row) {
            Some(reason) => _ = map.insert(FAILURE.into(), reason.into()),
            None => {
                let found = sweep.results.names.iter().zip(sweep.results.row(row));
                map.extend(found.map(|(name, value)| (name.as_str().into(), Dynamic::from(value))));
            }
        }
        map
    }

    /// Column as numbers, with NaN for missing values; `None` for an unknown column.
    pub fn numbers(&self, name: &str) -> Option<Vec<f64>> {
        let column = self.sweep().column(name)?;
        Some(self.rows().map(|row| column.number(row)).collect())
    }

    fn texts(&self, column: SweepColumn) -> Option<Vec<Option<String>>> {
        match column {
            SweepColumn::Parameter(values @ SweptValues::Levels { numbers: None, .. }) => {
                Some(self.rows().map(|row| values.label(row).map(str::to_owned)).collect())
            }
            _ => None,
        }
    }

    pub fn data(&self) -> DataTable {
        let sweep = self.sweep();
        let column = |name: &str| {
            let of = sweep.column(name)?;
            let numbers = || self.rows().map(|row| Some(of.number(row)).filter(|x| !x.is_nan()));
            let texts = self.texts(of).map(DataValues::Texts);
            let values = texts.unwrap_or_else(|| DataValues::Numbers(numbers().collect()));
            Some(DataColumn { name: name.to_owned(), dimension: String::new(), values })
        };
        let reasons = self.rows().map(|row| sweep.results.failure(row).map(str::to_owned));
        let failures = DataColumn {
            name: FAILURE.to_owned(),
            dimension: String::new(),
            values: DataValues::Texts(reasons.collect()),
        };
        DataTable { columns: sweep.names().filter_map(column).chain([failures]).collect() }
    }

    pub fn archive(&self) -> NpzArchive {
        let is_number = |values: &&[f64]| values.iter().any(|x| x.is_finite());
        let column = |name: &str| {
            let numbers = self.numbers(name)?;
            is_number(&numbers.as_slice()).then(|| NpzArray::row(name, numbers))
        };
        NpzArchive { arrays: self.sweep().names().filter_map(column).collect() }
    }

    /// Writes the table as CSV, row by row, so that many rows need little memory.
    pub fn write_csv(&self, file: &mut dyn io::Write) -> io::Result<()> {
        let sweep = self.sweep();
        let columns: Vec<_> = sweep.names().filter_map(|name| sweep.column(name)).collect();
        let mut writer = csv::Writer::from_writer(file);
        writer
            .write_record(sweep.names().chain([FAILURE]).map(|name| csv_cell(name).into_owned()))?;
        for row in self.rows() {
            let failure = sweep.results.failure(row);
            for column in &columns {
                writer.write_field(&*csv_cell(&exact(*column, row)))?;
            }
            writer.write_field(&*csv_cell(failure.unwrap_or_default()))?;
            writer.write_record(None::<&[u8]>)?;
        }
        writer.flush()
    }

    pub fn text(&self) -> String {
        let sweep = self.sweep();
        let columns: Vec<_> = sweep.names().filter_map(|name| sweep.column(name)).collect();
        let has_failures = self.rows().any(|row| sweep.results.failure(row).is_some());
        let head: Vec<&str> = sweep.names().chain(has_failures.then_some(FAILURE)).collect();
        let mut table = TextTable::new(&head);
        let (first, last) = SHOWN;
        let left_out = self.length().saturating_sub(first + last);
        for (at, row) in self.rows().enumerate() {
            if left_out > 0 && at == first {
                table.row([format!("… {left_out} rows")]);
            }
            if left_out > 0 && (first..first + left_out).contains(&at) {
                continue;
            }
            let cells = columns.iter().map(|column| short(*column, row));
            let failure = sweep.results.failure(row).unwrap_or_default();
            table.row(cells.chain(has_failures.then(|| Cell::from(failure))));
        }
        table.to_string().trim_end().to_owned()
    }
}

impl FinishedSweep {
    pub fn summary(&self) -> String {
        let Sweep { name, design, results } = &self.sweep;
        let failed = results.failures().len();
        let mut text =
            format!("sweep '{name}': {} of {} runs finished", design.rows - failed, design.rows);
        let mut table = TextTable::new(&["result", "least", "at", "mean", "largest", "at"]);
        for name in &results.names {
            let Some(column) = results.column(name) else { continue };
            let found = || column.iter().copied().enumerate().filter(|(_, x)| x.is_finite());
            let least = found().min_by(|a, b| a.1.total_cmp(&b.1));
            let largest = found().rev().max_by(|a, b| a.1.total_cmp(&b.1));
            let count = found().count().max(1);
            let mean = found().map(|(_, x)| x / count as f64).sum::<f64>();
            if let (Some(least), Some(largest)) = (least, largest) {
                let number = |x: f64| Cell::Number(significant(x, DIGITS));
                table.row([
                    Cell::from(name.as_str()),
                    number(least.1),
                    Cell::from(self.place(least.0)),
                    number(mean),
                    number(largest.1),
                    Cell::from(self.place(largest.0)),
                ]);
            }
        }
        text.push_str(&format!("\n{}", table.to_string().trim_end()));
        for (row, reason) in results.failures().take(3) {
            text.push_str(&format!("\nfailed with {}: {reason}", self.place(row)));
        }
        if failed > 3 {
            text.push_str(&format!("\n… and {} more, listed in {name}.csv", failed - 3));
        }
        text
    }

    fn place(&self, row: usize) -> String {
        let parameters = &self.sweep.design.parameters;
        let words = parameters.iter().map(|of| {
            format!("{} {}", of.name, of.values.in_words(row, |number| significant(number, 4)))
        });
        words.collect::<Vec<_>>().join(", ")
    }
}

fn exact(column: SweepColumn, row: usize) -> String {
    match column {
        SweepColumn::Parameter(values @ SweptValues::Levels { numbers: None, .. }) => {
            values.label(row).unwrap_or_default().to_owned()
        }
        _ => {
            Some(column.number(row)).filter(|x| !x.is_nan()).map(format_number).unwrap_or_default()
        }
    }
}

fn short(column: SweepColumn, row: usize) -> Cell {
    match column {
        SweepColumn::Parameter(values @ SweptValues::Levels { numbers: None, .. }) => {
            Cell::from(values.label(row).unwrap_or_default())
        }
        _ => match column.number(row) {
            x if x.is_nan() => Cell::Number("-".into()),
            x => Cell::Number(significant(x, DIGITS)),
        },
    }
}
