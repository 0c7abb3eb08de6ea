//! The quadrature points of one span.

use pulp::Simd;

use super::at_rest::SpanAtRest;
use super::block::Block;
use super::dynamics::{Collocation, ForceSummary, Movement};
use super::force_point::ForcePoint;
use super::moment_point::MomentPoint;
use super::{RotationIncrement, Section};

/// The quadrature points of a span on which `N` functions of the basis are not zero.
#[derive(Debug, Clone)]
pub(super) struct SpanPoints<const N: usize> {
    /// The index of the first control point of the span.
    pub(super) first: usize,
    pub(super) force_points: Vec<ForcePoint<N>>,
    pub(super) moment_points: Vec<MomentPoint<N>>,
}

/// The movements of the `N` control points from `first` on.
#[inline]
pub(super) fn window<const N: usize>(movements: &[Movement], first: usize) -> &[Movement; N] {
    movements[first..]
        .first_chunk()
        .expect("a span has as many control points as its basis has functions")
}

#[inline]
pub(super) fn window_mut<const N: usize>(
    movements: &mut [Movement],
    first: usize,
) -> &mut [Movement; N] {
    movements[first..]
        .first_chunk_mut()
        .expect("a span has as many control points as its basis has functions")
}

impl<const N: usize> SpanPoints<N> {
    /// Adds the forces of this span on its control points; `moved` are the movements of all control points of the beam.
    #[inline]
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
        for point in &mut self.force_points {
            point.add_forces(section, at, moved, weight, forces, summary);
        }
        for point in &mut self.moment_points {
            point.add_forces(section, at, moved, weight, forces, summary);
        }
    }

    /// Adds the condensed forces of this span on its control points, and their derivatives to the block.
    #[inline(always)]
    pub(super) fn add_linearised_forces<S: Simd>(
        &mut self,
        section: &Section,
        at: Collocation,
        moved: &[Movement],
        weight: f64,
        forces: &mut [Movement; N],
        block: &mut Block<S, N>,
    ) {
        let moved = window(moved, self.first);
        for point in &mut self.force_points {
            point.add_linearised_forces(section, at, moved, weight, forces, block);
        }
        for point in &mut self.moment_points {
            point.add_linearised_forces(section, at, moved, weight, forces, block);
        }
    }

    /// Adds the forces that would close the strain mismatch in this span.
    #[inline]
    pub(super) fn add_mismatch_forces(
        &self,
        section: &Section,
        weight: f64,
        forces: &mut [Movement; N],
    ) {
        self.force_points
            .iter()
            .for_each(|point| point.add_mismatch_forces(section, weight, forces));
        self.moment_points
            .iter()
            .for_each(|point| point.add_mismatch_forces(section, weight, forces));
    }

    /// Updates the section forces of this span for a correction of the movements of all control points.
    #[inline]
    pub(super) fn correct_section_forces(&mut self, section: &Section, correction: &[Movement]) {
        let correction = window(correction, self.first);
        self.force_points
            .iter_mut()
            .for_each(|point| point.correct_section_force(section, correction));
        self.moment_points.iter_mut().for_each(|point| point.correct_moment(section, correction));
    }

    /// Accepts the movements of all control points, as far as they are of this span.
    pub(super) fn advance(&mut self, moved: &[Movement], rotations: RotationIncrement) {
        let moved = window(moved, self.first);
        self.force_points.iter_mut().for_each(|point| point.advance(moved, rotations));
        self.moment_points.iter_mut().for_each(|point| point.advance(moved, rotations));
    }

    /// Writes how this span resists small movements at rest.
    pub(super) fn write_at_rest(&self, section: &Section, span: &mut SpanAtRest) {
        span.begin(self.first);
        self.force_points.iter().for_each(|point| point.write_at_rest(section, span));
        self.moment_points.iter().for_each(|point| point.write_at_rest(section, span));
    }

    pub(super) fn strain_energy(&self, section: &Section) -> f64 {
        let force = self.force_points.iter().map(|point| point.strain_energy(section)).sum::<f64>();
        let moment =
            self.moment_points.iter().map(|point| point.strain_energy(section)).sum::<f64>();
        force + moment
    }

    /// Adds the energies of stretching, of shear and of bending.
    pub(super) fn add_strain_energies(&self, section: &Section, sums: &mut [f64; 3]) {
        for point in &self.force_points {
            let [axial, shear] = point.strain_energies(section);
            sums[0] += axial;
            sums[1] += shear;
        }
        sums[2] += self.moment_points.iter().map(|point| point.strain_energy(section)).sum::<f64>();
    }
}
