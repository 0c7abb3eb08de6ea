//! The loops of a step over the spans of a beam, by vector instructions.

use pulp::{Arch, Simd, WithSimd};

use super::block::Block;
use super::dynamics::{Collocation, ForceSummary, Movement};
use super::sections::Sections;
use super::span_points::{SpanPoints, window_mut};
use super::{RotationIncrement, Section};

/// A loop over spans: a type for each, so that the compiler knows which instructions it may use all through it.
pub(super) trait SpanLoop<const N: usize, S> {
    /// What the loop does at a span.
    fn at<V: Simd>(&mut self, simd: V, span: &mut SpanPoints<N, S>);

    /// Goes through some spans.
    fn over(self, spans: &mut [SpanPoints<N, S>])
    where
        Self: Sized,
    {
        Arch::new().dispatch(Over { spans, work: self });
    }
}

/// A loop, and the spans that it is over.
pub(super) struct Over<'a, const N: usize, S, W> {
    pub(super) spans: &'a mut [SpanPoints<N, S>],
    pub(super) work: W,
}

impl<const N: usize, S, W: SpanLoop<N, S>> WithSimd for Over<'_, N, S, W> {
    type Output = ();

    #[inline(always)]
    fn with_simd<V: Simd>(mut self, simd: V) {
        for span in self.spans {
            self.work.at(simd, span);
        }
    }
}

/// What internal forces depend on besides the spans: sections, where in the step, movements, and the factor of the forces.
#[derive(Clone, Copy)]
pub(super) struct Iterate<'a> {
    pub(super) section: &'a Section,
    pub(super) at: Collocation,
    pub(super) moved: &'a [Movement],
    pub(super) weight: f64,
}

/// The forces on control points, from one of them on.
pub(super) struct ForcesFrom<'a> {
    pub(super) first: usize,
    pub(super) forces: &'a mut [Movement],
}

impl ForcesFrom<'_> {
    #[inline(always)]
    fn of<const N: usize, S>(&mut self, span: &SpanPoints<N, S>) -> &mut [Movement; N] {
        window_mut(self.forces, span.first - self.first)
    }
}

/// Adds the internal forces, with the section forces as they are.
pub(super) struct Forces<'a> {
    pub(super) iterate: Iterate<'a>,
    pub(super) forces: ForcesFrom<'a>,
    pub(super) summary: &'a mut ForceSummary,
}

impl<const N: usize, S: Sections> SpanLoop<N, S> for Forces<'_> {
    #[inline(always)]
    fn at<V: Simd>(&mut self, _: V, span: &mut SpanPoints<N, S>) {
        let Iterate { section, at, moved, weight } = self.iterate;
        let forces = self.forces.of(span);
        span.add_forces(section, at, moved, weight, forces, self.summary);
    }
}

/// Adds the condensed internal forces, and gives the tangent of each span.
pub(super) struct Linearisation<'a> {
    pub(super) iterate: Iterate<'a>,
    pub(super) forces: ForcesFrom<'a>,
    pub(super) tangent: &'a mut dyn FnMut(usize, &[f64]),
}

impl<const N: usize, S: Sections> SpanLoop<N, S> for Linearisation<'_> {
    #[inline(always)]
    fn at<V: Simd>(&mut self, simd: V, span: &mut SpanPoints<N, S>) {
        let Iterate { section, at, moved, weight } = self.iterate;
        let forces = self.forces.of(span);
        let mut block = Block::zeros(simd);
        span.add_linearised_forces(section, at, moved, weight, forces, &mut block);
        (self.tangent)(span.first, block.entries());
    }
}

/// Adds the forces that would close the strain mismatch.
pub(super) struct MismatchForces<'a> {
    pub(super) section: &'a Section,
    pub(super) weight: f64,
    pub(super) forces: ForcesFrom<'a>,
}

impl<const N: usize, S: Sections> SpanLoop<N, S> for MismatchForces<'_> {
    #[inline(always)]
    fn at<V: Simd>(&mut self, _: V, span: &mut SpanPoints<N, S>) {
        span.add_mismatch_forces(self.section, self.weight, self.forces.of(span));
    }
}

/// Carries a correction of the movements over to the section forces.
#[derive(Clone, Copy)]
pub(super) struct Correction<'a> {
    pub(super) section: &'a Section,
    pub(super) movements: &'a [Movement],
}

impl<const N: usize, S: Sections> SpanLoop<N, S> for Correction<'_> {
    #[inline(always)]
    fn at<V: Simd>(&mut self, _: V, span: &mut SpanPoints<N, S>) {
        span.correct_section_forces(self.section, self.movements);
    }
}

/// Accepts movements of a step.
#[derive(Clone, Copy)]
pub(super) struct Advance<'a> {
    pub(super) moved: &'a [Movement],
    pub(super) rotations: RotationIncrement,
}

impl<const N: usize, S: Sections> SpanLoop<N, S> for Advance<'_> {
    #[inline(always)]
    fn at<V: Simd>(&mut self, _: V, span: &mut SpanPoints<N, S>) {
        span.advance(self.moved, self.rotations);
    }
}
