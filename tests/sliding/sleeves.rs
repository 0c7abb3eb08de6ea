//! Sleeves without length in motion: conservation, order, symmetries, and comparisons with closed forms and ordinary differential equations.
#![allow(clippy::unwrap_used)]

use crate::common::body_scenes::{add_body, hinge};
use crate::common::scenes::{add_beam, drive, end_of, line, spaghetti_section, start_of};
use crate::common::sleeve_scenes::{self, moving, sleeve};
use crate::common::{at, ends, meshes, orders, run, sci, settings, simulate};
use nalgebra::{DMatrix, DVector};
use withy::beams::{Mesh, Section, Station};
use withy::geometry::Vec2;
use withy::integrators::Method;
use withy::joints::{
    Component, Components, EndAction, JointKind, Partner, Releasable, Release, Trigger,
};
use withy::loads::{LoadFrame, LoadKind, PrescribedMotion, Schedule};
use withy::simulation::{Invariant, Simulation};
use withy::statics::{Equilibrium, Loading};
use withy::system::{PointMass, Scene, SliderState, StartMotion};

const ROUNDING: f64 = 1e-12;

fn stiff() -> Section {
    Section { rotary_inertia: 1e-4, ..spaghetti_section(1e8, 1e8) }
}

fn drifts(simulation: &Simulation) -> [f64; 4] {
    Invariant::ALL.map(|(_, invariant)| simulation.history().drift(invariant))
}

#[test]
fn energy_momenta_and_gap_are_kept_to_rounding_at_any_step() {
    let mut worst = [0.0_f64; 4];
    for (mesh_name, mesh) in meshes(6) {
        for scene in sleeve_scenes::all(&mesh) {
            for dt in [0.002, 0.02, 0.1] {
                let label = format!("{}, {mesh_name}, {dt}", scene.name);
                let flight = simulate(scene.clone(), Method::EnergyMomentum, dt, 0.6);
                let drifts = drifts(&flight);
                worst = std::array::from_fn(|k| worst[k].max(drifts[k]));
                assert!(drifts.iter().all(|drift| *drift <= ROUNDING), "{label}: {drifts:?}");
                assert!(flight.counts().newton_max <= 8, "{label}");
            }
        }
    }
    println!("worst drift of E, p, L, gap {}", sci(&worst));
}

fn state(simulation: &Simulation) -> [f64; 5] {
    let [start, end] = ends(simulation);
    [start.x, start.y, end.x, end.y, simulation.model().slider_arc_length(0)]
}

fn distance(one: &[f64; 5], other: &[f64; 5]) -> f64 {
    one.iter().zip(other).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max)
}

/// Changes of a scene's state at a time on halving of the step.
fn changes(scene: &Scene, method: Method, dts: &[f64], end: f64) -> Vec<f64> {
    let run = |dt: &f64| state(&simulate(scene.clone(), method, *dt, end));
    let found: Vec<[f64; 5]> = dts.iter().map(run).collect();
    found.windows(2).map(|pair| distance(&pair[0], &pair[1])).collect()
}

#[test]
fn sleeves_converge_in_time_at_the_order_of_the_integrator() {
    let mesh = Mesh::bspline(6, 3, 2).unwrap();
    // The time of an impact depends on the steps, so that changes are irregular.
    let bounces = |scene: &Scene| scene.sliders.iter().any(|one| one.ends == EndAction::Bounce);
    for scene in sleeve_scenes::all(&mesh).into_iter().filter(|scene| !bounces(scene)) {
        for (method, order) in
            [(Method::EnergyMomentum, 2.0), (Method::Trapezoidal, 2.0), (Method::FourthOrder, 4.0)]
        {
            let found = changes(&scene, method, &[0.0005, 0.00025, 0.000125], 0.2);
            println!("{}, {method:?}: {} {:.2?}", scene.name, sci(&found), orders(&found));
            assert!((orders(&found)[0] - order).abs() < 0.25, "{}: {found:?}", scene.name);
        }
    }
}

