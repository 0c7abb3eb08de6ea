//! The quadrature points of one span.

use pulp::Simd;

use super::at_rest::SpanAtRest;
use super::block::Block;
use super::dynamics::{Collocation, ForceSummary, Movement};
use super::force_point::ForcePoint;
use super::moment_point::MomentPoint;
use super::sections::{Sections, Uniform};
use super::{RotationIncrement, Section};

/// The quadrature points of a span on which `N` functions of the basis are not zero.
#[derive(Debug, Clone)]
pub(super) struct SpanPoints<const N: usize, S = Uniform> {
    /// The index of the first control point of the span.
    pub(super) first: usize,
    pub(super) force_points: Vec<ForcePoint<N>>,
    pub(super) moment_points: Vec<MomentPoint<N>>,
    pub(super) sections: S,
}

/// The movements of the `N` control points from `first` on.
#[inline(always)]
pub(super) fn window<const N: usize>(movements: &[Movement], first: usize) -> &[Movement; N] {
    movements[first..]
        .first_chunk()
        .expect("a span has as many control points as its basis has functions")
}

#[inline(always)]
pub(super) fn window_mut<const N: usize>(
    movements: &mut [Movement],
    first: usize,
) -> &mut [Movement; N] {
    movements[first..]
        .first_chunk_mut()
        .expect("a span has as many control points as its basis has functions")
}

impl<const N: usize, S: Sections> SpanPoints<N, S> {
    /// Adds the forces of this span on its control points; `moved` are the movements of all control points of the beam.
    #[inline(always)]
    pub(super) fn add_forces(
        &mut self,
        section: &Section,
        at: Collocation,
        moved: &[Movement],
        weight: f64,
        forces: &mut [Movement; N],
        summary: &mut ForceSummary,
    ) {
        let moved = window(moved, self.first);
        let Self { sections, force_points, moment_points, .. } = self;
        for (index, point) in force_points.iter_mut().enumerate() {
            let section = sections.of_force(section, index);
            point.add_forces(section, at, moved, weight, forces, summary);
        }
        for (index, point) in moment_points.iter_mut().enumerate() {
            let section = sections.of_moment(section, index);
            point.add_forces(section, at, moved, weight, forces, summary);
        }
    }

    /// Adds the condensed forces of this span on its control points, and their derivatives to the block.
    #[inline(always)]
    pub(super) fn add_linearised_forces<V: Simd>(
        &mut self,
        section: &Section,
        at: Collocation,
        moved: &[Movement],
        weight: f64,
        forces: &mut [Movement; N],
        block: &mut Block<V, N>,
    ) {
        let moved = window(moved, self.first);
        let Self { sections, force_points, moment_points, .. } = self;
        for (index, point) in force_points.iter_mut().enumerate() {
            let section = sections.of_force(section, index);
            point.add_linearised_forces(section, at, moved, weight, forces, block);
        }
        for (index, point) in moment_points.iter_mut().enumerate() {
            let section = sections.of_moment(section, index);
            point.add_linearised_forces(section, at, moved, weight, forces, block);
        }
    }

    /// Adds the forces that would close the strain mismatch in this span.
    #[inline(always)]
    pub(super) fn add_mismatch_forces(
        &self,
        section: &Section,
        weight: f64,
        forces: &mut [Movement; N],
    ) {
        let Self { sections, force_points, moment_points, .. } = self;
        for (index, point) in force_points.iter().enumerate() {
            point.add_mismatch_forces(sections.of_force(section, index), weight, forces);
        }
        for (index, point) in moment_points.iter().enumerate() {
            point.add_mismatch_forces(sections.of_moment(section, index), weight, forces);
        }
    }

    /// Updates the section forces of this span for a correction of the movements of all control points.
    #[inline(always)]
    pub(super) fn correct_section_forces(&mut self, section: &Section, correction: &[Movement]) {
        let correction = window(correction, self.first);
        let Self { sections, force_points, moment_points, .. } = self;
        for (index, point) in force_points.iter_mut().enumerate() {
            point.correct_section_force(sections.of_force(section, index), correction);
        }
        for (index, point) in moment_points.iter_mut().enumerate() {
            point.correct_moment(sections.of_moment(section, index), correction);
        }
    }

    /// Accepts the movements of all control points, as far as they are of this span.
    #[inline(always)]
    pub(super) fn advance(&mut self, moved: &[Movement], rotations: RotationIncrement) {
        let moved = window(moved, self.first);
        self.force_points.iter_mut().for_each(|point| point.advance(moved, rotations));
        self.moment_points.iter_mut().for_each(|point| point.advance(moved, rotations));
    }

    /// Writes how this span resists small movements at rest.
    pub(super) fn write_at_rest(&self, section: &Section, span: &mut SpanAtRest) {
        span.begin(self.first);
        let Self { sections, force_points, moment_points, .. } = self;
        for (index, point) in force_points.iter().enumerate() {
            point.write_at_rest(sections.of_force(section, index), span);
        }
        for (index, point) in moment_points.iter().enumerate() {
            point.write_at_rest(sections.of_moment(section, index), span);
        }
    }

    pub(super) fn strain_energy(&self, section: &Section) -> f64 {
        let of_force = |(index, point): (usize, &ForcePoint<N>)| {
            point.strain_energy(self.sections.of_force(section, index))
        };
        let force = self.force_points.iter().enumerate().map(of_force).sum::<f64>();
        force + self.bending_energy(section)
    }

    fn bending_energy(&self, section: &Section) -> f64 {
        let of_moment = |(index, point): (usize, &MomentPoint<N>)| {
            point.strain_energy(self.sections.of_moment(section, index))
        };
        self.moment_points.iter().enumerate().map(of_moment).sum::<f64>()
    }

    /// Adds the energies of stretching, of shear and of bending of this span [energy].
    pub(super) fn add_strain_energies(&self, section: &Section, sums: &mut [f64; 3]) {
        for (index, point) in self.force_points.iter().enumerate() {
            let [axial, shear] = point.strain_energies(self.sections.of_force(section, index));
            sums[0] += axial;
            sums[1] += shear;
        }
        sums[2] += self.bending_energy(section);
    }
}
