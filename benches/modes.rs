//! Time of the search for ten modes of a beam with 100 000 unknowns, in units of the time of one factorisation of its static stiffness matrix.
//! The processor time of this process is measured, which requires Linux (`cargo bench --bench modes`).
#![allow(clippy::unwrap_used)]

use withy::beams::{Mesh, Section};
use withy::geometry::{Curve, Vec2};
use withy::integrators::Mechanism;
use withy::joints::{JointKind, Partner};
use withy::linalg::{BorderShape, BorderedMatrix};
use withy::system::{BeamDefinition, Scene, StartMotion, System};
use withy::vibration::Modes;

const FACTORISATIONS: usize = 30;
const SEARCHES: usize = 5;

/// Processor time of this process [s].
fn processor_time() -> f64 {
    let told = std::fs::read_to_string("/proc/self/schedstat").unwrap_or_default();
    told.split(' ').next().and_then(|n| n.parse::<f64>().ok()).unwrap_or(0.0) * 1e-9
}

fn main() {
    for (spans, free, ratio) in
        [(33_333, false, 1e6), (33_333, true, 1e6), (33_333, false, 1e10), (33_333, true, 1e4)]
    {
        let mut scene = Scene::new("large");
        let axis = Curve::line(Vec2::zeros(), Vec2::new(10.0, 0.0)).unwrap();
        let mesh = Mesh::bspline(spans, 3, 2).unwrap();
        let section = Section {
            axial_stiffness: ratio,
            shear_stiffness: ratio / 3.0,
            bending_stiffness: 100.0,
            mass_per_length: 1.0,
            rotary_inertia: 100.0 / ratio,
        };
        let (name, motion) = ("rod".to_owned(), StartMotion::default());
        let beam = scene
            .add_beam(BeamDefinition { name, axis, mesh, section: section.into(), motion })
            .unwrap();
        if !free {
            let start = scene.station(beam, 0.0).unwrap();
            scene.join(JointKind::Rigid, start, Partner::Ground).unwrap();
        }
        let mut model = System::assemble(&scene).unwrap();
        let still = vec![0.0; model.unknowns()];
        let mut forces = vec![0.0; model.degrees_of_freedom()];
        let none = BorderShape::default();
        let mut matrix = BorderedMatrix::zeros(model.unknowns(), model.half_bandwidth(), none);
        model.add_linearised_static_forces(&still, 1.0, &mut forces, &mut matrix);
        // The clock has a resolution of milliseconds, so several factorisations are measured together.
        let mut copies = vec![matrix; FACTORISATIONS];
        let start = processor_time();
        assert!(copies.iter_mut().all(|copy| copy.factorise().is_ok()));
        let one = (processor_time() - start) / FACTORISATIONS as f64;
        drop(copies);
        let start = processor_time();
        let found: Vec<Modes> =
            (0..SEARCHES).filter_map(|_| Modes::of(&model, 10, &mut || true).ok()).collect();
        let all = (processor_time() - start) / SEARCHES as f64;
        let residuals = found.iter().flat_map(Modes::all).map(|mode| mode.residual);
        println!(
            "{} unknowns, free {free}, EA {ratio:.0e}: factorisation {:.2} ms, modes {:.0} ms, {:.1} factorisations; {} of {SEARCHES} found, residual {:.1e}",
            model.unknowns(),
            1e3 * one,
            1e3 * all,
            all / one,
            found.len(),
            residuals.fold(0.0, f64::max)
        );
    }
}