/// Flying beam that slides through a sleeve at the end of another one, turned, mirrored, and with the beams in the given order.
fn arranged(turn: f64, mirror: f64, rod_first: bool) -> Scene {
    let mut scene = Scene::new("arranged");
    let (sine, cosine) = turn.sin_cos();
    let place = |x: f64, y: f64| at(cosine * x - sine * y * mirror, sine * x + cosine * y * mirror);
    let mesh = Mesh::bspline(6, 3, 2).unwrap();
    let section = Section { rotary_inertia: 0.05, ..spaghetti_section(5e2, 5.0) };
    let axes = [line(place(0.3, -1.0), place(0.0, 0.0)), line(place(-1.2, 0.2), place(1.2, -0.2))];
    let [holder_axis, rod_axis] = axes;
    let (holder, rod) = if rod_first {
        let rod = add_beam(&mut scene, rod_axis, &mesh, section);
        (add_beam(&mut scene, holder_axis, &mesh, section), rod)
    } else {
        let holder = add_beam(&mut scene, holder_axis, &mesh, section);
        (holder, add_beam(&mut scene, rod_axis, &mesh, section))
    };
    moving(&mut scene, holder, place(-0.5, 0.1), mirror);
    moving(&mut scene, rod, place(1.5, 0.4), -mirror);
    let (mouth, along) = (end_of(&mut scene, holder), 0.5 * scene.beams[rod].axis.length());
    sleeve(&mut scene, mouth, rod, along);
    scene
}

#[test]
fn turned_mirrored_and_reordered_scenes_move_alike() {
    let at_end = |turn: f64, mirror: f64, rod_first: bool| {
        let scene = arranged(turn, mirror, rod_first);
        let flight = simulate(scene, Method::EnergyMomentum, 0.02, 0.6);
        let model = flight.model();
        let couple = mirror * model.sleeve_couple(0);
        [model.slider_arc_length(0), couple, model.contact_force(0).norm()]
    };
    let plain = at_end(0.0, 1.0, false);
    for (turn, mirror, rod_first) in
        [(0.7, 1.0, false), (0.0, -1.0, false), (2.0, -1.0, true), (0.0, 1.0, true)]
    {
        for (found, expected) in at_end(turn, mirror, rod_first).iter().zip(plain) {
            let off = (found - expected).abs();
            assert!(off < 1e-9, "{turn} {mirror} {rod_first}: {found} {expected}");
        }
    }
}

#[test]
fn the_holder_turns_with_the_section_that_it_passes() {
    let passing = |dt: f64| {
        let mut scene = arranged(0.0, 1.0, false);
        let rod = scene.station(1, 0.9).unwrap();
        let mouth = end_of(&mut scene, 0);
        let mut flight = Simulation::start(scene, settings(Method::EnergyMomentum, dt)).unwrap();
        let read = |flight: &Simulation| {
            let angle = |of: &Station| flight.model().angle(flight.scene(), of).unwrap();
            (flight.model().slider_arc_length(0) - 0.9, angle(&mouth) - angle(&rod))
        };
        // The rod is undeformed at the start, so that all of its sections have one angle.
        let start = read(&flight);
        let mut before = start;
        loop {
            let until = flight.time() + dt;
            run(&mut flight, until).unwrap();
            let after = read(&flight);
            if after.0 < 0.0 {
                let share = before.0 / (before.0 - after.0);
                let turned = before.1 + share * (after.1 - before.1) - start.1;
                return [turned.abs(), flight.model().sleeve_rotation_gap(0).abs()];
            }
            before = after;
        }
    };
    let errors = [0.02, 0.01, 0.005].map(passing);
    println!("{errors:?}");
    let [first, .., last] = errors;
    assert!(last[0] < 1e-5 && last[0] < 0.1 * first[0], "{errors:?}");
    assert!(last[1] < 1e-6 && last[1] < 0.1 * first[1], "{errors:?}");
}

#[test]
fn a_stiff_beam_slides_down_an_inclined_sleeve() {
    let (slope, gravity, time) = (0.5_f64, 9.81, 0.3);
    let along = at(slope.cos(), slope.sin());
    let mut scene = Scene::new("inclined");
    let rod = add_beam(
        &mut scene,
        line(along * -0.6, along * 1.4),
        &Mesh::bspline(16, 3, 2).unwrap(),
        stiff(),
    );
    scene.gravity = at(0.0, -gravity);
    let holder = scene.add_holder("sleeve", Vec2::zeros()).unwrap();
    sleeve(&mut scene, holder, rod, 0.6);
    let flight = simulate(scene, Method::EnergyMomentum, 0.01, time);
    let slid = flight.model().slider_arc_length(0) - 0.6;
    let expected = 0.5 * gravity * slope.sin() * time.powi(2);
    assert!((slid / expected - 1.0).abs() < 1e-6, "{slid} {expected}");
}

