//! Joint elimination of a band and its border. The band alone may be singular, for example in mechanisms that only contacts restrain.
//!
//! Border rows with few entries are inserted into the band by reverse Cuthill–McKee ordering, and rows are exchanged as in any banded matrix.
//! Rows and columns are scaled first, because they contain forces as well as lengths (Ruiz, report RAL-TR-2001-034).

use super::ordering::reverse_cuthill_mckee;
use super::{BandedLu, BandedMatrix, LinearError};

const SCALINGS: usize = 4;

type MatrixEntry = (usize, usize, f64);

#[derive(Debug, Clone)]
pub(super) struct JointElimination {
    size: usize,
    band: BandedMatrix,
    position: Vec<usize>,
    scales: Equilibration,
    /// Dense columns of the border. The factorisation multiplies them by the inverse of the band.
    columns: Vec<Vec<f64>>,
    rows: Vec<MatrixEntry>,
    complement: BandedMatrix,
}

#[derive(Debug, Clone, Default)]
struct Equilibration {
    rows: Vec<f64>,
    columns: Vec<f64>,
}

#[derive(Debug)]
pub(super) struct JointLu<'a> {
    others: Ordered<'a>,
    columns: &'a [Vec<f64>],
    rows: &'a [MatrixEntry],
    complement: BandedLu<'a>,
}

#[derive(Debug)]
struct Ordered<'a> {
    band: BandedLu<'a>,
    position: &'a [usize],
    scales: &'a Equilibration,
}

impl JointElimination {
    pub(super) fn new(size: usize, full: usize) -> Self {
        Self {
            size: size - full,
            band: BandedMatrix::zeros(0, 0),
            position: Vec::new(),
            scales: Equilibration::default(),
            columns: vec![vec![0.0; size - full]; full],
            rows: Vec::new(),
            complement: BandedMatrix::zeros(full, full.saturating_sub(1)),
        }
    }

    /// Factorises the matrix with the given entries. Values for the same row and column are added up.
    pub(super) fn factorise(
        &mut self,
        entries: &[MatrixEntry],
    ) -> Result<JointLu<'_>, LinearError> {
        let size = self.size;
        self.columns.iter_mut().for_each(|column| column.fill(0.0));
        self.rows.clear();
        self.complement.clear();
        let mut others = Vec::with_capacity(entries.len());
        for &(row, column, value) in entries {
            match (row.checked_sub(size), column.checked_sub(size)) {
                (None, None) => others.push((row, column, value)),
                (None, Some(full)) => self.columns[full][row] += value,
                (Some(full), None) => self.rows.push((full, column, value)),
                (Some(row), Some(column)) => self.complement.add(row, column, value),
            }
        }
        self.order(&others);
        let Self { band, position, scales, columns, rows, complement, .. } = self;
        let others = Ordered { band: band.factorise()?, position, scales };
        columns.iter_mut().for_each(|column| others.solve(column));
        for (row, at, value) in &*rows {
            for (column, solved) in columns.iter().enumerate() {
                complement.add(*row, column, -value * solved[*at]);
            }
        }
        let complement = complement.factorise().map_err(|error| error.offset_by_rows(size))?;
        Ok(JointLu { others, columns, rows, complement })
    }

    fn order(&mut self, entries: &[MatrixEntry]) {
        let scales = Equilibration::of(self.size, entries);
        let pairs = entries.iter().filter(|(row, column, _)| row != column);
        let groups: Vec<Vec<usize>> = pairs.map(|(row, column, _)| vec![*row, *column]).collect();
        let order = reverse_cuthill_mckee(self.size, &groups);
        self.band = BandedMatrix::zeros(self.size, order.half_bandwidth);
        for (row, column, value) in entries {
            let value = value * scales.rows[*row] * scales.columns[*column];
            self.band.add(order.position[*row], order.position[*column], value);
        }
        (self.position, self.scales) = (order.position, scales);
    }
}

impl JointLu<'_> {
    pub(super) fn solve(&self, x: &mut [f64]) {
        let (x, z) = x.split_at_mut(x.len() - self.columns.len());
        self.others.solve(x);
        for (row, column, value) in self.rows {
            z[*row] -= value * x[*column];
        }
        self.complement.solve(z);
        for (solved, z) in self.columns.iter().zip(z) {
            x.iter_mut().zip(solved).for_each(|(x, solved)| *x -= solved * *z);
        }
    }
}

impl Ordered<'_> {
    fn solve(&self, x: &mut [f64]) {
        let mut ordered = vec![0.0; x.len()];
        for ((value, scale), at) in x.iter().zip(&self.scales.rows).zip(self.position) {
            ordered[*at] = value * scale;
        }
        self.band.solve(&mut ordered);
        for ((value, scale), at) in x.iter_mut().zip(&self.scales.columns).zip(self.position) {
            *value = ordered[*at] * scale;
        }
    }
}

impl Equilibration {
    fn of(size: usize, entries: &[MatrixEntry]) -> Self {
        let (mut rows, mut columns) = (vec![1.0; size], vec![1.0; size]);
        for _ in 0..SCALINGS {
            let (mut of_row, mut of_column) = (vec![0.0_f64; size], vec![0.0_f64; size]);
            for (row, column, value) in entries {
                let value = (value * rows[*row] * columns[*column]).abs();
                of_row[*row] = of_row[*row].max(value);
                of_column[*column] = of_column[*column].max(value);
            }
            let scale = |(scale, largest): (&mut f64, &f64)| {
                if *largest > 0.0 && largest.is_finite() {
                    *scale /= largest.sqrt();
                }
            };
            rows.iter_mut().zip(&of_row).for_each(scale);
            columns.iter_mut().zip(&of_column).for_each(scale);
        }
        Self { rows, columns }
    }
}
