//! A cantilever rolled into a circle by an end moment `2π EI/L`, in eight load steps.
use std::error::Error;
use std::f64::consts::TAU;

use withy_mechanics::beams::{Mesh, Section};
use withy_mechanics::geometry::{Curve, Vec2};
use withy_mechanics::joints::{JointKind, Partner};
use withy_mechanics::loads::{LoadKind, Schedule};
use withy_mechanics::statics::{Equilibrium, Loading};
use withy_mechanics::system::{BeamDefinition, Scene};

fn main() -> Result<(), Box<dyn Error>> {
    let section = Section {
        axial_stiffness: 1e8,
        shear_stiffness: 1e8,
        bending_stiffness: 100.0,
        mass_per_length: 1.0,
        rotary_inertia: 1.0,
    };
    let mut scene = Scene::new("circle");
    let axis = Curve::line(Vec2::zeros(), Vec2::new(10.0, 0.0))?;
    let mesh = Mesh::bspline(16, 3, 2)?;
    let rod = scene.add_beam(BeamDefinition::new("rod", axis, mesh, section))?;
    let (start, end) = (scene.station(rod, 0.0)?, scene.station(rod, 10.0)?);
    scene.join(JointKind::Rigid, start, Partner::Ground)?;
    let moment = TAU * section.bending_stiffness / 10.0;
    scene.add_load(LoadKind::Moment { station: end, moment }, Schedule::constant(1.0)?);

    let loading = Loading { steps: 8, ..Loading::default() };
    let rest = Equilibrium::find(scene, loading, &mut |_| true)?;
    let place = rest.scene().place(&end, rest.model().meshes())?;
    println!("distance of the ends: {:.1e}", rest.model().position(&place).norm());
    Ok(())
}
