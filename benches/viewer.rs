//! Time to write the page of a viewer, and its size, for rotating rods with several numbers of beams and frames.
//!
//! `cargo bench --bench viewer`

use std::time::Instant;

use withy::beams::{Mesh, Section};
use withy::geometry::{Curve, Vec2};
use withy::integrators::Method;
use withy::newton::Tolerance;
use withy::output::viewer::Viewer;
use withy::script::presentation::viewer_data::{FieldReader, ViewerOptions, film};
use withy::simulation::{NoMonitor, Simulation, SimulationSettings};
use withy::system::{BeamDefinition, Scene, StartMotion};

/// Numbers of beams and frames.
const SIZES: [(usize, usize); 4] = [(1, 200), (1, 1000), (10, 1000), (50, 1000)];

/// Simulation of rotating flexible rods with eight cubic spans each and different angular velocities, after a number of steps.
fn turning(beams: usize, steps: usize) -> Simulation {
    let mut scene = Scene::new("rods");
    let section = Section {
        axial_stiffness: 1e4,
        shear_stiffness: 1e4,
        bending_stiffness: 100.0,
        mass_per_length: 1.0,
        rotary_inertia: 10.0,
    };
    for row in 0..beams {
        let from = Vec2::new(0.0, row as f64);
        let beam = BeamDefinition {
            name: format!("rod {row}"),
            axis: Curve::line(from, from + Vec2::new(10.0, 0.0)).expect("a line"),
            mesh: Mesh::bspline(8, 3, 2).expect("a mesh"),
            section: section.into(),
            motion: StartMotion { spin: 0.1 * (row + 1) as f64, ..StartMotion::default() },
        };
        scene.add_beam(beam).expect("a beam");
    }
    let settings = SimulationSettings {
        method: Method::EnergyMomentum,
        dt: 0.01.into(),
        tolerance: Tolerance::default(),
    };
    let mut simulation = Simulation::start(scene, settings).expect("a scene");
    let end = 0.01 * (steps - 1) as f64;
    simulation.run_to(end, &mut NoMonitor).expect("steps");
    simulation
}

fn main() {
    println!("| beams | frames | page | film | page made |\n| --- | --- | --- | --- | --- |");
    let columns = ["kinetic", "strain", "potential", "energy", "work"].map(str::to_owned);
    for (beams, frames) in SIZES {
        let simulation = turning(beams, frames);
        let fields = ["speed", "M", "strain_energy", "stretch", "curvature"];
        let begun = Instant::now();
        let shown = simulation.frames_between(0.0, f64::INFINITY, frames);
        // The time to restore states is not measured, so all frames use the last state.
        let mut inside = FieldReader::of(&simulation, shown.len(), &fields).expect("places");
        if let Some(inside) = &mut inside {
            (0..shown.len()).for_each(|frame| inside.store_frame(frame, &simulation));
        }
        let wishes = ViewerOptions {
            span: (0.0, f64::INFINITY),
            frames: shown,
            label: "rods".into(),
            trails: None,
            columns: &columns,
            fields: &fields,
            inside: inside.map(FieldReader::fields).unwrap_or_default(),
        };
        let films = vec![film(&simulation, wishes).expect("a film")];
        let filmed = begun.elapsed();
        let page = Viewer { title: "rods".into(), films }.to_html().expect("a page");
        let made = begun.elapsed() - filmed;
        println!(
            "| {beams} | {frames} | {} kB | {:.3} s | {:.3} s |",
            page.len() / 1000,
            filmed.as_secs_f64(),
            made.as_secs_f64()
        );
    }
}
