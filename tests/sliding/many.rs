//! Many sliders: the elimination of contacts within the band gives the same solution as the border, and all invariants hold as with few sliders.
#![allow(clippy::unwrap_used)]

use crate::common::{Random, meshes, simulate, sliding_scenes};
use withy::integrators::{Constraints, Forces, Inertia, Interval, Mechanism, Method, Stage};
use withy::joints::{Releasable, Release, SLIDING_RULES, Trigger};
use withy::linalg::BorderedMatrix;
use withy::newton::Tolerance;
use withy::simulation::Invariant;
use withy::system::{MasterEnd, MasterLimit, Scene, System};

const DT: f64 = 0.01;

fn moved(scene: &Scene) -> System {
    let mut model = System::assemble(scene).unwrap();
    let mut integrator = Method::EnergyMomentum.build(&mut model, Tolerance::default());
    for step in 0..5 {
        let interval = Interval::between(step as f64 * DT, (step + 1) as f64 * DT);
        integrator.step(&mut model, interval).unwrap();
    }
    model
}

/// Solution of a linear system with the tangent of the next step for a right-hand side.
fn solution(model: &mut System, mut tangent: BorderedMatrix, right: &[f64]) -> Vec<f64> {
    let (movements, width) = (model.unknowns(), model.constraint_shape().width);
    let interval = Interval::between(model.time(), model.time() + DT);
    model.begin_step(interval, &[Stage::Midpoint]).unwrap();
    let increments: Vec<f64> = model.rates().iter().map(|rate| DT * rate).collect();
    let mut contacts = vec![0.0; width];
    model.predict_constraints(interval, &mut contacts);
    let mut out = vec![0.0; model.degrees_of_freedom()];
    let band = tangent.band_mut();
    model.add_inertia_tangent(2.0 / (DT * DT), band);
    model.add_linearised_forces(Stage::Midpoint, &increments, 1.0, &mut out, band);
    let border = tangent.border_mut();
    model.add_linearised_constraints(&increments, &contacts, &mut out, border);
    let mut x = right[..movements + width].to_vec();
    tangent.factorise().unwrap().solve(&mut x);
    x
}

#[test]
fn solution_equals_that_of_a_bordered_system() {
    let mut random = Random(3);
    for entry in SLIDING_RULES.iter().filter(|entry| entry.claims.gap) {
        for (mesh_name, mesh) in meshes(4) {
            let scene = sliding_scenes::crowd(&mesh, entry.rule);
            for state in ["sliding", "held", "released"] {
                let mut model = moved(&scene);
                for slider in 0..scene.sliders.len() {
                    match state {
                        "held" => model.hold_at_stop(MasterLimit { slider, end: MasterEnd::Start }),
                        "released" => model.release_slider(slider),
                        _ => {}
                    }
                }
                let (size, reach) = (model.unknowns(), model.half_bandwidth());
                let blocks = model.constraint_blocks().unwrap().clone();
                let free = blocks.own.iter().filter(|own| !own.is_empty()).count();
                assert_eq!((blocks.own.len(), free), (8, 4));
                let shape = model.constraint_shape();
                let right = random.vector(size + shape.width, 1.0);
                let border = BorderedMatrix::zeros(size, reach, shape);
                let border = solution(&mut model, border, &right);
                let blocks = BorderedMatrix::with_blocks(size, reach, blocks);
                let blocks = solution(&mut model, blocks, &right);
                let largest = border.iter().fold(0.0_f64, |most, x| most.max(x.abs()));
                for (at, (x, y)) in border.iter().zip(&blocks).enumerate() {
                    let label = format!("{}, {mesh_name}, {state}, {at}", entry.name);
                    assert!((x - y).abs() <= 1e-8 * largest, "{label}: {x} {y} of {largest}");
                }
            }
        }
    }
}

#[test]
fn few_sliders_use_a_bordered_system() {
    let mesh = withy::beams::Mesh::bspline(4, 3, 2).unwrap();
    let scene = sliding_scenes::abacus(&mesh, withy::joints::SlidingRule::Kinked);
    assert!(System::assemble(&scene).unwrap().constraint_blocks().is_none());
}

#[test]
fn dozens_of_beads_eyelets_and_rings_conserve_all_invariants() {
    // An eyelet of the last scene is released from the ground, and then moves as a bead.
    let mut loose = sliding_scenes::eyelets(20, 6);
    let (hold, trigger) = (Releasable::Joint(2), Trigger::Time(0.05));
    loose.add_release(Release { object: hold, trigger }).unwrap();
    let scenes = [
        sliding_scenes::necklace(20, 60),
        sliding_scenes::eyelets(30, 20),
        sliding_scenes::chain(24),
        loose,
    ];
    for scene in scenes {
        let name = scene.name.clone();
        for method in [Method::EnergyMomentum, Method::FourthOrder] {
            let flight = simulate(scene.clone(), method, 0.005, 0.1);
            let history = flight.history();
            let kept = Invariant::ALL.map(|(_, invariant)| history.drift(invariant));
            println!("{name}, {method:?}: {kept:?}");
            assert!(kept.iter().all(|drift| *drift < 1e-11), "{name}, {method:?}: {kept:?}");
            let work = flight.counts();
            assert_eq!(work.retries, 0, "{name}, {method:?}");
            // The number of iterations is the same as with few sliders.
            let most = 4 * if method == Method::FourthOrder { 7 } else { 1 };
            assert!(work.newton_iterations <= most * work.steps, "{name}, {method:?}: {work:?}");
        }
    }
}