/// Bar of mass 1 and length 1 in a guide at a distance from the axis of a turning hub: distance slid and spin after a time, by the Runge–Kutta method of order 4.
fn guided_bar([offset, inertia, time]: [f64; 3], spin: f64, slid: f64) -> [f64; 2] {
    let own = inertia + 1.0 / 12.0 + 1e-4;
    let momentum = (own + offset * offset + slid * slid) * spin;
    let spin_of = |s: f64, u: f64| (momentum + offset * u) / (own + s * s);
    let rates = |[s, u]: [f64; 2]| {
        let spin = spin_of(s, u);
        [u + spin * offset, spin * spin * s]
    };
    let steps = 2000;
    let h = time / f64::from(steps);
    let mut y = [slid, -spin * offset];
    let ahead = |y: [f64; 2], k: [f64; 2], h: f64| [y[0] + h * k[0], y[1] + h * k[1]];
    for _ in 0..steps {
        let a = rates(y);
        let b = rates(ahead(y, a, 0.5 * h));
        let c = rates(ahead(y, b, 0.5 * h));
        let d = rates(ahead(y, c, h));
        y = std::array::from_fn(|k| y[k] + h / 6.0 * (a[k] + 2.0 * b[k] + 2.0 * c[k] + d[k]));
    }
    [y[0], spin_of(y[0], y[1])]
}

#[test]
fn a_stiff_beam_in_a_sleeve_on_a_turning_body_moves_as_a_rigid_bar() {
    let (offset, inertia, spin, time) = (0.2, 0.5, 2.0, 0.5);
    let [slid, final_spin] = guided_bar([offset, inertia, time], spin, 0.1);
    let errors = [0.01, 0.005, 0.0025].map(|dt| {
        let mut scene = Scene::new("guided bar");
        let mesh = Mesh::bspline(16, 3, 2).unwrap();
        let rod = add_beam(&mut scene, line(at(-0.4, offset), at(0.6, offset)), &mesh, stiff());
        let hub = add_body(&mut scene, Vec2::zeros(), 0.0, (1.0, inertia), &[at(0.05, offset)]);
        let motion = StartMotion { velocity: Vec2::zeros(), spin, centre: Some(Vec2::zeros()) };
        scene.beams[rod].motion = motion;
        scene.rigid_bodies[hub].motion = motion;
        hinge(&mut scene, Station::on_rigid_body(hub, 0), None);
        sleeve(&mut scene, Station::on_rigid_body(hub, 1), rod, 0.45);
        let flight = simulate(scene, Method::EnergyMomentum, dt, time);
        let model = flight.model();
        // The hub turns about its centre, and the middle of the bar is at the distance s from the foot of the perpendicular.
        let found = 0.55 - model.slider_arc_length(0);
        let place = flight.place(&Station::on_rigid_body(hub, 0)).unwrap();
        let turning = model.spin(&place);
        assert!((turning / final_spin - 1.0).abs() < 1e-5, "{turning} {final_spin}");
        assert!(drifts(&flight).iter().all(|drift| *drift < 1e-11));
        (found - slid).abs()
    });
    println!("{} {:.2?}", sci(&errors), orders(&errors));
    assert!(errors[2] < 1e-5 && orders(&errors).iter().all(|order| *order > 1.8), "{errors:?}");
}

/// Weightless rod with a mass at its tip in a sleeve at the origin, bent by a force on the mass.
fn shot_rod(mesh: &Mesh) -> (Scene, Station) {
    let mut scene = Scene::new("shot rod");
    let section = Section {
        axial_stiffness: 1e5,
        shear_stiffness: 1e5,
        bending_stiffness: 1.0,
        mass_per_length: 1e-5,
        rotary_inertia: 1e-8,
    };
    let rod = add_beam(&mut scene, line(at(-2.8, 0.0), at(1.0, 0.0)), mesh, section);
    let tip = end_of(&mut scene, rod);
    scene.add_mass(PointMass { station: tip, mass: 1.0, rotary_inertia: 0.0 }).unwrap();
    let force = LoadKind::Force { station: tip, force: at(0.0, -1.0), frame: LoadFrame::Dead };
    scene.add_load(force, Schedule::constant(1.0).unwrap());
    let holder = scene.add_holder("sleeve", Vec2::zeros()).unwrap();
    sleeve(&mut scene, holder, rod, 2.8);
    (scene, tip)
}

