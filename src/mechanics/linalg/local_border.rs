//! Border of many blocks. Each block is coupled to few unknowns of the band and is eliminated separately.
//!
//! In each factorisation, the blocks may be coupled to different unknowns of the band.

use std::sync::Arc;

use pulp::Arch;

use super::arrangement::Arrangement;
use super::block::{BLOCK, Block, BlockElimination, UNTOUCHED};
use super::profile::{ProfileLu, ProfileMatrix};
use super::{BandedMatrix, LinearError};

/// Additional half-bandwidth that is allocated for the Schur complements of the blocks.
const EXTRA_HALF_BANDWIDTH: usize = 16;

#[derive(Debug, Clone, PartialEq, Eq)]
pub struct BlockLayout {
    pub own: Vec<Vec<usize>>,
    pub groups: Arc<[Vec<usize>]>,
    pub block_entries: usize,
}

/// Border of blocks of five unknowns, and the order in which the band is eliminated after the blocks.
#[derive(Debug, Clone)]
pub struct LocalBorder {
    blocks: Vec<Block>,
    arrangement: Arrangement,
    /// Band plus the Schur complements of the blocks, in the order of the arrangement.
    matrix: ProfileMatrix,
    places: Vec<usize>,
    right: Vec<f64>,
    own: Vec<f64>,
    all: Vec<f64>,
}

#[derive(Debug)]
pub(super) struct LocalLu<'a> {
    blocks: &'a [Block],
    arrangement: &'a Arrangement,
    factors: ProfileLu<'a>,
    right: &'a mut Vec<f64>,
    own: &'a mut Vec<f64>,
    all: &'a mut Vec<f64>,
}

impl LocalBorder {
    pub(super) fn zeros(size: usize, half_bandwidth: usize, layout: BlockLayout) -> Self {
        let entries = layout.block_entries;
        let blocks: Vec<_> =
            layout.own.iter().map(|own| Block::new(own.clone(), entries)).collect();
        let candidates = blocks.iter().map(Block::candidates).sum();
        let capacity = size + BLOCK * blocks.len();
        Self {
            arrangement: Arrangement::new(size, layout),
            matrix: ProfileMatrix::with_capacity(capacity, half_bandwidth + EXTRA_HALF_BANDWIDTH),
            blocks,
            places: vec![UNTOUCHED; size],
            right: Vec::with_capacity(capacity),
            own: Vec::with_capacity(candidates),
            all: Vec::with_capacity(BLOCK + entries),
        }
    }

    pub(super) fn width(&self) -> usize {
        BLOCK * self.blocks.len()
    }

    pub(super) fn clear(&mut self) {
        self.blocks.iter_mut().for_each(Block::clear);
    }

    pub(super) fn block_mut(&mut self, border_index: usize) -> (&mut Block, usize) {
        (&mut self.blocks[border_index / BLOCK], border_index % BLOCK)
    }

    pub(super) fn column_in(border_row: usize, border_column: usize) -> usize {
        debug_assert_eq!(border_row / BLOCK, border_column / BLOCK, "blocks are not coupled");
        border_column % BLOCK
    }

    /// Entry of the matrix at a row and a column. Each index is `Ok` for the band and `Err` for the border.
    pub(super) fn get(&self, row: Result<usize, usize>, column: Result<usize, usize>) -> f64 {
        let block = |at: usize| (&self.blocks[at / BLOCK], at % BLOCK);
        match (row, column) {
            (Ok(_), Ok(_)) => 0.0,
            (Ok(row), Err(column)) => block(column).0.in_column(row, column % BLOCK),
            (Err(row), Ok(column)) => block(row).0.in_row(row % BLOCK, column),
            (Err(row), Err(column)) if row / BLOCK != column / BLOCK => 0.0,
            (Err(row), Err(column)) => block(row).0.in_corner(row % BLOCK, column % BLOCK),
        }
    }

