//! Springs in equilibria and vibration modes, compared with closed forms.
#![allow(clippy::unwrap_used)]

use crate::common::at;
use crate::common::scenes::{self, spring};
use withy::beams::{Mesh, Section};
use withy::integrators::Mechanism;
use withy::joints::{JointKind, Partner};
use withy::loads::{LoadFrame, LoadKind, Schedule};
use withy::statics::{Equilibrium, Loading};
use withy::system::{Anchor, ParticleDefinition, Scene, SpringKind, SpringLaw, System};
use withy::vibration::{Mode, Modes};

fn linear(stiffness: f64, natural: f64) -> Option<SpringLaw> {
    Some(SpringLaw::Linear { stiffness, natural })
}

/// Slender cantilever of length 2 along x.
fn cantilever() -> (Scene, withy::beams::Station) {
    let mut scene = Scene::new("cantilever");
    let section = Section {
        axial_stiffness: 1e7,
        shear_stiffness: 1e9,
        bending_stiffness: 5.0,
        mass_per_length: 1.0,
        rotary_inertia: 1e-9,
    };
    let mesh = Mesh::bspline(12, 5, 4).unwrap();
    let beam =
        scenes::add_beam(&mut scene, scenes::line(at(0.0, 0.0), at(2.0, 0.0)), &mesh, section);
    let foot = scene.station(beam, 0.0).unwrap();
    scene.join(JointKind::Rigid, foot, Partner::Ground).unwrap();
    let tip = scenes::end_of(&mut scene, beam);
    (scene, tip)
}

fn rest(scene: Scene) -> Equilibrium {
    Equilibrium::find(scene, Loading { steps: 4, ..Loading::default() }, &mut |_| true).unwrap()
}

#[test]
fn a_spring_below_the_tip_shares_its_load() {
    for stiffness in [1e-3, 1.0, 1e6] {
        let (mut scene, tip) = cantilever();
        // A spring that is long compared with the deflection keeps its direction. It is initially unstrained.
        let below = Anchor::Ground(at(2.0, -1.0));
        let way = SpringKind::Length(vec![below, Anchor::Station(tip)]);
        spring(&mut scene, way, linear(stiffness, 1.0), 0.0);
        let always = Schedule::constant(1.0).unwrap();
        let down = 1e-4 * (3.0 * 5.0 / 8.0 + stiffness);
        let force = LoadKind::Force { station: tip, force: at(0.0, -down), frame: LoadFrame::Dead };
        scene.add_load(force, always);
        let rest = rest(scene);
        let deflection = rest.model().control_points().next().unwrap().last().unwrap().y;
        let error = (deflection / -1e-4 - 1.0).abs();
        assert!(error < 1e-6, "{stiffness}: {deflection:e}");
        assert!(rest.model().springs().next().unwrap().force <= 0.0);
    }
}

#[test]
fn a_torsion_spring_turns_the_tip_back() {
    let (mut scene, tip) = cantilever();
    let kind = SpringKind::Torsion([Anchor::Ground(at(0.0, 0.0)), Anchor::Station(tip)]);
    spring(&mut scene, kind, linear(4.0, 0.0), 0.0);
    scene
        .add_load(LoadKind::Moment { station: tip, moment: 0.3 }, Schedule::constant(1.0).unwrap());
    // Pure bending by the moment that the spring does not carry: θ = M L/EI, for any rotation.
    let angle = rest(scene).model().springs().next().unwrap().elongation;
    assert!((angle - 0.3 / (5.0 / 2.0 + 4.0)).abs() < 1e-9, "{angle}");
}

#[test]
fn hanging_mass_on_a_spring_has_its_equilibrium_independent_of_dampers() {
    let mut scene = Scene::new("scales");
    let pan = ParticleDefinition { name: "pan".to_owned(), position: at(0.0, -1.0) };
    let pan = Anchor::Station(scene.add_particle(pan, 3.0).unwrap());
    let from = |x: f64| SpringKind::Length(vec![Anchor::Ground(at(x, 0.0)), pan]);
    // The initial tension of the spring stabilises the lateral motion.
    spring(&mut scene, from(0.0), linear(50.0, 0.9), 7.0);
    scene.gravity = at(0.0, -9.81);
    let rest = rest(scene);
    let place = rest.model().control_points().next().unwrap()[0];
    assert!((place - at(0.0, -0.9 - 3.0 * 9.81 / 50.0)).norm() < 1e-9, "{place}");
    assert_eq!(rest.model().springs().next().unwrap().dissipated, 0.0);
}

fn frequencies(model: &System) -> Vec<f64> {
    let modes = Modes::of(model, model.unknowns(), &mut || true).unwrap();
    modes.all().iter().map(Mode::angular_frequency).collect()
}

#[test]
fn mass_between_tensioned_springs_has_exact_frequencies() {
    // Two springs of stiffness 40 along x, stretched from 0.5 to 1. Both act along x, and their tension acts across x with 2 F/ℓ.
    let mut scene = Scene::new("between");
    let bead = ParticleDefinition { name: "bead".to_owned(), position: at(0.0, 0.0) };
    let bead = Anchor::Station(scene.add_particle(bead, 2.0).unwrap());
    for x in [-1.0, 1.0] {
        let way = SpringKind::Length(vec![Anchor::Ground(at(x, 0.0)), bead]);
        spring(&mut scene, way, linear(40.0, 0.5), 0.0);
    }
    let found = frequencies(&System::assemble(&scene).unwrap());
    let expected = [(2.0 * 20.0 / 2.0_f64).sqrt(), (2.0 * 40.0 / 2.0_f64).sqrt()];
    for (found, expected) in found.iter().zip(expected) {
        assert!((found / expected - 1.0).abs() < 1e-12, "{found} {expected}");
    }
}

#[test]
fn beam_with_a_tip_spring_has_the_exact_lowest_frequency() {
    // cos β cosh β + 1 + κ (sin β cosh β - cos β sinh β)/β³ = 0, κ = k L³/EI (Blevins 1979, spring at the tip).
    for stiffness in [0.1, 10.0, 1e7] {
        let (mut scene, tip) = cantilever();
        let way = SpringKind::Length(vec![Anchor::Ground(at(2.0, -1e4)), Anchor::Station(tip)]);
        spring(&mut scene, way, linear(stiffness, 1e4), 0.0);
        let kappa = stiffness * 8.0 / 5.0;
        let equation = |b: f64| {
            b.powi(3) * (b.cos() * b.cosh() + 1.0)
                + kappa * (b.sin() * b.cosh() - b.cos() * b.sinh())
        };
        let (mut low, mut high) = (1.0, 3.9266);
        for _ in 0..80 {
            let middle = 0.5 * (low + high);
            if equation(low) * equation(middle) > 0.0 { low = middle } else { high = middle }
        }
        let expected = low * low / 4.0 * 5.0_f64.sqrt();
        let found = frequencies(&System::assemble(&scene).unwrap())[0];
        assert!((found / expected - 1.0).abs() < 2e-6, "{stiffness}: {found} {expected}");
    }
}
