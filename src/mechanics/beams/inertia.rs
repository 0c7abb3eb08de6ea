//! Inertia matrix of a beam, stored by diagonals.

use std::ops::Range;

use pulp::{Arch, Simd, WithSimd};

use super::Section;
use super::dynamics::Movement;
use super::sections::MassIntegral;

/// Number of control points whose rows are processed together. The rows stay in the cache while all diagonals are processed.
const ROWS_PER_PASS: usize = 16;

#[derive(Debug, Clone)]
pub(super) struct InertiaMatrix<const N: usize, I> {
    gram: Vec<[I; N]>,
    diagonals: [Vec<f64>; N],
    shares: Vec<f64>,
    section: Section,
}

impl<const N: usize, I: MassIntegral> InertiaMatrix<N, I> {
    pub(super) fn new(gram: Vec<[I; N]>, section: Section) -> Self {
        let diagonal = |k: usize| gram.iter().flat_map(|row| row[k].weights()).collect();
        let shares = gram.iter().flat_map(|_| I::shares(&section)).collect();
        Self { diagonals: std::array::from_fn(diagonal), shares, section, gram }
    }

    pub(super) fn lumped(&self, of: impl Fn(I) -> f64) -> Vec<f64> {
        let mut sums = vec![0.0; self.gram.len()];
        for (a, row) in self.gram.iter().enumerate() {
            for (b, entry) in (a..self.gram.len()).zip(row) {
                sums[a] += of(*entry);
                if b > a {
                    sums[b] += of(*entry);
                }
            }
        }
        sums
    }

    pub(super) fn add_product(
        &self,
        points: Range<usize>,
        factor: f64,
        rates: &[Movement],
        forces: &mut [Movement],
    ) {
        let (rates, forces) = (rates.as_flattened(), forces.as_flattened_mut());
        Arch::new().dispatch(InertiaProduct { matrix: self, points, factor, rates, forces });
    }

    pub(super) fn each_diagonal(
        &self,
        factor: f64,
        points: Range<usize>,
        take: &mut dyn FnMut(usize, isize, &[f64]),
    ) {
        Arch::new().dispatch(Diagonals { matrix: self, points, factor, take });
    }

    pub(super) fn each_row(
        &self,
        factor: f64,
        points: Range<usize>,
        take: &mut dyn FnMut(usize, usize, &[Movement]),
    ) {
        for point in points {
            let first = point.saturating_sub(N - 1);
            let mut row = [Movement::default(); N];
            for (inertia, other) in row.iter_mut().zip(first..point) {
                *inertia = self.gram[other][point - other].inertia(factor, &self.section);
            }
            take(point, first, &row[..point - first]);
            row = self.gram[point].map(|entry| entry.inertia(factor, &self.section));
            take(point, point, &row[..N.min(self.gram.len() - point)]);
        }
    }
}

struct Diagonals<'a, const N: usize, I> {
    matrix: &'a InertiaMatrix<N, I>,
    points: Range<usize>,
    factor: f64,
    take: &'a mut dyn FnMut(usize, isize, &[f64]),
}

impl<const N: usize, I> WithSimd for Diagonals<'_, N, I> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(self, simd: S) {
        let Self { matrix: InertiaMatrix { gram, diagonals, shares, .. }, points, factor, take } =
            self;
        let mut entries = [0.0; 3 * ROWS_PER_PASS];
        for first in points.clone().step_by(ROWS_PER_PASS) {
            let end = points.end.min(first + ROWS_PER_PASS);
            for offset in 1 - N as isize..N as isize {
                let k = offset.unsigned_abs();
                let (first, columns) = if offset < 0 {
                    (first.max(k), first.max(k) - k..end.max(k) - k)
                } else {
                    (first, first..end.min(gram.len().saturating_sub(k)).max(first))
                };
                let columns = 3 * columns.start..3 * columns.end;
                let entries = &mut entries[..columns.len()];
                multiply(simd, factor, [&diagonals[k][columns.clone()], &shares[columns]], entries);
                take(first, offset, entries);
            }
        }
    }
}

struct InertiaProduct<'a, const N: usize, I> {
    matrix: &'a InertiaMatrix<N, I>,
    points: Range<usize>,
    factor: f64,
    rates: &'a [f64],
    forces: &'a mut [f64],
}

impl<const N: usize, I> WithSimd for InertiaProduct<'_, N, I> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(self, simd: S) {
        let Self { matrix: InertiaMatrix { gram, diagonals, shares, .. }, points, factor, .. } =
            self;
        let (rates, forces) = (self.rates, self.forces);
        let numbers = |points: Range<usize>| 3 * points.start..3 * points.end;
        for (k, diagonal) in diagonals.iter().enumerate().skip(1).rev() {
            let rows = points.start.max(k)..points.end;
            if !rows.is_empty() {
                let columns = numbers(rows.start - k..rows.end - k);
                let factors =
                    [&diagonal[columns.clone()], &shares[columns.clone()], &rates[columns]];
                add_products(simd, factor, factors, &mut forces[3 * (rows.start - points.start)..]);
            }
        }
        for (k, diagonal) in diagonals.iter().enumerate() {
            let rows = points.start..points.end.min(gram.len().saturating_sub(k));
            if !rows.is_empty() {
                let columns = numbers(rows.start + k..rows.end + k);
                let rows = numbers(rows);
                let forces = &mut forces[..rows.len()];
                let factors = [&diagonal[rows.clone()], &shares[rows], &rates[columns]];
                add_products(simd, factor, factors, forces);
            }
        }
    }
}

