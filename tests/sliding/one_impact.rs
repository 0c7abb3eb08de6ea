//! Simultaneous arrivals at seams and ends are one impact: comparison with a rigid frame, symmetry, independence of the order, and reported impulses.
#![allow(clippy::unwrap_used)]

use crate::common::rails::{bead as on_rail, clamped_rail};
use crate::common::scenes::{add_beam, line};
use crate::common::tracks::{bead, section, track};
use crate::common::{at, run, sci, settings, simulate};
use withy::beams::Mesh;
use withy::geometry::Vec2;
use withy::integrators::Method;
use withy::joints::{EndAction, TrackEnd};
use withy::simulation::{ArrivalKind, Invariant, Simulation};
use withy::system::Scene;

const INVARIANTS: [Invariant; 3] =
    [Invariant::Energy, Invariant::AngularMomentum, Invariant::Momentum];

/// Mass and speed of the beads that move to the corners, and of those that move to the ends.
const TO_CORNERS: (f64, f64) = (0.7, 1.0);
const TO_ENDS: (f64, f64) = (0.4, 0.8);

/// Free tray: a floor from -1 to 1, and walls that rise from its ends at 45°. Two beads reach its corners and two reach its ends at 0.5, symmetrically.
fn tray(order: [usize; 4], stiffness: f64, restitution: f64) -> Scene {
    let mut scene = Scene::new("tray");
    let corners = [at(-2.0, 1.0), at(-1.0, 0.0), at(1.0, 0.0), at(2.0, 1.0)];
    let mesh = Mesh::bspline(5, 3, 2).unwrap();
    let beams = [0, 1, 2].map(|leg| {
        let axis = line(corners[leg], corners[leg + 1]);
        add_beam(&mut scene, axis, &mesh, section(stiffness, stiffness))
    });
    let track = track(&mut scene, &beams, TrackEnd::Open);
    let length = scene.track_length(track);
    let up = 0.5_f64.sqrt();
    let (slow, fast) = (TO_ENDS.1 * up, TO_CORNERS.1);
    for number in order {
        let (from_end, mass, velocity) = [
            (0.5 * TO_ENDS.1, TO_ENDS.0, at(slow, slow)),
            (2.0_f64.sqrt() + 0.5 * fast, TO_CORNERS.0, at(fast, 0.0)),
        ][number % 2];
        let (along, velocity) = match number < 2 {
            true => (from_end, at(-velocity.x, velocity.y)),
            false => (length - from_end, velocity),
        };
        let slider = bead(&mut scene, track, along, mass, velocity);
        scene.sliders[slider].name = format!("bead {number}");
        scene.sliders[slider].restitution = restitution;
    }
    scene
}

/// Values for each bead, by the number in its name.
fn by_bead<T: Copy + Default>(simulation: &Simulation, of: impl Fn(usize) -> T) -> [T; 4] {
    let mut found = [T::default(); 4];
    for (index, slider) in simulation.scene().sliders.iter().enumerate() {
        found[slider.name[5..].parse::<usize>().unwrap()] = of(index);
    }
    found
}

