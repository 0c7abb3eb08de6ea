//! Block of a local border: a few unknowns outside a band, and the band unknowns that are coupled to them.
//!
//! A block is a small dense matrix, like the front of a multifrontal method (Duff & Reid, ACM Trans. Math. Softw. 9 (1983) 302–325).
//! The unknowns of a block are eliminated with complete pivoting, and the Schur complement is added to the band.
//! An unknown without a sufficiently large pivot, for example the contact force of a supported slave, is delayed: it is inserted into the band.

use pulp::{Simd, WithSimd};

use super::{BandedMatrix, BorderUnit, LinearError};

/// Number of unknowns of a block outside the band, which equals the number of unknowns of a sliding contact.
pub(super) const BLOCK: usize = 5;

const LANES: usize = 4;

pub(super) const MOST_DELAYED: usize = 2;

const LARGEST_FILL: f64 = 100.0;

/// Placeholder for an index that does not exist, for example the place in a block of a band unknown that is not coupled to the block.
pub(super) const UNTOUCHED: usize = usize::MAX;

pub(super) struct BlockElimination<'a> {
    pub(super) blocks: &'a mut [Block],
    pub(super) band: &'a BandedMatrix,
    pub(super) places: &'a mut [usize],
}

impl WithSimd for BlockElimination<'_> {
    type Output = Result<(), (usize, LinearError)>;

    #[inline(always)]
    fn with_simd<S: Simd>(self, _simd: S) -> Self::Output {
        let Self { blocks, band, places } = self;
        for (index, block) in blocks.iter_mut().enumerate() {
            block.eliminate(band, places).map_err(|error| (index, error))?;
        }
        Ok(())
    }
}

#[derive(Debug, Clone)]
struct Coupling {
    at: usize,
    in_columns: [f64; BLOCK],
    in_rows: [f64; BLOCK],
}

#[derive(Debug, Clone)]
pub(super) struct Block {
    pub(super) own: Vec<usize>,
    couplings: Vec<Coupling>,
    corner: [[f64; BLOCK]; BLOCK],
    pub(super) touched: Vec<usize>,
    front: Vec<f64>,
    pivot_row: Vec<[f64; LANES]>,
    row_at: Vec<usize>,
    column_at: Vec<usize>,
    pub(super) pivots: usize,
    units: [(BorderUnit, BorderUnit); BLOCK],
    /// Scale factors of the rows and columns of the dense matrix, in the order of elimination.
    row_factors: Vec<f64>,
    column_factors: Vec<f64>,
    pub(super) stiffness: f64,
}

impl Block {
    pub(super) fn new(own: Vec<usize>, entries: usize) -> Self {
        let touched = entries / BLOCK;
        let size = own.len() + BLOCK;
        Self {
            couplings: Vec::with_capacity(touched),
            corner: [[0.0; BLOCK]; BLOCK],
            touched: Vec::with_capacity(touched),
            front: Vec::with_capacity((size + touched) * (size + touched).next_multiple_of(LANES)),
            pivot_row: Vec::with_capacity((size + touched).div_ceil(LANES)),
            row_at: Vec::with_capacity(size),
            column_at: Vec::with_capacity(size),
            pivots: 0,
            units: [(BorderUnit::default(), BorderUnit::default()); BLOCK],
            row_factors: Vec::with_capacity(size + touched),
            column_factors: Vec::with_capacity(size + touched),
            stiffness: 1.0,
            own,
        }
    }

    pub(super) fn clear(&mut self) {
        self.couplings.clear();
        self.corner = [[0.0; BLOCK]; BLOCK];
    }

    pub(super) fn add_to_column(&mut self, row: usize, column: usize, value: f64) {
        let mut in_columns = [0.0; BLOCK];
        in_columns[column] = value;
        self.add_couplings(row, &in_columns, &[0.0; BLOCK]);
    }

    pub(super) fn add_to_row(&mut self, row: usize, column: usize, value: f64) {
        let mut in_rows = [0.0; BLOCK];
        in_rows[row] = value;
        self.add_couplings(column, &[0.0; BLOCK], &in_rows);
    }

    pub(super) fn add_couplings(
        &mut self,
        at: usize,
        in_columns: &[f64; BLOCK],
        in_rows: &[f64; BLOCK],
    ) {
        self.couplings.push(Coupling { at, in_columns: *in_columns, in_rows: *in_rows });
    }

    pub(super) fn add_to_corner(&mut self, row: usize, column: usize, value: f64) {
        self.corner[row][column] += value;
    }

    pub(super) fn set_units(&mut self, at: usize, row: BorderUnit, unknown: BorderUnit) {
        self.units[at] = (row, unknown);
    }

    pub(super) fn in_column(&self, row: usize, column: usize) -> f64 {
        let here = self.couplings.iter().filter(|coupling| coupling.at == row);
        here.map(|coupling| coupling.in_columns[column]).sum()
    }