#[inline(always)]
fn multiply<S: Simd>(simd: S, factor: f64, [one, two]: [&[f64]; 2], out: &mut [f64]) {
    let (head, rest) = S::as_mut_simd_f64s(out);
    let (one, one_rest) = S::as_simd_f64s(one);
    let (two, two_rest) = S::as_simd_f64s(two);
    let factors = simd.splat_f64s(factor);
    for ((out, one), two) in head.iter_mut().zip(one).zip(two) {
        *out = simd.mul_f64s(simd.mul_f64s(factors, *one), *two);
    }
    for ((out, one), two) in rest.iter_mut().zip(one_rest).zip(two_rest) {
        *out = factor * one * two;
    }
}

#[inline(always)]
fn add_products<S: Simd>(simd: S, factor: f64, [one, two, three]: [&[f64]; 3], out: &mut [f64]) {
    let (head, rest) = S::as_mut_simd_f64s(out);
    let (one, one_rest) = S::as_simd_f64s(one);
    let (two, two_rest) = S::as_simd_f64s(two);
    let (three, three_rest) = S::as_simd_f64s(three);
    let factors = simd.splat_f64s(factor);
    for (((out, one), two), three) in head.iter_mut().zip(one).zip(two).zip(three) {
        let product = simd.mul_f64s(simd.mul_f64s(factors, *one), *two);
        *out = simd.add_f64s(*out, simd.mul_f64s(product, *three));
    }
    for (((out, one), two), three) in rest.iter_mut().zip(one_rest).zip(two_rest).zip(three_rest) {
        *out += factor * one * two * three;
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    const SECTION: Section = Section {
        axial_stiffness: 1.0,
        shear_stiffness: 1.0,
        bending_stiffness: 1.0,
        mass_per_length: 0.7,
        rotary_inertia: 0.3,
    };

    fn by_rows<const N: usize>(
        matrix: &InertiaMatrix<N, f64>,
        rates: &[Movement],
    ) -> Vec<Movement> {
        let mut forces = vec![Movement::default(); rates.len()];
        matrix.each_row(1.7, 0..rates.len(), &mut |point, first, row| {
            for (entry, rate) in row.iter().zip(&rates[first..]) {
                for component in 0..3 {
                    forces[point][component] += entry[component] * rate[component];
                }
            }
        });
        forces
    }

    fn assert_same<const N: usize>(count: usize, cut: usize, numbers: &[f64]) {
        let mut numbers = numbers.iter().copied().cycle();
        let mut next = || numbers.next().unwrap();
        let gram = (0..count).map(|_| std::array::from_fn(|_| next())).collect();
        let matrix = InertiaMatrix::<N, f64>::new(gram, SECTION);
        let rates: Vec<Movement> = (0..count).map(|_| [next(), next(), next()]).collect();
        let expected = by_rows(&matrix, &rates);
        for arch in [Arch::Scalar, Arch::new()] {
            let mut forces = vec![Movement::default(); count];
            let (before, behind) = forces.split_at_mut(cut.min(count));
            let cut = before.len();
            for (points, forces) in [(0..cut, before), (cut..count, behind)] {
                let (rates, forces) = (rates.as_flattened(), forces.as_flattened_mut());
                arch.dispatch(InertiaProduct {
                    matrix: &matrix,
                    points,
                    factor: 1.7,
                    rates,
                    forces,
                });
            }
            assert_eq!(forces, expected, "{N} functions, {count} points, cut at {cut}");
        }
        assert_same_entries(count, 0..cut.min(count), &matrix);
        assert_same_entries(count, cut.min(count)..count, &matrix);
    }

    fn assert_same_entries<const N: usize>(
        count: usize,
        points: Range<usize>,
        matrix: &InertiaMatrix<N, f64>,
    ) {
        let (mut by_rows, mut by_diagonals) =
            (vec![0.0; 9 * count * count], vec![0.0; 9 * count * count]);
        let at = |row: usize, column: usize| row * 3 * count + column;
        matrix.each_row(1.7, points.clone(), &mut |point, first, row| {
            for (index, entry) in row.as_flattened().iter().enumerate() {
                by_rows[at(3 * point + index % 3, 3 * first + index)] += entry;
            }
        });
        matrix.each_diagonal(1.7, points, &mut |first, offset, entries| {
            for (index, entry) in entries.iter().enumerate() {
                let row = 3 * first + index;
                by_diagonals[at(row, row.strict_add_signed(3 * offset))] += entry;
            }
        });
        assert_eq!(by_rows, by_diagonals);
    }

    proptest! {
        #[test]
        fn inertia_by_diagonals_is_bit_identical_to_inertia_by_rows(
            count in 1_usize..40, cut in 0_usize..40, numbers in prop::collection::vec(-1.0..1.0_f64, 97),
        ) {
            assert_same::<2>(count, cut, &numbers);
            assert_same::<4>(count, cut, &numbers);
            assert_same::<6>(count, cut, &numbers);
        }
    }
}
