//! Bodies without elasticity: particles and rigid bodies. Their masses are the point masses of the scene.

use std::ops::Range;

use super::discrete::move_compensated;
use super::dynamics::{BlockSink, BodyDynamics, Collocation, ForceSummary, Movement};
use super::span_stiffness::SpanStiffness;
use super::{Rotation, RotationIncrement, Section, SectionForces, SectionPlace};
use crate::geometry::{Vec2, larger};

/// Body without elasticity: a particle, or the centre of mass of a rigid body followed by its other points.
#[derive(Debug, Clone)]
pub struct RigidPoints {
    positions: Vec<Vec2>,
    remainders: Vec<Vec2>,
    /// Rotation of the rigid body; `None` for a particle.
    rotation: Option<Rotation>,
}

impl RigidPoints {
    /// Creates a particle at a position [length].
    pub fn particle(position: Vec2) -> Self {
        Self { positions: vec![position], remainders: vec![Vec2::zeros()], rotation: None }
    }

    /// Creates a rigid body at an angle [rad]. `positions` contains its centre of mass, followed by its other points [length].
    pub fn rigid(positions: Vec<Vec2>, angle: f64) -> Self {
        let remainders = vec![Vec2::zeros(); positions.len()];
        Self { positions, remainders, rotation: Some(Rotation::by(angle)) }
    }

    fn summary(&self, moved: &[Movement]) -> ForceSummary {
        let rotation = moved.iter().fold(0.0, |most, moved| larger(most, moved[2].abs()));
        ForceSummary { rotation, ..ForceSummary::default() }
    }
}

impl BodyDynamics for RigidPoints {
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
        &self.positions
    }

    fn remainders(&self) -> &[Vec2] {
        &self.remainders
    }

    fn begin_step(&mut self) {}

    fn add_forces(
        &mut self,
        _at: Collocation,
        moved: &[Movement],
        _weight: f64,
        _forces: &mut [Movement],
    ) -> ForceSummary {
        self.summary(moved)
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

    fn advance(&mut self, moved: &[Movement], rotations: RotationIncrement) {
        let points = self.positions.iter_mut().zip(&mut self.remainders).zip(moved);
        points.for_each(|((point, remainder), moved)| move_compensated(point, remainder, moved));
        if let (Some(rotation), Some([.., increment])) = (&mut self.rotation, moved.first()) {
            *rotation = rotation.turned(rotations, *increment).normalised();
        }
    }

    fn add_inertia(&self, _factor: f64, _rates: &[Movement], _forces: &mut [Movement]) {}

    fn add_inertia_tangent(
        &self,
        _factor: f64,
        _points: Range<usize>,
        _tangent: &mut dyn FnMut(usize, usize, &[Movement]),
    ) {
    }

    fn each_inertia_diagonal(
        &self,
        _factor: f64,
        _points: Range<usize>,
        _tangent: &mut dyn FnMut(usize, isize, &[f64]),
    ) {
    }

    fn for_each_static_span(&self, _take: &mut dyn FnMut(&SpanStiffness)) {}

    fn extent(&self) -> Option<(Section, f64)> {
        None
    }

    fn write_normals(&self, normals: &mut Vec<Vec2>) {
        normals.extend(self.rotation.map(|rotation| Vec2::new(rotation.cos, rotation.sin)));
    }

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
        vec![0.0; self.positions.len()]
    }

    fn lumped_masses(&self) -> Vec<f64> {
        vec![0.0; self.positions.len()]
    }

    fn save(&self, state: &mut Vec<f64>) {
        for (position, remainder) in self.positions.iter().zip(&self.remainders) {
            state.extend([position.x, position.y, remainder.x, remainder.y]);
        }
        state.extend(self.rotation.iter().flat_map(|rotation| [rotation.cos, rotation.sin]));
    }

    fn restore(&mut self, next: &mut dyn FnMut() -> f64) {
        for (position, remainder) in self.positions.iter_mut().zip(&mut self.remainders) {
            *position = Vec2::new(next(), next());
            *remainder = Vec2::new(next(), next());
        }
        if let Some(rotation) = &mut self.rotation {
            *rotation = Rotation { cos: next(), sin: next() };
        }
    }
}
