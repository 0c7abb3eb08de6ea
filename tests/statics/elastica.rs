//! Equilibria of elastic rods in frictionless sleeves. Each sleeve is two rings at a distance. The reference is Euler's elastica, integrated here by a
//! Runge–Kutta method and solved by Newton's method.
//!
//! The problems are the elastica arm scale (Bosi, Misseroni, Dal Corso & Bigoni, Proc. R. Soc. A 470, 2014), the elastica sling (Cazzolli & Dal Corso, Eur. J.
//! Mech. A/Solids 105, 2024) and the blade in a sleeve on a spring (Bigoni, Bosi, Misseroni, Dal Corso & Noselli, 2014–15). The sleeves of the publications
//! have zero length.
#![allow(clippy::unwrap_used)]

use std::f64::consts::{FRAC_PI_4, PI};

use nalgebra::{DMatrix, DVector};

use crate::common::scenes::{add_beam, drive, end_of, line, spring, start_of};
use crate::common::sliding::{particle, slider};
use crate::common::{at, probe::differences};
use withy::beams::{Mesh, Section};
use withy::geometry::Vec2;
use withy::joints::{Component, Components, JointKind, Partner, Slider, SlidingRule};
use withy::loads::{LoadFrame, LoadKind, PrescribedMotion, Schedule};
use withy::statics::{Equilibrium, Loading, Stability};
use withy::system::{Anchor, Scene, SpringKind, SpringLaw};

/// Axial and shear stiffness for `EI = 1`. Elongation and shear change the results by about 1e-6.
const STIFF: f64 = 1e7;

fn rod(scene: &mut Scene, from: Vec2, to: Vec2, spans: usize) -> usize {
    let section = Section {
        axial_stiffness: STIFF,
        shear_stiffness: STIFF,
        bending_stiffness: 1.0,
        mass_per_length: 1.0,
        rotary_inertia: 1e-6,
    };
    add_beam(scene, line(from, to), &Mesh::bspline(spans, 3, 2).unwrap(), section)
}

/// Ring through which the rod slides, at the distance `along` from its start. It is displaced by `by` while the loads increase.
fn ring(scene: &mut Scene, rod: usize, place: Vec2, along: f64, by: Vec2) {
    let station = particle(scene, place, 1.0);
    let motion = |by: f64| PrescribedMotion::Position(growing(by));
    drive(scene, station, &[(Component::X, motion(by.x)), (Component::Y, motion(by.y))]);
    let name = scene.free_name("ring");
    scene.add_slider(Slider { name, ..slider(station, rod, along, SlidingRule::Kinked) }).unwrap();
}

/// Schedule from zero at t = 0 to a value at t = 1.
fn growing(to: f64) -> Schedule {
    let rows = vec![(0.0, 0.0), (0.5, 0.0), (1.0, to)];
    Schedule::table(rows).unwrap()
}

fn rests(scene: Scene, steps: usize) -> Equilibrium {
    let loading = Loading { steps, time: 1.0, ..Loading::default() };
    Equilibrium::find(scene, loading, &mut |_| true).unwrap()
}

fn push(scene: &mut Scene, station: withy::beams::Station, force: Vec2) {
    let kind = LoadKind::Force { station, force, frame: LoadFrame::Dead };
    scene.add_load(kind, Schedule::constant(1.0).unwrap());
}

/// Position, angle and curvature of an elastica.
#[derive(Clone, Copy)]
struct Point([f64; 4]);

impl Point {
    fn place(&self) -> Vec2 {
        at(self.0[0], self.0[1])
    }

    /// `EI κ' = n × x'`, with the force `n` of the part beyond.
    fn rates(&self, force: Vec2) -> [f64; 4] {
        let [_, _, angle, curvature] = self.0;
        let (sine, cosine) = angle.sin_cos();
        [cosine, sine, curvature, force.x * sine - force.y * cosine]
    }

    fn after(&self, by: f64, rates: &[f64; 4]) -> Self {
        Self(std::array::from_fn(|at| self.0[at] + by * rates[at]))
    }

    /// Point at a distance along the elastica, by the Runge–Kutta method of order 4.
    fn on(mut self, force: Vec2, length: f64) -> Self {
        let steps = 400;
        let h = length / f64::from(steps);
        for _ in 0..steps {
            let a = self.rates(force);
            let b = self.after(0.5 * h, &a).rates(force);
            let c = self.after(0.5 * h, &b).rates(force);
            let d = self.after(h, &c).rates(force);
            self = Self(std::array::from_fn(|at| {
                self.0[at] + h / 6.0 * (a[at] + 2.0 * b[at] + 2.0 * c[at] + d[at])
            }));
        }
        self
    }

    /// Section force behind a ring that pushes transversely on the rod.
    fn behind(&self, force: Vec2, push: f64) -> Vec2 {
        let (sine, cosine) = self.0[2].sin_cos();
        force - at(-sine, cosine) * push
    }
}