/// Positions of the tip at t = 0.5, 1, … 3 of a massless inextensible rod (DOP853 on the elastica, benchmark B1).
const SHOT: [(f64, f64); 6] = [
    (1.00054246, -0.11744062),
    (1.02543246, -0.39724460),
    (1.16301966, -0.75091266),
    (1.45697096, -1.21500979),
    (1.86998395, -1.85789784),
    (2.35719651, -2.71934153),
];

#[test]
fn bent_rod_ejected_from_a_sleeve_follows_the_reference() {
    let is_long = std::env::var_os("WITHY_LONG").is_some();
    let runs = [(240, 0.0025, 2.2e-3), (480, 0.0025, 1.3e-3), (960, 0.00125, 1e-3)];
    for (spans, dt, bound) in runs.into_iter().take(if is_long { 3 } else { 2 }) {
        let (scene, tip) = shot_rod(&Mesh::bspline(spans, 3, 2).unwrap());
        let mut flight = Simulation::start(scene, settings(Method::EnergyMomentum, dt)).unwrap();
        let mut worst = 0.0_f64;
        for (index, (x, y)) in SHOT.into_iter().enumerate() {
            run(&mut flight, 0.5 * (index + 1) as f64).unwrap();
            let found = flight.model().position(&flight.place(&tip).unwrap());
            worst = worst.max((found - at(x, y)).norm() / at(x, y).norm());
        }
        let drifts = drifts(&flight);
        println!("{spans} spans, dt {dt}: {worst:.2e}, drift {}", sci(&drifts));
        assert!(worst < bound, "{spans} spans: {worst:e}");
        assert!(drifts.iter().all(|drift| *drift <= ROUNDING), "{drifts:?}");
    }
}

#[test]
fn an_equilibrium_with_a_sleeve_remains_at_rest() {
    let mut scene = Scene::new("bent rod");
    let section = Section { rotary_inertia: 1e-3, ..spaghetti_section(1e4, 1.0) };
    let mesh = Mesh::bspline(32, 3, 2).unwrap();
    let rod = add_beam(&mut scene, line(at(-0.5, 0.0), at(1.0, 0.0)), &mesh, section);
    let (back, tip) = (start_of(&mut scene, rod), end_of(&mut scene, rod));
    scene.join(JointKind::Support(Components::X), back, Partner::Ground).unwrap();
    let force = LoadKind::Force { station: tip, force: at(0.0, -0.5), frame: LoadFrame::Dead };
    scene.add_load(force, Schedule::constant(1.0).unwrap());
    let holder = scene.add_holder("sleeve", Vec2::zeros()).unwrap();
    sleeve(&mut scene, holder, rod, 0.5);
    scene.sliders[0].ends = EndAction::Stop;
    let rest = Equilibrium::find(scene, Loading { steps: 4, ..Loading::default() }, &mut |_| true);
    let rest = rest.unwrap();
    let settings = settings(Method::EnergyMomentum, 0.01);
    let mut still = Simulation::start_at_rest(&rest, settings).unwrap();
    let before = ends(&still);
    let couple = still.model().sleeve_couple(0);
    run(&mut still, 0.5).unwrap();
    let moved = ends(&still).iter().zip(before).map(|(a, b)| (a - b).norm()).fold(0.0, f64::max);
    assert!(moved < 1e-12, "{moved:e}");
    assert!((still.model().sleeve_couple(0) - couple).abs() < 1e-9);
    // The mesh without the compliance of the kink is stiffer.
    assert!((rest.model().sleeve_couple(0) / couple - 1.0).abs() < 1e-2);
}

#[test]
fn a_rod_that_leans_on_the_stop_of_a_sleeve_remains_there() {
    let mut scene = Scene::new("plunger");
    let section = Section { rotary_inertia: 1e-3, ..spaghetti_section(1e4, 1.0) };
    let rod = line(at(-0.2, 0.0), at(0.8, 0.0));
    let rod = add_beam(&mut scene, rod, &Mesh::bspline(16, 3, 2).unwrap(), section);
    let tip = end_of(&mut scene, rod);
    let force = LoadKind::Force { station: tip, force: at(1.0, 0.1), frame: LoadFrame::Dead };
    scene.add_load(force, Schedule::constant(1.0).unwrap());
    let holder = scene.add_holder("sleeve", Vec2::zeros()).unwrap();
    sleeve(&mut scene, holder, rod, 0.2);
    scene.sliders[0].ends = EndAction::Stop;
    let rest = Equilibrium::find(scene, Loading { steps: 2, ..Loading::default() }, &mut |_| true);
    let settings = settings(Method::EnergyMomentum, 0.01);
    let mut still = Simulation::start_at_rest(&rest.unwrap(), settings).unwrap();
    let before = ends(&still);
    run(&mut still, 0.5).unwrap();
    let moved = ends(&still).iter().zip(before).map(|(a, b)| (a - b).norm()).fold(0.0, f64::max);
    assert!(moved < 1e-10, "{moved:e}");
    assert_eq!(still.model().slider_held_by(0), Some("start"));
}

