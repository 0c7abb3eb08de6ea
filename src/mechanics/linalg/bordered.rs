//! A banded matrix with a few full columns and rows at its end, factorised by blocks.
//!
//! ```text
//! [ A  B ] [x]   [f]        Z = A⁻¹ B      y = A⁻¹ f
//! [ C  D ] [z] = [g]        (D - C Z) z = g - C y      x = y - Z z
//! ```
//!
//! The band keeps its width whatever the border couples (Govaerts & Pryce, Block elimination with one iterative
//! refinement solves bordered linear systems accurately, BIT 30 (1990) 490–507; refining is the business of the caller).

use super::together::{Together, TogetherLu};
use super::{BandedLu, BandedMatrix, LinearError};

/// A square matrix that is banded but for its last rows and columns, the border.
#[derive(Debug, Clone)]
pub struct BorderedMatrix {
    band: BandedMatrix,
    border: Border,
    /// Where the band alone may be singular.
    together: Option<Together>,
}

/// The size of the border of a [`BorderedMatrix`]: its last rows and columns, which are full.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct BorderShape {
    /// The number of rows of the border, and of its columns.
    pub width: usize,
    /// How many entries the rows of the border may have together in the columns of the band.
    pub row_entries: usize,
}

/// Columns of the border are kept and solved in strips of so many, a number that the compiler knows: that of the unknowns of
/// a sliding contact, for which borders are.
const STRIP: usize = 5;

/// Some columns of `B`; after factorising, of `Z`.
#[derive(Debug, Clone)]
struct Strip {
    rows: Vec<[f64; STRIP]>,
    /// The first row with an entry.
    first_row: Option<usize>,
}

/// The border of a [`BorderedMatrix`]: its last columns `B`, its last rows `C` and their common corner `D`.
#[derive(Debug, Clone)]
pub struct Border {
    width: usize,
    strips: Vec<Strip>,
    /// `C`: (row of the border, column, value); entries of one place add up.
    rows: Vec<(usize, usize, f64)>,
    corner: BandedMatrix,
}

/// The factors of a [`BorderedMatrix`], kept in its storage.
#[derive(Debug)]
pub struct BorderedLu<'a>(Factors<'a>);

#[derive(Debug)]
enum Factors<'a> {
    Band(BandedLu<'a>),
    Blocks(BandedLu<'a>, FactorisedBorder<'a>),
    Together(TogetherLu<'a>),
}

#[derive(Debug)]
struct FactorisedBorder<'a> {
    width: usize,
    /// `Z`
    solved: &'a [Strip],
    /// `C`
    rows: &'a [(usize, usize, f64)],
    complement: BandedLu<'a>,
}

impl Strip {
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

impl Border {
    fn zeros(size: usize, BorderShape { width, row_entries }: BorderShape) -> Self {
        Self {
            width,
            strips: vec![Strip::zeros(size); width.div_ceil(STRIP)],
            rows: Vec::with_capacity(row_entries),
            corner: BandedMatrix::zeros(width, width.saturating_sub(1)),
        }
    }

    /// The number of rows of the border, which is that of its columns.
    pub fn width(&self) -> usize {
        self.width
    }

    fn clear(&mut self) {
        self.strips.iter_mut().for_each(Strip::clear);
        self.rows.clear();
        self.corner.clear();
    }

    /// Adds `value` to the part `B` of the border, at a row of the band and a column of the border.
    pub fn add_to_column(&mut self, row: usize, border_column: usize, value: f64) {
        self.strips[border_column / STRIP].add(row, border_column % STRIP, value);
    }

    /// Adds `value` to the part `C` of the border, at a row of the border and a column of the band.
    pub fn add_to_row(&mut self, border_row: usize, column: usize, value: f64) {
        self.rows.push((border_row, column, value));
    }

    /// Adds `value` to the corner `D` of the border, at a row and a column of the border.
    pub fn add_to_corner(&mut self, border_row: usize, border_column: usize, value: f64) {
        self.corner.add(border_row, border_column, value);
    }

