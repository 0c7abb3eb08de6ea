//! Lowest natural frequencies of a cantilever, compared with those of the Euler–Bernoulli beam.
use std::error::Error;

use withy_mechanics::beams::{Mesh, Section};
use withy_mechanics::geometry::{Curve, Vec2};
use withy_mechanics::integrators::Method;
use withy_mechanics::joints::{JointKind, Partner};
use withy_mechanics::simulation::{Simulation, SimulationSettings};
use withy_mechanics::system::{BeamDefinition, Scene};
use withy_mechanics::vibration::Modes;

fn main() -> Result<(), Box<dyn Error>> {
    let section = Section {
        axial_stiffness: 1e8,
        shear_stiffness: 1e8,
        bending_stiffness: 100.0,
        mass_per_length: 1.0,
        rotary_inertia: 1e-6,
    };
    let mut scene = Scene::new("cantilever");
    let axis = Curve::line(Vec2::zeros(), Vec2::new(10.0, 0.0))?;
    let mesh = Mesh::bspline(32, 3, 2)?;
    let rod = scene.add_beam(BeamDefinition::new("rod", axis, mesh, section))?;
    let start = scene.station(rod, 0.0)?;
    scene.join(JointKind::Rigid, start, Partner::Ground)?;

    let settings = SimulationSettings::new(Method::EnergyMomentum, 0.1);
    let simulation = Simulation::start(scene, settings)?;
    let modes = Modes::of(simulation.model(), 3, &mut || true)?;
    for (mode, root) in modes.all().iter().zip([1.875_104_07, 4.694_091_13, 7.854_757_44_f64]) {
        let closed_form = root * root * (100.0_f64 / 1e4).sqrt();
        println!("{:.6} rad per time, closed form {closed_form:.6}", mode.angular_frequency());
    }
    Ok(())
}