/// Solution of the equations near an initial guess, by Newton's method.
fn solve(mut unknowns: Vec<f64>, equations: &mut dyn FnMut(&[f64]) -> Vec<f64>) -> Vec<f64> {
    for _ in 0..30 {
        let value = DVector::from_vec(equations(&unknowns));
        if value.amax() < 1e-12 {
            return unknowns;
        }
        let slope: DMatrix<f64> = differences(&unknowns, 1e-5, equations);
        let step = slope.lu().solve(&value).unwrap();
        unknowns.iter_mut().zip(step.iter()).for_each(|(unknown, by)| *unknown -= by);
    }
    panic!("no elastica: {unknowns:?}");
}

#[test]
fn sling_in_sleeves_agrees_with_the_elastica() {
    // Sleeves of length a with mouths at ±d/2 = ±0.5, inclined by 45°. The middle is supported along x.
    let (half, length) = (1.6, 0.2);
    let mut scene = Scene::new("sling");
    let rod = rod(&mut scene, at(-half, 0.0), at(half, 0.0), 257);
    let crown = scene.station(rod, half).unwrap();
    scene.join(JointKind::Support(Components::X), crown, Partner::Ground).unwrap();
    let (sine, cosine) = FRAC_PI_4.sin_cos();
    for side in [-1.0, 1.0] {
        for back in [length, 0.0] {
            let place = side * (0.5 + back);
            let by = at(side * back * (cosine - 1.0), -back * sine);
            ring(&mut scene, rod, at(place, 0.0), half + place, by);
        }
    }
    let rest = rests(scene, 10);
    assert_eq!(rest.stability(&mut || true), Stability::Stable);
    let model = rest.model();
    let along = |ring: usize| model.slider_arc_length(ring);
    let (arc, rise) = (
        along(3) - along(1),
        model.position(&rest.scene().place(&crown, model.meshes()).unwrap()).y,
    );
    let thrust = (model.contact_force(0) + model.contact_force(1)).x;

    let end = at(-0.5 - length * cosine, -length * sine);
    let crown_of = |u: &[f64]| {
        let start = Point([end.x, end.y, u[0], 0.0]);
        let force = start.behind(Vec2::zeros(), u[1]);
        let mouth = start.on(force, u[2]);
        let force = mouth.behind(force, u[3]);
        (mouth, mouth.on(force, u[4]), force)
    };
    let (outer, inner) = (model.contact_force(0), model.contact_force(1));
    let across = at(-sine, cosine);
    let guess = vec![FRAC_PI_4 + 0.04, outer.dot(&across), length, inner.dot(&across), 0.5 * arc];
    let found = solve(guess, &mut |u| {
        let (mouth, crown, force) = crown_of(u);
        let off = mouth.place() - at(-0.5, 0.0);
        vec![off.x, off.y, crown.0[2], crown.0[0], force.y]
    });
    let (_, crown, force) = crown_of(&found);
    println!(
        "sling: arc {arc} for {}, rise {rise} for {}, thrust {thrust} for {}",
        2.0 * found[4],
        crown.0[1],
        force.x
    );
    assert!((arc - 2.0 * found[4]).abs() < 2e-6);
    assert!((rise - crown.0[1]).abs() < 2e-6);
    assert!((thrust.abs() - force.x.abs()).abs() < 1e-4 * force.x.abs());
    // For sleeves of zero length: P d²/EI = 1.1079741491, arc/d 1.11634123. The flexibility within sleeves of length a changes both.
    assert!((arc - 1.11634123).abs() < 0.03 && (thrust.abs() - 1.1079741491).abs() < 0.2);
}

