//! Energy of impacts at ends of masters: no impact adds energy, for any restitution and any transverse velocities of the masters.
#![allow(clippy::unwrap_used)]

use crate::common::scenes::{add_beam, line, spring};
use crate::common::sliding::{particle, slider};
use crate::common::{Random, at, run, settings, simulate, wild_scenes};
use withy::beams::{Mesh, Section, Station};
use withy::geometry::Vec2;
use withy::integrators::Method;
use withy::joints::{EndAction, JointKind, Partner, Slider, SlidingRule};
use withy::simulation::{Invariant, Simulation};
use withy::system::{Anchor, Scene, SpringKind, SpringLaw, StationVelocity};

const METHOD: Method = Method::EnergyMomentum;

/// Largest decrease of a lost energy, as a fraction of the largest energy: rounding of the impulses.
const ROUNDING: f64 = 1e-10;

/// Frame of a copy of a scene: rotation [rad], and reflection.
#[derive(Clone, Copy)]
struct Frame {
    rotation: f64,
    mirror: f64,
}

impl Frame {
    fn of(self, x: f64, y: f64) -> Vec2 {
        let (sine, cosine) = self.rotation.sin_cos();
        at(cosine * x - sine * self.mirror * y, sine * x + cosine * self.mirror * y)
    }
}

fn add_bead(scene: &mut Scene, frame: Frame, [place, speed, mass]: [f64; 3]) -> Station {
    let station = particle(scene, frame.of(place, 0.0), mass);
    scene.velocities.push(StationVelocity { station, velocity: frame.of(speed, 0.0), spin: None });
    let name = scene.free_name("slider");
    let slider = slider(station, 0, place, SlidingRule::Conserving);
    scene.add_slider(Slider { name, ..slider }).unwrap();
    station
}

/// Light clamped beam with a light bead that is released at the ends, a bead with restitution 0, and a heavy bead on a spring with restitution 0.5.
/// The steps are far too long for the vibrations of the beam, so the transverse velocities alternate strongly from step to step.
fn shaken_beam(frame: Frame) -> Scene {
    let mut scene = Scene::new("shaken beam");
    let section = Section {
        axial_stiffness: 141.27474476060928,
        shear_stiffness: 54.33644029254203,
        bending_stiffness: 0.017790239910723833,
        mass_per_length: 0.04673392039342869,
        rotary_inertia: 4.673392039342869e-05,
    };
    let axis = line(Vec2::zeros(), frame.of(1.40998070468603, 0.0));
    let rod = add_beam(&mut scene, axis, &Mesh::bspline(16, 3, 2).unwrap(), section);
    let start = scene.station(rod, 0.0).unwrap();
    scene.join(JointKind::Rigid, start, Partner::Ground).unwrap();
    scene.gravity = frame.of(-0.13531125453301354, -2.30499138941661);
    add_bead(&mut scene, frame, [0.10296130660824243, -2.4378285608304453, 0.049886459215516064]);
    add_bead(&mut scene, frame, [0.7659070495538818, 1.2079498415414154, 0.18136749842623015]);
    let heavy =
        add_bead(&mut scene, frame, [1.1299351827130535, -2.0671230011293105, 7.4411355631876175]);
    let ends = [(EndAction::Release, 1.0), (EndAction::Bounce, 0.0), (EndAction::Bounce, 0.5)];
    for (slider, (ends, restitution)) in scene.sliders.iter_mut().zip(ends) {
        (slider.ends, slider.restitution) = (ends, restitution);
    }
    let anchor = frame.of(0.37296931876985373, -0.9130991141538056);
    let anchors = [Anchor::Station(heavy), Anchor::Ground(anchor)];
    let law = SpringLaw::Linear { stiffness: 10.761360181776588, natural: 0.5134823917046583 };
    spring(&mut scene, SpringKind::Length(anchors.into()), law, 0.0);
    scene
}

/// Largest energy in any row.
fn largest_energy(simulation: &Simulation) -> f64 {
    let kinetic = simulation.history().column("kinetic").unwrap();
    kinetic.iter().fold(0.0, |most: f64, energy| most.max(energy.abs()))
}

/// The lost energy of all sliders together never decreases.
/// Of two sliders that come to rest at the same time, one may receive work from the other.
/// If the other has restitution 1, its stop stores the energy, and the lost energy does not contain this work.
fn assert_losses_grow(simulation: &Simulation) {
    if simulation.scene().sliders.iter().any(|slider| slider.restitution == 1.0) {
        return;
    }
    let name = &simulation.scene().name;
    let least = -ROUNDING * largest_energy(simulation);
    let Some(lost) = simulation.history().column("dissipated") else { return };
    let times = simulation.history().column("t").unwrap();
    for (pair, time) in lost.windows(2).zip(&times) {
        let gain = pair[1] - pair[0];
        assert!(gain >= least, "{name}: {gain:e} of {} after {time}", pair[0]);
    }
}

#[test]
fn a_beam_with_strongly_alternating_velocities_gets_no_energy_from_impacts() {
    for rotation in [0.0, 0.7, 2.0] {
        for mirror in [1.0, -1.0] {
            let scene = shaken_beam(Frame { rotation, mirror });
            let simulation = simulate(scene, METHOD, 0.1, 3.0);
            assert!(simulation.arrivals().len() > 10, "{}", simulation.arrivals().len());
            assert_losses_grow(&simulation);
            assert!(simulation.history().drift(Invariant::Energy) < 1e-10);
        }
    }
}

/// Random scenes with stops of random restitution, of which every second scene has elastic stops too.
/// Every impact loses energy or conserves it, and the balances of energy and momenta close.
#[test]
fn impacts_of_random_scenes_add_no_energy() {
    let seeds = if std::env::var("WITHY_LONG").is_ok() { 1140 } else { 60 };
    let (mut impacts, mut failed) = (0, Vec::new());
    for seed in 0..seeds {
        let (mut scene, _) = wild_scenes::scene(seed);
        let mut random = Random(seed + 1);
        let largest = if seed % 2 == 0 { 1.0 } else { 0.99 };
        for slider in &mut scene.sliders {
            let restitution = 0.7 * (1.0 + random.next()) - 0.2;
            slider.restitution = restitution.clamp(0.0, largest);
        }
        let name = scene.name.clone();
        let mut simulation = Simulation::start(scene, settings(METHOD, 0.02)).unwrap();
        if let Err(error) = run(&mut simulation, 2.0) {
            println!("{name}: {error}");
            failed.push(name);
            continue;
        }
        impacts += simulation.arrivals().len();
        assert_losses_grow(&simulation);
        for invariant in [Invariant::Energy, Invariant::Momentum, Invariant::AngularMomentum] {
            let drift = simulation.history().drift(invariant);
            assert!(drift < 1e-8, "{name}: {invariant:?} {drift:e}");
        }
    }
    println!("{impacts} impacts, {failed:?}");
    assert!(impacts as u64 > 10 * seeds, "{impacts}");
    assert!(10 * failed.len() as u64 <= seeds, "{failed:?}");
}