/// Deflections of the tip of a linear Euler–Bernoulli cantilever that is pushed out of a clamp at a constant speed, with `EI = ρA = 1`, at the given times.
/// Galerkin's method with powers of `x/L(t)`, and the Runge–Kutta method of order 4.
fn pushed_out([length, speed, gravity]: [f64; 3], times: &[f64]) -> Vec<f64> {
    const SHAPES: usize = 5;
    let integral = |power: i32, falling: i32| {
        (1..=falling).fold(1.0 / f64::from(power + 1), |sum, k| {
            sum * f64::from(k) / f64::from(power + 1 + k)
        })
    };
    let matrix = |of: &dyn Fn(i32, i32) -> f64| {
        DMatrix::from_fn(SHAPES, SHAPES, |i, j| of(i as i32 + 2, j as i32 + 2))
    };
    let mass = matrix(&|i, j| integral(i + j, 0)).try_inverse().unwrap();
    let drift = &mass * matrix(&|i, j| f64::from(j) * integral(i + j - 1, 1));
    let bend = &mass
        * matrix(&|i, j| {
            f64::from(j * (j - 1)) * integral(i + j - 2, 2)
                - 2.0 * f64::from(j) * integral(i + j - 1, 1)
        });
    let stiffness =
        &mass * matrix(&|i, j| f64::from(i * (i - 1) * j * (j - 1)) * integral(i + j - 4, 0));
    let weight = &mass * DVector::from_fn(SHAPES, |i, _| integral(i as i32 + 2, 0)) * gravity;
    let rates = |time: f64, q: &DVector<f64>, u: &DVector<f64>| {
        let reach = length + speed * time;
        let flow = speed / reach;
        let forces = &drift * u * (2.0 * flow)
            + &bend * q * flow.powi(2)
            + &stiffness * q * reach.powi(-4)
            + &weight;
        (u.clone(), -forces)
    };
    let h = 2e-5;
    let (mut time, mut q, mut u) = (0.0, DVector::zeros(SHAPES), DVector::zeros(SHAPES));
    let mut found = Vec::new();
    for end in times {
        while time < end - 0.5 * h {
            let (qa, ua) = rates(time, &q, &u);
            let (qb, ub) = rates(time + 0.5 * h, &(&q + &qa * (0.5 * h)), &(&u + &ua * (0.5 * h)));
            let (qc, uc) = rates(time + 0.5 * h, &(&q + &qb * (0.5 * h)), &(&u + &ub * (0.5 * h)));
            let (qd, ud) = rates(time + h, &(&q + &qc * h), &(&u + &uc * h));
            q += (qa + qb * 2.0 + qc * 2.0 + qd) * (h / 6.0);
            u += (ua + ub * 2.0 + uc * 2.0 + ud) * (h / 6.0);
            time += h;
        }
        found.push(q.sum());
    }
    found
}

