//! Simultaneous arrivals are one impact: symmetric scenes stay symmetric, and the order of declaration of sliders has no effect.
#![allow(clippy::unwrap_used)]

use crate::common::rails::{bead, clamped_rail, rail};
use crate::common::scenes::{add_beam, end_of, line, start_of};
use crate::common::{at, run, settings, sliding_scenes};
use nalgebra::Rotation2;
use withy::beams::{Mesh, Section};
use withy::geometry::{Vec2, perpendicular};
use withy::integrators::Method;
use withy::joints::{EndAction, Releasable, Release, SlidingRule, StartVelocities, Trigger};
use withy::loads::{LoadFrame, LoadKind, Schedule};
use withy::simulation::{ArrivalKind, Invariant, Simulation};
use withy::system::{
    Anchor, Origin, Scene, SliderState, Spring, SpringKind, SpringLaw, StartMotion,
};

const METHODS: [Method; 2] = [Method::EnergyMomentum, Method::FourthOrder];

/// Positions, masses and speeds of symmetric beads on a free beam along x of length 1.
const BEADS: [(f64, f64, f64); 4] =
    [(0.25, 0.4, -1.0), (0.75, 0.4, 1.0), (0.4, 0.1, -1.6), (0.6, 0.1, 1.6)];

fn mirrored(order: [usize; 4], axial: f64, restitution: f64, rule: SlidingRule) -> Scene {
    let mut scene = rail(&Mesh::bspline(6, 3, 2).unwrap(), at(1.0, 0.0));
    let mut section = scene.beams[0].section.mean();
    section.axial_stiffness = axial;
    scene.beams[0].section = section.into();
    for number in order {
        let (along, mass, speed) = BEADS[number];
        let slider = bead(&mut scene, along, mass, at(speed, 0.0), EndAction::Bounce);
        scene.sliders[slider].name = format!("bead {number}");
        scene.sliders[slider].restitution = restitution;
        scene.sliders[slider].rule = rule;
    }
    scene
}

fn simulated(scene: Scene, method: Method, dt: f64, end: f64) -> Simulation {
    let mut simulation = Simulation::start(scene, settings(method, dt)).unwrap();
    run(&mut simulation, end).unwrap();
    simulation
}

/// Position of each bead, by the number in its name, and of the middle of the beam.
fn places(simulation: &Simulation) -> ([f64; 4], f64) {
    let mut places = [0.0; 4];
    for (index, slider) in simulation.scene().sliders.iter().enumerate() {
        let number: usize = slider.name[5..].parse().unwrap();
        places[number] = simulation.model().slider_position(index);
    }
    let points = simulation.model().control_points().next().unwrap();
    (places, points.iter().map(|point| point.x).sum::<f64>() / points.len() as f64)
}

#[test]
fn symmetric_scenes_stay_symmetric_in_any_declaration_order() {
    for method in METHODS {
        for (axial, dt) in [(1e2, 0.002), (1e4, 0.01), (1e8, 0.01)] {
            for restitution in [1.0, 0.6, 0.0] {
                for rule in [SlidingRule::Conserving, SlidingRule::Kinked] {
                    // Backward substeps excite the kink near a soft end and amplify rounding errors.
                    if rule == SlidingRule::Kinked && method == Method::FourthOrder {
                        continue;
                    }
                    let label = format!("{method:?}, EA = {axial:e}, e = {restitution}, {rule:?}");
                    let first = mirrored([0, 1, 2, 3], axial, restitution, rule);
                    let first = simulated(first, method, dt, 0.6);
                    let (found, middle) = places(&first);
                    let mirror = [found[0] + found[1], found[2] + found[3]];
                    let off = mirror.map(|sum| (sum - 1.0).abs()).into_iter().fold(0.0, f64::max);
                    let off = off.max((middle - 0.5).abs());
                    assert!(!first.arrivals().is_empty());
                    let energy = first.history().drift(Invariant::Energy);
                    let momentum = first.history().drift(Invariant::Momentum);
                    assert!(energy < 1e-11 && momentum < 1e-12, "{label}: {energy:e} {momentum:e}");
                    println!("{label}: asymmetry {off:.1e}, {} arrivals", first.arrivals().len());
                    assert!(off < 1e-12, "{label}: {off:e}");
                    // Arrivals come in pairs at equal times.
                    for pair in first.arrivals().chunks(2) {
                        assert!(pair.len() == 2 && pair[0].time == pair[1].time, "{label}");
                        assert_eq!(pair[0].kind, pair[1].kind, "{label}");
                    }
                    for order in [[1, 0, 3, 2], [3, 1, 2, 0]] {
                        let other = mirrored(order, axial, restitution, rule);
                        let (other, _) = places(&simulated(other, method, dt, 0.6));
                        // A bead that rests without a contact force at the stop of a stiff beam leaves it because of rounding.
                        let least = if restitution == 0.0 && axial == 1e8 { 1e-8 } else { 1e-12 };
                        for (one, other) in found.iter().zip(other) {
                            assert!(
                                (one - other).abs() < least,
                                "{label}, {order:?}: {one} {other}"
                            );
                        }
                    }
                }
            }
        }
    }
}

