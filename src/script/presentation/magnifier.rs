//! Magnified deformations in pictures of motion.

use super::travel::{Travel, joint_ends};
use crate::beams::Station;
use crate::geometry::{Vec2, cross, perpendicular};
use crate::joints::Partner;
use crate::simulation::{DrawnConfiguration, Simulation};
use crate::system::SystemError;

/// Magnification of the deformations relative to the initial configuration.
///
/// Rigid motions of bodies that joints do not hold in place are not magnified.
pub struct Magnifier<'a> {
    simulation: &'a Simulation,
    factor: f64,
    travel: Travel,
    start: DrawnConfiguration,
    joints: Vec<Vec<Station>>,
}

#[derive(Clone, Copy, Default)]
struct RigidMotion {
    from: Vec2,
    to: Vec2,
    /// Rotation (cosine, sine), times the ratio of present to initial joint distances if the body has several joints.
    turn: Option<Vec2>,
    /// Displacement by which the body stays attached to magnified bodies at its joints and sliders.
    shift: Vec2,
}

/// Rigid motions of all bodies at a time, used to magnify positions.
pub struct MagnifiedBodies {
    factor: f64,
    motions: Vec<RigidMotion>,
}

impl MagnifiedBodies {
    /// Magnified position of a point of a body [length]. `start` is the initial position of the point, and `now` its present position.
    pub fn magnified_position(&self, body: usize, start: Vec2, now: Vec2) -> Vec2 {
        let RigidMotion { from, to, turn, shift } = self.motions[body];
        let arm = start - from;
        let turned_arm = turn.map_or(arm, |turn| arm * turn.x + perpendicular(arm) * turn.y);
        let undeformed = to + turned_arm;
        undeformed + (now - undeformed) * self.factor + shift
    }

    fn magnified_positions(&self, body: usize, start: &[Vec2], now: &[Vec2]) -> Vec<Vec2> {
        start
            .iter()
            .zip(now)
            .map(|(start, now)| self.magnified_position(body, *start, *now))
            .collect()
    }
}

impl<'a> Magnifier<'a> {
    /// Magnifier of a simulation; `None` if nothing is recorded.
    ///
    /// # Errors
    /// Fails if the axis of a beam has a point without a tangent.
    pub fn new(simulation: &'a Simulation, factor: f64) -> Result<Option<Self>, SystemError> {
        let Some(start) = simulation.configuration_near(0.0)? else { return Ok(None) };
        let scene = simulation.scene();
        let count = scene.first_rigid_body() + scene.rigid_bodies.len();
        let mut joints = vec![Vec::new(); count];
        joint_ends(scene)
            .for_each(|(station, ..)| joints[scene.index_of_body(&station)].push(station));
        Ok(Some(Self { simulation, factor, travel: Travel::of(scene), start, joints }))
    }

    /// Returns true for a body whose rigid motion is not magnified.
    pub fn travels(&self, body: usize) -> bool {
        !self.travel.is_held(body)
    }

    pub fn configuration(
        &self,
        now: &DrawnConfiguration,
    ) -> Result<DrawnConfiguration, SystemError> {
        let bodies = self.rigid_motions(now)?;
        let start = &self.start;
        let first = self.simulation.scene().beams.len();
        let lines = start.lines.iter().zip(&now.lines).enumerate();
        let outlines = self.outlined().zip(start.bodies.iter().zip(&now.bodies));
        let particles = start.particles.iter().zip(&now.particles);
        let particles = (first..).zip(particles);
        let owners = self.owners_of_marks();
        let marks = owners.zip(start.marks.iter().zip(&now.marks));
        Ok(DrawnConfiguration {
            time: now.time,
            lines: lines
                .map(|(body, (start, now))| bodies.magnified_positions(body, start, now))
                .collect(),
            bodies: outlines
                .map(|(body, (start, now))| bodies.magnified_positions(body, start, now))
                .collect(),
            marks: marks
                .map(|(body, (start, now))| bodies.magnified_position(body, *start, *now))
                .collect(),
            particles: particles
                .map(|(body, (start, now))| bodies.magnified_position(body, *start, *now))
                .collect(),
        })
    }

    pub fn rigid_motions(&self, now: &DrawnConfiguration) -> Result<MagnifiedBodies, SystemError> {
        let mut motions = Vec::new();
        for (body, joints) in self.joints.iter().enumerate() {
            let is_held = self.travel.is_held(body);
            motions.push(if is_held {
                RigidMotion::default()
            } else {
                self.motion(body, joints, now)?
            });
        }
        let mut bodies = MagnifiedBodies { factor: self.factor, motions };
        for (body, shift) in self.shifts(&bodies, now)? {
            let group = self.travel.group(body);
            for (other, motion) in bodies.motions.iter_mut().enumerate() {
                if self.travel.group(other) == group {
                    motion.shift = shift;
                }
            }
        }
        Ok(bodies)
    }

