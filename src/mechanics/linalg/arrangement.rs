//! Elimination order of the unknowns of a band, including the delayed unknowns of blocks, and the resulting profile of the matrix.

use super::block::{Block, MOST_DELAYED, UNTOUCHED};
use super::distant::DistantBlocks;
use super::{BlockLayout, reverse_cuthill_mckee};

/// Largest accepted ratio of the elimination work to the work for the same band without blocks [-].
/// If the ratio is larger, the unknowns are renumbered for a small bandwidth.
const LARGEST_WORK: usize = 4;

/// Order of the unknowns that are not eliminated in blocks, including delayed unknowns, and the resulting profile of the matrix.
///
/// The delayed unknowns of a block follow the last unknown that the block touches, because they have a nonzero pivot there.
#[derive(Debug, Clone)]
pub(super) struct Arrangement {
    layout: BlockLayout,
    /// Position of each unknown of the band in the order; `UNTOUCHED` if the unknown is eliminated in a block.
    pub(super) position: Vec<usize>,
    pub(super) run_ends: Vec<usize>,
    pub(super) delayed: Vec<usize>,
    pub(super) ends: Vec<usize>,
    own_ends: Vec<usize>,
    delayed_after: Vec<usize>,
    ordered_for: Vec<usize>,
    touched: Vec<usize>,
}

impl Arrangement {
    pub(super) fn new(size: usize, layout: BlockLayout) -> Self {
        let blocks = layout.own.len();
        let mut new = Self {
            position: vec![UNTOUCHED; size],
            run_ends: vec![0; size],
            delayed: vec![UNTOUCHED; blocks],
            ends: Vec::with_capacity(size + MOST_DELAYED * blocks),
            own_ends: Vec::with_capacity(size + MOST_DELAYED * blocks),
            delayed_after: vec![0; size + 1],
            ordered_for: Vec::new(),
            touched: Vec::new(),
            layout,
        };
        new.use_natural_order();
        new.number(&[], &DistantBlocks::default());
        new
    }

    pub(super) fn size(&self) -> usize {
        self.ends.len()
    }

    pub(super) fn fit(&mut self, blocks: &[Block], distant: &DistantBlocks) {
        self.touched.clear();
        for block in blocks.iter().filter(|block| block.can_delay_unknowns()) {
            self.touched.extend(&block.touched);
            self.touched.push(UNTOUCHED);
        }
        for group in distant.groups() {
            self.touched.extend(group);
            self.touched.push(UNTOUCHED);
        }
        if self.touched != self.ordered_for {
            std::mem::swap(&mut self.touched, &mut self.ordered_for);
            self.use_natural_order();
            self.number(&[], &DistantBlocks::default());
            let alone = work(&self.own_ends);
            self.number(blocks, distant);
            if work(&self.own_ends) > LARGEST_WORK * alone {
                self.use_level_order(blocks, distant);
                self.number(blocks, distant);
            }
        }
        self.ends.clone_from(&self.own_ends);
        for block in blocks.iter().filter(|block| !block.can_delay_unknowns()) {
            couple(&mut self.ends, block.touched.iter().map(|&at| self.position[at]));
        }
    }

    fn use_natural_order(&mut self) {
        self.position.fill(0);
        for &at in self.layout.own.iter().flatten() {
            self.position[at] = UNTOUCHED;
        }
        let of_band = self.position.iter_mut().filter(|position| **position != UNTOUCHED);
        of_band.enumerate().for_each(|(next, position)| *position = next);
    }

    fn use_level_order(&mut self, blocks: &[Block], distant: &DistantBlocks) {
        self.use_natural_order();
        let position = |&at: &usize| Some(self.position[at]).filter(|&place| place != UNTOUCHED);
        let of_band = self.layout.groups.iter();
        let delaying = blocks.iter().filter(|block| block.can_delay_unknowns());
        let groups: Vec<Vec<usize>> = of_band
            .chain(delaying.map(|block| &block.touched))
            .map(Vec::as_slice)
            .chain(distant.groups())
            .map(|group| group.iter().filter_map(position).collect())
            .collect();
        let count = self.position.iter().filter(|&&place| place != UNTOUCHED).count();
        let ordering = reverse_cuthill_mckee(count, &groups);
        for place in self.position.iter_mut().filter(|place| **place != UNTOUCHED) {
            *place = ordering.position[*place];
        }
    }

    fn number(&mut self, blocks: &[Block], distant: &DistantBlocks) {
        let delaying = |block: &&Block| block.can_delay_unknowns() && !block.touched.is_empty();
        self.delayed_after.fill(0);
        let last = |block: &Block, position: &[usize]| {
            block.touched.iter().map(|&at| position[at]).max().unwrap_or(0)
        };
        for block in blocks.iter().filter(delaying) {
            self.delayed_after[last(block, &self.position)] += MOST_DELAYED;
        }
        let mut shift = 0;
        for (place, behind) in self.delayed_after.iter_mut().enumerate() {
            shift += std::mem::replace(behind, place + 1 + shift);
        }
        self.delayed.fill(UNTOUCHED);
        let mut size = self.position.iter().filter(|&&place| place != UNTOUCHED).count();
        for (delayed, block) in self.delayed.iter_mut().zip(blocks) {
            if delaying(&block) {
                let next = &mut self.delayed_after[last(block, &self.position)];
                *delayed = *next;
                *next += MOST_DELAYED;
                size += MOST_DELAYED;
            }
        }
        for position in self.position.iter_mut().filter(|position| **position != UNTOUCHED) {
            *position = position.checked_sub(1).map_or(0, |before| self.delayed_after[before]);
        }
        let mut run = self.position.len();
        for at in (0..self.position.len()).rev() {
            let follows = self.position.get(at + 1).is_some_and(|next| {
                self.position[at] != UNTOUCHED && *next == self.position[at] + 1
            });
            run = if follows { run } else { at };
            self.run_ends[at] = run;
        }
        self.own_ends.clear();
        self.own_ends.extend(0..size);
        for group in &*self.layout.groups {
            let places = group.iter().map(|&at| self.position[at]);
            couple(&mut self.own_ends, places.filter(|&place| place != UNTOUCHED));
        }
        for (block, &delayed) in blocks.iter().zip(&self.delayed) {
            if delayed != UNTOUCHED {
                let places = block.touched.iter().map(|&at| self.position[at]);
                couple(&mut self.own_ends, places.chain(delayed..delayed + MOST_DELAYED));
            }
        }
        for group in distant.groups() {
            couple(&mut self.own_ends, group.iter().map(|&at| self.position[at]));
        }
        let mut furthest = 0;
        for end in &mut self.own_ends {
            furthest = furthest.max(*end);
            *end = furthest;
        }
    }
}

fn couple(ends: &mut [usize], places: impl Iterator<Item = usize> + Clone) {
    let last = places.clone().max().unwrap_or(0);
    places.for_each(|place| ends[place] = ends[place].max(last));
}

fn work(ends: &[usize]) -> usize {
    ends.iter().enumerate().map(|(at, end)| (end - at) * (end - at)).sum()
}