#[test]
fn stiff_beam_transmits_an_impulse_between_beads() {
    // Newton's cradle: beads and beam have equal masses. The steps do not resolve waves, so the beam acts as a rigid body. The third bead rests at the other
    // end, and the second one takes no part.
    for dt in [0.01, 0.1] {
        let mut scene = rail(&Mesh::bspline(6, 3, 2).unwrap(), at(1.0, 0.0));
        let mut section = scene.beams[0].section.mean();
        section.axial_stiffness = 1e8;
        scene.beams[0].section = section.into();
        for (along, speed) in [(0.75, 1.0), (0.5, 0.0), (0.0, 0.0)] {
            bead(&mut scene, along, 1.0, at(speed, 0.0), EndAction::Bounce);
        }
        let simulation = simulated(scene, Method::EnergyMomentum, dt, 0.5);
        let beads: Vec<Vec2> =
            simulation.model().control_points().skip(1).map(|points| points[0]).collect();
        println!("dt = {dt}: {beads:?}, {:?}", simulation.arrivals());
        // The first bead stops where it strikes, and the last one moves on with its velocity.
        let expected = [1.0, 0.5, 0.25];
        for (bead, x) in beads.iter().zip(expected) {
            assert!((bead.x - x).abs() < 1e-3, "{bead:?} {x}");
        }
        assert!(simulation.history().drift(Invariant::Energy) < 1e-12);
        assert!(simulation.history().drift(Invariant::Momentum) < 1e-12);
    }
}

#[test]
fn a_bouncing_bead_comes_to_rest_in_the_time_of_the_series() {
    for method in METHODS {
        for restitution in [0.0, 0.3, 0.8] {
            // Fall of 0.5 under g = 1: the bead arrives at t = 1 and bounces for 2 e/(1 - e).
            let mut scene = clamped_rail(&Mesh::bspline(4, 3, 2).unwrap(), at(0.0, -1.0));
            bead(&mut scene, 0.5, 1.0, at(0.0, 0.0), EndAction::Bounce);
            scene.sliders[0].restitution = restitution;
            scene.gravity = at(0.0, -1.0);
            let station = scene.sliders[0].slave;
            let lift = LoadKind::Force { station, force: at(0.0, 2.0), frame: LoadFrame::Dead };
            scene.add_load(lift, Schedule::pulse(12.0, 20.0).unwrap());
            let simulation = simulated(scene, method, 0.01, 13.0);
            let last = simulation.arrivals().last().unwrap();
            let end = 1.0 + 2.0 * restitution / (1.0 - restitution);
            println!(
                "e = {restitution}: {} arrivals to t = {}",
                simulation.arrivals().len(),
                last.time
            );
            assert_eq!(last.kind, ArrivalKind::Held);
            // The remaining bounces of the series end within a few steps.
            assert!(last.time <= end + 1e-3 && last.time > end - 0.15, "{} {end}", last.time);
            assert!(simulation.arrivals().len() < 40);
            let row = simulation.history().samples().last().unwrap();
            // The tolerance allows for the energy exchange with the beam, on which gravity starts suddenly.
            assert!((row.measures.dissipated - 0.5).abs() < 1e-3, "{}", row.measures.dissipated);
            assert!(simulation.history().drift(Invariant::Energy) < 1e-12);
            // From t = 12 on the load lifts the bead, which leaves at once with an acceleration of 1.
            let place = simulation.model().slider_position(0);
            assert!((place - 0.5).abs() < 1e-3, "{place}");
            let lost = simulation.history().column("dissipated.slider1").unwrap();
            assert_eq!(*lost.last().unwrap(), row.measures.dissipated);
        }
    }
}

