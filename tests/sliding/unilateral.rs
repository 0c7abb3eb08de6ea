//! Unilateral sliders: take-off, flight, landing and their balances.
#![allow(clippy::unwrap_used)]

use crate::common::scenes::{add_beam, line};
use crate::common::sliding::{STIFF, moving_particle};
use crate::common::{at, run, settings, step};
use std::f64::consts::PI;
use withy::beams::{Mesh, Section, Station};
use withy::geometry::{Curve, Vec2, perpendicular, unit};
use withy::integrators::Method;
use withy::joints::{JointKind, Partner, Restraint, Side, Slider, StartVelocities};
use withy::loads::{LoadFrame, LoadKind, Schedule};
use withy::simulation::{
    Arrival, ArrivalKind, Invariant, NoMonitor, Simulation, StepControl, StepSize, Variation,
    Warning,
};
use withy::system::{Scene, SliderState, StartMotion};

const METHOD: Method = Method::EnergyMomentum;

/// Angle of the start of the circle [°].
const SPHERE_START: f64 = 120.0;

/// Section of such a large mass that the beam hardly moves. Its vibrations are slow, so steps resolve them.
const HEAVY: Section = Section {
    axial_stiffness: 1e9,
    shear_stiffness: 1e9,
    bending_stiffness: 1e8,
    mass_per_length: 1e9,
    rotary_inertia: 1e8,
};

fn add_slider(scene: &mut Scene, bead: Station, beam: usize, along: f64, restitution: f64) {
    let slider = Slider::new(scene.free_name("slider"), bead, beam, along);
    scene
        .add_slider(Slider { restraint: Restraint::OneSided(Side::Left), restitution, ..slider })
        .unwrap();
}

fn fix(scene: &mut Scene, beam: usize, count: usize) {
    let length = scene.beams[beam].axis.length();
    for at in 0..=count {
        let station = scene.station(beam, length * at as f64 / count as f64).unwrap();
        scene.join(JointKind::Rigid, station, Partner::Ground).unwrap();
    }
}

/// Bead on the top of a heavy circle with radius 1, with the start speed `√(q g)`.
fn sphere(q: f64) -> Scene {
    let mut scene = Scene::new("sphere");
    let (from, to) = (SPHERE_START.to_radians(), -100.0_f64.to_radians());
    let axis = Curve::arc(Vec2::zeros(), 1.0, from, to).unwrap();
    let rod = add_beam(&mut scene, axis, &Mesh::bspline(60, 3, 2).unwrap(), HEAVY);
    let top = moving_particle(&mut scene, at(0.0, 1.0), at((9.81 * q).sqrt(), 0.0), 1.0);
    let weight = LoadKind::Force { station: top, force: at(0.0, -9.81), frame: LoadFrame::Dead };
    scene.add_load(weight, Schedule::constant(1.0).unwrap());
    let along = (SPHERE_START - 90.0).to_radians();
    let slider = Slider::new("slider1", top, rod, along);
    let velocities = StartVelocities::Project;
    let restraint = Restraint::OneSided(Side::Left);
    scene.add_slider(Slider { restraint, velocities, restitution: 0.0, ..slider }).unwrap();
    scene
}

/// Time and position of the first take-off.
fn take_off(simulation: &Simulation) -> [f64; 2] {
    let gaps = simulation.history().column("slider1.gap").unwrap();
    let flies = gaps.iter().position(|gap| *gap != 0.0).unwrap();
    ["t", "slider1.position"].map(|name| simulation.history().column(name).unwrap()[flies - 1])
}

fn drifts(simulation: &Simulation) -> f64 {
    let drift = |(_, invariant)| simulation.history().drift(invariant);
    Invariant::ALL.into_iter().map(drift).fold(0.0, f64::max)
}

/// A bead leaves a circle where `cos φ = (2 + q)/3` (closed form). The angle depends on the mesh only, and the time has the order 2.
#[test]
fn a_bead_leaves_a_circle_at_the_exact_angle() {
    for q in [0.3, 1e-3] {
        let exact = ((2.0 + q) / 3.0_f64).acos().to_degrees();
        let times = [0.04, 0.02, 0.01].map(|dt| {
            let mut simulation = Simulation::start(sphere(q), settings(METHOD, dt)).unwrap();
            while simulation.model().slider_state(0) == SliderState::Sliding {
                step(&mut simulation).unwrap();
                assert!(simulation.time() < 5.0);
            }
            step(&mut simulation).unwrap();
            assert!(drifts(&simulation) < 1e-12, "{:e}", drifts(&simulation));
            let [time, place] = take_off(&simulation);
            let error = place * (SPHERE_START + 100.0) - (SPHERE_START - 90.0) - exact;
            assert!(error.abs() < 1e-2, "q {q} dt {dt}: {error:e}");
            time
        });
        let [coarse, middle, fine] = times;
        let order = ((coarse - middle) / (middle - fine)).log2();
        assert!((order - 2.0).abs() < 0.3, "q {q}: order {order}");
    }
}