#[test]
fn rod_pushed_out_of_a_sleeve_deflects_as_a_cantilever() {
    let (length, speed, gravity) = (0.5, 1.0, 1e-2);
    let times = [0.1, 0.2, 0.3, 0.4, 0.5];
    let expected = pushed_out([length, speed, gravity], &times);
    let largest = expected.iter().fold(0.0_f64, |most, w| most.max(w.abs()));
    let errors = [24, 48, 96].map(|spans| {
        let mut scene = Scene::new("pushed rod");
        let section = Section { rotary_inertia: 1e-6, ..spaghetti_section(1e5, 1.0) };
        let mesh = Mesh::bspline(spans, 3, 2).unwrap();
        let rod = line(at(length - 1.2, 0.0), at(length, 0.0));
        let rod = add_beam(&mut scene, rod, &mesh, section);
        moving(&mut scene, rod, at(speed, 0.0), 0.0);
        scene.gravity = at(0.0, -gravity);
        let (back, tip) = (start_of(&mut scene, rod), end_of(&mut scene, rod));
        let rows = vec![(0.0, 0.0), (1.0, speed)];
        let push = PrescribedMotion::Position(Schedule::table(rows).unwrap());
        drive(&mut scene, back, &[(Component::X, push)]);
        let holder = scene.add_holder("sleeve", Vec2::zeros()).unwrap();
        sleeve(&mut scene, holder, rod, 1.2 - length);
        let mut flight = Simulation::start(scene, settings(Method::EnergyMomentum, 0.002)).unwrap();
        let mut worst = 0.0_f64;
        for (time, expected) in times.iter().zip(&expected) {
            run(&mut flight, *time).unwrap();
            let found = flight.model().position(&flight.place(&tip).unwrap()).y;
            worst = worst.max((found - expected).abs() / largest);
        }
        worst
    });
    println!("{expected:?}: {} {:.2?}", sci(&errors), orders(&errors));
    assert!(errors[2] < 0.02 && errors[2] < 0.4 * errors[0], "{errors:?}");
}

#[test]
fn run_stops_or_continues_when_the_beam_leaves_the_sleeve() {
    let scene = |action: EndAction| {
        let mut scene = Scene::new("thrown rod");
        let section = Section { rotary_inertia: 1e-2, ..spaghetti_section(1e3, 10.0) };
        let mesh = Mesh::bspline(8, 3, 2).unwrap();
        let rod = add_beam(&mut scene, line(at(-0.3, 0.0), at(0.7, 0.0)), &mesh, section);
        moving(&mut scene, rod, at(2.0, 0.0), 0.0);
        scene.gravity = at(0.0, -1.0);
        let holder = scene.add_holder("sleeve", Vec2::zeros()).unwrap();
        sleeve(&mut scene, holder, rod, 0.3);
        scene.sliders[0].ends = action;
        scene
    };
    let stopped = simulate(scene(EndAction::Stop), Method::EnergyMomentum, 0.01, 1.0);
    assert!(stopped.ending().is_some() && stopped.time() < 0.2);
    assert!(stopped.model().slider_position(0) == 0.0);
    let thrown = simulate(scene(EndAction::Release), Method::EnergyMomentum, 0.01, 1.0);
    assert_eq!(thrown.model().slider_state(0), SliderState::Released);
    assert_eq!(thrown.model().sleeve_couple(0), 0.0);
    let drifts = drifts(&thrown);
    assert!(drifts.iter().all(|drift| *drift <= ROUNDING), "{drifts:?}");
}

#[test]
fn a_released_sleeve_transmits_neither_force_nor_couple() {
    let mut scene = arranged(0.0, 1.0, false);
    scene
        .add_release(Release { object: Releasable::Slider(0), trigger: Trigger::Time(0.2) })
        .unwrap();
    let flight = simulate(scene, Method::EnergyMomentum, 0.02, 0.5);
    let couples = flight.history().column("sleeve1.couple").unwrap();
    assert!(couples[1..10].iter().all(|couple| couple.abs() > 1e-3), "{couples:?}");
    assert!(couples[11..].iter().all(|couple| *couple == 0.0), "{couples:?}");
    let drifts = drifts(&flight);
    assert!(drifts.iter().all(|drift| *drift <= ROUNDING), "{drifts:?}");
}

#[test]
fn mean_and_present_couple_agree_to_second_order() {
    let errors = [0.002, 0.001, 0.0005].map(|dt| {
        let (mut scene, _) = shot_rod(&Mesh::bspline(24, 3, 2).unwrap());
        scene.beams[0].section =
            Section { mass_per_length: 1.0, rotary_inertia: 1e-2, ..spaghetti_section(1e3, 1.0) }
                .into();
        scene.record("sleeve1.present_couple").unwrap();
        let flight = simulate(scene, Method::EnergyMomentum, dt, 0.4);
        let column = |name: &str| flight.history().column(name).unwrap().to_vec();
        let [mean, present] = ["sleeve1.couple", "sleeve1.present_couple"].map(column);
        let pairs = present.windows(2).zip(&mean[1..]);
        pairs.map(|(ends, mean)| (mean - 0.5 * (ends[0] + ends[1])).abs()).fold(0.0, f64::max)
    });
    println!("{} {:.2?}", sci(&errors), orders(&errors));
    assert!(errors[2] < 1e-7 && orders(&errors).iter().all(|order| *order > 1.6), "{errors:?}");
}