#[test]
fn simultaneous_events_in_one_step_conserve_all_invariants() {
    // In the step from 0.3 on, one bead strikes an end, one is released at an end, one reverses, a load jumps, and the foot of the beam is released.
    for method in METHODS {
        for dt in [0.3, 0.1, 0.02] {
            let mut scene = clamped_rail(&Mesh::bspline(5, 3, 2).unwrap(), at(1.0, 0.0));
            bead(&mut scene, 0.55, 0.3, at(-1.5, 0.0), EndAction::Bounce);
            bead(&mut scene, 0.5, 0.2, at(1.37, 0.0), EndAction::Release);
            let turns = bead(&mut scene, 0.3, 0.2, at(0.4, 0.0), EndAction::Bounce);
            let station = scene.sliders[turns].slave;
            let pull = LoadKind::Force { station, force: at(-0.2, 0.0), frame: LoadFrame::Dead };
            scene.add_load(pull, Schedule::Constant(1.0));
            let side = LoadKind::Force { station, force: at(0.0, -3.0), frame: LoadFrame::Dead };
            scene.add_load(side, Schedule::pulse(0.36, 2.0).unwrap());
            let (hold, trigger) = (Releasable::Joint(0), Trigger::Time(0.37));
            scene.add_release(Release { object: hold, trigger }).unwrap();
            let simulation = simulated(scene, method, dt, 0.9);
            assert_eq!(simulation.slider_state(1), SliderState::Released);
            assert_eq!(simulation.releases().len(), 1);
            assert!(simulation.arrivals().len() >= 2);
            for (name, invariant) in Invariant::ALL {
                let drift = simulation.history().drift(invariant);
                assert!(drift < 2e-11, "{method:?}, dt = {dt}, {name}: {drift:e}");
            }
        }
    }
}

#[test]
fn sliders_at_stops_continue_bit_for_bit_from_files_and_after_rewinds() {
    let mesh = Mesh::bspline(4, 3, 2).unwrap();
    for method in METHODS {
        // Steps that resolve impacts, in which sliders stay in contact with stops, and steps that do not.
        for (dt, end) in [(5e-4, 0.12), (0.01, 0.6)] {
            let scene = sliding_scenes::losing_abacus(&mesh, SlidingRule::Conserving);
            let mut first = Simulation::start(scene, settings(method, dt)).unwrap();
            first.enable_snapshots(50_000_000);
            let mut states = Vec::new();
            for part in 1..=6 {
                run(&mut first, end * f64::from(part) / 6.0).unwrap();
                states.push((
                    first.time(),
                    first.model().state(),
                    first.to_bytes("abacus").unwrap(),
                ));
            }
            assert!(first.arrivals().len() >= 2, "{:?}", first.arrivals());
            let (_, last, _) = states.last().unwrap();
            for (time, state, file) in &states {
                let (_, mut loaded) = Simulation::from_bytes(file).unwrap();
                assert!(loaded.model().state() == *state);
                for part in 1..=6 {
                    let stop = end * f64::from(part) / 6.0;
                    if stop > *time {
                        run(&mut loaded, stop).unwrap();
                    }
                }
                assert!(loaded.model().state() == *last, "{method:?}, dt = {dt}, from {time}");
            }
            for (name, invariant) in Invariant::ALL {
                let drift = first.history().drift(invariant);
                assert!(drift < 2e-12, "{method:?}, dt = {dt}, {name}: {drift:e}");
            }
            let (time, state, _) = &states[2];
            first.rewind(*time).unwrap();
            assert!(first.model().state() == *state);
            for part in 4..=6 {
                run(&mut first, end * f64::from(part) / 6.0).unwrap();
            }
            assert!(first.model().state() == *last, "{method:?}, dt = {dt}, after going back");
        }
    }
}

