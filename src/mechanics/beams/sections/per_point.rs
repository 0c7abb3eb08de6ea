//! The sections of quadrature points.

use std::fmt::Debug;

use pulp::Simd;

use super::{Interpolated, Interpolation, MassIntegral, SectionIntegral};
use crate::beams::Section;
use crate::beams::force_points::Stiffness;
use crate::beams::pair::Pair;
use crate::beams::simd::{LANES, LaneChunk, Lanes, Vector};

/// The sections of the quadrature points of neighbouring spans, a type for each way in which they are known: the points of a uniform beam share one and
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

    /// The stiffness `diag(EA, GA)` of points for `Γ` side by side, by their number.
    fn force_stiffness<V: Simd>(
        &self,
        uniform: &Section,
        points: usize,
        part: LaneChunk<V>,
    ) -> Stiffness<V>;

    /// The stiffness `EI` of points for `κ` side by side, by their number.
    fn bending_stiffness<V: Simd>(
        &self,
        uniform: &Section,
        points: usize,
        part: LaneChunk<V>,
    ) -> Vector<V>;

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

    #[inline(always)]
    fn force_stiffness<V: Simd>(
        &self,
        uniform: &Section,
        _points: usize,
        part: LaneChunk<V>,
    ) -> Stiffness<V> {
        Pair { x: part.splat(uniform.axial_stiffness), y: part.splat(uniform.shear_stiffness) }
    }

    #[inline(always)]
    fn bending_stiffness<V: Simd>(
        &self,
        uniform: &Section,
        _points: usize,
        part: LaneChunk<V>,
    ) -> Vector<V> {
        part.splat(uniform.bending_stiffness)
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
    /// `diag(EA, GA)` and `EI` of points side by side.
    force_stiffness: Vec<Pair<Lanes>>,
    bending_stiffness: Vec<Lanes>,
}

/// A number of the sections of points side by side; lanes without a point have that of the last one.
fn side_by_side(sections: &[Section], of: impl Fn(&Section) -> f64) -> Lanes {
    let mut lanes = Lanes::default();
    for lane in 0..LANES {
        lanes.set_lane(lane, of(&sections[lane.min(sections.len() - 1)]));
    }
    lanes
}

impl Sections for PerPoint {
    type MassIntegral = SectionIntegral;
    type Interpolation = Interpolated;

    fn new(at_force: Vec<Section>, at_moment: Vec<Section>) -> Self {
        let force_stiffness = at_force.chunks(LANES).map(|sections| Pair {
            x: side_by_side(sections, |section| section.axial_stiffness),
            y: side_by_side(sections, |section| section.shear_stiffness),
        });
        let bending = |section: &Section| section.bending_stiffness;
        let bending_stiffness =
            at_moment.chunks(LANES).map(|sections| side_by_side(sections, bending));
        Self {
            force_stiffness: force_stiffness.collect(),
            bending_stiffness: bending_stiffness.collect(),
            at_force,
            at_moment,
        }
    }

    #[inline(always)]
    fn of_force<'a>(&'a self, _uniform: &'a Section, point: usize) -> &'a Section {
        &self.at_force[point]
    }

    #[inline(always)]
    fn of_moment<'a>(&'a self, _uniform: &'a Section, point: usize) -> &'a Section {
        &self.at_moment[point]
    }

    #[inline(always)]
    fn force_stiffness<V: Simd>(
        &self,
        _uniform: &Section,
        points: usize,
        part: LaneChunk<V>,
    ) -> Stiffness<V> {
        self.force_stiffness[points].get(part)
    }

    #[inline(always)]
    fn bending_stiffness<V: Simd>(
        &self,
        _uniform: &Section,
        points: usize,
        part: LaneChunk<V>,
    ) -> Vector<V> {
        self.bending_stiffness[points].get(part)
    }

    fn masses(_uniform: &Section, _lengths: Vec<f64>, weighed: Vec<f64>) -> Vec<f64> {
        weighed
    }
}
