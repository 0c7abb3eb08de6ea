//! In which order the unknowns of a band are eliminated, with those of blocks that are delayed, and where the entries end then.

use super::block::{Block, MOST_DELAYED, NOWHERE};
use super::{BlockLayout, reverse_cuthill_mckee};

/// The order of the band is kept where elimination in it takes at most so many times the work without blocks.
const LARGEST_WORK: usize = 4;

/// An order of the unknowns of a band that are not eliminated in blocks, with delayed ones between, and the profile of the matrix in it.
///
/// It depends on nothing but what the blocks touch. Delayed unknowns stand behind the last one that their block touches: there they have a pivot.
#[derive(Debug, Clone)]
pub(super) struct Arrangement {
    layout: BlockLayout,
    /// The place of each unknown of the band; nowhere if it is eliminated in a block.
    pub(super) position: Vec<usize>,
    /// The unknown up to which places follow one another from each unknown of the band on.
    pub(super) runs_to: Vec<usize>,
    /// The first place of the delayed unknowns of each block; nowhere if it delays none.
    pub(super) delayed: Vec<usize>,
    /// Where the entries end, for each place.
    pub(super) ends: Vec<usize>,
    /// The same without what blocks touch that delay nothing.
    own_ends: Vec<usize>,
    /// How many delayed unknowns of blocks stand behind each unknown of the order.
    behind: Vec<usize>,
    /// What the blocks touched for which it was made.
    made_for: Vec<usize>,
    touched: Vec<usize>,
}

impl Arrangement {
    /// The order of the band, for blocks that touch nothing yet.
    pub(super) fn new(size: usize, layout: BlockLayout) -> Self {
        let blocks = layout.own.len();
        let mut new = Self {
            position: vec![NOWHERE; size],
            runs_to: vec![0; size],
            delayed: vec![NOWHERE; blocks],
            ends: Vec::with_capacity(size + MOST_DELAYED * blocks),
            own_ends: Vec::with_capacity(size + MOST_DELAYED * blocks),
            behind: vec![0; size + 1],
            made_for: Vec::new(),
            touched: Vec::new(),
            layout,
        };
        new.follow_the_band();
        new.number(&[]);
        new
    }

    /// The number of places.
    pub(super) fn size(&self) -> usize {
        self.ends.len()
    }

    /// Makes the order, if blocks touch others than those for which it was made, and the profile.
    pub(super) fn fit(&mut self, blocks: &[Block]) {
        self.touched.clear();
        for block in blocks.iter().filter(|block| block.may_delay()) {
            self.touched.extend(&block.touched);
            self.touched.push(NOWHERE);
        }
        if self.touched != self.made_for {
            std::mem::swap(&mut self.touched, &mut self.made_for);
            self.follow_the_band();
            self.number(&[]);
            let alone = work(&self.own_ends);
            self.number(blocks);
            if work(&self.own_ends) > LARGEST_WORK * alone {
                self.follow_levels(blocks);
                self.number(blocks);
            }
        }
        self.ends.clone_from(&self.own_ends);
        for block in blocks.iter().filter(|block| !block.may_delay()) {
            couple(&mut self.ends, block.touched.iter().map(|&at| self.position[at]));
        }
    }

    /// Puts the unknowns of the band into its own order.
    fn follow_the_band(&mut self) {
        self.position.fill(0);
        for &at in self.layout.own.iter().flatten() {
            self.position[at] = NOWHERE;
        }
        let others = self.position.iter_mut().filter(|position| **position != NOWHERE);
        others.enumerate().for_each(|(place, position)| *position = place);
    }

    /// Puts the unknowns of the band, which are in its own order, into one that is narrow with what blocks touch.
    fn follow_levels(&mut self, blocks: &[Block]) {
        self.follow_the_band();
        let position = |&at: &usize| Some(self.position[at]).filter(|&place| place != NOWHERE);
        let of_band = self.layout.groups.iter();
        let delaying = blocks.iter().filter(|block| block.may_delay());
        let groups: Vec<Vec<usize>> = of_band
            .chain(delaying.map(|block| &block.touched))
            .map(|group| group.iter().filter_map(position).collect())
            .collect();
        let count = self.position.iter().filter(|&&place| place != NOWHERE).count();
        let ordering = reverse_cuthill_mckee(count, &groups);
        for place in self.position.iter_mut().filter(|place| **place != NOWHERE) {
            *place = ordering.position[*place];
        }
    }

    /// Lets delayed unknowns in behind what their blocks touch, and finds where the entries end.
    fn number(&mut self, blocks: &[Block]) {
        let delaying = |block: &&Block| block.may_delay() && !block.touched.is_empty();
        self.behind.fill(0);
        let last = |block: &Block, position: &[usize]| {
            block.touched.iter().map(|&at| position[at]).max().unwrap_or(0)
        };
        for block in blocks.iter().filter(delaying) {
            self.behind[last(block, &self.position)] += MOST_DELAYED;
        }
        // From how many there are to where they begin.
        let mut shift = 0;
        for (place, behind) in self.behind.iter_mut().enumerate() {
            shift += std::mem::replace(behind, place + 1 + shift);
        }
        self.delayed.fill(NOWHERE);
        let mut size = self.position.iter().filter(|&&place| place != NOWHERE).count();
        for (delayed, block) in self.delayed.iter_mut().zip(blocks) {
            if delaying(&block) {
                let next = &mut self.behind[last(block, &self.position)];
                *delayed = *next;
                *next += MOST_DELAYED;
                size += MOST_DELAYED;
            }
        }
        // Where delayed unknowns behind a place end, the next place begins.
        for position in self.position.iter_mut().filter(|position| **position != NOWHERE) {
            *position = position.checked_sub(1).map_or(0, |before| self.behind[before]);
        }
        let mut run = self.position.len();
        for at in (0..self.position.len()).rev() {
            let follows = self
                .position
                .get(at + 1)
                .is_some_and(|next| self.position[at] != NOWHERE && *next == self.position[at] + 1);
            run = if follows { run } else { at };
            self.runs_to[at] = run;
        }
        self.own_ends.clear();
        self.own_ends.extend(0..size);
        for group in &*self.layout.groups {
            let places = group.iter().map(|&at| self.position[at]);
            couple(&mut self.own_ends, places.filter(|&place| place != NOWHERE));
        }
        for (block, &delayed) in blocks.iter().zip(&self.delayed) {
            if delayed != NOWHERE {
                let places = block.touched.iter().map(|&at| self.position[at]);
                couple(&mut self.own_ends, places.chain(delayed..delayed + MOST_DELAYED));
            }
        }
        let mut furthest = 0;
        for end in &mut self.own_ends {
            furthest = furthest.max(*end);
            *end = furthest;
        }
    }
}

/// Lets the entries of some places reach to the last of them.
fn couple(ends: &mut [usize], places: impl Iterator<Item = usize> + Clone) {
    let last = places.clone().max().unwrap_or(0);
    places.for_each(|place| ends[place] = ends[place].max(last));
}

/// About the number of multiplications that elimination takes in a profile.
fn work(ends: &[usize]) -> usize {
    ends.iter().enumerate().map(|(at, end)| (end - at) * (end - at)).sum()
}