/// Mass that crosses a simply supported beam with half of the critical speed. It takes off at `v t/L = 0.9374` (modal solution of Frýba's problem).
#[test]
fn a_moving_mass_takes_off_near_the_end_of_a_beam() {
    let section = Section {
        axial_stiffness: 1e6,
        shear_stiffness: 1e6,
        bending_stiffness: 1.0,
        mass_per_length: 1.0,
        rotary_inertia: 1e-6,
    };
    let speed = 0.5 * PI;
    let place = |spans: usize, dt: f64| {
        let mut scene = Scene::new("moving mass");
        let mesh = Mesh::bspline(spans, 3, 2).unwrap();
        let rod = add_beam(&mut scene, line(Vec2::zeros(), at(1.0, 0.0)), &mesh, section);
        for along in [0.0, 1.0] {
            let end = scene.station(rod, along).unwrap();
            scene.join(JointKind::Hinge, end, Partner::Ground).unwrap();
        }
        let mass = moving_particle(&mut scene, Vec2::zeros(), at(speed, 0.0), 0.5);
        add_slider(&mut scene, mass, rod, 0.0, 0.0);
        let (force, frame) = (at(0.0, -5e-4), LoadFrame::Dead);
        let load = LoadKind::Force { station: mass, force, frame };
        scene.add_load(load, Schedule::constant(1.0).unwrap());
        let mut simulation = Simulation::start(scene, settings(METHOD, dt)).unwrap();
        while simulation.model().slider_state(0) == SliderState::Sliding {
            step(&mut simulation).unwrap();
        }
        step(&mut simulation).unwrap();
        assert!(drifts(&simulation) < 1e-9, "{:e}", drifts(&simulation));
        take_off(&simulation)[1]
    };
    let places = [place(16, 2e-3), place(16, 1e-3), place(32, 1e-3)];
    assert!(places.iter().all(|place| (place - 0.9374).abs() < 2e-3), "{places:?}");
}

/// A bead falls on a fixed beam. The times of the impacts follow from Newton's law of restitution.
#[test]
fn a_bead_bounces_on_a_beam() {
    for (restitution, dt) in [(0.8, 0.05), (0.8, 0.01), (0.5, 0.01), (1.0, 0.013), (0.0, 0.01)] {
        let mut scene = Scene::new("drop");
        let mesh = Mesh::bspline(4, 3, 2).unwrap();
        let rod = add_beam(&mut scene, line(at(-1.0, 0.0), at(1.0, 0.0)), &mesh, STIFF);
        fix(&mut scene, rod, 4);
        scene.gravity = at(0.0, -9.81);
        let ball = moving_particle(&mut scene, at(0.1, 1.0), at(0.1, 0.0), 1.0);
        add_slider(&mut scene, ball, rod, 1.1, restitution);
        let mut simulation = Simulation::start(scene, settings(METHOD, dt)).unwrap();
        run(&mut simulation, 2.5).unwrap();
        let history = simulation.history();
        let (times, gaps) = (history.column("t").unwrap(), history.column("slider1.gap").unwrap());
        let touches = times.iter().zip(&gaps).filter(|(_, gap)| gap.abs() < 1e-12);
        let first = (2.0 / 9.81_f64).sqrt();
        let mut exact = first;
        let known = if restitution > 0.0 { 3 } else { 1 };
        for (bounce, (time, _)) in (1..=known).zip(touches) {
            assert!((time - exact).abs() < 1e-8, "e {restitution} dt {dt}: {time} {exact}");
            exact += 2.0 * first * restitution.powi(bounce);
        }
        assert!(drifts(&simulation) < 1e-13, "{:e}", drifts(&simulation));
        let lost = history.column("dissipated.slider1").unwrap();
        assert!(lost.windows(2).all(|pair| pair[1] >= pair[0] - 1e-15));
        // With a rebound of one half, the bounces end after a finite time.
        if restitution == 0.5 {
            assert_eq!(simulation.model().slider_state(0), SliderState::Sliding);
            assert!((lost.last().unwrap() - 9.81).abs() < 1e-8, "{:?}", lost.last());
        }
    }
}