    pub(super) fn in_row(&self, row: usize, column: usize) -> f64 {
        let here = self.couplings.iter().filter(|coupling| coupling.at == column);
        here.map(|coupling| coupling.in_rows[row]).sum()
    }

    pub(super) fn in_corner(&self, row: usize, column: usize) -> f64 {
        self.corner[row][column]
    }

    pub(super) fn candidates(&self) -> usize {
        self.own.len() + BLOCK
    }

    pub(super) fn can_delay_unknowns(&self) -> bool {
        self.own.is_empty()
    }

    pub(super) fn delayed(&self) -> usize {
        self.candidates() - self.pivots
    }

    fn size(&self) -> usize {
        self.candidates() + self.touched.len()
    }

    fn stride(&self) -> usize {
        self.size().next_multiple_of(LANES)
    }

    pub(super) fn scale(&self, left: usize) -> f64 {
        if left < self.delayed() { self.row_factors[self.pivots + left] } else { 1.0 }
    }

    #[inline(always)]
    fn eliminate(&mut self, band: &BandedMatrix, places: &mut [usize]) -> Result<(), LinearError> {
        self.gather(band, places);
        let largest = self.touched.iter().map(|&at| band.in_band(at, at).abs()).fold(0.0, f64::max);
        self.stiffness = if largest > 0.0 { largest } else { 1.0 };
        self.set_scale_factors(band);
        let candidates = self.candidates();
        let fewest = candidates - if self.can_delay_unknowns() { MOST_DELAYED } else { 0 };
        self.row_at.clear();
        self.row_at.extend(0..candidates);
        self.column_at.clear();
        self.column_at.extend(0..candidates);
        self.pivots = 0;
        for at in 0..candidates {
            let (row, column, magnitude) = self.largest_from(at);
            if !magnitude.is_finite() {
                return Err(LinearError::NotFinite { unknown: at, size: candidates });
            }
            if at >= fewest && self.fill(row, column) > LARGEST_FILL * self.stiffness * magnitude {
                break;
            }
            if magnitude == 0.0 {
                return Err(LinearError::Singular { unknown: at, size: candidates });
            }
            self.exchange(at, row, column);
            self.eliminate_one(at);
            self.pivots += 1;
        }
        Ok(())
    }

    #[inline(always)]
    fn gather(&mut self, band: &BandedMatrix, places: &mut [usize]) {
        let (own, candidates) = (self.own.len(), self.candidates());
        for (place, &at) in self.own.iter().enumerate() {
            places[at] = place;
        }
        self.touched.clear();
        for at in self.couplings.iter().map(|coupling| coupling.at) {
            if places[at] == UNTOUCHED {
                places[at] = candidates + self.touched.len();
                self.touched.push(at);
            }
        }
        let (size, stride) = (self.size(), self.stride());
        self.front.clear();
        self.front.resize(size * stride, 0.0);
        for Coupling { at, in_columns, in_rows } in &self.couplings {
            let place = places[*at];
            let row = &mut self.front[place * stride + own..][..BLOCK];
            row.iter_mut().zip(in_columns).for_each(|(entry, value)| *entry += value);
            let column = self.front[own * stride + place..].iter_mut().step_by(stride);
            column.zip(in_rows).for_each(|(entry, value)| *entry += value);
        }
        for (row, values) in self.corner.iter().enumerate() {
            self.front[(own + row) * stride + own..][..BLOCK].copy_from_slice(values);
        }
        for (row, &at) in self.own.iter().enumerate() {
            for (column, &other) in self.own.iter().enumerate() {
                self.front[row * stride + column] += band.in_band(at, other);
            }
        }
        self.own.iter().chain(&self.touched).for_each(|&at| places[at] = UNTOUCHED);
    }

    fn set_scale_factors(&mut self, band: &BandedMatrix) {
        let Self { own, touched, units, row_factors, column_factors, stiffness, .. } = self;
        let of_band = |at: &usize| {
            let diagonal = band.in_band(*at, *at).abs();
            if diagonal > 0.0 { (*stiffness / diagonal).sqrt() } else { 1.0 }
        };
        row_factors.clear();
        row_factors.extend(own.iter().map(of_band));
        row_factors.extend(units.iter().map(|(row, _)| row.row_factor(*stiffness)));
        row_factors.extend(touched.iter().map(of_band));
        column_factors.clear();
        column_factors.extend_from_slice(row_factors);
        let unknowns = column_factors[own.len()..].iter_mut().zip(units);
        unknowns.for_each(|(factor, (_, unknown))| *factor = unknown.column_factor(*stiffness));
    }

