//! Tracks: passages over smooth seams and corners, and closed tracks, compared with closed forms and with a single beam.
#![allow(clippy::unwrap_used)]

use std::f64::consts::PI;

use crate::common::scenes::{add_beam, line};
use crate::common::tracks::{bead, ends, hold, section, track};
use crate::common::{at, run, sci, settings, simulate, sliding_scenes};
use withy::beams::Mesh;
use withy::geometry::{Curve, Vec2};
use withy::integrators::{EnergyClaim, INTEGRATORS, Method};
use withy::joints::{JointKind, Partner, Releasable, Release, SlidingRule, TrackEnd, Trigger};
use withy::loads::{LoadFrame, LoadKind, Schedule};
use withy::simulation::{ArrivalKind, Invariant, Simulation};
use withy::system::{Scene, SliderState};

fn smooth(spans: usize) -> Mesh {
    Mesh::bspline(spans, 3, 2).unwrap()
}

fn drift(simulation: &Simulation, invariant: Invariant) -> f64 {
    simulation.history().drift(invariant)
}

fn gap(simulation: &Simulation) -> f64 {
    let rows = simulation.history().samples().iter();
    rows.map(|row| row.measures.gap).fold(0.0, f64::max)
}

fn arc_length(simulation: &Simulation, slider: usize) -> f64 {
    simulation.model().slider_arc_length(slider)
}

#[test]
fn a_bead_goes_round_a_rigid_ring_a_hundred_times_at_its_speed() {
    let mut scene = Scene::new("ring");
    let arcs = [(0.0, PI), (2.0 * PI, PI)];
    let beams = arcs.map(|(from, to)| {
        let axis = Curve::arc(Vec2::zeros(), 1.0, from, to).unwrap();
        add_beam(&mut scene, axis, &smooth(32), section(1e8, 1e8))
    });
    let foot = ends(&mut scene, beams[0])[0];
    hold(&mut scene, JointKind::Rigid, &[foot]);
    let track = track(&mut scene, &beams, TrackEnd::Closed);
    let ring = bead(&mut scene, track, 0.0, 1.0, at(0.0, 1.0));
    let (dt, end) = (0.05, 200.0 * PI);
    let simulation = simulate(scene, Method::EnergyMomentum, dt, end);
    // A step is a chord, and its displacement is the mean of two velocities of equal size times Δt: the bead rotates by 2 atan(v Δt/2 r).
    let found = arc_length(&simulation, ring);
    let expected = end / dt * 2.0 * (0.5 * dt).atan();
    println!("ring: {found} for {end}, by chords {expected}");
    assert!((found - expected).abs() < 2e-6 * end, "{found} {expected}");
    assert!(simulation.model().slider_position(ring) > 99.9);
    assert_eq!(simulation.arrivals().len(), (found / PI).floor() as usize);
    assert!(drift(&simulation, Invariant::Energy) < 1e-11);
    assert!(simulation.model().slider_speed(ring) - 1.0 < 1e-4);
}

/// Bead that crosses a hinged beam along x from 0 to 2, of one piece or of two that join at `seam`. Pieces that are `turned` have the opposite direction.
fn crossing(spans: usize, seam: Option<f64>, turned: [bool; 2]) -> (Scene, usize) {
    let mut scene = Scene::new("crossing");
    let cuts: Vec<f64> = std::iter::once(0.0).chain(seam).chain([2.0]).collect();
    let mut beams = Vec::new();
    for (pair, turned) in cuts.windows(2).zip(turned) {
        let (from, to) = if turned { (pair[1], pair[0]) } else { (pair[0], pair[1]) };
        let mesh = smooth(if seam.is_some() { spans } else { 2 * spans });
        beams.push(add_beam(
            &mut scene,
            line(at(from, 0.0), at(to, 0.0)),
            &mesh,
            section(1e4, 1e2),
        ));
    }
    let outer = [(beams[0], turned[0]), (beams[beams.len() - 1], !turned[beams.len() - 1])];
    for (beam, is_end) in outer {
        let end = ends(&mut scene, beam)[usize::from(is_end)];
        hold(&mut scene, JointKind::Hinge, &[end]);
    }
    scene.gravity = at(0.0, -10.0);
    let track = track(&mut scene, &beams, TrackEnd::Open);
    let bead = bead(&mut scene, track, 0.1, 5.0, at(1.0, 0.0));
    (scene, bead)
}