/// Soft beam on springs, rotated about the origin. Two beads repeatedly come to rest at its end.
fn resting_beads(angle: f64) -> Scene {
    let turned = |point: Vec2| Rotation2::new(angle) * point;
    let mut scene = Scene::new("resting beads");
    let (start, along) = (at(0.245, 0.0), Rotation2::new(-0.258) * at(1.71, 0.0));
    let section = Section {
        axial_stiffness: 40_500.0,
        shear_stiffness: 20_300.0,
        bending_stiffness: 0.447,
        mass_per_length: 3.9,
        rotary_inertia: 0.039,
    };
    let axis = line(turned(start), turned(start + along));
    let beam = add_beam(&mut scene, axis, &Mesh::bspline(4, 3, 2).unwrap(), section);
    let (drift, spin, centre) = (at(-0.444, 0.378), 0.304, start + along * 0.5);
    scene.beams[beam].motion =
        StartMotion { velocity: turned(drift), spin, centre: Some(turned(centre)) };
    let spring = |scene: &mut Scene, kind, stiffness, damping: f64| {
        let law = Some(SpringLaw::Linear { stiffness, natural: 0.0 });
        let name = scene.free_name("spring");
        let (origin, damping) = (Origin::AsBuilt, damping.into());
        scene.add_spring(Spring { name, kind, law, origin, damping, rest: None }).unwrap();
    };
    let [begin, end] = [start_of(&mut scene, beam), end_of(&mut scene, beam)].map(Anchor::Station);
    let ground = |point: Vec2| Anchor::Ground(turned(point));
    for (place, stiffness, damping) in [(at(1.34, -1.2), 80.9, 0.5), (at(-1.49, -2.68), 1.2, 0.0)] {
        let kind = SpringKind::Length(vec![ground(start + place), end]);
        spring(&mut scene, kind, stiffness, damping);
    }
    spring(&mut scene, SpringKind::Torsion([ground(start), begin]), 1.79, 0.0);
    for (part, mass, speed) in [(0.402, 0.143, 3.84), (0.308, 2.1, 3.37)] {
        let place = start + along * part;
        let velocity = drift + perpendicular(place - centre) * spin + along.normalize() * speed;
        let slider = bead(&mut scene, part, mass, turned(velocity), EndAction::Bounce);
        scene.sliders[slider].restitution = 0.0;
        scene.sliders[slider].velocities = StartVelocities::Project;
    }
    let bead = Anchor::Station(scene.sliders[0].slave);
    let place = start + along * 0.402 + at(0.3, -1.0);
    spring(&mut scene, SpringKind::Length(vec![ground(place), bead]), 2.25, 0.0);
    scene
}

#[test]
fn bead_at_rest_leaves_a_stop_alike_in_rotated_scenes() {
    let run = |angle: f64| simulated(resting_beads(angle), Method::FourthOrder, 0.00813, 0.5);
    let own = run(0.0);
    for angle in [0.4, 1.1, 2.3, 4.7] {
        let other = run(angle);
        assert_eq!(own.arrivals().len(), other.arrivals().len(), "{angle}");
        let points = |simulation: &Simulation| {
            simulation.model().control_points().flatten().copied().collect::<Vec<Vec2>>()
        };
        let pairs = points(&own).into_iter().zip(points(&other));
        let off = pairs.map(|(one, other)| (Rotation2::new(angle) * one - other).norm());
        let off = off.fold(0.0, f64::max);
        println!("turned by {angle}: off by {off:.1e}, {} arrivals", own.arrivals().len());
        assert!(off < 1e-10, "{angle}: {off:e}");
    }
}
