//! Optional parts of a scene, such as masses and springs, whose cost per step is measured. Their effect on the motion is small.

use crate::beams::Station;
use crate::elementary::square;
use crate::geometry::Vec2;
use crate::joints::{EndAction, JointKind, Partner, Slider, StartVelocities};
use crate::loads::{LoadFrame, LoadKind, Schedule};
use crate::system::{ParticleDefinition, PointMass, Scene, SystemError};

/// Magnitude of an added mass, stiffness or force, as a fraction of the corresponding property of the first beam.
const SMALL: f64 = 1e-3;

/// Optional part of a scene whose cost is measured.
#[derive(Debug, Clone, Copy)]
pub struct Feature {
    /// Name of the feature.
    pub name: &'static str,
    /// Function that adds the part to a scene, mostly to its first beam.
    pub add: fn(&mut Scene) -> Result<(), SystemError>,
}

/// All optional parts; they can be combined.
pub const FEATURES: &[Feature] = &[
    Feature {
        name: "gravity",
        add: |scene| {
            scene.gravity += Vec2::new(0.0, -small_force(scene) / beam_mass(scene));
            Ok(())
        },
    },
    Feature { name: "force", add: |scene| force_at_end(scene, LoadFrame::Dead) },
    Feature { name: "follower force", add: |scene| force_at_end(scene, LoadFrame::Follower) },
    Feature { name: "line load", add: |scene| line_load(scene, LoadFrame::Dead) },
    Feature { name: "follower line load", add: |scene| line_load(scene, LoadFrame::Follower) },
    Feature {
        name: "point mass",
        add: |scene| {
            let (station, mass) = (end(scene)?, SMALL * beam_mass(scene));
            scene.add_mass(PointMass { station, mass, rotary_inertia: 0.0 })
        },
    },
    Feature {
        name: "hinge",
        add: |scene| {
            let start = scene.station(0, 0.0)?;
            scene.join(JointKind::Hinge, start, Partner::Ground)
        },
    },
    Feature { name: "slider", add: bead },
];

fn length(scene: &Scene) -> f64 {
    scene.beams[0].axis.length()
}

fn beam_mass(scene: &Scene) -> f64 {
    scene.beams[0].mass()
}

fn small_force(scene: &Scene) -> f64 {
    SMALL * scene.beams[0].section.mean().bending_stiffness / square(length(scene))
}

fn end(scene: &mut Scene) -> Result<Station, SystemError> {
    let length = length(scene);
    scene.station(0, length)
}

fn force_at_end(scene: &mut Scene, frame: LoadFrame) -> Result<(), SystemError> {
    let (station, size) = (end(scene)?, small_force(scene));
    let kind = LoadKind::Force { station, force: Vec2::new(0.0, size), frame };
    scene.add_load(kind, Schedule::Constant(1.0));
    Ok(())
}

fn line_load(scene: &mut Scene, frame: LoadFrame) -> Result<(), SystemError> {
    let size = small_force(scene) / length(scene);
    let kind = LoadKind::Line { beam: 0, force: Vec2::new(0.0, size), frame };
    scene.add_load(kind, Schedule::Constant(1.0));
    Ok(())
}

/// Adds a small sliding point mass, off the middle of the beam, because in the middle of a spinning beam it would not move.
fn bead(scene: &mut Scene) -> Result<(), SystemError> {
    let arc_length = 0.4 * length(scene);
    let place = scene.station(0, arc_length)?;
    let position = scene.drawn_at(&place)?;
    let name = scene.free_name("bead");
    let slave =
        scene.add_particle(ParticleDefinition { name, position }, SMALL * beam_mass(scene))?;
    let slider = Slider::new(scene.free_name("slider"), slave, 0, arc_length);
    let (ends, velocities) = (EndAction::Release, StartVelocities::Project);
    scene.add_slider(Slider { ends, velocities, ..slider }).map(|_| ())
}

#[cfg(test)]
mod tests {
    use super::super::samples::spinning;
    use super::*;
    use crate::simulation::{NoMonitor, Simulation};

    #[test]
    fn every_feature_changes_the_energy_by_less_than_two_percent() {
        let case = spinning(0.05, &[0.5]);
        let energy = |scene: Scene| {
            let mut simulation = Simulation::start(scene, case.settings).unwrap();
            simulation.run_to(0.5, &mut NoMonitor).unwrap();
            simulation.history().column("kinetic").unwrap().pop().unwrap()
        };
        let plain = energy(case.scene.clone());
        for Feature { name, add } in FEATURES.iter().filter(|feature| feature.name != "hinge") {
            let mut scene = case.scene.clone();
            add(&mut scene).unwrap();
            let changed = energy(scene);
            assert!(changed != plain && (changed / plain - 1.0).abs() < 0.02, "{name}: {changed}");
        }
    }
}