/// Flexible cantilever under its weight, with a bead that falls on it, rotated by an angle and optionally mirrored.
fn cantilever(turn: f64, side: Side, restitution: f64) -> Scene {
    let mut scene = Scene::new("cantilever");
    let place = |x: f64, y: f64| {
        let (along, across) = (unit(turn), perpendicular(unit(turn)) * side.sign());
        along * x + across * y
    };
    let section = Section {
        axial_stiffness: 1e4,
        shear_stiffness: 4e3,
        bending_stiffness: 20.0,
        mass_per_length: 0.5,
        rotary_inertia: 1e-2,
    };
    let mesh = Mesh::bspline(6, 3, 2).unwrap();
    let rod = add_beam(&mut scene, line(Vec2::zeros(), place(4.0, 0.0)), &mesh, section);
    let start = scene.station(rod, 0.0).unwrap();
    scene.join(JointKind::Rigid, start, Partner::Ground).unwrap();
    scene.gravity = place(0.0, -1.0);
    let ball = moving_particle(&mut scene, place(1.5, 0.3), place(0.1, 0.0), 0.2);
    let slider = Slider::new("slider1", ball, rod, 1.5);
    scene
        .add_slider(Slider { restraint: Restraint::OneSided(side), restitution, ..slider })
        .unwrap();
    scene
}

/// Number of rows after which the slider has left its master.
fn take_offs(simulation: &Simulation) -> usize {
    let gaps = simulation.history().column("slider1.gap").unwrap();
    gaps.windows(2).filter(|pair| pair[0].abs() < 1e-12 && pair[1] > 1e-12).count()
}

#[test]
fn flexible_beam_keeps_its_energy_balance_through_many_landings() {
    for restitution in [0.0, 0.5, 1.0] {
        for dt in [0.01, 0.03, 0.1] {
            let scene = cantilever(0.0, Side::Left, restitution);
            let mut simulation = Simulation::start(scene, settings(METHOD, dt)).unwrap();
            run(&mut simulation, 6.0).unwrap();
            let (drift, count) = (drifts(&simulation), take_offs(&simulation));
            assert!(drift < 1e-11, "e {restitution} dt {dt}: {drift:e}");
            assert!(count > 2 || (restitution == 0.0 && dt == 0.1), "{count}");
            let gaps = simulation.history().column("slider1.gap").unwrap();
            let places = simulation.history().column("slider1.position").unwrap();
            let is_above = |(gap, place): (&f64, &f64)| *gap > -1e-12 || *place == 1.0;
            assert!(gaps.iter().zip(&places).all(is_above), "e {restitution} dt {dt}");
            let lost = simulation.history().column("dissipated.slider1").unwrap();
            assert!(lost.windows(2).all(|pair| pair[1] >= pair[0] - 1e-14));
        }
    }
}

#[test]
fn a_free_beam_and_a_bead_keep_their_momenta() {
    for restitution in [0.0, 0.7] {
        let mut scene = cantilever(0.4, Side::Left, restitution);
        scene.joints.clear();
        scene.gravity = Vec2::zeros();
        scene.beams[0].motion =
            StartMotion { velocity: at(0.0, 0.2), spin: -0.8, centre: Some(unit(0.4) * 2.0) };
        let mut simulation = Simulation::start(scene, settings(METHOD, 0.02)).unwrap();
        run(&mut simulation, 2.0).unwrap();
        assert!(drifts(&simulation) < 1e-12, "{:e}", drifts(&simulation));
        assert!(*simulation.history().column("dissipated.slider1").unwrap().last().unwrap() > 0.0);
    }
}

#[test]
fn rotated_and_mirrored_copies_agree() {
    let gaps = |turn: f64, side: Side| {
        let scene = cantilever(turn, side, 0.5);
        let mut simulation = Simulation::start(scene, settings(METHOD, 0.02)).unwrap();
        run(&mut simulation, 2.0).unwrap();
        simulation.history().column("slider1.gap").unwrap()
    };
    let straight = gaps(0.0, Side::Left);
    for (turn, side) in [(1.0, Side::Left), (0.0, Side::Right), (-2.3, Side::Right)] {
        let other = gaps(turn, side);
        assert_eq!(other.len(), straight.len());
        let apart = straight.iter().zip(&other).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
        assert!(apart < 1e-8, "{turn} {side:?}: {apart:e}");
    }
}