#[test]
fn arm_scale_agrees_with_the_elastica() {
    // Sleeve of length a, inclined by 30°, with forces of 4 on the right arm and 1 on the left arm. This equilibrium is unstable, so the right tip is
    // supported along x, where the reaction vanishes.
    let (inclination, right, left, length, arm) = (PI / 6.0, 4.0, 1.0, 0.2, 0.62);
    let along = at(inclination.cos(), inclination.sin());
    let held = |moved: f64| {
        let mut scene = Scene::new("arm scale");
        let rod = rod(&mut scene, along * (arm - 1.0), along * arm, 257);
        for place in [-0.5 * length, 0.5 * length] {
            ring(&mut scene, rod, along * place, 1.0 - arm + place, Vec2::zeros());
        }
        let (start, tip) = (start_of(&mut scene, rod), end_of(&mut scene, rod));
        drive(&mut scene, tip, &[(Component::X, PrescribedMotion::Position(growing(moved)))]);
        push(&mut scene, start, at(0.0, -left));
        push(&mut scene, tip, at(0.0, -right));
        let mut rest = rests(scene, 8);
        let place = rest.scene().place(&tip, rest.model().meshes()).unwrap();
        let pull = rest.reaction(&place).unwrap().0.x;
        (rest, pull)
    };
    let (mut before, mut now) = (0.0, 0.02);
    let (mut pull_before, (mut rest, mut pull)) = (held(before).1, held(now));
    for _ in 0..8 {
        if pull.abs() < 1e-9 {
            break;
        }
        let next = now - pull * (now - before) / (pull - pull_before);
        (before, pull_before, now) = (now, pull, next);
        (rest, pull) = held(now);
    }
    assert!(pull.abs() < 1e-9, "{pull}");
    let model = rest.model();
    let middle = 0.5 * (model.slider_arc_length(0) + model.slider_arc_length(1));
    let (start_angle, end_angle) = model.end_angles(0);

    let rings = [-0.5 * length, 0.5 * length].map(|place| along * place);
    let tip_of = |u: &[f64]| {
        let start = Point([u[0], u[1], u[2], 0.0]);
        let force = at(0.0, left);
        let first = start.on(force, u[3]);
        let force = first.behind(force, u[4]);
        let second = first.on(force, u[5]);
        let force = second.behind(force, u[6]);
        (first, second, second.on(force, 1.0 - u[3] - u[5]), force)
    };
    let start = model.control_points().next().unwrap()[0];
    let (first, second) = (model.contact_force(0), model.contact_force(1));
    let across = at(-along.y, along.x);
    let guess = vec![
        start.x,
        start.y,
        start_angle,
        model.slider_arc_length(0),
        first.dot(&across),
        model.slider_arc_length(1) - model.slider_arc_length(0),
        second.dot(&across),
    ];
    let found = solve(guess, &mut |u| {
        let (first, second, tip, force) = tip_of(u);
        let (a, b) = (first.place() - rings[0], second.place() - rings[1]);
        vec![a.x, a.y, b.x, b.y, tip.0[3], force.x, force.y + right]
    });
    let (_, _, tip, _) = tip_of(&found);
    let exact = 1.0 - found[3] - 0.5 * found[5];
    println!(
        "arm scale: arm {} for {exact}, tips {end_angle} for {}, {start_angle} for {}",
        1.0 - middle,
        tip.0[2],
        found[2]
    );
    assert!((1.0 - middle - exact).abs() < 5e-6);
    assert!((end_angle - tip.0[2]).abs() < 1e-5 && (start_angle - found[2]).abs() < 1e-5);
    // Equilibrium of the arms for sleeves of any length: P1 sin(-θ1) = P2 sin(-θ2).
    let balance = right * (-end_angle).sin() - left * start_angle.sin();
    assert!(balance.abs() < 5e-5, "{balance}");
}

#[test]
fn a_blade_in_a_sleeve_on_a_spring_is_stable_unstable_and_stable_again() {
    // Behind the mouth, the blade has the length b + P/k and an end that slides without rotation. It acts as a torsion spring on the free part.
    let (spring_stiffness, behind) = (15.0, 0.05);
    let criterion = |load: f64| {
        let (wave, free) = (load.sqrt(), 1.0 - load / spring_stiffness);
        let rear = behind + load / spring_stiffness;
        let u = wave * rear;
        let (sine, cosine) = u.sin_cos();
        let held = u / rear * (sine - u * cosine) / (2.0 * (1.0 - cosine) - u * sine);
        wave * (wave * free).sin() - held * (wave * free).cos()
    };
    let between = |mut low: f64, mut high: f64| {
        for _ in 0..60 {
            let middle = 0.5 * (low + high);
            if criterion(low) * criterion(middle) <= 0.0 { high = middle } else { low = middle }
        }
        low
    };
    let is_stable = |load: f64| {
        let mut scene = Scene::new("blade");
        let blade = rod(&mut scene, at(-behind, 0.0), at(1.0, 0.0), 84);
        let (start, tip) = (start_of(&mut scene, blade), end_of(&mut scene, blade));
        let guided = JointKind::Support(Components::YRotation);
        scene.join(guided, start, Partner::Ground).unwrap();
        let mouth = particle(&mut scene, at(0.0, 0.0), 1.0);
        scene.join(JointKind::Hinge, mouth, Partner::Ground).unwrap();
        scene.add_slider(slider(mouth, blade, behind, SlidingRule::Kinked)).unwrap();
        let anchors = vec![Anchor::Ground(at(-1.0 - behind, 0.0)), Anchor::Station(start)];
        let law = SpringLaw::Linear { stiffness: spring_stiffness, natural: 1.0 };
        spring(&mut scene, SpringKind::Length(anchors), law, 0.0);
        push(&mut scene, tip, at(-load, 0.0));
        rests(scene, 1).stability(&mut || true)
    };
    let (first, last) = (between(3.0, 4.0), between(11.0, 12.0));
    println!("blade: unstable between {first} and {last}");
    assert_eq!(is_stable(first * (1.0 - 1e-5)), Stability::Stable);
    assert_eq!(is_stable(first * (1.0 + 1e-5)), Stability::Unstable);
    assert_eq!(is_stable(last * (1.0 - 1e-5)), Stability::Unstable);
    assert_eq!(is_stable(last * (1.0 + 1e-5)), Stability::Stable);
}
