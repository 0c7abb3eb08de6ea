//! Interface of the bodies of a model: beams with any basis, particles and rigid bodies.

use std::ops::Range;

use super::span_stiffness::SpanStiffness;
use super::{RotationIncrement, Section, SectionForces, SectionPlace};
use crate::geometry::{Vec2, larger};

/// Values of a control point for x, y and the rotation.
/// The values are increments [length, length, rad], rates [length/time, length/time, rad/time] or forces [force, force, force·length].
pub type Movement = [f64; 3];

/// Fractions of a step, from start (0) to end (1), at which internal forces are evaluated.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Collocation {
    /// Fraction of the step at which positions and rotations are evaluated, by linear interpolation between start and end [-].
    pub configuration: f64,
    /// Fraction of the step at which the strain for the section forces is evaluated, by linear interpolation between start and end [-].
    pub stress: f64,
    /// Type of rotation increments.
    pub rotations: RotationIncrement,
}

/// Largest forces, rotation and strain residual in an evaluation of the internal forces.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct ForceSummary {
    /// Largest strain residual: strain of the configuration minus the strain that belongs to the section force [-].
    /// Residuals of curvatures are multiplied by a length to make them dimensionless.
    pub strain_mismatch: f64,
    /// Largest section force [force].
    pub force: f64,
    /// Largest of all bending moments and of all products of a section force and its quadrature weight [force·length].
    pub moment: f64,
    /// Largest rotation increment `|Δω|` of a section [rad].
    pub rotation: f64,
}

impl ForceSummary {
    /// Replaces each value of the summary by the larger of the values in both summaries.
    pub fn join(&mut self, other: &Self) {
        self.strain_mismatch = larger(self.strain_mismatch, other.strain_mismatch);
        self.force = larger(self.force, other.force);
        self.moment = larger(self.moment, other.moment);
        self.rotation = larger(self.rotation, other.rotation);
    }
}

/// Function that receives the first control point of a span and the rows of its tangent matrix.
pub type BlockSink<'a> = &'a mut (dyn FnMut(usize, &[f64]) + Send);

/// Dynamics of a beam, particle or rigid body. Increments, rates and forces are given for all control points.
pub trait BodyDynamics: Send + Sync {
    /// Number of nonzero basis functions per span, degree + 1.
    fn order(&self) -> usize;

    /// First control point of each span.
    fn span_starts(&self) -> Vec<usize>;

    /// Divides the body into at most `most` parts that threads evaluate concurrently. Small bodies are not divided. Results do not change.
    /// Returns the first control point of each part of the body except the first part.
    fn divide(&mut self, most: usize) -> Vec<usize>;

    /// Positions of the control points at the start of the step [length].
    fn control_points(&self) -> &[Vec2];

    /// Rounding errors that the increments of the positions have accumulated [length].
    fn remainders(&self) -> &[Vec2];

    /// Prepares a step. Iterations start with the section forces of the last step.
    fn begin_step(&mut self);

    /// Adds `weight` times the internal forces on control points, computed from the present section forces.
    fn add_forces(
        &mut self,
        at: Collocation,
        moved: &[Movement],
        weight: f64,
        forces: &mut [Movement],
    ) -> ForceSummary;

    /// Adds `weight` times the internal forces, with the section force unknowns eliminated.
    /// Each function in `tangents` receives the tangent matrices of the spans of one part of a divided body, multiplied by `weight`.
    ///
    /// A span whose control points belong to two parts is passed to the functions of both parts.
    /// It is the last span of the earlier part and the first span of the later part.
    /// The function of a part in `tangents` must use only the rows of control points of this part.
    fn add_linearised_forces(
        &mut self,
        at: Collocation,
        moved: &[Movement],
        weight: f64,
        forces: &mut [Movement],
        tangents: &mut [BlockSink<'_>],
    );

    /// Adds `weight` times the force corrections that would remove the strain residuals, with the derivatives of the last linearisation.
    fn add_mismatch_forces(&mut self, weight: f64, forces: &mut [Movement]);

    /// Updates the section forces after an iteration has corrected the increments.
    fn correct_section_forces(&mut self, correction: &[Movement]);

    /// Ends a step with the given increments.
    fn advance(&mut self, moved: &[Movement], rotations: RotationIncrement);

    /// Adds `factor · M · rates` to the forces on control points, with the inertia matrix `M` of the body.
    fn add_inertia(&self, factor: f64, rates: &[Movement], forces: &mut [Movement]);

    /// Calls `tangent` with consecutive entries of each row of `factor · M`, where `M` is the inertia matrix of the body.
    /// The arguments of `tangent` are the control point of the row, the first control point of the columns, and three entries per column.
    fn add_inertia_tangent(
        &self,
        factor: f64,
        points: Range<usize>,
        tangent: &mut dyn FnMut(usize, usize, &[Movement]),
    );

    /// Calls `tangent` with consecutive entries of each diagonal of `factor · M`, where `M` is the inertia matrix of the body.
    /// The arguments of `tangent` are the first control point of the rows, the offset of the columns, and three entries per control point.
    /// The offset of the columns counts control points, and is negative to the left of the main diagonal.
    fn each_inertia_diagonal(
        &self,
        factor: f64,
        points: Range<usize>,
        tangent: &mut dyn FnMut(usize, isize, &[f64]),
    );

    /// Calls `take` with the static tangent stiffness of each span in the configuration at the start of the step.
    fn for_each_static_span(&self, take: &mut dyn FnMut(&SpanStiffness));

    /// Section and initial length of the axis of a beam [length]; `None` for particles and rigid bodies.
    /// The section of a tapered beam is its mean section.
    fn extent(&self) -> Option<(Section, f64)>;

    /// Appends the unit normals of the sections at the start of the step, at the quadrature points of axial and shear strain [-].
    fn write_normals(&self, normals: &mut Vec<Vec2>);

    /// Strain energy at the start of the step [energy].
    fn strain_energy(&self) -> f64;

    /// Axial, shear and bending strain energies at the start of the step [energy].
    fn strain_energies(&self) -> [f64; 3];

    /// Section forces and strains at a section at the start of the step; zero for particles and rigid bodies.
    fn section_forces(&self, place: &SectionPlace) -> SectionForces;

    /// Length assigned to each control point: the integral of its basis function along the beam [length].
    fn lumped_lengths(&self) -> Vec<f64>;

    /// Mass assigned to each control point: the integral of its basis function times the mass per length, without point masses [mass].
    fn lumped_masses(&self) -> Vec<f64>;

    /// Appends the present state of the body to `state`.
    fn save(&self, state: &mut Vec<f64>);

    /// Restores the state of the body from numbers in the order of [`save`](Self::save).
    fn restore(&mut self, next: &mut dyn FnMut() -> f64);
}
