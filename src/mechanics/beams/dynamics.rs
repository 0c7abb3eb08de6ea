//! What a body offers to the model: a beam, whatever its basis, a particle or a rigid body.

use std::ops::Range;

use super::span_stiffness::SpanStiffness;
use super::{RotationIncrement, Section, SectionForces, SectionPlace};
use crate::geometry::{Vec2, larger};

/// The movement of a control point, its rate, or the force on it: the components x, y and rotation [length, length, rad].
pub type Movement = [f64; 3];

/// Where between start (0) and end (1) of a step internal forces are taken.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Collocation {
    /// The share `τ` of the step at which the configuration is taken: `(1-τ)(x0, Λ0) + τ (x1, Λ1)` [-].
    pub configuration: f64,
    /// The share `σ` of the step whose strain the section forces belong to: `(1-σ) Γ0 + σ Γ1` [-].
    pub stress: f64,
    /// What rotation increments of the step stand for.
    pub rotations: RotationIncrement,
}

/// The largest mismatch, forces and rotation that were met while the internal forces of a body were added up.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct ForceSummary {
    /// The largest difference between the strain of a section force and that of the configuration; of curvatures, times the length
    /// they stand for [-].
    pub strain_mismatch: f64,
    /// The largest section force that was met [force].
    pub force: f64,
    /// The largest moment, or section force times the length it stands for, that was met [force·length].
    pub moment: f64,
    /// The largest rotation increment `|Δω|` of a section that was met [rad].
    pub rotation: f64,
}

impl ForceSummary {
    /// Takes the larger of both summaries, entry by entry.
    pub fn join(&mut self, other: &Self) {
        self.strain_mismatch = larger(self.strain_mismatch, other.strain_mismatch);
        self.force = larger(self.force, other.force);
        self.moment = larger(self.moment, other.moment);
        self.rotation = larger(self.rotation, other.rotation);
    }
}

/// Takes the derivative of the forces of a span: its first control point and the rows of the block, one after another.
pub type BlockSink<'a> = &'a mut (dyn FnMut(usize, &[f64]) + Send);

/// A beam on its basis, or a body of points: reference quantities, state at the start of a step, and the iterate of the step.
///
/// Movements, rates and forces are indexed by control point.
pub trait BodyDynamics: Send + Sync {
    /// The number of basis functions that are not zero on a span of this body, degree + 1.
    fn order(&self) -> usize;

    /// The index of the first control point of each span of this body.
    fn span_starts(&self) -> Vec<usize>;

    /// Lets the body work in at most so many parts at once from here on, in as many as pay, with the same results. Gives the first
    /// control point of each part but the first.
    fn divide(&mut self, most: usize) -> Vec<usize>;

    /// The places of the control points of this body at the start of the step [length].
    fn control_points(&self) -> &[Vec2];

    /// What rounding has cut off the places of the control points of this body so far [length].
    fn remainders(&self) -> &[Vec2];

    /// Begins a step with the section forces of the last one.
    fn begin_step(&mut self);

    /// Adds `weight` times the internal forces of this body, with the section forces as they are, to the forces on its control points.
    fn add_forces(
        &mut self,
        at: Collocation,
        moved: &[Movement],
        weight: f64,
        forces: &mut [Movement],
    ) -> ForceSummary;

    /// Adds `weight` times the condensed internal forces of this body, and gives `weight` times their derivative, span by span, to the
    /// sink of the part.
    ///
    /// The sink of the part behind a cut gets spans astride the cut before its own, that of the part before it after its own;
    /// each is to take the rows of the control points of its part.
    fn add_linearised_forces(
        &mut self,
        at: Collocation,
        moved: &[Movement],
        weight: f64,
        forces: &mut [Movement],
        tangents: &mut [BlockSink<'_>],
    );

    /// Adds `weight` times the forces that would close the strain mismatch met by the last forces, in the directions
    /// of the last linearisation.
    fn add_mismatch_forces(&mut self, weight: f64, forces: &mut [Movement]);

    /// Updates the section forces of this body for a correction of the movements of the last linearisation.
    fn correct_section_forces(&mut self, correction: &[Movement]);

    /// Accepts the movements of a step: its end becomes the start of the next.
    fn advance(&mut self, moved: &[Movement], rotations: RotationIncrement);

    /// Adds `factor · M · rates` to the forces on the control points, with the inertia `M` of this body.
    fn add_inertia(&self, factor: f64, rates: &[Movement], forces: &mut [Movement]);

    /// Gives the rows of some control points in `factor · M`, the inertia of this body, to `tangent`, in pieces: control point of the row, first
    /// one of the columns, and the three diagonal entries for each column.
    fn add_inertia_tangent(
        &self,
        factor: f64,
        points: Range<usize>,
        tangent: &mut dyn FnMut(usize, usize, &[Movement]),
    );

    /// Gives the same rows in pieces of diagonals: the first control point of some rows, by how many control points the columns stand behind these
    /// (before them if negative), and the entries, three for each control point.
    fn each_inertia_diagonal(
        &self,
        factor: f64,
        points: Range<usize>,
        tangent: &mut dyn FnMut(usize, isize, &[f64]),
    );

    /// Gives, span by span, how this body resists small movements of its control points at the start of the step, as at rest there.
    fn each_span_at_rest(&self, take: &mut dyn FnMut(&SpanStiffness));

    /// The section of a beam, of one that tapers the mean, and the length of its axis as drawn [length]; none for a body without extent.
    fn extent(&self) -> Option<(Section, f64)>;

    /// Appends the normal [-], in space, of each section at which strains are taken, at the start of the step.
    fn write_normals(&self, normals: &mut Vec<Vec2>);

    /// The strain energy of this body at the start of the step [energy].
    fn strain_energy(&self) -> f64;

    /// The strain energies of stretching, of shear and of bending of this body at the start of the step [energy].
    fn strain_energies(&self) -> [f64; 3];

    /// Section forces and strains of this body at a place, at the start of the step; zero where nothing is strained.
    fn section_forces(&self, place: &SectionPlace) -> SectionForces;

    /// The length `∫ N_a dX` that belongs to every control point of this body [length].
    fn lumped_lengths(&self) -> Vec<f64>;

    /// The mass `∫ ρA N_a dX` that belongs to every control point of this body, without what stands on it [mass].
    fn lumped_masses(&self) -> Vec<f64>;

    /// Appends the state of this body at the start of a step to `state`.
    fn save(&self, state: &mut Vec<f64>);

    /// Takes the state of this body back, in the order in which it was appended.
    fn restore(&mut self, next: &mut dyn FnMut() -> f64);
}
