//! Queries of positions, velocities and angles.

use crate::beams::{BodyIndex, BodyPoint, Mesh, Station};
use crate::geometry::Vec2;
use crate::integrators::Mechanism;
use crate::system::bodies::Body;
use crate::system::{Scene, System, UnknownKind};

impl System {
    /// Meshes of the beams, with breaks at joints.
    pub fn meshes(&self) -> &[Mesh] {
        self.bodies().meshes()
    }

    /// Control points of all bodies: beams, then particles, then rigid bodies [length].
    pub fn control_points(&self) -> impl Iterator<Item = &[Vec2]> {
        self.bodies().iter().map(|body| body.dynamics.control_points())
    }

    pub(crate) fn movement(&self, unknown: usize) -> Option<(usize, usize, usize)> {
        self.bodies().iter().enumerate().find_map(|(body, one)| {
            let all = one.degrees_of_freedom.as_flattened();
            let at = all.iter().position(|degree| *degree == unknown)?;
            Some((body, at / 3, at % 3))
        })
    }

    pub(crate) fn linked_by(&self, unknown: usize) -> Option<(usize, usize)> {
        let link = self.links().iter().find(|link| link.unknowns.contains(&unknown))?;
        Some((link.body, link.point))
    }

    /// Number of unknowns without contact multipliers: degrees of freedom, and forces of rigid links and inclined rollers.
    pub(crate) fn unknown_count(&self) -> usize {
        self.unknown_movements().count()
    }

    /// Position of a point of a body [length].
    pub fn position(&self, place: &BodyPoint) -> Vec2 {
        self.bodies().position(place)
    }

    /// Velocity of a point of a body [length/time].
    pub fn velocity(&self, place: &BodyPoint) -> Vec2 {
        let [x, y, _] = self.bodies()[place.body].at(place, self.rates());
        Vec2::new(x, y)
    }

    /// Section angle at a station, counted over full turns [rad]; `None` if the angle is not tracked.
    pub fn angle(&self, scene: &Scene, station: &Station) -> Option<f64> {
        self.section_angle(self.tracked_section(scene, station)?)
    }

    /// Angle of a tracked section, counted over full turns [rad].
    pub fn section_angle(&self, section: usize) -> Option<f64> {
        self.bodies().angle(section)
    }

    /// Index of the tracked section at a station; `None` if the station is not tracked.
    pub(crate) fn tracked_section(&self, scene: &Scene, station: &Station) -> Option<usize> {
        let beam = match station.body {
            BodyIndex::Beam(beam) => beam,
            BodyIndex::Particle(_) => return None,
            BodyIndex::Rigid(body, _) => {
                return Some(2 * scene.beams.len() + scene.stations.len() + body);
            }
        };
        let length = scene.beams[beam].axis.length();
        let is_at = |arc_length| station.is_at(&Station::on_beam(beam, arc_length), length);
        Some(if is_at(0.0) {
            2 * beam
        } else if is_at(length) {
            2 * beam + 1
        } else {
            let known = scene.stations.iter().position(|other| other.is_at(station, length))?;
            2 * scene.beams.len() + known
        })
    }

    /// Section angles at the start and end of a beam, counted over full turns [rad].
    pub fn end_angles(&self, beam: usize) -> (f64, f64) {
        let angle = |section| self.bodies().angle(section).unwrap_or(f64::NAN);
        (angle(2 * beam), angle(2 * beam + 1))
    }

    /// Types of all unknowns.
    pub fn unknown_kinds(&self) -> &[UnknownKind] {
        self.unknown_movements().kinds()
    }

    pub(crate) fn displacements(&self, movements: &[f64]) -> Vec<Vec<Vec2>> {
        let of_body = |body: &Body| {
            (0..body.degrees_of_freedom.len()).map(|at| body.vector_at(at, movements)).collect()
        };
        self.bodies().iter().map(of_body).collect()
    }

    /// Name of the first follower load; `None` without follower loads. Follower loads have no potential.
    pub fn follower(&self) -> Option<&str> {
        self.elements().forces().find(|element| element.turns()).map(|element| element.name())
    }
}
