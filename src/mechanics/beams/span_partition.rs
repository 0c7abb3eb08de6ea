//! Division of the spans of a beam into parts that threads process concurrently, without an effect on the results.
//!
//! The beam is divided at control points, called cuts. A few spans have control points on both sides of a cut.
//! Contributions of spans at a cut are computed twice, once for each side, because rounding depends on the order of additions.

use std::ops::Range;

use super::dynamics::Movement;
use super::sections::Sections;
use super::span_points::{SPANS_AT_ONCE, SpanGroup};
use crate::threads::run_concurrently;

type PartOf<'a, const N: usize, S, C> =
    (&'a mut C, &'a mut [SpanGroup<N, S>], usize, &'a mut [Movement]);

/// Largest number of concurrent parts. More parts are not faster, because a few processor cores exhaust the memory bandwidth.
pub(super) const MOST_PARTS: usize = 8;

/// Smallest number of spans in a part. Smaller parts gain little time, and lose time if the other cores are busy (docs/studies.md).
const SMALLEST_PART: usize = 4000;

/// Smallest number of spans in a part for operations that take less than a tenth of the time of computing tangents.
const SMALLEST_LIGHT_PART: usize = 2000;

fn count_spans<const N: usize, S>(groups: &[SpanGroup<N, S>]) -> usize {
    groups.iter().map(|group| group.spans.len()).sum()
}

#[derive(Debug, Clone, PartialEq)]
struct SpanCut {
    point: usize,
    astride: Range<usize>,
}

#[derive(Debug, Clone, Default)]
pub(super) struct SpanPartition {
    cuts: Vec<SpanCut>,
}

impl SpanPartition {
    pub(super) fn worthwhile<const N: usize, S: Sections>(
        groups: &[SpanGroup<N, S>],
        most: usize,
    ) -> Self {
        Self::new(groups, most.min(MOST_PARTS).min(count_spans(groups) / SMALLEST_PART))
    }

    fn new<const N: usize, S: Sections>(groups: &[SpanGroup<N, S>], count: usize) -> Self {
        let cut = |part: usize| {
            let behind = part * groups.len() / count;
            let point = groups[behind].control_points().start;
            let before = |group: &SpanGroup<N, S>| group.control_points().end <= point;
            let begin = groups[..behind].partition_point(before);
            SpanCut { point, astride: begin..behind }
        };
        Self { cuts: (1..count).map(cut).collect() }
    }

    pub(super) fn count(&self) -> usize {
        self.cuts.len() + 1
    }

    pub(super) fn first_points(&self) -> Vec<usize> {
        self.cuts.iter().map(|cut| cut.point).collect()
    }

    fn are_large(&self, spans: usize) -> bool {
        !self.cuts.is_empty() && spans >= SMALLEST_LIGHT_PART * self.count()
    }

    pub(super) fn each<const N: usize, S: Sections>(
        &self,
        groups: &mut [SpanGroup<N, S>],
        work: impl Fn(&mut [SpanGroup<N, S>]) + Sync,
    ) {
        if !self.are_large(count_spans(groups)) {
            return work(groups);
        }
        let most = groups.len().div_ceil(self.count());
        run_concurrently(groups.chunks_mut(most), work);
    }

    pub(super) fn each_point(
        &self,
        sums: &mut [Movement],
        work: impl Fn(Range<usize>, &mut [Movement]) + Sync,
    ) {
        if !self.are_large(sums.len()) {
            return work(0..sums.len(), sums);
        }
        let mut parts = Vec::with_capacity(self.count());
        let (mut sums, mut next) = (sums, 0);
        for cut in &self.cuts {
            let (before, behind) = sums.split_at_mut(cut.point - next);
            parts.push((next..cut.point, before));
            (sums, next) = (behind, cut.point);
        }
        parts.push((next..next + sums.len(), sums));
        run_concurrently(parts, |(points, sums)| work(points, sums));
    }

    /// Adds contributions of spans to control points. The parts of the beam are processed concurrently.
    ///
    /// The callback `work` is called for groups of consecutive spans. It receives four arguments: the element of `own` for its part,
    /// the spans, the index of their first control point, and the sums at their control points.
    /// For spans across a cut, `work` is called twice and must compute the same values both times.
    pub(super) fn sum<const N: usize, S: Sections, C: Send>(
        &self,
        groups: &mut [SpanGroup<N, S>],
        sums: &mut [Movement],
        own: &mut [C],
        work: impl Fn(&mut C, &mut [SpanGroup<N, S>], usize, &mut [Movement]) + Sync,
    ) {
        if self.cuts.is_empty() {
            return work(&mut own[0], groups, 0, sums);
        }
        let on_one_side = |own: &mut C,
                           group: &mut SpanGroup<N, S>,
                           sums: &mut [Movement],
                           side: Range<usize>| {
            let points = group.control_points();
            let mut copy = [[Movement::default(); N]; SPANS_AT_ONCE];
            let copy = &mut copy.as_flattened_mut()[..points.len()];
            let sums = &mut sums[points.clone()];
            copy.copy_from_slice(sums);
            work(own, std::slice::from_mut(group), points.start, copy);
            let Range { start, end } = points;
            let side = side.start.max(start) - start..side.end.min(end) - start;
            sums[side.clone()].copy_from_slice(&copy[side]);
        };
        for (cut, own) in self.cuts.iter().zip(&mut own[1..]) {
            for group in &mut groups[cut.astride.clone()] {
                on_one_side(own, group, sums, cut.point..usize::MAX);
            }
        }
        run_concurrently(self.split(groups, sums, own), |(own, groups, first, sums)| {
            work(own, groups, first, sums);
        });
        for (cut, own) in self.cuts.iter().zip(own) {
            for group in &mut groups[cut.astride.clone()] {
                on_one_side(own, group, sums, 0..cut.point);
            }
        }
    }

    pub(super) fn sum_lightly<const N: usize, S: Sections>(
        &self,
        groups: &mut [SpanGroup<N, S>],
        sums: &mut [Movement],
        work: impl Fn(&mut [SpanGroup<N, S>], usize, &mut [Movement]) + Sync,
    ) {
        if !self.are_large(count_spans(groups)) {
            return work(groups, 0, sums);
        }
        let own = &mut [(); MOST_PARTS];
        self.sum(groups, sums, own, |(), groups, first, sums| work(groups, first, sums));
    }

    fn split<'a, const N: usize, S, C>(
        &self,
        mut groups: &'a mut [SpanGroup<N, S>],
        mut sums: &'a mut [Movement],
        own: &'a mut [C],
    ) -> Vec<PartOf<'a, N, S, C>> {
        let mut parts = Vec::with_capacity(self.count());
        let (mut next_group, mut next_point) = (0, 0);
        let mut own = own.iter_mut();
        for (cut, own) in self.cuts.iter().zip(&mut own) {
            let (before, behind) = groups.split_at_mut(cut.astride.start - next_group);
            let (sums_before, sums_behind) = sums.split_at_mut(cut.point - next_point);
            parts.push((own, before, next_point, sums_before));
            groups = &mut behind[cut.astride.len()..];
            sums = sums_behind;
            (next_group, next_point) = (cut.astride.end, cut.point);
        }
        parts.extend(own.next().map(|own| (own, groups, next_point, sums)));
        parts
    }
}