/// An impact near a bead in contact moves the beam away from the bead.
#[test]
fn impact_of_a_slider_separates_another_slider() {
    let mut scene = Scene::new("seesaw");
    let mesh = Mesh::bspline(4, 3, 2).unwrap();
    let rod = add_beam(&mut scene, line(at(-1.0, 0.0), at(1.0, 0.0)), &mesh, STIFF);
    let middle = scene.station(rod, 1.0).unwrap();
    scene.join(JointKind::Hinge, middle, Partner::Ground).unwrap();
    let falling = moving_particle(&mut scene, at(0.8, 0.1), at(0.0, -1.0), 1.0);
    let resting = moving_particle(&mut scene, at(0.5, 0.0), Vec2::zeros(), 1.0);
    add_slider(&mut scene, falling, rod, 1.8, 0.0);
    add_slider(&mut scene, resting, rod, 1.5, 0.0);
    let mut simulation = Simulation::start(scene, settings(METHOD, 0.01)).unwrap();
    run(&mut simulation, 0.15).unwrap();
    assert!(drifts(&simulation) < 1e-12, "{:e}", drifts(&simulation));
    let gaps = simulation.history().column("slider2.gap").unwrap();
    // The seesaw has the moment of inertia 2/3 + 1/50 at the hinge, and the falling bead 0.64.
    let spin = 0.8 / (2.0 / 3.0 + 0.02 + 0.64);
    let exact = 0.5 * (spin * 0.05_f64).sin();
    assert!((gaps.last().unwrap() / exact - 1.0).abs() < 0.02, "{:?} {exact}", gaps.last());
}

/// No landing occurs beyond the end of a beam, even if the slave returns from the other side.
#[test]
fn a_bead_passes_beyond_the_end_of_a_beam() {
    let mut scene = Scene::new("passing");
    let rod = add_beam(
        &mut scene,
        line(at(-1.0, 0.0), at(1.0, 0.0)),
        &Mesh::bspline(4, 3, 2).unwrap(),
        STIFF,
    );
    fix(&mut scene, rod, 4);
    let passing = moving_particle(&mut scene, at(1.5, 0.5), at(-0.5, -1.0), 1.0);
    add_slider(&mut scene, passing, rod, 2.0, 0.5);
    let mut simulation = Simulation::start(scene, settings(METHOD, 0.03)).unwrap();
    run(&mut simulation, 2.0).unwrap();
    assert_eq!(simulation.model().slider_state(0), SliderState::Separated);
    let gap = *simulation.history().column("slider1.gap").unwrap().last().unwrap();
    assert!((gap + 1.5).abs() < 1e-12, "{gap}");
}

#[test]
fn rewinding_and_continuing_gives_the_same_bits() {
    let scene = cantilever(0.0, Side::Left, 0.5);
    let mut simulation = Simulation::start(scene, settings(METHOD, 0.03)).unwrap();
    simulation.enable_snapshots(1 << 26);
    run(&mut simulation, 3.0).unwrap();
    let straight = simulation.history().column("slider1.gap").unwrap();
    for time in [0.3, 1.2, 2.7] {
        simulation.rewind(time).unwrap();
        run(&mut simulation, 3.0).unwrap();
        assert_eq!(simulation.history().column("slider1.gap").unwrap(), straight, "{time}");
    }
}

#[test]
fn adaptive_steps_keep_the_energy_balance() {
    let scene = cantilever(0.0, Side::Left, 0.5);
    let steps = StepSize::from(StepControl::to(1e-4));
    let mut simulation = Simulation::start(scene, settings(METHOD, steps)).unwrap();
    run(&mut simulation, 2.0).unwrap();
    assert!(drifts(&simulation) < 1e-11, "{:e}", drifts(&simulation));
    assert!(take_offs(&simulation) > 1);
}

/// Particles at the start and above a hinged beam. Each landing separates the other particle from the beam.
fn two_on_a_beam(mass_per_length: f64) -> Scene {
    let mut scene = Scene::new("two on a beam");
    let section = Section {
        axial_stiffness: 1e4,
        shear_stiffness: 4e3,
        bending_stiffness: 1.0,
        mass_per_length,
        rotary_inertia: 1e-4 * mass_per_length,
    };
    let mesh = Mesh::bspline(8, 3, 2).unwrap();
    let rod = add_beam(&mut scene, line(at(-1.0, 0.0), at(1.0, 0.0)), &mesh, section);
    for along in [0.0, 2.0] {
        let end = scene.station(rod, along).unwrap();
        scene.join(JointKind::Hinge, end, Partner::Ground).unwrap();
    }
    scene.gravity = at(0.0, -9.81);
    for (x, y) in [(0.0, 0.0), (0.3, 0.05)] {
        let bead = moving_particle(&mut scene, at(x, y), Vec2::zeros(), 0.02);
        add_slider(&mut scene, bead, rod, x + 1.0, 0.0);
    }
    scene
}