    pub(super) fn factorise(&mut self, band: &BandedMatrix) -> Result<LocalLu<'_>, LinearError> {
        let size = band.size() + self.width();
        let Self { blocks, places, .. } = self;
        Arch::new()
            .dispatch(BlockElimination { blocks, band, places })
            .map_err(|(index, error)| error.at(band.size() + BLOCK * index, size))?;
        self.arrangement.fit(&self.blocks, band.distant());
        self.matrix.remake(&self.arrangement.ends, band.half_bandwidth());
        self.copy(band);
        self.matrix.weigh_rows();
        for (block, &delayed) in self.blocks.iter().zip(&self.arrangement.delayed) {
            add_schur_complement(block, delayed, &self.arrangement.position, &mut self.matrix);
        }
        let Self { blocks, arrangement, matrix, right, own, all, .. } = self;
        let factors = matrix.factorise().map_err(|error| {
            let is_there = |place: &usize| *place == error.unknown();
            let of_band = arrangement.position.iter().position(is_there);
            error.at(of_band.unwrap_or(band.size()), size)
        })?;
        Ok(LocalLu { blocks, arrangement, factors, right, own, all })
    }

    fn copy(&mut self, band: &BandedMatrix) {
        let Arrangement { position, run_ends: runs_to, .. } = &self.arrangement;
        for (row, &place) in position.iter().enumerate().filter(|(_, place)| **place != UNTOUCHED) {
            let (first, entries) = band.row(row);
            if position[first] != UNTOUCHED && runs_to[first] >= first + entries.len() - 1 {
                self.matrix.copy_to_row(place, position[first], entries);
                continue;
            }
            for (&column, &value) in position[first..].iter().zip(entries) {
                if value != 0.0 {
                    self.matrix.add(place, column, value);
                }
            }
        }
        for (row, column, value) in band.distant().iter() {
            self.matrix.add(position[row], position[column], value);
        }
    }
}

fn place_of(block: &Block, delayed: usize, position: &[usize], left: usize) -> usize {
    left.checked_sub(block.delayed())
        .map_or_else(|| delayed + left, |touched| position[block.touched[touched]])
}

fn add_schur_complement(
    block: &Block,
    delayed: usize,
    position: &[usize],
    matrix: &mut ProfileMatrix,
) {
    let count = block.delayed();
    for left in 0..count {
        matrix.set_row_size(delayed + left, block.stiffness);
    }
    for (number, entries) in block.schur_complement() {
        let scale = block.scale(number);
        let row = place_of(block, delayed, position, number);
        for (other, &value) in entries.iter().enumerate() {
            if value != 0.0 {
                matrix.add(row, place_of(block, delayed, position, other), scale * value);
            }
        }
    }
    if delayed != UNTOUCHED {
        for place in delayed + count..delayed + super::block::MOST_DELAYED {
            matrix.set_row_size(place, 1.0);
            matrix.add(place, place, 1.0);
        }
    }
}