#[test]
fn smoothly_joined_beams_act_as_one_beam() {
    let mut apart = Vec::new();
    for spans in [4, 8, 16, 32] {
        let places = [None, Some(1.0)].map(|seam| {
            let (scene, slider) = crossing(spans, seam, [false; 2]);
            let simulation = simulate(scene, Method::EnergyMomentum, 0.005, 1.5);
            assert!(drift(&simulation, Invariant::Energy) < 1e-13);
            assert!(gap(&simulation) < 1e-14);
            arc_length(&simulation, slider)
        });
        apart.push((places[1] - places[0]).abs());
    }
    println!("one and two beams: {}", sci(&apart));
    assert!(apart.windows(2).all(|pair| pair[1] < 0.6 * pair[0]), "{apart:?}");
    assert!(apart[3] < 3e-5, "{apart:?}");
}

#[test]
fn contact_forces_are_continuous_at_a_smooth_seam() {
    let (scene, slider) = crossing(8, Some(1.0), [false; 2]);
    let simulation = simulate(scene, Method::EnergyMomentum, 0.005, 0.8);
    let passed = simulation.arrivals()[slider].time;
    let history = simulation.history();
    let forces = history.column("slider1.force_y").unwrap();
    let rows = history.samples().iter().zip(&forces);
    let about = rows.filter(|(row, _)| (row.measures.time - passed).abs() < 0.03);
    let about: Vec<f64> = about.map(|(_, force)| *force).collect();
    let jumps = about.windows(2).map(|pair| (pair[1] - pair[0]).abs());
    let largest = jumps.fold(0.0, f64::max);
    assert!(about.len() > 8 && largest < 5.0, "{about:?}");
}

#[test]
fn beams_of_a_track_may_have_either_direction() {
    let places = |turned| {
        let (scene, slider) = crossing(6, Some(0.7), turned);
        let simulation = simulate(scene, Method::EnergyMomentum, 0.01, 1.6);
        (arc_length(&simulation, slider), simulation.model().slider_speed(slider))
    };
    let (place, speed) = places([false; 2]);
    for turned in [[true, false], [false, true], [true; 2]] {
        let (other, with) = places(turned);
        assert!(
            (place - other).abs() < 1e-12 && (speed - with).abs() < 1e-11,
            "{turned:?}: {other}"
        );
    }
}

/// Ramp of 45° and floor, both stiff beams, with a supported or a free corner.
fn ramp(stiffness: f64, held: bool) -> (Scene, usize) {
    let mut scene = Scene::new("ramp");
    let slope = line(at(0.0, 1.0), at(1.0, 0.0));
    let slope = add_beam(&mut scene, slope, &smooth(8), section(stiffness, stiffness));
    let floor = line(at(4.0, 0.0), at(1.0, 0.0));
    let floor = add_beam(&mut scene, floor, &smooth(8), section(stiffness, stiffness));
    let [top, corner] = ends(&mut scene, slope);
    let far = ends(&mut scene, floor)[0];
    hold(&mut scene, JointKind::Rigid, &[top, far]);
    if held {
        hold(&mut scene, JointKind::Rigid, &[corner]);
    }
    scene.gravity = at(0.0, -10.0);
    let track = track(&mut scene, &[slope, floor], TrackEnd::Open);
    let bead = bead(&mut scene, track, 0.0, 1.0, Vec2::zeros());
    (scene, bead)
}

#[test]
fn a_corner_of_a_stiff_ramp_keeps_the_speed_with_every_method() {
    let (down, after) = (0.4_f64.sqrt(), 0.3);
    let expected = 2.0_f64.sqrt() + after * 20.0_f64.sqrt();
    for entry in INTEGRATORS {
        for held in [true, false] {
            let (scene, slider) = ramp(1e8, held);
            let simulation = simulate(scene, entry.method, 0.01, down + after);
            let found = arc_length(&simulation, slider);
            println!("{} held {held}: {:.1e}", entry.name, found - expected);
            let tolerance = if entry.claims.energy == EnergyClaim::Conserved { 2e-6 } else { 2e-3 };
            assert!((found - expected).abs() < tolerance, "{} {held}: {found}", entry.name);
            assert_eq!(simulation.arrivals().len(), 1);
        }
    }
}

