//! Repeated sampling of beams at the same positions.

use std::f64::consts::PI;

use crate::beams::{BodyPoint, SectionForces, SectionPlace};
use crate::elementary::atan2;
use crate::geometry::{Vec2, corresponding};
use crate::system::{Scene, System, SystemError};

/// Positions along a beam, precomputed for repeated sampling: its knots, and equally spaced positions between consecutive knots.
/// A joint inside the beam has two positions with the same arc length: the first before the joint, the second after the joint.
#[derive(Debug, Clone, PartialEq)]
pub struct BeamPlaces {
    beam: usize,
    places: Vec<(f64, BodyPoint, SectionPlace)>,
}

/// State of a beam at a sampled position.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct BeamSample {
    /// Arc length of the sampled point in the initial configuration [length].
    pub arc_length: f64,
    /// Position of the sampled point [length].
    pub position: Vec2,
    /// Velocity of the sampled point [length/time].
    pub velocity: Vec2,
    /// Section angle [rad], continuous along the beam and not reduced to one turn. It starts from the tracked angle at the start of the beam.
    pub angle: f64,
    /// Section forces at the position, including the forces of material damping.
    pub forces: SectionForces,
    /// Strain energy per undeformed length [energy/length].
    pub strain_energy: f64,
}

impl BeamPlaces {
    /// Number of positions between two knots that is sufficient to represent the variation of section forces.
    pub const WITHIN_A_SPAN: usize = 3;

    /// Removes, at each joint inside the beam, the first of the two positions with the same arc length.
    pub fn deduplicate_places(mut self) -> Self {
        let mut behind = self.arc_lengths().skip(1).collect::<Vec<_>>().into_iter();
        self.places.retain(|(arc_length, ..)| behind.next() != Some(*arc_length));
        self
    }

    /// Increasing arc lengths of the positions in the initial configuration [length].
    pub fn arc_lengths(&self) -> impl Iterator<Item = f64> + '_ {
        self.places.iter().map(|(arc_length, ..)| *arc_length)
    }

    /// Coordinates of the positions, computed from control points of the beam [length].
    pub fn positions(&self, control_points: &[Vec2]) -> impl Iterator<Item = Vec2> {
        self.places.iter().map(|(_, place, _)| place.interpolate(control_points))
    }
}

impl System {
    /// Positions along a beam for [`sample_along`](Self::sample_along): its knots, and `within_a_span` positions between consecutive knots.
    ///
    /// # Errors
    /// Fails if an axis has a point without a tangent.
    pub fn places_along(
        &self,
        scene: &Scene,
        beam: usize,
        within_a_span: usize,
    ) -> Result<BeamPlaces, SystemError> {
        let (definition, mesh) = (&scene.beams[beam], &self.meshes()[beam]);
        let (from, onto) = (mesh.basis().domain(), definition.axis.domain());
        let of_geometry = SystemError::geometry(&definition.name);
        let place = |(xi, section): (f64, SectionPlace)| {
            let arc_length = definition.axis.length_to(corresponding(xi, from, onto))?;
            Ok((arc_length, BodyPoint::at(beam, &definition.axis, mesh, xi)?, section))
        };
        let sections = self.section_points(scene, beam)?.along(within_a_span);
        let sections = sections.map_err(SystemError::beam(&definition.name))?;
        let places = sections.into_iter().map(place).collect::<Result<_, _>>();
        Ok(BeamPlaces { beam, places: places.map_err(of_geometry)? })
    }

    /// Samples a beam in the present configuration, from its start to its end.
    pub fn sample_along(&self, along: &BeamPlaces) -> Vec<BeamSample> {
        let dynamics = &self.bodies()[along.beam].dynamics;
        let mut angle = self.end_angles(along.beam).0;
        let sample = |(arc_length, place, section): &(f64, BodyPoint, SectionPlace)| {
            let of_strains = dynamics.section_forces(section);
            let forces = self.with_damping(of_strains, along.beam, section);
            angle = unwrap_to_nearest(atan2(forces.normal.y, forces.normal.x), angle);
            BeamSample {
                arc_length: *arc_length,
                position: self.position(place),
                velocity: self.velocity(place),
                angle,
                forces,
                strain_energy: of_strains.strain_energy(),
            }
        };
        along.places.iter().map(sample).collect()
    }
}

/// Angle that differs from `angle` by whole turns and is nearest to `other` [rad].
fn unwrap_to_nearest(angle: f64, other: f64) -> f64 {
    angle + 2.0 * PI * ((other - angle) / (2.0 * PI)).round()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn angles_are_unwrapped_to_the_nearest_whole_turn() {
        for (angle, other, expected) in [(0.1, 0.0, 0.1), (-3.0, 3.2, 2.0 * PI - 3.0)] {
            assert!((unwrap_to_nearest(angle, other) - expected).abs() < 1e-15);
        }
        assert!((unwrap_to_nearest(0.5, 20.0 * PI) - (20.0 * PI + 0.5)).abs() < 1e-12);
    }
}
