//! Sections at quadrature points.

use std::fmt::Debug;

use pulp::Simd;

use super::{Interpolated, Interpolation, MassIntegral, SectionIntegral};
use crate::beams::Section;
use crate::beams::force_points::Stiffness;
use crate::beams::pair::Pair;
use crate::beams::simd::{LANES, LaneChunk, Lanes, Vector};

/// Sections at the quadrature points of consecutive spans; empty for a uniform beam.
pub(in crate::beams) trait Sections: Clone + Debug + Send + Sync {
    type MassIntegral: MassIntegral;
    type Interpolation: Interpolation;

    fn new(at_force: Vec<Section>, at_moment: Vec<Section>) -> Self;

    fn of_force<'a>(&'a self, uniform: &'a Section, point: usize) -> &'a Section;

    fn of_moment<'a>(&'a self, uniform: &'a Section, point: usize) -> &'a Section;

    fn force_stiffness<V: Simd>(
        &self,
        uniform: &Section,
        points: usize,
        part: LaneChunk<V>,
    ) -> Stiffness<V>;

    fn bending_stiffness<V: Simd>(
        &self,
        uniform: &Section,
        points: usize,
        part: LaneChunk<V>,
    ) -> Vector<V>;

    fn masses(uniform: &Section, lengths: Vec<f64>, weighed: Vec<f64>) -> Vec<f64>;
}

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

#[derive(Debug, Clone)]
pub(in crate::beams) struct PerPoint {
    at_force: Vec<Section>,
    at_moment: Vec<Section>,
    force_stiffness: Vec<Pair<Lanes>>,
    bending_stiffness: Vec<Lanes>,
}

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
