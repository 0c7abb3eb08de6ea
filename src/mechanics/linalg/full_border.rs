//! Dense border of a banded matrix, which is eliminated with the factors of the band.
//!
//! ```text
//! [ A  B ] [x]   [f]        solutions of the band: Z = A⁻¹ B      y = A⁻¹ f
//! [ C  D ] [z] = [g]        system of the border: (D - C Z) z = g - C y      x = y - Z z
//! ```
//!
//! The border may have entries anywhere without changing the width of the band (Govaerts & Pryce, BIT 30 (1990) 490–507).

use super::{BandedLu, BandedMatrix, BorderShape, BorderUnit, LinearError};
use crate::elementary::square;

/// Number of border columns that are stored and solved together, which equals the number of unknowns of a sliding contact.
const STRIP: usize = 5;

/// Weight of rows with the unit of a length, relative to rows with the unit of a force, in the choice of pivots [-].
/// Force rows, such as the equation of a frictionless contact, are preferred as pivot rows if this choice loses at most four digits.
/// With force rows as pivot rows, a contact force of zero is computed without rounding error.
const LENGTHS: f64 = 1e-4;

#[derive(Debug, Clone)]
struct BorderStrip {
    rows: Vec<[f64; STRIP]>,
    first_row: Option<usize>,
}

#[derive(Debug, Clone)]
pub struct FullBorder {
    width: usize,
    strips: Vec<BorderStrip>,
    rows: Vec<(usize, usize, f64)>,
    corner: Box<BandedMatrix>,
    units: Vec<(BorderUnit, BorderUnit)>,
}

#[derive(Debug)]
pub(super) struct FullLu<'a> {
    width: usize,
    band: BandedLu<'a>,
    /// Columns of the matrix `Z = A⁻¹ B`.
    solved: &'a [BorderStrip],
    /// Entries of the border rows `C` as row, column and value.
    rows: &'a [(usize, usize, f64)],
    complement: BandedLu<'a>,
}

impl BorderStrip {
    fn zeros(size: usize) -> Self {
        Self { rows: vec![[0.0; STRIP]; size], first_row: None }
    }

    fn clear(&mut self) {
        self.rows.fill([0.0; STRIP]);
        self.first_row = None;
    }

    fn add(&mut self, row: usize, column: usize, value: f64) {
        self.rows[row][column] += value;
        self.first_row = Some(self.first_row.map_or(row, |first| first.min(row)));
    }
}

impl FullBorder {
    pub(super) fn zeros(size: usize, BorderShape { width, row_entries }: BorderShape) -> Self {
        Self {
            width,
            strips: vec![BorderStrip::zeros(size); width.div_ceil(STRIP)],
            rows: Vec::with_capacity(row_entries),
            corner: Box::new(BandedMatrix::zeros(width, width.saturating_sub(1))),
            units: vec![(BorderUnit::default(), BorderUnit::default()); width],
        }
    }

    pub(super) fn width(&self) -> usize {
        self.width
    }

    pub(super) fn clear(&mut self) {
        self.strips.iter_mut().for_each(BorderStrip::clear);
        self.rows.clear();
        self.corner.clear();
    }

    pub(super) fn add_to_column(&mut self, row: usize, border_column: usize, value: f64) {
        self.strips[border_column / STRIP].add(row, border_column % STRIP, value);
    }

    pub(super) fn add_to_row(&mut self, border_row: usize, column: usize, value: f64) {
        self.rows.push((border_row, column, value));
    }

    pub(super) fn add_to_corner(&mut self, border_row: usize, border_column: usize, value: f64) {
        self.corner.add(border_row, border_column, value);
    }

    pub(super) fn set_units(&mut self, at: usize, row: BorderUnit, unknown: BorderUnit) {
        self.units[at] = (row, unknown);
    }

    fn weigh_rows(&mut self) {
        let compliances = self.units.iter().enumerate().map(|(at, units)| match units {
            (BorderUnit::Length(_), BorderUnit::Force) => self.corner.in_band(at, at).abs(),
            _ => 0.0,
        });
        let compliance = compliances.fold(0.0, f64::max);
        if compliance > 0.0 && compliance.is_finite() {
            let stiffness = LENGTHS / compliance;
            let sizes = self.units.iter().map(|(row, _)| square(1.0 / row.row_factor(stiffness)));
            self.corner.set_row_sizes(sizes);
        }
    }

    pub(super) fn in_column(&self, row: usize, border_column: usize) -> f64 {
        self.strips[border_column / STRIP].rows[row][border_column % STRIP]
    }

    pub(super) fn in_row(&self, border_row: usize, column: usize) -> f64 {
        let here = |(r, c, _): &&(usize, usize, f64)| (*r, *c) == (border_row, column);
        self.rows.iter().filter(here).map(|(.., value)| value).sum()
    }

    pub(super) fn in_corner(&self, border_row: usize, border_column: usize) -> f64 {
        self.corner.get(border_row, border_column)
    }

    pub(super) fn entries_with(&self, band: &BandedMatrix) -> Vec<(usize, usize, f64)> {
        let (Self { width, strips, rows, corner, .. }, n) = (self, band.size());
        let reach = band.half_bandwidth();
        let in_band = (0..n).flat_map(|row| {
            let columns = row.saturating_sub(reach)..(row + reach + 1).min(n);
            columns.map(move |column| (row, column, band.in_band(row, column)))
        });
        let in_columns = (0..*width).flat_map(|column| {
            let rows = strips[column / STRIP].rows.iter().enumerate();
            rows.map(move |(row, entries)| (row, n + column, entries[column % STRIP]))
        });
        let in_rows = rows.iter().map(|&(row, column, value)| (n + row, column, value));
        let in_corner = (0..width * width).map(|at| {
            let (row, column) = (at / width, at % width);
            (n + row, n + column, corner.get(row, column))
        });
        let all =
            in_band.chain(band.distant().iter()).chain(in_columns).chain(in_rows).chain(in_corner);
        all.filter(|(.., value)| *value != 0.0).collect()
    }

    pub(super) fn factorise<'a>(
        &'a mut self,
        band: BandedLu<'a>,
        size: usize,
    ) -> Result<FullLu<'a>, LinearError> {
        self.eliminate(&band);
        self.weigh_rows();
        let Self { width, strips, rows, corner, .. } = self;
        let complement = corner.factorise().map_err(|error| error.offset_by_rows(size))?;
        Ok(FullLu { width: *width, band, solved: strips, rows, complement })
    }

    fn eliminate(&mut self, band: &BandedLu<'_>) {
        for strip in &mut self.strips {
            if let Some(first) = strip.first_row {
                band.solve_strip(&mut strip.rows, first);
            }
        }
        for &(row, column, value) in &self.rows {
            let solved = self.strips.iter().flat_map(|strip| strip.rows[column]);
            for (border_column, z) in solved.take(self.width).enumerate() {
                self.corner.add(row, border_column, -value * z);
            }
        }
    }
}

impl FullLu<'_> {
    pub(super) fn solve(&self, x: &mut [f64]) {
        let (x, z) = x.split_at_mut(x.len() - self.width);
        self.band.solve(x);
        for &(row, column, value) in self.rows {
            z[row] -= value * x[column];
        }
        self.complement.solve(z);
        for (strip, z) in self.solved.iter().zip(z.chunks(STRIP)) {
            for (x, solved) in x.iter_mut().zip(&strip.rows) {
                *x -= solved.iter().zip(z).map(|(solved, z)| solved * z).sum::<f64>();
            }
        }
    }
}
