//! Choice of the number of spans of beams from the scene (docs/theory.md, section 3).

use super::{BeamDefinition, Scene};
use crate::beams::{Mesh, Station, TaperQuadrature};
use crate::geometry::smaller;
use crate::loads::LoadKind;
use crate::system::elements::Element;

/// Number of spans of a straight uniform beam without sliders.
const SPANS: usize = 16;

/// Number of spans of a straight uniform beam on which a slider slides.
const SPANS_UNDER_SLIDERS: usize = 32;

const MOST_SPANS: usize = 64;

/// Smallest number of spans between neighbouring concentrated forces.
const SPANS_BETWEEN_FORCES: f64 = 2.0;

/// Largest distance between two forces that count as acting at the same place, as a fraction of the length of the beam.
const SAME_PLACE: f64 = 1e-6;

/// Largest error of the length of a curved axis on its mesh, as a fraction of its length.
const LENGTH_TOLERANCE: f64 = 1e-4;

impl Scene {
    /// Chooses the number of spans of a beam with an [automatic](Mesh::automatic) mesh. Other meshes do not change.
    ///
    /// A beam on which sliders slide has twice as many spans as a beam without sliders.
    /// The number of spans is doubled until two spans fit between concentrated forces, and the mesh represents the axis and the section, up to 64 spans.
    pub fn choose_mesh(&mut self, beam: usize) {
        if !self.beams[beam].mesh.is_automatic() {
            return;
        }
        let slides = self.sliders.iter().any(|slider| self.masters(slider).contains(&beam));
        let mut spans = if slides { SPANS_UNDER_SLIDERS } else { SPANS };
        let longest = self.shortest_gap(beam) / SPANS_BETWEEN_FORCES;
        while let Ok(mesh) = Mesh::automatic(spans) {
            self.beams[beam].mesh = mesh;
            if spans >= MOST_SPANS || !self.beams[beam].is_coarse(longest) {
                return;
            }
            spans *= 2;
        }
    }

    pub(super) fn choose_meshes_under(&mut self, element: usize) {
        for station in concentrated(&self.elements[element]) {
            if let Some(beam) = station.beam() {
                self.choose_mesh(beam);
            }
        }
    }

    /// Shortest distance along a beam between different places of concentrated loads, springs and point masses [length].
    /// The result is the length of the beam if there are fewer than two such places.
    fn shortest_gap(&self, beam: usize) -> f64 {
        let length = self.beams[beam].axis.length();
        let stations = self.elements.iter().flat_map(concentrated);
        let inside = stations.filter(|at| at.beam() == Some(beam)).map(|at| at.arc_length);
        let mut places: Vec<f64> = inside.collect();
        places.sort_by(f64::total_cmp);
        let gaps = places.windows(2).map(|pair| pair[1] - pair[0]);
        gaps.filter(|gap| *gap > SAME_PLACE * length).fold(length, smaller)
    }
}

impl BeamDefinition {
    /// Returns true if spans are longer than `longest` [length], or if the mesh does not represent the axis or the section.
    fn is_coarse(&self, longest: f64) -> bool {
        let length = self.axis.length();
        let is_missed = |meshed: f64| (meshed / length - 1.0).abs() > LENGTH_TOLERANCE;
        length > longest * self.mesh.spans() as f64
            || self.meshed_length().is_ok_and(is_missed)
            || TaperQuadrature::of(&self.section, &self.mesh).is_ok_and(|seen| seen.is_coarse())
    }
}

pub(super) fn concentrated(element: &Element) -> Vec<Station> {
    match element {
        Element::PointMass(mass) => vec![mass.station],
        Element::Spring(spring) => spring.stations().copied().collect(),
        Element::Load(load) => match load.kind {
            LoadKind::Force { station, .. } | LoadKind::Moment { station, .. } => vec![station],
            LoadKind::Line { .. } => Vec::new(),
        },
        Element::Damping(_) | Element::Drag(_) | Element::Obstacle(_) | Element::Contact(_) => {
            Vec::new()
        }
    }
}