    /// Rigid motion of a body. Its translation is that of the mean position of its joints, or of all its points if there are no joints.
    /// Its rotation is computed from its joints if there are several, otherwise from all its points.
    fn motion(
        &self,
        body: usize,
        joints: &[Station],
        now: &DrawnConfiguration,
    ) -> Result<RigidMotion, SystemError> {
        let [start, end] = [0.0, now.time].map(|time| positions(self.simulation, joints, time));
        let joints = [start?, end?];
        let all = [self.points(body, &self.start), self.points(body, now)];
        let reference = if joints[0].is_empty() { &all } else { &joints };
        let [from, to] = reference.each_ref().map(|points| mean(points));
        let has_several = joints[0].len() > 1;
        let [start, now] = if has_several { joints } else { all };
        let arms = || start.iter().zip(&now).map(|(start, now)| (start - from, now - to));
        let turn: Vec2 =
            arms().map(|(start, now)| Vec2::new(start.dot(&now), cross(start, now))).sum();
        let size = match has_several {
            true => arms().map(|(start, _)| start.norm_squared()).sum(),
            false => turn.norm(),
        };
        let turn = (size > 0.0).then(|| turn / size);
        Ok(RigidMotion { from, to, turn, shift: Vec2::zeros() })
    }

    fn points(&self, body: usize, of: &DrawnConfiguration) -> Vec<Vec2> {
        let particle = body.checked_sub(self.simulation.scene().beams.len());
        let Some(particle) = particle else { return of.lines[body].clone() };
        let outline = self.outlined().position(|other| other == body);
        let outline = outline.map_or(&[][..], |index| &of.bodies[index]);
        [of.particles[particle]].iter().chain(outline).copied().collect()
    }

    fn shifts(
        &self,
        bodies: &MagnifiedBodies,
        now: &DrawnConfiguration,
    ) -> Result<Vec<(usize, Vec2)>, SystemError> {
        let scene = self.simulation.scene();
        let mut shifts = Vec::new();
        for slider in &scene.sliders {
            let body = scene.index_of_body(&slider.slave);
            if self.travel.is_held(body) || self.travels(slider.master) || slider.track.is_some() {
                continue;
            }
            let at = positions(self.simulation, &[slider.slave], now.time)?[0];
            let magnified = bodies.magnified_positions(
                slider.master,
                &self.start.lines[slider.master],
                &now.lines[slider.master],
            );
            shifts.extend(
                displacement(at, &now.lines[slider.master], &magnified).map(|by| (body, by)),
            );
        }
        for (station, partner, _) in joint_ends(scene) {
            let body = scene.index_of_body(&station);
            let Partner::Station(other) = partner else { continue };
            if self.travels(body) && !self.travels(scene.index_of_body(&other)) {
                let [start, now] =
                    [0.0, now.time].map(|time| positions(self.simulation, &[station], time));
                shifts.push((body, (now?[0] - start?[0]) * (self.factor - 1.0)));
            }
        }
        Ok(shifts)
    }

    fn outlined(&self) -> impl Iterator<Item = usize> + '_ {
        let scene = self.simulation.scene();
        let bodies = (scene.first_rigid_body()..).zip(&scene.rigid_bodies);
        bodies.filter(|(_, body)| body.links().next().is_some()).map(|(index, _)| index)
    }

    fn owners_of_marks(&self) -> impl Iterator<Item = usize> + '_ {
        let meshes = self.simulation.model().meshes().iter().enumerate();
        meshes.flat_map(|(beam, mesh)| std::iter::repeat_n(beam, mesh.basis().breaks().len()))
    }
}

/// Positions of stations at the present time, or in the recorded configuration nearest to an earlier time [length].
///
/// # Errors
/// Fails if a station lies outside its beam.
pub fn positions(
    simulation: &Simulation,
    stations: &[Station],
    time: f64,
) -> Result<Vec<Vec2>, SystemError> {
    match time >= simulation.time() && time > 0.0 {
        true => simulation.stations(stations),
        false => simulation.stations_near(stations, time),
    }
}

fn mean(points: &[Vec2]) -> Vec2 {
    points.iter().sum::<Vec2>() / points.len().max(1) as f64
}

/// Displacement between two polylines at the point of the first polyline that is nearest to `at`.
fn displacement(at: Vec2, from: &[Vec2], to: &[Vec2]) -> Option<Vec2> {
    let part = |index: usize| {
        let along = from[index + 1] - from[index];
        let part = ((at - from[index]).dot(&along) / along.norm_squared()).clamp(0.0, 1.0);
        let on = |line: &[Vec2]| line[index] + (line[index + 1] - line[index]) * part;
        ((at - on(from)).norm(), on(to) - on(from))
    };
    let parts = (0..from.len().saturating_sub(1)).map(part).filter(|(apart, _)| !apart.is_nan());
    parts.min_by(|a, b| a.0.total_cmp(&b.0)).map(|(_, displacement)| displacement)
}