#[test]
fn a_free_rigid_corner_turns_the_relative_velocity_in_the_kinetic_metric() {
    // Free angle of two stiff bars of lengths 1 and 2, initially at rest. The bead moves along the first one.
    let mut scene = Scene::new("angle");
    let (inner, outer) = (at(0.0, 0.0), at(1.2, 1.6));
    let one = add_beam(&mut scene, line(at(-1.0, 0.0), inner), &smooth(6), section(1e8, 1e8));
    let two = add_beam(&mut scene, line(inner, outer), &smooth(6), section(1e8, 1e8));
    let track = track(&mut scene, &[one, two], TrackEnd::Open);
    let mass = 0.7;
    let slider = bead(&mut scene, track, 0.5, mass, at(1.0, 0.0));
    // The bead reaches the corner at 0.5.
    let simulation = simulate(scene, Method::EnergyMomentum, 0.025, 0.5 + 1e-7);
    assert_eq!(simulation.arrivals().len(), 1);

    // Frame as a rigid body, with the rotary inertia of the sections.
    let bars = [(at(-0.5, 0.0), 1.0), (outer * 0.5, 2.0)];
    let centre = (bars[0].0 + bars[1].0 * 2.0) / 3.0;
    let inertia = bars.map(|(own, mass): (Vec2, f64)| {
        mass * (mass * mass / 12.0 + 0.01 + (own - centre).norm_squared())
    });
    let inertia: f64 = inertia.iter().sum();
    let arm = inner - centre;
    let arm = at(-arm.y, arm.x);
    let response =
        |impulse: Vec2| impulse * (1.0 / mass + 1.0 / 3.0) + arm * (arm.dot(&impulse) / inertia);
    let (column_x, column_y) = (response(at(1.0, 0.0)), response(at(0.0, 1.0)));
    let determinant = column_x.x * column_y.y - column_x.y * column_y.x;
    let inverse = |w: Vec2| {
        at(column_y.y * w.x - column_y.x * w.y, column_x.x * w.y - column_x.y * w.x) / determinant
    };
    let [before, after] =
        [at(1.0, 0.0), outer.normalize()].map(|tangent| tangent.dot(&inverse(tangent)));
    let expected = (before / after).sqrt();
    let found = simulation.model().slider_speed(slider);
    println!("free corner: {found}, rigid {expected}");
    assert!((found - expected).abs() < 1e-6, "{found} {expected}");
    assert!((expected - 1.0).abs() > 0.02);
    for invariant in [Invariant::Energy, Invariant::AngularMomentum, Invariant::Momentum] {
        assert!(drift(&simulation, invariant) < 1e-13, "{invariant:?}");
    }
}

#[test]
fn ten_thousand_steps_round_a_free_triangle_conserve_all_invariants() {
    let scene = sliding_scenes::triangle(&smooth(4), SlidingRule::Conserving);
    let simulation = simulate(scene, Method::EnergyMomentum, 0.005, 50.0);
    let passed = simulation.arrivals().len();
    println!("triangle: {passed} seams, energy {:.1e}", drift(&simulation, Invariant::Energy));
    assert!(passed > 40, "{passed}");
    for invariant in [Invariant::Energy, Invariant::AngularMomentum, Invariant::Momentum] {
        assert!(drift(&simulation, invariant) < 1e-11, "{invariant:?}");
    }
    assert!(gap(&simulation) < 1e-13);
}