#[test]
fn two_sliders_do_not_separate_each_other_endlessly() {
    for mass_per_length in [0.01, 0.1, 1.0] {
        let scene = two_on_a_beam(mass_per_length);
        let mut simulation = Simulation::start(scene, settings(METHOD, 0.01)).unwrap();
        run(&mut simulation, 1.0).unwrap();
        assert!(drifts(&simulation) < 1e-11, "{mass_per_length}: {:e}", drifts(&simulation));
    }
}

fn dropped(restitution: f64) -> Simulation {
    let scene = cantilever(0.0, Side::Left, restitution);
    let mut simulation = Simulation::start(scene, settings(METHOD, 0.03)).unwrap();
    run(&mut simulation, 6.0).unwrap();
    simulation
}

/// Take-offs and landings are events with the times of rows of the history. The impulse of a landing changes the momentum of the ball.
#[test]
fn take_offs_and_landings_are_events() {
    for restitution in [0.0, 0.5] {
        let simulation = dropped(restitution);
        let events = simulation.arrivals();
        let first = &events[0];
        let lands = if restitution == 0.0 { ArrivalKind::Landed } else { ArrivalKind::Bounced };
        assert_eq!((first.kind, first.end, first.slider), (lands, None, 0));
        assert!(first.impulse.y < 0.0, "{first:?}");
        let has = |kind: ArrivalKind| events.iter().any(|event| event.kind == kind);
        assert!(has(ArrivalKind::TookOff) && has(ArrivalKind::Landed), "{events:?}");
        let impulse =
            |event: &Arrival| event.kind == ArrivalKind::TookOff && event.impulse.y != 0.0;
        assert!(!events.iter().any(impulse));
        let times = simulation.history().column("t").unwrap();
        assert!(events.iter().all(|event| times.contains(&event.time)), "{events:?}");
        let text = first.describe("hop", None);
        let did = if restitution == 0.0 { "landed on" } else { "bounced off" };
        assert!(text.starts_with(&format!("slider 'hop' {did} its beam at t = ")), "{text}");
    }
}

/// A saved run is repeated bit for bit in single rows, as in conversions.
#[test]
fn saved_runs_are_repeated_through_landings() {
    for scene in [cantilever(0.0, Side::Left, 0.5), two_on_a_beam(0.1)] {
        let mut simulation = Simulation::start(scene, settings(METHOD, 0.02)).unwrap();
        run(&mut simulation, 4.0).unwrap();
        assert!(simulation.arrivals().len() > 2);
        let (_, loaded) = Simulation::from_bytes(&simulation.to_bytes("run").unwrap()).unwrap();
        assert_eq!(loaded.arrivals(), simulation.arrivals());
        let mut again = loaded.copy_at_start().unwrap();
        for row in 0..loaded.history().samples().len() {
            let time = loaded.history().samples()[row].measures.time;
            assert!(again.run_again(&loaded, row, &mut NoMonitor).unwrap(), "t = {time}");
        }
    }
}

#[test]
fn runs_with_derivatives_take_off_like_runs_without() {
    let scene = || sphere(0.3);
    let variation = Variation {
        name: "gravity".to_owned(),
        distance: 1e-6,
        scenes: [1.0 + 1e-6, 1.0 - 1e-6].map(|factor| {
            let mut scene = scene();
            scene.gravity *= factor;
            scene
        }),
    };
    let start =
        Simulation::start_with_derivatives(scene(), settings(METHOD, 0.02), vec![variation]);
    let mut simulation = start.unwrap();
    let mut plain = Simulation::start(scene(), settings(METHOD, 0.02)).unwrap();
    run(&mut simulation, 1.0).unwrap();
    run(&mut plain, 1.0).unwrap();
    assert_eq!(plain.arrivals()[0].kind, ArrivalKind::TookOff);
    assert_eq!(plain.model().state(), simulation.model().state());
    let refused = simulation.derivative(0, |run| run.time()).unwrap_err();
    assert!(refused.to_string().contains("lands on its beam"), "{refused}");
}

/// Events divide steps, but the steps of the grid have one length.
#[test]
fn take_offs_and_landings_are_not_reported_as_alternating_steps() {
    let simulation = dropped(0.0);
    let divided = |dt: &f64| *dt < 0.029;
    let lengths = simulation.history().column("dt").unwrap();
    assert!(lengths.into_iter().filter(divided).count() > 20);
    let notes = simulation.warnings();
    assert!(!notes.iter().any(|note| matches!(note, Warning::Uneven { .. })), "{notes:?}");
}
