//! A particle: a body of one point, without a section, strain or extent. Its mass is a point mass of the scene.

use std::ops::Range;

use super::at_rest::SpanAtRest;
use super::discrete::move_compensated;
use super::dynamics::{BlockSink, BodyDynamics, Collocation, ForceSummary, Movement};
use super::{RotationIncrement, Section, SectionForces, SectionPlace};
use crate::geometry::Vec2;

/// A particle: a body of one control point, without extent and elasticity.
#[derive(Debug, Clone)]
pub struct Particle {
    position: [Vec2; 1],
    remainder: [Vec2; 1],
}

impl Particle {
    /// A particle at a position [length].
    pub fn new(position: Vec2) -> Self {
        Self { position: [position], remainder: [Vec2::zeros()] }
    }
}

impl BodyDynamics for Particle {
    fn order(&self) -> usize {
        1
    }

    fn span_starts(&self) -> Vec<usize> {
        Vec::new()
    }

    fn divide(&mut self, _most: usize) -> Vec<usize> {
        Vec::new()
    }

    fn control_points(&self) -> &[Vec2] {
        &self.position
    }

    fn remainders(&self) -> &[Vec2] {
        &self.remainder
    }

    fn begin_step(&mut self) {}

    fn add_forces(
        &mut self,
        _at: Collocation,
        _moved: &[Movement],
        _weight: f64,
        _forces: &mut [Movement],
    ) -> ForceSummary {
        ForceSummary::default()
    }

    fn add_linearised_forces(
        &mut self,
        _at: Collocation,
        _moved: &[Movement],
        _weight: f64,
        _forces: &mut [Movement],
        _tangents: &mut [BlockSink<'_>],
    ) {
    }

    fn add_mismatch_forces(&mut self, _weight: f64, _forces: &mut [Movement]) {}

    fn correct_section_forces(&mut self, _correction: &[Movement]) {}

    fn advance(&mut self, moved: &[Movement], _rotations: RotationIncrement) {
        let points = self.position.iter_mut().zip(&mut self.remainder).zip(moved);
        points.for_each(|((point, remainder), moved)| move_compensated(point, remainder, moved));
    }

    fn add_inertia(&self, _factor: f64, _rates: &[Movement], _forces: &mut [Movement]) {}

    fn add_inertia_tangent(
        &self,
        _factor: f64,
        _points: Range<usize>,
        _tangent: &mut dyn FnMut(usize, usize, Movement),
    ) {
    }

    fn each_span_at_rest(&self, _take: &mut dyn FnMut(&SpanAtRest)) {}

    fn extent(&self) -> Option<(&Section, f64)> {
        None
    }

    fn write_normals(&self, _normals: &mut Vec<Vec2>) {}

    fn strain_energy(&self) -> f64 {
        0.0
    }

    fn strain_energies(&self) -> [f64; 3] {
        [0.0; 3]
    }

    fn section_forces(&self, _place: &SectionPlace) -> SectionForces {
        SectionForces::default()
    }

    fn lumped_lengths(&self) -> Vec<f64> {
        vec![0.0]
    }

    fn save(&self, state: &mut Vec<f64>) {
        let ([position], [remainder]) = (&self.position, &self.remainder);
        state.extend([position.x, position.y, remainder.x, remainder.y]);
    }

    fn restore(&mut self, next: &mut dyn FnMut() -> f64) {
        self.position = [Vec2::new(next(), next())];
        self.remainder = [Vec2::new(next(), next())];
    }
}