#[test]
fn many_beads_go_round_beams_with_meshes_of_all_kinds() {
    let mut scene = Scene::new("many");
    let corners = [at(0.0, 0.0), at(2.0, 0.3), at(0.8, 1.5)];
    let meshes = [smooth(5), Mesh::bspline(4, 5, 3).unwrap(), Mesh::lagrange(6, 1).unwrap()];
    let beams = [0, 1, 2].map(|leg| {
        let axis = line(corners[leg], corners[(leg + 1) % 3]);
        add_beam(&mut scene, axis, &meshes[leg], section(1e3, 1e1))
    });
    let track = track(&mut scene, &beams, TrackEnd::Closed);
    for number in 0..6 {
        let speed = at((2.0 * f64::from(number)).sin(), (3.0 * f64::from(number)).cos()) * 2.0;
        bead(&mut scene, track, 0.4 + 0.9 * f64::from(number), 0.1, speed);
    }
    let mut simulation = Simulation::start(scene, settings(Method::EnergyMomentum, 0.01)).unwrap();
    run(&mut simulation, 4.0).unwrap();
    println!("many: {} seams", simulation.arrivals().len());
    assert!(simulation.arrivals().len() > 12);
    for invariant in [Invariant::Energy, Invariant::AngularMomentum, Invariant::Momentum] {
        assert!(drift(&simulation, invariant) < 1e-11, "{invariant:?}");
    }
    assert!(gap(&simulation) < 1e-13);
}

#[test]
fn beads_that_meet_a_seam_together_pass_it_together() {
    let places = |order: [f64; 2]| {
        let mut scene = Scene::new("pair");
        let left =
            add_beam(&mut scene, line(at(-1.0, 0.5), Vec2::zeros()), &smooth(6), section(1e4, 1e2));
        let right =
            add_beam(&mut scene, line(at(1.0, 0.5), Vec2::zeros()), &smooth(6), section(1e4, 1e2));
        let feet = [left, right].map(|beam| ends(&mut scene, beam)[0]);
        hold(&mut scene, JointKind::Hinge, &feet);
        scene.gravity = at(0.0, -10.0);
        let track = track(&mut scene, &[left, right], TrackEnd::Open);
        let length = scene.track_length(track);
        let beads = order.map(|part| bead(&mut scene, track, part * length, 1.0, Vec2::zeros()));
        let simulation = simulate(scene, Method::EnergyMomentum, 0.01, 2.0);
        assert!(drift(&simulation, Invariant::Energy) < 1e-13);
        let passed =
            simulation.arrivals().iter().filter(|arrival| arrival.kind == ArrivalKind::Passed);
        assert_eq!(passed.count(), 4);
        let found = beads.map(|bead| arc_length(&simulation, bead));
        assert!((found[0] + found[1] - length).abs() < 1e-11, "{found:?}");
        found
    };
    let (one, other) = (places([0.25, 0.75]), places([0.75, 0.25]));
    assert!((one[0] - other[1]).abs() < 1e-12, "{one:?} {other:?}");
}

/// Free track of three beams. At 0.5 one bead reaches its end, one a corner, and one a smooth seam, a load jumps, and another beam is released.
fn everything_at_once(order: [usize; 3]) -> Scene {
    let mut scene = Scene::new("everything at once");
    let corners = [at(0.0, 0.0), at(1.0, 0.0), at(2.0, 0.0), at(2.0, 1.0)];
    let beams = [0, 1, 2].map(|leg| {
        add_beam(&mut scene, line(corners[leg], corners[leg + 1]), &smooth(4), section(1e4, 1e2))
    });
    let tail =
        add_beam(&mut scene, line(at(0.0, 0.0), at(-1.0, 0.0)), &smooth(4), section(1e4, 1e2));
    let track = track(&mut scene, &beams, TrackEnd::Open);
    let joint = scene.joints.len();
    let (foot, start) = (ends(&mut scene, tail)[0], ends(&mut scene, beams[0])[0]);
    scene.join(JointKind::Hinge, foot, Partner::Station(start)).unwrap();
    for number in order {
        let (along, velocity) =
            [(0.5, at(-1.0, 0.0)), (0.6, at(0.8, 0.0)), (1.6, at(0.8, 0.0))][number];
        let slider = bead(&mut scene, track, along, 0.3, velocity);
        scene.sliders[slider].name = format!("bead {number}");
    }
    let station = ends(&mut scene, beams[1])[0];
    let force = LoadKind::Force { station, force: at(0.0, 3.0), frame: LoadFrame::Dead };
    scene.add_load(force, Schedule::hold_for(0.5).unwrap());
    scene
        .add_release(Release { object: Releasable::Joint(joint), trigger: Trigger::Time(0.5) })
        .unwrap();
    scene
}

