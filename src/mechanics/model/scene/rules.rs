//! Which law of sliding fits a scene, where the description of a slider names none.

use super::Scene;
use super::definitions::{BeamDefinition, RigidBodyDefinition};
use crate::beams::{BodyIndex, SectionVariation};
use crate::elementary::square;
use crate::geometry::{Vec2, larger};
use crate::joints::{Slider, SlidingRule};
use crate::loads::LoadKind;

/// The largest angle by which all that presses in a scene as drawn may kink a master at one place, for the law that follows kinks to be the one that
/// fits: for larger ones a kink is no small one, and one scene in fifty has steps without a solution [rad].
const LARGEST_KINK: f64 = 0.15;

impl Scene {
    /// The laws of all sliders: those that their descriptions name. Of the others [`SlidingRule::Kinked`], where a slave slides on one beam that is
    /// smooth, and neither all weights, loads and springs together nor the energy of motion, spent over the length of the beam, would kink it by
    /// more than 0.15 rad; else [`SlidingRule::Conserving`].
    pub fn sliding_rules(&self) -> Vec<SlidingRule> {
        let is_named = self.sliders.iter().all(|slider| slider.rule.is_some());
        let (force, energy) =
            if is_named { (0.0, 0.0) } else { (self.pressing(), self.energy_of_motion()) };
        let fitting = |slider: &Slider| {
            let beam = &self.beams[slider.master];
            let shear = least_shear_stiffness(&beam.section);
            let kink = larger(force, energy / beam.axis.length()) / shear;
            let is_small = kink <= LARGEST_KINK && is_smooth(beam);
            let kinks = is_small && slider.track.is_none() && !self.slides_elsewhere(slider);
            if kinks { SlidingRule::Kinked } else { SlidingRule::Conserving }
        };
        self.sliders.iter().map(|slider| slider.rule.unwrap_or_else(|| fitting(slider))).collect()
    }

    /// Whether the slave of a slider slides on another beam, too, as a ring does that holds two.
    fn slides_elsewhere(&self, slider: &Slider) -> bool {
        let others = self.sliders.iter().filter(|other| other.slave == slider.slave);
        others.count() > 1
    }

    /// All weights, loads while their schedules are 1, and what springs hold as drawn [force].
    fn pressing(&self) -> f64 {
        let weights = self.mass() * self.gravity.norm();
        let loads = self.loads().map(|load| match &load.kind {
            LoadKind::Force { force, .. } => force.norm(),
            LoadKind::Moment { .. } => 0.0,
            LoadKind::Line { beam, force, .. } => force.norm() * self.beams[*beam].axis.length(),
        });
        let springs = self.springs().filter_map(|spring| self.held_by(spring));
        weights + loads.chain(springs).sum::<f64>()
    }

    /// The kinetic energy at the start, at most: everything as fast as its fastest place [energy].
    fn energy_of_motion(&self) -> f64 {
        let beams = self.beams.iter().map(|beam| (beam.mass(), fastest_of_beam(beam)));
        let masses = self.masses().map(|mass| {
            let velocities = self.velocities.iter();
            let own = velocities.filter(|velocity| velocity.station.body == mass.station.body);
            let given = own.map(|velocity| velocity.velocity.norm()).fold(0.0, larger);
            let carried = match mass.station.body {
                BodyIndex::Beam(beam) => fastest_of_beam(&self.beams[beam]),
                BodyIndex::Rigid(body, _) => fastest_of_body(&self.rigid_bodies[body]),
                BodyIndex::Particle(_) => 0.0,
            };
            (mass.mass, larger(given, carried))
        });
        beams.chain(masses).map(|(mass, speed)| 0.5 * mass * square(speed)).sum()
    }
}

/// Whether the axis of a beam has no place at which its functions may kink by themselves.
fn is_smooth(beam: &BeamDefinition) -> bool {
    let basis = beam.mesh.basis();
    basis.breaks().len() == 2 || basis.continuity() > 0
}

fn least_shear_stiffness(section: &SectionVariation) -> f64 {
    let all = section.sections().into_iter().map(|section| section.shear_stiffness);
    all.fold(f64::INFINITY, f64::min)
}

/// `|v| + |ω| r`, with the way `r` from the place about which it turns that no place of the beam is farther off than [length/time].
fn fastest_of_beam(beam: &BeamDefinition) -> f64 {
    let motion = &beam.motion;
    let (start, length) = (beam.axis.point(beam.axis.domain().0), beam.axis.length());
    let reach = match (motion.about, start) {
        (Some(about), Ok(start)) => (start - about).norm() + length,
        _ => length,
    };
    motion.velocity.norm() + motion.spin.abs() * reach
}

fn fastest_of_body(body: &RigidBodyDefinition) -> f64 {
    let motion = &body.motion;
    let reach = motion.about.map_or(0.0, |about: Vec2| (body.position - about).norm());
    motion.velocity.norm() + motion.spin.abs() * (reach + body.size())
}
