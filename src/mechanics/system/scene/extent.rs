//! Length scale of a scene without beams, and rounding error of the energy of a scene.

use super::{Scene, Ties};
use crate::beams::{BodyIndex, Station};
use crate::geometry::{Vec2, larger};
use crate::joints::Partner;
use crate::loads::LoadKind;
use crate::system::elements::{Anchor, Origin, Spring, SpringKind, SpringLaw};

/// Largest distance of two points that counts as zero, as a fraction of their coordinates.
const ROUNDED: f64 = 1e-9;

/// Particles and rigid bodies connected by springs and joints, with the ground anchors of the springs.
#[derive(Default)]
struct Group {
    points: Vec<Vec2>,
    /// Largest natural length of the springs in the group [length].
    natural_length: f64,
}

impl Group {
    fn extent(&self) -> f64 {
        let count = self.points.len().max(1) as f64;
        let centre = self.points.iter().sum::<Vec2>() / count;
        let farthest =
            |from: Vec2| self.points.iter().map(|at| (at - from).norm()).fold(0.0, larger);
        let extent = 2.0 * farthest(centre);
        let is_rounding = extent <= ROUNDED * farthest(Vec2::zeros());
        if is_rounding { self.natural_length } else { larger(self.natural_length, extent) }
    }
}

impl Scene {
    /// Largest initial extent of a group of connected particles and rigid bodies [length].
    /// The extent of a scene does not depend on its location. The extent of isolated particles without size is zero.
    pub fn extent(&self) -> f64 {
        let mut groups = self.groups();
        for (index, particle) in self.particles.iter().enumerate() {
            groups.of(index).points.push(particle.position);
        }
        for (index, body) in self.rigid_bodies.iter().enumerate() {
            groups.of(self.particles.len() + index).points.extend(body.control_points());
        }
        for spring in self.springs() {
            let Some(member) = spring.stations().find_map(|at| self.member(at)) else { continue };
            let group = groups.of(member);
            group.natural_length = larger(group.natural_length, natural_length(spring));
            group.points.extend(spring.anchors().iter().filter_map(|anchor| match anchor {
                Anchor::Ground(at) => Some(*at),
                Anchor::Station(_) => None,
            }));
        }
        groups.all.iter().map(Group::extent).fold(0.0, larger)
    }

    /// Length scale of a scene [length]: its longest beam, or its [extent](Self::extent) if it has no beams.
    /// Isolated particles without size have no length scale (`None`).
    pub fn size(&self) -> Option<f64> {
        let extent = || Some(self.extent()).filter(|extent| *extent > 0.0 && extent.is_finite());
        self.longest_beam().or_else(extent)
    }

    /// Rounding error of strain energies [energy].
    /// For a scene with beams, the rounding error is the machine precision times the sum of `EA L + EI/L` over the beams.
    /// `L` is the length of a beam, `EA` its axial stiffness and `EI` its bending stiffness.
    /// For a scene without beams, the rounding error is the work of the initial forces on the rounding errors of positions.
    pub(crate) fn rounding_energy(&self) -> f64 {
        if self.beams.is_empty() {
            return f64::EPSILON * self.rounded_work();
        }
        let stiffness = self.beams.iter().map(|beam| {
            let length = beam.axis.length();
            let section = beam.section.largest();
            section.axial_stiffness * length + section.bending_stiffness / length
        });
        f64::EPSILON * stiffness.sum::<f64>()
    }

    fn rounded_work(&self) -> f64 {
        let extent = self.extent();
        let reach = |at: &Station| extent + self.drawn_at(at).map_or(0.0, |place| place.norm());
        let weights =
            self.masses().map(|mass| mass.mass * self.gravity.norm() * reach(&mass.station));
        let loads = self.loads().map(|load| match &load.kind {
            LoadKind::Force { station, force, .. } => force.norm() * reach(station),
            LoadKind::Moment { moment, .. } => moment.abs(),
            LoadKind::Line { .. } => 0.0,
        });
        let springs = self.springs().filter_map(|spring| Some(self.held_by(spring)? * extent));
        weights.chain(loads).chain(springs).sum()
    }

    fn held_by(&self, spring: &Spring) -> Option<f64> {
        let SpringKind::Length(anchors) = &spring.kind else { return None };
        let places = anchors.iter().map(|anchor| match anchor {
            Anchor::Ground(at) => Ok(*at),
            Anchor::Station(station) => self.drawn_at(station),
        });
        let places: Vec<Vec2> = places.collect::<Result<_, _>>().ok()?;
        let length: f64 = places.windows(2).map(|pair| (pair[1] - pair[0]).norm()).sum();
        let drawn = if spring.origin == Origin::Zero { length } else { 0.0 };
        Some(spring.law.as_ref()?.force(drawn).abs())
    }

    fn groups(&self) -> Groups {
        let mut groups = Groups::new(self.particles.len() + self.rigid_bodies.len());
        for joint in &self.joints {
            if let Partner::Station(other) = &joint.partner {
                groups.join([&joint.station, other].into_iter().filter_map(|at| self.member(at)));
            }
        }
        for spring in self.springs() {
            groups.join(spring.stations().filter_map(|at| self.member(at)));
        }
        groups
    }

    /// Index of the body of a station among particles and rigid bodies; `None` for a station of a beam.
    fn member(&self, station: &Station) -> Option<usize> {
        match station.body {
            BodyIndex::Beam(_) => None,
            BodyIndex::Particle(index) => Some(index),
            BodyIndex::Rigid(index, _) => Some(self.particles.len() + index),
        }
    }
}

/// Natural length of a spring [length]; zero for angles and for laws without a natural length.
fn natural_length(spring: &Spring) -> f64 {
    match (&spring.kind, &spring.law) {
        (SpringKind::Torsion(_) | SpringKind::Brake { .. }, _) | (_, None) => 0.0,
        (_, Some(SpringLaw::Linear { natural, .. })) => natural.abs(),
        (_, Some(law)) => {
            let corners = law.sharp_corners().into_iter();
            corners
                .filter(|at| law.is_unloaded_at(*at))
                .fold(0.0, |most, at| larger(most, at.abs()))
        }
    }
}

struct Groups {
    ties: Ties,
    all: Vec<Group>,
}

impl Groups {
    fn new(count: usize) -> Self {
        let all = (0..count).map(|_| Group::default()).collect();
        Self { ties: Ties::new(count), all }
    }

    fn join(&mut self, mut members: impl Iterator<Item = usize>) {
        let Some(first) = members.next() else { return };
        for member in members {
            self.ties.unite(first, member);
        }
    }

    fn of(&mut self, member: usize) -> &mut Group {
        &mut self.all[self.ties.root(member)]
    }
}