    #[inline(always)]
    fn largest_from(&self, first: usize) -> (usize, usize, f64) {
        let (stride, candidates) = (self.stride(), self.candidates());
        let factors = &self.column_factors[first..candidates];
        let mut found = (first, 0.0);
        let mut sum = 0.0;
        for (row, of_row) in (first..candidates).zip(&self.row_factors[first..]) {
            let entries = &self.front[row * stride..][first..candidates];
            let scaled = entries.iter().zip(factors).map(|(entry, factor)| entry.abs() * factor);
            let (mut largest, mut of_entries) = (0.0, 0.0);
            for magnitude in scaled {
                largest = if magnitude > largest { magnitude } else { largest };
                of_entries += magnitude;
            }
            sum += of_entries;
            if largest * of_row > found.1 {
                found = (row, largest * of_row);
            }
        }
        if !f64::is_finite(sum) {
            return (first, first, f64::NAN);
        }
        let (row, magnitude) = found;
        let entries = self.front[row * stride..][first..candidates].iter().zip(factors);
        let is_it = |(entry, factor): (&f64, &f64)| {
            entry.abs() * factor * self.row_factors[row] == magnitude
        };
        let column = entries.map(is_it).position(|is_it| is_it).unwrap_or(0);
        (row, first + column, magnitude)
    }

    fn fill(&self, row: usize, column: usize) -> f64 {
        let (size, stride, candidates) = (self.size(), self.stride(), self.candidates());
        let of_row = self.front[row * stride..][candidates..size].iter();
        let of_row = of_row.zip(&self.column_factors[candidates..]);
        let of_row = of_row.map(|(entry, factor)| entry.abs() * factor).fold(0.0, f64::max);
        let of_column = (candidates..size)
            .map(|touched| self.front[touched * stride + column].abs() * self.row_factors[touched]);
        of_row * self.row_factors[row] * of_column.fold(0.0, f64::max) * self.column_factors[column]
    }

    fn exchange(&mut self, at: usize, row: usize, column: usize) {
        let stride = self.stride();
        if row != at {
            let (before, behind) = self.front.split_at_mut(row * stride);
            before[at * stride..][..stride].swap_with_slice(&mut behind[..stride]);
            self.row_at.swap(at, row);
            self.row_factors.swap(at, row);
        }
        if column != at {
            self.front.chunks_exact_mut(stride).for_each(|row| row.swap(at, column));
            self.column_at.swap(at, column);
            self.column_factors.swap(at, column);
        }
    }

    #[inline(always)]
    fn eliminate_one(&mut self, at: usize) {
        let (stride, first) = (self.stride(), (at + 1) / LANES);
        let (above, below) = self.front.split_at_mut((at + 1) * stride);
        let row = &mut above[at * stride..];
        let inverse = 1.0 / row[at];
        row[at] = inverse;
        self.pivot_row.clear();
        self.pivot_row.extend_from_slice(&row.as_chunks().0[first..]);
        if let Some(head) = self.pivot_row.first_mut() {
            head[..(at + 1) % LANES].fill(0.0);
        }
        for other in below.chunks_exact_mut(stride).filter(|other| other[at] != 0.0) {
            let multiplier = other[at] * inverse;
            other[at] = multiplier;
            let (others, _) = other.as_chunks_mut::<LANES>();
            for (entries, above) in others[first..].iter_mut().zip(&self.pivot_row) {
                for (entry, above) in entries.iter_mut().zip(above) {
                    *entry -= multiplier * above;
                }
            }
        }
    }

    pub(super) fn schur_complement(&self) -> impl Iterator<Item = (usize, &[f64])> {
        let (size, stride, first) = (self.size(), self.stride(), self.pivots);
        let rows = self.front.chunks_exact(stride).map(move |row| &row[..size]).skip(first);
        rows.map(move |row| &row[first..]).enumerate()
    }

    pub(super) fn substitute(&self, own: &mut [f64], mut subtract: impl FnMut(usize, f64)) {
        let rows = self.front.chunks_exact(self.stride());
        for (at, row) in rows.enumerate() {
            let count = at.min(self.pivots);
            let sum = row[..count].iter().zip(&*own).fold(0.0, |sum, (l, y)| sum + l * y);
            match own.get_mut(at) {
                Some(own) => *own -= sum,
                None => subtract(at - self.candidates(), sum),
            }
        }
    }

    pub(super) fn back_substitute(&self, all: &mut [f64]) {
        let (size, stride) = (self.size(), self.stride());
        for at in (0..self.pivots).rev() {
            let row = &self.front[at * stride + at..][..size - at];
            let known = row[1..].iter().zip(&all[at + 1..]);
            let rest = known.fold(all[at], |rest, (entry, x)| rest - entry * x);
            all[at] = rest * row[0];
        }
    }

    pub(super) fn by_rows<'a>(
        &'a self,
        own: impl Fn(usize) -> f64 + 'a,
        block: &'a [f64],
    ) -> impl Iterator<Item = f64> + 'a {
        self.row_at.iter().map(move |&at| match at.checked_sub(self.own.len()) {
            None => own(self.own[at]),
            Some(at) => block[at],
        })
    }

    pub(super) fn unknowns(&self) -> impl Iterator<Item = Result<usize, usize>> + '_ {
        self.column_at
            .iter()
            .map(|&at| at.checked_sub(self.own.len()).map_or_else(|| Ok(self.own[at]), Err))
    }
}
