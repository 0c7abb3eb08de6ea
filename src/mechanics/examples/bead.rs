//! A bead that slides down a clamped beam and leaves the beam at its end.
use std::error::Error;

use withy_mechanics::beams::{Mesh, Section};
use withy_mechanics::geometry::{Curve, Vec2};
use withy_mechanics::integrators::Method;
use withy_mechanics::joints::{EndAction, JointKind, Partner, Slider};
use withy_mechanics::simulation::{NoMonitor, Simulation, SimulationSettings};
use withy_mechanics::system::{BeamDefinition, ParticleDefinition, Scene};

fn main() -> Result<(), Box<dyn Error>> {
    let section = Section {
        axial_stiffness: 1e4,
        shear_stiffness: 4e3,
        bending_stiffness: 20.0,
        mass_per_length: 0.5,
        rotary_inertia: 1e-3,
    };
    let mut scene = Scene::new("bead");
    let axis = Curve::line(Vec2::zeros(), Vec2::new(2.0, -0.4))?;
    let mesh = Mesh::bspline(12, 3, 2)?;
    let rod = scene.add_beam(BeamDefinition::new("rod", axis, mesh, section))?;
    let start = scene.station(rod, 0.0)?;
    scene.join(JointKind::Rigid, start, Partner::Ground)?;
    scene.gravity = Vec2::new(0.0, -9.81);
    let position = Vec2::new(0.5, -0.1);
    let bead = scene.add_particle(ParticleDefinition { name: "bead".into(), position }, 1.0)?;
    let ring = Slider::new("ring", bead, rod, position.norm());
    scene.add_slider(Slider { ends: EndAction::Release, ..ring })?;

    let settings = SimulationSettings::new(Method::EnergyMomentum, 0.01);
    let mut simulation = Simulation::start(scene, settings)?;
    simulation.run_to(1.5, &mut NoMonitor)?;
    for arrival in simulation.arrivals() {
        println!("{:?} at t = {:.4}", arrival.kind, arrival.time);
    }
    Ok(())
}