    /// Makes `Z` of `B` and `D - C Z` of `D`.
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

impl BorderedMatrix {
    /// The zero matrix: `size` rows with entries up to `half_bandwidth` places off the diagonal, and a border.
    pub fn zeros(size: usize, half_bandwidth: usize, border: BorderShape) -> Self {
        Self {
            band: BandedMatrix::zeros(size, half_bandwidth),
            border: Border::zeros(size, border),
            together: None,
        }
    }

    /// The same matrix, to be eliminated with the border among the rows of the band, which alone may be singular; the last `full` rows and columns,
    /// which couple with all others, are a border still.
    pub fn together(self, full: usize) -> Self {
        Self { together: Some(Together::new(self.size(), full)), ..self }
    }

    /// All entries of the matrix that are not zero: row, column, value; those of one place add up.
    fn entries(&self) -> Vec<(usize, usize, f64)> {
        let (band, n, Border { width, strips, rows, corner }) =
            (&self.band, self.band.size(), &self.border);
        let reach = band.half_bandwidth();
        let in_band = (0..n).flat_map(|row| {
            let columns = row.saturating_sub(reach)..(row + reach + 1).min(n);
            columns.map(move |column| (row, column, band.get(row, column)))
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
        let all = in_band.chain(in_columns).chain(in_rows).chain(in_corner);
        all.filter(|(.., value)| *value != 0.0).collect()
    }

    /// The number of rows of the matrix, those of the border included.
    pub fn size(&self) -> usize {
        self.band.size() + self.border.width
    }

    /// The banded part `A` of a bordered matrix, to be read.
    pub fn band(&self) -> &BandedMatrix {
        &self.band
    }

    /// The banded part `A` of a bordered matrix, to be changed.
    pub fn band_mut(&mut self) -> &mut BandedMatrix {
        &mut self.band
    }

    /// The border of the matrix, to add entries to.
    pub fn border_mut(&mut self) -> &mut Border {
        &mut self.border
    }

    /// Sets every entry of the matrix, those of the border included, to zero.
    pub fn clear(&mut self) {
        self.band.clear();
        self.border.clear();
    }

    /// The entry of the matrix at `(row, column)`; zero outside band and border.
    pub fn get(&self, row: usize, column: usize) -> f64 {
        let (n, Border { strips, rows, corner, .. }) = (self.band.size(), &self.border);
        match (row.checked_sub(n), column.checked_sub(n)) {
            (None, None) => self.band.get(row, column),
            (None, Some(border_column)) => {
                strips[border_column / STRIP].rows[row][border_column % STRIP]
            }
            (Some(border_row), None) => {
                let here = |(r, c, _): &&(usize, usize, f64)| (*r, *c) == (border_row, column);
                rows.iter().filter(here).map(|(.., value)| value).sum()
            }
            (Some(border_row), Some(border_column)) => corner.get(border_row, border_column),
        }
    }

    /// Replaces the entries of the matrix by its factors. Without a border these are the factors of the band and nothing else.
    ///
    /// # Errors
    /// When a column has no non-zero or no finite pivot; the entries are then lost.
    pub fn factorise(&mut self) -> Result<BorderedLu<'_>, LinearError> {
        let entries = self.together.as_ref().map(|_| self.entries());
        let Self { band, border, together } = self;
        if let (Some(together), Some(entries)) = (together, entries) {
            return together.factorise(&entries).map(Factors::Together).map(BorderedLu);
        }
        let size = band.size();
        let band = band.factorise()?;
        if border.width == 0 {
            return Ok(BorderedLu(Factors::Band(band)));
        }
        border.eliminate(&band);
        let Border { width, strips, rows, corner } = border;
        let complement = corner.factorise().map_err(|error| error.behind(size))?;
        let border = FactorisedBorder { width: *width, solved: strips, rows, complement };
        Ok(BorderedLu(Factors::Blocks(band, border)))
    }
}

impl BorderedLu<'_> {
    /// Replaces the right-hand side `x`, one number a row, those of the border last, by the solution of `A x = b`.
    pub fn solve(&self, x: &mut [f64]) {
        match &self.0 {
            Factors::Band(band) => band.solve(x),
            Factors::Blocks(band, border) => border.solve(band, x),
            Factors::Together(together) => together.solve(x),
        }
    }
}

impl FactorisedBorder<'_> {
    /// Solves for the unknowns of the band without the border, for the border, and then for both.
    fn solve(&self, band: &BandedLu<'_>, x: &mut [f64]) {
        let (x, z) = x.split_at_mut(x.len() - self.width);
        band.solve(x);
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

#[cfg(test)]
mod tests {
    use super::*;
    use nalgebra::{DMatrix, DVector};
    use proptest::prelude::*;

    proptest! {
        #[test]
        fn the_bordered_solution_is_the_dense_one(
            size in 1_usize..30, half_bandwidth in 0_usize..6, width in 0_usize..12,
            entries in prop::collection::vec(-1.0..1.0_f64, 997), sparse in any::<u64>(),
        ) {
            let border = BorderShape { width, row_entries: 0 };
            let mut matrix = BorderedMatrix::zeros(size, half_bandwidth, border);
            let mut entries = entries.iter().cycle();
            let mut next = || *entries.next().unwrap();
            for i in 0..size {
                for j in i.saturating_sub(half_bandwidth)..(i + half_bandwidth + 1).min(size) {
                    matrix.band_mut().add(i, j, next());
                }
                if sparse >> (i % 64) & 1 == 1 {
                    for k in 0..width {
                        matrix.border_mut().add_to_column(i, k, next());
                        matrix.border_mut().add_to_row(k, i, next());
                    }
                }
            }
            for i in 0..width {
                (0..width).for_each(|j| matrix.border_mut().add_to_corner(i, j, next()));
            }
            let dense = DMatrix::from_fn(matrix.size(), matrix.size(), |i, j| matrix.get(i, j));
            let smallest = |m: &DMatrix<f64>| m.clone().svd(false, false).singular_values.min();
            prop_assume!(smallest(&dense) > 1e-2);
            prop_assume!(smallest(&dense.view((0, 0), (size, size)).into_owned()) > 1e-2);
            let right = DVector::from_fn(matrix.size(), |i, _| (i as f64 + 1.0).sin());
            let mut x = right.as_slice().to_vec();
            matrix.factorise().unwrap().solve(&mut x);
            let error = dense * DVector::from_vec(x) - right;
            prop_assert!(error.amax() < 1e-8, "residual {}", error.amax());
        }
    }

    #[test]
    fn what_only_the_border_holds_is_solved_with_it() {
        // Three masses on springs of stiffness 2 and 3, of which the border holds the last; the last border row is full.
        let border = BorderShape { width: 2, row_entries: 4 };
        let mut matrix = BorderedMatrix::zeros(3, 1, border).together(1);
        for (at, stiffness) in [2e6, 3e6].into_iter().enumerate() {
            for (row, column) in [(at, at), (at + 1, at + 1)] {
                matrix.band_mut().add(row, column, stiffness);
            }
            matrix.band_mut().add(at, at + 1, -stiffness);
            matrix.band_mut().add(at + 1, at, -stiffness);
        }
        matrix.border_mut().add_to_row(0, 2, 1.0);
        matrix.border_mut().add_to_column(2, 0, 1.0);
        for at in 0..3 {
            matrix.border_mut().add_to_row(1, at, 1.0 + at as f64);
            matrix.border_mut().add_to_column(at, 1, -1.0);
        }
        matrix.border_mut().add_to_corner(0, 1, 0.5);
        let dense = DMatrix::from_fn(5, 5, |i, j| matrix.get(i, j));
        for _ in 0..2 {
            let mut x = [1.0, -2.0, 0.5, 0.25, 4.0];
            matrix.factorise().unwrap().solve(&mut x);
            let right = DVector::from_vec(vec![1.0, -2.0, 0.5, 0.25, 4.0]);
            let error = &dense * DVector::from_row_slice(&x) - right;
            assert!(error.amax() < 1e-9, "{error}");
        }
    }

    #[test]
    fn a_border_that_determines_nothing_is_named_by_its_unknown() {
        let mut matrix = BorderedMatrix::zeros(2, 0, BorderShape { width: 1, row_entries: 0 });
        matrix.band_mut().add(0, 0, 1.0);
        matrix.band_mut().add(1, 1, 1.0);
        matrix.border_mut().add_to_column(1, 0, 1.0);
        let error = matrix.factorise().unwrap_err();
        assert_eq!(error, LinearError::Singular { unknown: 2, size: 3 });
    }
}
