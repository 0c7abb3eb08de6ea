//! A free beam thrown by a force and a moment at one end (Simo & Vu-Quoc 1986).
use std::error::Error;

use withy_mechanics::beams::{Mesh, Section};
use withy_mechanics::geometry::{Curve, Vec2};
use withy_mechanics::integrators::Method;
use withy_mechanics::loads::{LoadFrame, LoadKind, Schedule};
use withy_mechanics::simulation::{Invariant, NoMonitor, Simulation, SimulationSettings};
use withy_mechanics::system::{BeamDefinition, Scene};

fn main() -> Result<(), Box<dyn Error>> {
    let section = Section {
        axial_stiffness: 1e4,
        shear_stiffness: 1e4,
        bending_stiffness: 100.0,
        mass_per_length: 1.0,
        rotary_inertia: 10.0,
    };
    let mut scene = Scene::new("flying spaghetti");
    let axis = Curve::line(Vec2::new(0.0, 8.0), Vec2::new(6.0, 0.0))?;
    let mesh = Mesh::bspline(14, 3, 2)?;
    let rod = scene.add_beam(BeamDefinition::new("rod", axis, mesh, section))?;
    let end = scene.station(rod, 10.0)?;
    let force = Vec2::new(8.0, 0.0);
    let schedule = Schedule::hold_for(2.5)?;
    let kind = LoadKind::Force { station: end, force, frame: LoadFrame::Dead };
    scene.add_load(kind, schedule.clone());
    scene.add_load(LoadKind::Moment { station: end, moment: -80.0 }, schedule);
    let settings = SimulationSettings::new(Method::EnergyMomentum, 0.1);
    let mut simulation = Simulation::start(scene, settings)?;
    simulation.run_to(7.5, &mut NoMonitor)?;
    let position = simulation.scene().place(&end, simulation.model().meshes())?;
    let position = simulation.model().position(&position);
    println!("end at ({:.4}, {:.4})", position.x, position.y);
    for (name, invariant) in Invariant::ALL {
        println!("{name}: largest relative change {:.1e}", simulation.history().drift(invariant));
    }
    Ok(())
}