#[test]
fn simultaneous_corner_and_stop_share_one_impact() {
    let ((m, v), (n, u)) = (TO_CORNERS, TO_ENDS);
    for restitution in [1.0, 0.5] {
        let scene = tray([0, 1, 2, 3], 1e8, restitution);
        let simulation = simulate(scene, Method::EnergyMomentum, 0.25, 0.5 + 1e-7);
        let kinds = by_bead(&simulation, |slider| {
            simulation.arrivals().iter().find(|arrival| arrival.slider == slider).map(|a| a.kind)
        });
        let [bounced, passed] = [ArrivalKind::Bounced, ArrivalKind::Passed].map(Some);
        assert_eq!(kinds, [bounced, passed, bounced, passed]);

        // The tray is a rigid body with the velocity V after the impact. Beads leave its ends with e u, and pass its corners up the walls with s.
        // Momentum: (2 m + 2 n + M) V = √2 (n u (1 + e) - m s). The energy decreases by n u² (1 - e²).
        let whole = 2.0 * (m + n) + 2.0 + 2.0 * 2.0_f64.sqrt();
        let (root, e) = (2.0_f64.sqrt(), restitution);
        // V, and the change of energy, as functions of s.
        let rises = |s: f64| root * (n * u * (1.0 + e) - m * s) / whole;
        let surplus = |s: f64| {
            let rise = rises(s);
            let bead = |mass: f64, speed: f64| mass * (speed * speed + root * speed * rise);
            bead(m, s) + bead(n, -e * u) + 0.5 * whole * rise * rise - m * v * v - n * u * u
        };
        // The loss of each stop is -P ½ (w⁻ + w⁺) = ½ (1 - e) u P, with the impulse P that changes the momentum of the bead along the wall.
        let loss = |s: f64| (1.0 - e) * u * n * (u * (1.0 + e) - rises(s) / root);
        let (mut low, mut high) = (0.5 * v, 1.5 * v);
        for _ in 0..60 {
            let middle = 0.5 * (low + high);
            let is_low = surplus(middle) + loss(middle) < 0.0;
            (low, high) = if is_low { (middle, high) } else { (low, middle) };
        }
        let speeds = by_bead(&simulation, |slider| simulation.model().slider_speed(slider));
        println!("e = {e}: speeds {speeds:?}, rigid {low} and {}", e * u);
        for (found, expected) in speeds.iter().zip([e * u, low, e * u, low]) {
            assert!((found.abs() - expected).abs() < 5e-6, "{speeds:?}: {expected}");
        }
        // The impulses of the beads are the whole momentum of the tray.
        let given: Vec2 = simulation.arrivals().iter().map(|arrival| arrival.impulse).sum();
        let mass_of_tray = whole - 2.0 * (m + n);
        assert!((given - at(0.0, mass_of_tray * rises(low))).norm() < 2e-5, "{given:?}");
        for invariant in INVARIANTS {
            assert!(simulation.history().drift(invariant) < 1e-13, "{invariant:?}");
        }
    }
}

#[test]
fn mirrored_beads_at_corners_and_ends_stay_mirrored_in_any_order() {
    for (method, stiffness, dt) in [
        (Method::EnergyMomentum, 1e3, 0.01),
        (Method::EnergyMomentum, 1e6, 0.02),
        (Method::FourthOrder, 1e4, 0.05),
    ] {
        let simulated = |order: [usize; 4]| {
            let scene = tray(order, stiffness, 1.0);
            let mut simulation = Simulation::start(scene, settings(method, dt)).unwrap();
            run(&mut simulation, 0.8).unwrap();
            simulation
        };
        let first = simulated([0, 1, 2, 3]);
        assert!(first.arrivals().len() >= 4);
        let time = first.arrivals()[0].time;
        assert!(first.arrivals()[..4].iter().all(|arrival| arrival.time == time));
        let places = |simulation: &Simulation| {
            by_bead(simulation, |slider| simulation.model().slider_arc_length(slider))
        };
        let found = places(&first);
        let length = 2.0 + 2.0 * 2.0_f64.sqrt();
        let off = [found[0] + found[2] - length, found[1] + found[3] - length];
        println!("{method:?}, {stiffness:e}: {} {:?}", sci(&off), first.arrivals()[0].kind);
        assert!(off.iter().all(|off| off.abs() < 1e-12), "{found:?}");
        for invariant in INVARIANTS {
            let drift = first.history().drift(invariant);
            assert!(drift < 1e-11, "{invariant:?}: {drift:e}");
        }
        for order in [[2, 3, 0, 1], [3, 0, 1, 2]] {
            let other = places(&simulated(order));
            assert!(found.iter().zip(other).all(|(a, b)| (a - b).abs() < 1e-12), "{other:?}");
        }
    }
}

#[test]
fn bounce_reports_its_impulse() {
    let mut scene = clamped_rail(&Mesh::bspline(4, 3, 2).unwrap(), at(1.0, 0.0));
    let mut section = scene.beams[0].section.mean();
    (section.axial_stiffness, section.shear_stiffness) = (1e10, 1e10);
    scene.beams[0].section = section.into();
    on_rail(&mut scene, 0.5, 0.3, at(2.0, 0.0), EndAction::Bounce);
    let simulation = simulate(scene, Method::EnergyMomentum, 0.1, 0.5);
    let [bounce] = simulation.arrivals() else { panic!("{:?}", simulation.arrivals()) };
    // The impulse on the rail is twice the momentum of the bead.
    assert!((bounce.impulse - at(1.2, 0.0)).norm() < 1e-6, "{:?}", bounce.impulse);
}
