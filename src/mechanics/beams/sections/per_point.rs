//! The sections of quadrature points.

use std::fmt::Debug;

use super::{Interpolated, Interpolation, MassIntegral, SectionIntegral};
use crate::beams::Section;

/// The sections of the quadrature points of a span, a type for each way in which they are known: the points of a uniform beam share one and
/// nothing is looked up.
pub(in crate::beams) trait Sections: Clone + Debug + Send + Sync {
    /// What is summed up of a product of two functions: the length, and the inertia where that is not proportional to it.
    type MassIntegral: MassIntegral;
    /// The section at a place between points.
    type Interpolation: Interpolation;

    /// The sections at the points for `Γ` and at those for `κ`.
    fn new(at_force: Vec<Section>, at_moment: Vec<Section>) -> Self;

    /// That of a point for `Γ`.
    fn of_force<'a>(&'a self, uniform: &'a Section, point: usize) -> &'a Section;

    /// That of a point for `κ`.
    fn of_moment<'a>(&'a self, uniform: &'a Section, point: usize) -> &'a Section;

    /// The masses of control points, from their lengths where the section is the same, or as they were weighed.
    fn masses(uniform: &Section, lengths: Vec<f64>, weighed: Vec<f64>) -> Vec<f64>;
}

/// All points have the section of the beam.
#[derive(Debug, Clone)]
pub(in crate::beams) struct Uniform;

impl Sections for Uniform {
    type MassIntegral = f64;
    type Interpolation = ();

    fn new(_at_force: Vec<Section>, _at_moment: Vec<Section>) -> Self {
        Self
    }

    #[inline(always)]
    fn of_force<'a>(&'a self, uniform: &'a Section, _point: usize) -> &'a Section {
        uniform
    }

    #[inline(always)]
    fn of_moment<'a>(&'a self, uniform: &'a Section, _point: usize) -> &'a Section {
        uniform
    }

    fn masses(uniform: &Section, lengths: Vec<f64>, _weighed: Vec<f64>) -> Vec<f64> {
        lengths.into_iter().map(|length| length * uniform.mass_per_length).collect()
    }
}

/// Each point has its own.
#[derive(Debug, Clone)]
pub(in crate::beams) struct PerPoint {
    at_force: Vec<Section>,
    at_moment: Vec<Section>,
}

impl Sections for PerPoint {
    type MassIntegral = SectionIntegral;
    type Interpolation = Interpolated;

    fn new(at_force: Vec<Section>, at_moment: Vec<Section>) -> Self {
        Self { at_force, at_moment }
    }

    #[inline(always)]
    fn of_force<'a>(&'a self, _uniform: &'a Section, point: usize) -> &'a Section {
        &self.at_force[point]
    }

    #[inline(always)]
    fn of_moment<'a>(&'a self, _uniform: &'a Section, point: usize) -> &'a Section {
        &self.at_moment[point]
    }

    fn masses(_uniform: &Section, _lengths: Vec<f64>, weighed: Vec<f64>) -> Vec<f64> {
        weighed
    }
}
