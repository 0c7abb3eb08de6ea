//! Loops of a step over the spans of a beam, compiled for vector instructions.

use pulp::{Arch, Simd, WithSimd};

use super::block::SpanTangent;
use super::dynamics::{Collocation, ForceSummary, Movement};
use super::force_maxima::ForceMaxima;
use super::force_points::{ForceTangent, Resultant};
use super::moment_points::MomentTangent;
use super::sections::Sections;
use super::simd::{LANES, LaneChunk, Lanes};
use super::span_points::{SpanGroup, window_mut};
use super::{RotationIncrement, Section};

/// Operation that is repeated for all spans.
/// Each operation is a separate type, so that the compiler uses vector instructions in the whole loop.
pub(super) trait SpanLoop<const N: usize, S> {
    fn at<V: Simd>(&mut self, simd: V, group: &mut SpanGroup<N, S>);

    fn over(self, groups: &mut [SpanGroup<N, S>])
    where
        Self: Sized,
    {
        Arch::new().dispatch(LoopRange { groups, work: self });
    }
}

pub(super) struct LoopRange<'a, const N: usize, S, W> {
    pub(super) groups: &'a mut [SpanGroup<N, S>],
    pub(super) work: W,
}

impl<const N: usize, S, W: SpanLoop<N, S>> WithSimd for LoopRange<'_, N, S, W> {
    type Output = ();

    #[inline(always)]
    fn with_simd<V: Simd>(mut self, simd: V) {
        for group in self.groups {
            self.work.at(simd, group);
        }
    }
}

#[derive(Clone, Copy)]
pub(super) struct SpanInputs<'a> {
    pub(super) section: &'a Section,
    pub(super) at: Collocation,
    pub(super) movements: &'a [Movement],
    pub(super) weight: f64,
}

pub(super) struct ForcesFrom<'a> {
    pub(super) first: usize,
    pub(super) forces: &'a mut [Movement],
}

impl ForcesFrom<'_> {
    #[inline(always)]
    fn of<const N: usize>(&mut self, first: usize) -> &mut [Movement; N] {
        window_mut(self.forces, first - self.first)
    }
}

pub(super) struct ForceAssembly<'a> {
    pub(super) iterate: SpanInputs<'a>,
    pub(super) forces: ForcesFrom<'a>,
    pub(super) summary: &'a mut ForceSummary,
}

impl<const N: usize, S: Sections> SpanLoop<N, S> for ForceAssembly<'_> {
    #[inline(always)]
    fn at<V: Simd>(&mut self, simd: V, group: &mut SpanGroup<N, S>) {
        let SpanInputs { section, at, movements: moved, weight } = self.iterate;
        let SpanGroup { spans, force_points, moment_points, sections } = group;
        let mut maxima = ForceMaxima::default();
        let (mut resultant, mut moment) = (Resultant::default(), Lanes::default());
        for span in spans {
            let forces = self.forces.of(span.first);
            for point in span.force_points.clone() {
                let (index, lane) = (point / LANES, point % LANES);
                let points = &mut force_points[index];
                if lane == 0 {
                    let windows = points.windows(moved);
                    for part in 0..LaneChunk::<V>::COUNT {
                        let part = LaneChunk::new(simd, part);
                        let stiffness = sections.force_stiffness(section, index, part);
                        let by = (stiffness, weight);
                        points.take_forces(part, by, at, &windows, &mut resultant, &mut maxima);
                    }
                }
                points.distribute(lane, &resultant, forces);
            }
            for point in span.moment_points.clone() {
                let (index, lane) = (point / LANES, point % LANES);
                let points = &mut moment_points[index];
                if lane == 0 {
                    let windows = points.windows(moved);
                    for part in 0..LaneChunk::<V>::COUNT {
                        let part = LaneChunk::new(simd, part);
                        let stiffness = sections.bending_stiffness(section, index, part);
                        let by = (stiffness, weight);
                        points.take_forces(part, by, at, &windows, &mut moment, &mut maxima);
                    }
                }
                points.distribute(lane, &moment, forces);
            }
        }
        maxima.join_to(self.summary);
    }
}

pub(super) struct Linearisation<'a> {
    pub(super) iterate: SpanInputs<'a>,
    pub(super) forces: ForcesFrom<'a>,
    pub(super) tangent: &'a mut dyn FnMut(usize, &[f64]),
}