#[test]
fn end_corner_seam_release_and_load_jump_may_coincide() {
    let places = |order: [usize; 3]| {
        let scene = everything_at_once(order);
        let mut simulation =
            Simulation::start(scene, settings(Method::EnergyMomentum, 0.07)).unwrap();
        run(&mut simulation, 2.0).unwrap();
        for invariant in [Invariant::Energy, Invariant::AngularMomentum, Invariant::Momentum] {
            assert!(drift(&simulation, invariant) < 1e-12, "{invariant:?}");
        }
        let mut found = [0.0; 3];
        for (index, slider) in simulation.scene().sliders.iter().enumerate() {
            let number: usize = slider.name[5..].parse().unwrap();
            found[number] = arc_length(&simulation, index);
        }
        assert!(simulation.arrivals().len() >= 3);
        found
    };
    let found = places([0, 1, 2]);
    for order in [[2, 1, 0], [1, 2, 0]] {
        let other = places(order);
        assert!(found.iter().zip(other).all(|(a, b)| (a - b).abs() < 1e-11), "{found:?} {other:?}");
    }
}

#[test]
fn bead_that_reverses_at_a_seam_returns() {
    let mut scene = Scene::new("throw");
    let low = line(at(0.0, 0.0), at(1.0, 1.0));
    let low = add_beam(&mut scene, low, &smooth(4), section(1e8, 1e8));
    let high = line(at(1.0, 1.0), at(2.0, 2.0));
    let high = add_beam(&mut scene, high, &smooth(4), section(1e8, 1e8));
    for beam in [low, high] {
        let both = ends(&mut scene, beam);
        hold(&mut scene, JointKind::Rigid, &both[usize::from(beam == high)..][..1]);
    }
    let track = track(&mut scene, &[low, high], TrackEnd::Open);
    scene.gravity = at(0.0, -10.0);
    // The energy of the bead is just sufficient to reach the seam.
    let speed = 10.0_f64.sqrt();
    let slider = bead(&mut scene, track, 0.0, 1.0, at(speed, speed));
    let simulation = simulate(scene, Method::EnergyMomentum, 0.01, 0.5);
    let expected = (20.0_f64.sqrt() - 0.25 * 10.0 / 2.0_f64.sqrt()) * 0.5;
    assert!((arc_length(&simulation, slider) - expected).abs() < 1e-4);
    assert!(drift(&simulation, Invariant::Energy) < 1e-12);
}

#[test]
fn bead_rests_in_a_valley_and_leaves_when_pulled() {
    let mut scene = Scene::new("valley");
    let left =
        add_beam(&mut scene, line(at(-1.0, 1.0), Vec2::zeros()), &smooth(4), section(1e6, 1e5));
    let right =
        add_beam(&mut scene, line(at(1.0, 1.0), Vec2::zeros()), &smooth(4), section(1e6, 1e5));
    let feet = [left, right].map(|beam| ends(&mut scene, beam)[0]);
    hold(&mut scene, JointKind::Rigid, &feet);
    scene.gravity = at(0.0, -10.0);
    let track = track(&mut scene, &[left, right], TrackEnd::Open);
    let slider = bead(&mut scene, track, 2.0_f64.sqrt(), 1.0, Vec2::zeros());
    let station = scene.sliders[slider].slave;
    let force = LoadKind::Force { station, force: at(30.0, 0.0), frame: LoadFrame::Dead };
    let pulls = Schedule::table(vec![(0.0, 0.0), (0.5, 0.0), (0.5, 1.0), (10.0, 1.0)]).unwrap();
    scene.add_load(force, pulls);
    let mut simulation = Simulation::start(scene, settings(Method::EnergyMomentum, 0.01)).unwrap();
    run(&mut simulation, 0.5).unwrap();
    assert!(matches!(simulation.slider_state(slider), SliderState::Held(_)));
    assert!((arc_length(&simulation, slider) - 2.0_f64.sqrt()).abs() < 1e-14);
    run(&mut simulation, 0.7).unwrap();
    // Forces of 30 along x and -10 along y accelerate the bead up the right side.
    let up = 0.5 * (20.0 / 2.0_f64.sqrt()) * 0.04;
    let found = arc_length(&simulation, slider) - 2.0_f64.sqrt();
    assert!((found - up).abs() < 1e-3 * up, "{found} {up}");
    assert!(drift(&simulation, Invariant::Energy) < 1e-10);
}
