//! Banded matrix with a border: additional columns and rows that may have entries anywhere.
//!
//! A border with few unknowns is stored as dense columns, which do not change the band.
//! A border of many blocks is eliminated block by block, with work in proportion to the number of blocks.

use super::block::BLOCK;
use super::full_border::FullLu;
use super::joint_elimination::{JointElimination, JointLu};
use super::local_border::LocalLu;
use super::two_ended::{TwoEnded, TwoEndedLu};
use super::{BandedLu, BandedMatrix, BlockLayout, FullBorder, LinearError, LocalBorder};

/// Square matrix that consists of a band and a border. The border comprises the last rows and columns.
#[derive(Debug, Clone)]
pub struct BorderedMatrix {
    band: BandedMatrix,
    border: Border,
    joint_elimination: Option<JointElimination>,
    ends: Option<Box<TwoEnded>>,
}

/// Size of the border of a [`BorderedMatrix`].
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct BorderShape {
    /// Number of border rows and columns.
    pub width: usize,
    /// Upper bound of the number of nonzero entries in the rows `C` of the border.
    pub row_entries: usize,
}

/// Unit of a border row or border unknown. In the band, unknowns are lengths and rows are forces.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub enum BorderUnit {
    /// Force.
    #[default]
    Force,
    /// Unit other than force, with the number that converts this unit to a length.
    Length(f64),
}

impl BorderUnit {
    pub(super) fn row_factor(self, stiffness: f64) -> f64 {
        match self {
            Self::Force => 1.0,
            Self::Length(factor) => factor * stiffness,
        }
    }

    pub(super) fn column_factor(self, stiffness: f64) -> f64 {
        match self {
            Self::Force => stiffness,
            Self::Length(factor) => 1.0 / factor,
        }
    }
}

/// Border of a [`BorderedMatrix`]: its last columns `B`, its last rows `C` and their common corner `D`.
#[derive(Debug, Clone)]
pub enum Border {
    /// Dense columns, and rows that are stored as a list of entries.
    Full(FullBorder),
    /// Blocks of five unknowns. Each block is coupled to few unknowns of the band, and to no other block.
    Local(Box<LocalBorder>),
}

/// Factors of a [`BorderedMatrix`], stored in the memory of its entries.
#[derive(Debug)]
pub struct BorderedLu<'a>(BorderFactors<'a>);