impl LocalLu<'_> {
    pub(super) fn solve(&mut self, x: &mut [f64]) {
        let Arrangement { position, delayed, .. } = self.arrangement;
        let (x, z) = x.split_at_mut(position.len());
        self.right.clear();
        self.right.resize(self.arrangement.size(), 0.0);
        for (&place, &value) in position.iter().zip(&*x) {
            if place != UNTOUCHED {
                self.right[place] = value;
            }
        }
        self.own.clear();
        for ((block, &delayed), z) in self.blocks.iter().zip(delayed).zip(z.chunks_exact(BLOCK)) {
            let first = self.own.len();
            self.own.extend(block.by_rows(|at| x[at], z));
            let right = &mut *self.right;
            let own = &mut self.own[first..];
            block.substitute(own, |touched, value| {
                right[position[block.touched[touched]]] -= value;
            });
            for (left, value) in own[block.pivots..].iter().enumerate() {
                right[delayed + left] += block.scale(left) * value;
            }
        }
        self.factors.solve(self.right);
        for (&place, value) in position.iter().zip(&mut *x) {
            if place != UNTOUCHED {
                *value = self.right[place];
            }
        }
        let mut first = 0;
        for ((block, &delayed), z) in self.blocks.iter().zip(delayed).zip(z.chunks_exact_mut(BLOCK))
        {
            self.all.clear();
            self.all.extend(&self.own[first..first + block.pivots]);
            first += block.candidates();
            self.all.extend((0..block.delayed()).map(|left| self.right[delayed + left]));
            self.all.extend(block.touched.iter().map(|&at| self.right[position[at]]));
            block.back_substitute(self.all);
            for (unknown, &value) in block.unknowns().zip(&**self.all) {
                match unknown {
                    Ok(of_band) => x[of_band] = value,
                    Err(of_block) => z[of_block] = value,
                }
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::super::{Border, BorderedMatrix};
    use super::*;
    use nalgebra::{DMatrix, DVector};
    use proptest::prelude::*;

    type Touch = (usize, usize, Option<usize>);

    const OWN: usize = 2;

    fn layout(size: usize, reach: usize, own: &[bool]) -> (BlockLayout, usize) {
        let mut next = size;
        let mut own_of = |is_own: &bool| {
            let own: Vec<usize> = (next..next + if *is_own { OWN } else { 0 }).collect();
            next += own.len();
            own
        };
        let own: Vec<Vec<usize>> = own.iter().map(&mut own_of).collect();
        let of_band = (0..size).map(|first| (first..=(first + reach).min(size - 1)).collect());
        let groups: Vec<Vec<usize>> =
            of_band.chain(own.iter().filter(|own| !own.is_empty()).cloned()).collect();
        (BlockLayout { own, groups: groups.into(), block_entries: 10 }, next)
    }

    fn fill(
        matrix: &mut BorderedMatrix,
        layout: &BlockLayout,
        touches: &[Touch],
        mut next: impl FnMut() -> f64,
    ) {
        let all = matrix.band().size();
        matrix.clear();
        let groups = layout.groups.clone();
        for group in &*groups {
            for (i, j) in group.iter().flat_map(|i| group.iter().map(move |j| (*i, *j))) {
                let diagonal = if i == j { 3.0 } else { 0.0 };
                matrix.band_mut().add(i, j, 0.3 * next() + diagonal);
            }
        }
        let size = all - layout.own.iter().map(Vec::len).sum::<usize>();
        for (block, (own, &(first, count, far))) in layout.own.iter().zip(touches).enumerate() {
            let near = (first..first + count).chain(far).map(|at| at % size);
            for at in near.chain(own.iter().copied()) {
                for unknown in 0..BLOCK {
                    matrix.border_mut().add_to_column(at, BLOCK * block + unknown, next());
                    matrix.border_mut().add_to_row(BLOCK * block + unknown, at, next());
                }
            }
            for (row, column) in (0..BLOCK * BLOCK).map(|at| (at / BLOCK, at % BLOCK)) {
                let value = if row < 2 && column < 2 { 0.0 } else { 2.0 * next() };
                let (row, column) = (BLOCK * block + row, BLOCK * block + column);
                matrix.border_mut().add_to_corner(row, column, value);
            }
        }
    }

    proptest! {
        #[test]
        fn solution_with_blocks_agrees_with_the_dense_solution(
            size in 12_usize..50, reach in 0_usize..5, own in prop::collection::vec(any::<bool>(), 1..8),
            touches in prop::collection::vec((0_usize..50, 1_usize..7, prop::option::of(0_usize..50)), 16),
            entries in prop::collection::vec(-1.0..1.0_f64, 997),
            distant in prop::collection::vec([0_usize..50, 0_usize..50], 0..4),
        ) {
            let mut distant = distant.into_iter().map(|pair| pair.map(|at| at % size)).cycle();
            let (layout, all) = layout(size, reach, &own);
            let reach = reach.max(OWN - 1);
            let mut matrix = BorderedMatrix::with_blocks(all, reach, layout.clone());
            let mut entries = entries.into_iter().cycle();
            for touches in [&touches[..8], &touches[8..], &touches[..8]] {
                fill(&mut matrix, &layout, touches, || entries.next().unwrap());
                for [a, b] in distant.by_ref().take(3).filter(|[a, b]| a != b) {
                    let block: Vec<f64> = entries.by_ref().take(4).collect();
                    matrix.band_mut().add_block(&[a, b], block.into_iter());
                }
                let dense = DMatrix::from_fn(matrix.size(), matrix.size(), |i, j| matrix.get(i, j));
                prop_assume!(dense.clone().svd(false, false).singular_values.min() > 1e-2);
                let right = DVector::from_fn(matrix.size(), |i, _| (i as f64 + 1.0).sin());
                let mut x = right.as_slice().to_vec();
                matrix.factorise().unwrap().solve(&mut x);
                let error = dense * DVector::from_vec(x) - right;
                prop_assert!(error.amax() < 1e-8, "residual {}", error.amax());
            }
        }
    }

    #[test]
    fn ordering_brings_distant_unknowns_of_a_block_together() {
        let (size, own) = (300, [false; 30]);
        let (layout, all) = layout(size, 2, &own);
        let mut matrix = BorderedMatrix::with_blocks(all, 2, layout.clone());
        let touches: Vec<Touch> =
            (0..30).map(|block| (5 * block, 3, Some(150 + 5 * block))).collect();
        let mut value = 0.3_f64;
        fill(&mut matrix, &layout, &touches, || {
            value = (value * 7.3).sin();
            value
        });
        matrix.factorise().unwrap();
        let Border::Local(border) = matrix.border_mut() else { panic!() };
        let ends = &border.arrangement.ends;
        let reach = ends.iter().enumerate().map(|(at, end)| end - at).max().unwrap();
        assert!(reach < 30, "{reach}");
    }

    #[test]
    fn singular_block_error_names_the_unknown() {
        let layout = BlockLayout { own: vec![vec![]], groups: [].into(), block_entries: 1 };
        let mut matrix = BorderedMatrix::with_blocks(2, 0, layout);
        matrix.band_mut().add(0, 0, 1.0);
        matrix.band_mut().add(1, 1, 1.0);
        (0..4).for_each(|unknown| matrix.border_mut().add_to_corner(unknown, unknown, 1.0));
        let error = matrix.factorise().unwrap_err();
        assert_eq!(error, LinearError::Singular { unknown: 2, size: 7 });
    }
}