impl<const N: usize, S: Sections> SpanLoop<N, S> for Linearisation<'_> {
    #[inline(always)]
    fn at<V: Simd>(&mut self, simd: V, group: &mut SpanGroup<N, S>) {
        let SpanInputs { section, at, movements: moved, weight } = self.iterate;
        let SpanGroup { spans, force_points, moment_points, sections } = group;
        let (mut resultant, mut tangent) = (Resultant::default(), ForceTangent::default());
        let (mut moment, mut moment_tangent) = (Lanes::default(), MomentTangent::default());
        for span in spans {
            let forces = self.forces.of(span.first);
            let mut block = SpanTangent::zeros(simd);
            for point in span.force_points.clone() {
                let (index, lane) = (point / LANES, point % LANES);
                let points = &mut force_points[index];
                if lane == 0 {
                    let windows = points.windows(moved);
                    for part in 0..LaneChunk::<V>::COUNT {
                        let part = LaneChunk::new(simd, part);
                        let by = (sections.force_stiffness(section, index, part), weight);
                        let out = (&mut resultant, &mut tangent);
                        points.linearise(part, by, at, &windows, out);
                    }
                }
                points.distribute(lane, &resultant, forces);
                points.add_tangent(lane, &tangent, &mut block);
            }
            for point in span.moment_points.clone() {
                let (index, lane) = (point / LANES, point % LANES);
                let points = &mut moment_points[index];
                if lane == 0 {
                    let windows = points.windows(moved);
                    for part in 0..LaneChunk::<V>::COUNT {
                        let part = LaneChunk::new(simd, part);
                        let by = (sections.bending_stiffness(section, index, part), weight);
                        let out = (&mut moment, &mut moment_tangent);
                        points.linearise(part, by, at, &windows, out);
                    }
                }
                points.distribute(lane, &moment, forces);
                points.add_tangent(lane, &moment_tangent, &mut block);
            }
            (self.tangent)(span.first, block.entries());
        }
    }
}

pub(super) struct MismatchForces<'a> {
    pub(super) section: &'a Section,
    pub(super) weight: f64,
    pub(super) forces: ForcesFrom<'a>,
}

impl<const N: usize, S: Sections> SpanLoop<N, S> for MismatchForces<'_> {
    #[inline(always)]
    fn at<V: Simd>(&mut self, simd: V, group: &mut SpanGroup<N, S>) {
        let (section, weight) = (self.section, self.weight);
        let SpanGroup { spans, force_points, moment_points, sections } = group;
        let (mut resultant, mut moment) = (Resultant::default(), Lanes::default());
        for span in spans {
            let forces = self.forces.of(span.first);
            for point in span.force_points.clone() {
                let (index, lane) = (point / LANES, point % LANES);
                let points = &force_points[index];
                if lane == 0 {
                    for part in 0..LaneChunk::<V>::COUNT {
                        let part = LaneChunk::new(simd, part);
                        let by = (sections.force_stiffness(section, index, part), weight);
                        points.take_mismatch_forces(part, by, &mut resultant);
                    }
                }
                points.distribute(lane, &resultant, forces);
            }
            for point in span.moment_points.clone() {
                let (index, lane) = (point / LANES, point % LANES);
                let points = &moment_points[index];
                if lane == 0 {
                    for part in 0..LaneChunk::<V>::COUNT {
                        let part = LaneChunk::new(simd, part);
                        let by = (sections.bending_stiffness(section, index, part), weight);
                        points.take_mismatch_forces(part, by, &mut moment);
                    }
                }
                points.distribute(lane, &moment, forces);
            }
        }
    }
}

#[derive(Clone, Copy)]
pub(super) struct ForceCorrection<'a> {
    pub(super) section: &'a Section,
    pub(super) movements: &'a [Movement],
}

impl<const N: usize, S: Sections> SpanLoop<N, S> for ForceCorrection<'_> {
    #[inline(always)]
    fn at<V: Simd>(&mut self, simd: V, group: &mut SpanGroup<N, S>) {
        group.correct_section_forces(simd, self.section, self.movements);
    }
}

#[derive(Clone, Copy)]
pub(super) struct Advance<'a> {
    pub(super) movements: &'a [Movement],
    pub(super) rotations: RotationIncrement,
}

impl<const N: usize, S: Sections> SpanLoop<N, S> for Advance<'_> {
    #[inline(always)]
    fn at<V: Simd>(&mut self, simd: V, group: &mut SpanGroup<N, S>) {
        group.advance(simd, self.movements, self.rotations);
    }
}