#[derive(Debug)]
enum BorderFactors<'a> {
    Band(BandedLu<'a>),
    TwoEnded(TwoEndedLu<'a>),
    Full(FullLu<'a>),
    Joint(JointLu<'a>),
    Local(LocalLu<'a>),
}

impl Border {
    /// Number of border rows and columns.
    pub fn width(&self) -> usize {
        match self {
            Self::Full(border) => border.width(),
            Self::Local(border) => border.width(),
        }
    }

    fn clear(&mut self) {
        match self {
            Self::Full(border) => border.clear(),
            Self::Local(border) => border.clear(),
        }
    }

    /// Adds `value` to the columns `B` of the border, at the given row of the band and column of the border.
    pub fn add_to_column(&mut self, row: usize, border_column: usize, value: f64) {
        match self {
            Self::Full(border) => border.add_to_column(row, border_column, value),
            Self::Local(border) => {
                let (block, column) = border.block_mut(border_column);
                block.add_to_column(row, column, value);
            }
        }
    }

    /// Adds `value` to the rows `C` of the border, at the given row of the border and column of the band.
    pub fn add_to_row(&mut self, border_row: usize, column: usize, value: f64) {
        match self {
            Self::Full(border) => border.add_to_row(border_row, column, value),
            Self::Local(border) => {
                let (block, row) = border.block_mut(border_row);
                block.add_to_row(row, column, value);
            }
        }
    }

    /// Adds the couplings of an unknown of the band with consecutive unknowns of the border, starting with `first`.
    /// In a border of blocks, all border unknowns of one call of `add_couplings` must belong to the same block.
    pub(crate) fn add_couplings(
        &mut self,
        at: usize,
        first: usize,
        in_columns: &[f64; BLOCK],
        in_rows: &[f64; BLOCK],
    ) {
        match self {
            Self::Local(border) => border.block_mut(first).0.add_couplings(at, in_columns, in_rows),
            Self::Full(border) => {
                for (index, (column, row)) in (first..).zip(in_columns.iter().zip(in_rows)) {
                    if *column != 0.0 {
                        border.add_to_column(at, index, *column);
                    }
                    if *row != 0.0 {
                        border.add_to_row(index, at, *row);
                    }
                }
            }
        }
    }

    /// Adds `value` to the corner `D` of the border. In a border of blocks, row and column must belong to the same block.
    pub fn add_to_corner(&mut self, border_row: usize, border_column: usize, value: f64) {
        match self {
            Self::Full(border) => border.add_to_corner(border_row, border_column, value),
            Self::Local(border) => {
                let (block, row) = border.block_mut(border_row);
                block.add_to_corner(row, LocalBorder::column_in(border_row, border_column), value);
            }
        }
    }

    pub(crate) fn set_units(&mut self, at: usize, row: BorderUnit, unknown: BorderUnit) {
        match self {
            Self::Full(border) => border.set_units(at, row, unknown),
            Self::Local(border) => {
                let (block, at) = border.block_mut(at);
                block.set_units(at, row, unknown);
            }
        }
    }

    fn get(&self, row: Result<usize, usize>, column: Result<usize, usize>) -> f64 {
        match (self, row, column) {
            (_, Ok(_), Ok(_)) => 0.0,
            (Self::Full(border), Ok(row), Err(column)) => border.in_column(row, column),
            (Self::Full(border), Err(row), Ok(column)) => border.in_row(row, column),
            (Self::Full(border), Err(row), Err(column)) => border.in_corner(row, column),
            (Self::Local(border), row, column) => border.get(row, column),
        }
    }
}

impl BorderedMatrix {
    /// Creates a zero matrix with a dense border. Its band has `size` rows, with entries up to `half_bandwidth` columns away from the diagonal.
    pub fn zeros(size: usize, half_bandwidth: usize, border: BorderShape) -> Self {
        Self {
            band: BandedMatrix::zeros(size, half_bandwidth),
            border: Border::Full(FullBorder::zeros(size, border)),
            joint_elimination: None,
            ends: if border.width == 0 {
                TwoEnded::worthwhile(size, half_bandwidth).map(Box::new)
            } else {
                None
            },
        }
    }

    /// Creates a zero matrix with a border of blocks. Its band has `size` rows, with entries up to `half_bandwidth` columns away from the diagonal.
    pub fn with_blocks(size: usize, half_bandwidth: usize, layout: BlockLayout) -> Self {
        Self {
            band: BandedMatrix::zeros(size, half_bandwidth),
            border: Border::Local(Box::new(LocalBorder::zeros(size, half_bandwidth, layout))),
            joint_elimination: None,
            ends: None,
        }
    }

    /// Returns the matrix with joint elimination, which eliminates the band and the border together.
    /// Joint elimination is needed if the band without the border may be singular.
    /// The last `full` rows and columns may have entries everywhere, and are eliminated after all others.
    pub(crate) fn with_joint_elimination(self, full: usize) -> Self {
        Self {
            joint_elimination: Some(JointElimination::new(self.size(), full)),
            ends: None,
            ..self
        }
    }

    /// Sets the number of threads for a long band. The number of threads does not change the results.
    pub fn use_threads(&mut self, threads: usize) {
        if let Some(ends) = &mut self.ends {
            ends.use_threads(threads);
        }
    }

    /// Number of rows of the matrix, including the rows of the border.
    pub fn size(&self) -> usize {
        self.band.size() + self.border.width()
    }

    /// Banded part `A` of the matrix.
    pub fn band(&self) -> &BandedMatrix {
        &self.band
    }

    /// Mutable banded part `A` of the matrix.
    pub fn band_mut(&mut self) -> &mut BandedMatrix {
        &mut self.band
    }

    /// Mutable border, for adding entries.
    pub fn border_mut(&mut self) -> &mut Border {
        &mut self.border
    }

    /// Sets every entry to zero, including the entries of the border.
    pub fn clear(&mut self) {
        match &self.ends {
            Some(ends) => ends.clear(&mut self.band),
            None => self.band.clear(),
        }
        self.border.clear();
    }

    /// Entry at `(row, column)`; zero outside the band, the border and the dense blocks of distant couplings.
    pub fn get(&self, row: usize, column: usize) -> f64 {
        let place = |at: usize| at.checked_sub(self.band.size()).map_or(Ok(at), Err);
        match (place(row), place(column)) {
            (Ok(row), Ok(column)) => self.band.get(row, column),
            (row, column) => self.border.get(row, column),
        }
    }

    /// Replaces the entries of the matrix by its factors.
    ///
    /// # Errors
    /// Fails if a column has no nonzero finite pivot. The entries of the matrix are then lost.
    pub fn factorise(&mut self) -> Result<BorderedLu<'_>, LinearError> {
        let Self { band, border, joint_elimination: together, ends } = self;
        let size = band.size();
        let factors = match (border, together) {
            (Border::Local(border), _) if border.width() == 0 && band.distant().is_empty() => {
                band.weigh_rows();
                BorderFactors::Band(band.factorise()?)
            }
            (Border::Local(border), _) => BorderFactors::Local(border.factorise(band)?),
            (Border::Full(border), Some(together)) => {
                BorderFactors::Joint(together.factorise(&border.entries_with(band))?)
            }
            (Border::Full(border), None) if border.width() == 0 => match ends {
                Some(ends) => BorderFactors::TwoEnded(ends.factorise(band)?),
                None => {
                    band.weigh_rows();
                    BorderFactors::Band(band.factorise()?)
                }
            },
            (Border::Full(border), None) => {
                band.weigh_rows();
                BorderFactors::Full(border.factorise(band.factorise()?, size)?)
            }
        };
        Ok(BorderedLu(factors))
    }
}

impl BorderedLu<'_> {
    /// Replaces the right-hand side `x` by the solution of `A x = b`. The entries of the border are last in `x`.
    pub fn solve(&mut self, x: &mut [f64]) {
        match &mut self.0 {
            BorderFactors::Band(factors) => factors.solve(x),
            BorderFactors::TwoEnded(factors) => factors.solve(x),
            BorderFactors::Full(factors) => factors.solve(x),
            BorderFactors::Joint(factors) => factors.solve(x),
            BorderFactors::Local(factors) => factors.solve(x),
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
        fn bordered_solution_agrees_with_the_dense_solution(
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
    fn unknowns_held_only_by_the_border_are_solved() {
        let border = BorderShape { width: 2, row_entries: 4 };
        let mut matrix = BorderedMatrix::zeros(3, 1, border).with_joint_elimination(1);
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

    fn in_units(length: f64, force: f64, mut matrix: BorderedMatrix, seed: f64) -> Vec<f64> {
        let of_band = [(force, length), (force, length), (force * length, 1.0)];
        let of_contact = [(length, force), (length, force), (force, force), (force, force)];
        let of_way = [(force, 1.0)];
        let units = of_band.iter().cycle().take(12).chain(&of_contact).chain(&of_way);
        let units: Vec<(f64, f64)> = units.copied().collect();
        let mut value = seed;
        let mut next = || {
            value = (7.3 * value).sin();
            value
        };
        let mut entry =
            |row: usize, column: usize, value: f64| value * units[row].0 / units[column].1 * next();
        for row in 0..12_usize {
            for column in row.saturating_sub(5)..(row + 6).min(12) {
                let stiff = if row == column { 1e4 } else { 30.0 };
                let value = entry(row, column, stiff).abs();
                matrix.band_mut().add(row, column, value);
            }
        }
        for at in 0..5 {
            for touched in [0, 1, 3, 4, 6, 7] {
                let (column, row) = (entry(touched, 12 + at, 1.0), entry(12 + at, touched, 1.0));
                matrix.border_mut().add_to_column(touched, at, column);
                matrix.border_mut().add_to_row(at, touched, row);
            }
            for other in 0..5 {
                let value = if at < 2 && other < 4 { 0.0 } else { 1.0 };
                let value = entry(12 + at, 12 + other, value);
                matrix.border_mut().add_to_corner(at, other, value);
            }
            let row = if at < 2 { BorderUnit::Length(1.0) } else { BorderUnit::Force };
            let unknown = if at < 4 { BorderUnit::Force } else { BorderUnit::Length(length) };
            matrix.border_mut().set_units(at, row, unknown);
        }
        let mut x: Vec<f64> =
            units.iter().enumerate().map(|(at, unit)| (1.0 + at as f64) * unit.0).collect();
        matrix.factorise().unwrap().solve(&mut x);
        x.iter().zip(units).map(|(x, (_, unit))| x / unit).collect()
    }

    #[test]
    fn bordered_solution_is_bit_identical_in_power_of_two_units() {
        let full = || BorderedMatrix::zeros(12, 5, BorderShape { width: 5, row_entries: 30 });
        let groups = (0..7).map(|first| (first..first + 6).collect()).collect();
        let layout = BlockLayout { own: vec![vec![]], groups, block_entries: 30 };
        let local = || BorderedMatrix::with_blocks(12, 5, layout.clone());
        for seed in 1..50 {
            let seed = f64::from(seed);
            let first = [in_units(1.0, 1.0, full(), seed), in_units(1.0, 1.0, local(), seed)];
            for (length, force) in [(-20, 0), (16, 4), (0, -60), (-40, 50)] {
                let (length, force) = (2.0_f64.powi(length), 2.0_f64.powi(force));
                assert_eq!(first[0], in_units(length, force, full(), seed));
                assert_eq!(first[1], in_units(length, force, local(), seed));
            }
            let apart = first[0].iter().zip(&first[1]).map(|(a, b)| (a - b).abs());
            let size = first[0].iter().fold(0.0_f64, |size, x| size.max(x.abs()));
            assert!(apart.fold(0.0, f64::max) < 1e-9 * size);
        }
    }

    #[test]
    fn singular_border_error_names_the_unknown() {
        let mut matrix = BorderedMatrix::zeros(2, 0, BorderShape { width: 1, row_entries: 0 });
        matrix.band_mut().add(0, 0, 1.0);
        matrix.band_mut().add(1, 1, 1.0);
        matrix.border_mut().add_to_column(1, 0, 1.0);
        let error = matrix.factorise().unwrap_err();
        assert_eq!(error, LinearError::Singular { unknown: 2, size: 3 });
    }
}
