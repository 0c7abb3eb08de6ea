//! Static friction of sliders: stick–slip of a block on a belt, and the start of a slip.
#![allow(clippy::unwrap_used)]

use crate::common::scenes::{add_beam, line, spring};
use crate::common::sliding::{STIFF, moving_particle};
use crate::common::{at, orders, run, sci, settings};
use withy::beams::{Mesh, Section};
use withy::geometry::Vec2;
use withy::integrators::Method;
use withy::joints::{JointKind, Partner, Slider};
use withy::loads::{LoadFrame, LoadKind, PrescribedMotion, Schedule};
use withy::simulation::{Invariant, Simulation};
use withy::system::{Anchor, Drive, DriveKind, Scene, SpringKind, SpringLaw, StartMotion};

const WEIGHT: f64 = 9.81;
const STIFFNESS: f64 = 20.0;
const BELT: f64 = 0.5;
const FRICTION: f64 = 0.2;
const STATIC_FRICTION: f64 = 0.4;

/// Section so stiff that the vibration of the belt under the weight of the block, which starts at rest without deflection, does not change the
/// filtered normal force in the time of the test.
const RIGID: Section = Section { shear_stiffness: 1e15, bending_stiffness: 1e15, ..STIFF };

/// Block of mass 1 on a belt with the speed `BELT`, held back by a spring that is relaxed at the start.
fn belt(friction: f64, static_friction: f64) -> Scene {
    let mut scene = Scene::new("belt");
    let mesh = Mesh::bspline(6, 3, 2).unwrap();
    let velocity = at(BELT, 0.0);
    let rod = add_beam(&mut scene, line(at(-6.0, 0.0), at(6.0, 0.0)), &mesh, RIGID);
    scene.beams[rod].motion = StartMotion { velocity, ..StartMotion::default() };
    let rate = |rate: f64| Some(PrescribedMotion::Rate(Schedule::Constant(rate)));
    for (along, motions) in [(0.0, [rate(BELT), rate(0.0), None]), (12.0, [None, rate(0.0), None])]
    {
        let station = scene.station(rod, along).unwrap();
        let name = format!("drive at {along}");
        scene.drives.push(Drive { name, kind: DriveKind::Move, station, motions });
    }
    scene.gravity = at(0.0, -WEIGHT);
    let block = moving_particle(&mut scene, Vec2::zeros(), velocity, 1.0);
    let anchors = vec![Anchor::Ground(at(-10.0, 0.0)), Anchor::Station(block)];
    let law = SpringLaw::Linear { stiffness: STIFFNESS, natural: 10.0 };
    spring(&mut scene, SpringKind::Length(anchors), law, 0.0);
    let slider = Slider::new("slider1", block, rod, 6.0);
    let static_friction = Some(static_friction);
    scene.add_slider(Slider { friction, static_friction, ..slider }).unwrap();
    scene
}

/// Elongation of the spring (closed form). The block sticks until the spring force is `μ_s N`. It then oscillates about the elongation `μ N/k`
/// until its velocity equals that of the belt, with the amplitude from `μ_s - μ` and the speed of the belt.
struct StickSlip {
    middle: f64,
    half: f64,
    omega: f64,
}

impl StickSlip {
    fn new() -> Self {
        let elongation = |coefficient: f64| coefficient * WEIGHT / STIFFNESS;
        let middle = elongation(FRICTION);
        Self { middle, half: elongation(STATIC_FRICTION) - middle, omega: STIFFNESS.sqrt() }
    }

    fn slip_duration(&self) -> f64 {
        2.0 * (std::f64::consts::PI - (self.half * self.omega / BELT).atan()) / self.omega
    }

    fn period(&self) -> f64 {
        self.slip_duration() + 2.0 * self.half / BELT
    }

    fn elongation(&self, time: f64) -> f64 {
        let first_slip = (self.middle + self.half) / BELT;
        if time < first_slip {
            return BELT * time;
        }
        let phase = (time - first_slip) % self.period();
        match phase < self.slip_duration() {
            true => {
                let angle = self.omega * phase;
                self.middle + self.half * angle.cos() + BELT / self.omega * angle.sin()
            }
            false => self.middle - self.half + BELT * (phase - self.slip_duration()),
        }
    }

    /// Work of the friction on the slip of one period [energy].
    fn loss(&self) -> f64 {
        FRICTION * WEIGHT * BELT * self.period()
    }
}

fn elongation(simulation: &Simulation) -> f64 {
    let along = simulation.model().slider_arc_length(0) - 6.0;
    along + BELT * simulation.time()
}

#[test]
fn a_block_on_a_belt_sticks_and_slips_with_second_order() {
    let exact = StickSlip::new();
    // Times within the third slip, and within the phase of sticking after it.
    let third = (exact.middle + exact.half) / BELT + 2.0 * exact.period();
    let ends = [third + 0.4 * exact.slip_duration(), third + exact.slip_duration() + 0.2];
    let errors = [0.04, 0.02, 0.01, 0.005].map(|dt| {
        let mut simulation = Simulation::start(
            belt(FRICTION, STATIC_FRICTION),
            settings(Method::EnergyMomentum, dt),
        )
        .unwrap();
        let errors = ends.map(|end| {
            run(&mut simulation, end).unwrap();
            (elongation(&simulation) - exact.elongation(end)).abs()
        });
        for (name, invariant) in Invariant::ALL {
            let drift = simulation.history().drift(invariant);
            assert!(drift < 1e-11, "{dt}: {name} drifts by {drift:e}");
        }
        let lost = *simulation.history().column("dissipated.slider1").unwrap().last().unwrap();
        assert!((lost / (3.0 * exact.loss()) - 1.0).abs() < 0.1 * dt, "{dt}: {lost}");
        errors
    });
    for end in [0, 1] {
        let of_end = errors.map(|errors| errors[end]);
        println!("{}: {:?}", sci(&of_end), orders(&of_end));
        assert!(of_end[3] < 2e-4, "{of_end:?}");
        assert!((of_end[0] / of_end[3]).log2() / 3.0 > 1.7, "{of_end:?}");
    }
}

/// With equal coefficients, the block sticks until the spring force reaches the friction, and then remains in place.
#[test]
fn equal_coefficients_give_steady_slip() {
    let simulation = |static_friction| {
        let scene = belt(FRICTION, static_friction);
        let mut simulation =
            Simulation::start(scene, settings(Method::EnergyMomentum, 0.01)).unwrap();
        run(&mut simulation, 1.5).unwrap();
        simulation
    };
    let steady = simulation(FRICTION);
    let mut scene = belt(FRICTION, FRICTION);
    scene.sliders[0].static_friction = None;
    let mut without = Simulation::start(scene, settings(Method::EnergyMomentum, 0.01)).unwrap();
    run(&mut without, 1.5).unwrap();
    assert_eq!(elongation(&steady).to_bits(), elongation(&without).to_bits());
    assert!((elongation(&simulation(STATIC_FRICTION)) - elongation(&steady)).abs() > 0.01);
}

/// A block on an incline stays if `tan α < μ_s`, and slides from the start otherwise.
#[test]
fn a_block_at_rest_slides_above_the_static_friction() {
    for (degrees, slides) in [(20.0_f64, false), (23.0, true)] {
        let mut scene = Scene::new("incline");
        let mesh = Mesh::bspline(4, 3, 2).unwrap();
        let uphill = withy::geometry::unit(degrees.to_radians());
        let rod = add_beam(&mut scene, line(uphill * -5.0, uphill * 5.0), &mesh, STIFF);
        for along in [0.0, 10.0] {
            let end = scene.station(rod, along).unwrap();
            scene.join(JointKind::Rigid, end, Partner::Ground).unwrap();
        }
        scene.gravity = at(0.0, -WEIGHT);
        let block = moving_particle(&mut scene, Vec2::zeros(), Vec2::zeros(), 1.0);
        let slider = Slider::new("slider1", block, rod, 5.0);
        let (friction, static_friction) = (FRICTION, Some(STATIC_FRICTION));
        scene.add_slider(Slider { friction, static_friction, ..slider }).unwrap();
        let mut simulation =
            Simulation::start(scene, settings(Method::EnergyMomentum, 0.02)).unwrap();
        run(&mut simulation, 1.0).unwrap();
        let (sin, cos) = degrees.to_radians().sin_cos();
        let exact = if slides { 0.5 * WEIGHT * (sin - FRICTION * cos) } else { 0.0 };
        let moved = 5.0 - simulation.model().slider_arc_length(0);
        assert!((moved - exact).abs() < 1e-5, "{degrees}°: {moved} {exact}");
    }
}

#[test]
fn static_friction_below_friction_is_rejected() {
    let mut scene = belt(FRICTION, STATIC_FRICTION);
    let slider = Slider { static_friction: Some(0.1), ..scene.sliders[0].clone() };
    scene.sliders.clear();
    let error = scene.add_slider(slider).unwrap_err().to_string();
    assert_eq!(
        error,
        "slider 'slider1': static_friction is 0.1, but must be at least friction, which is 0.2"
    );
}

/// Force along a block at rest on a rail: slip starts where a ramp passes the static friction, and at a jump of the force.
/// The steps are so long that the limit is passed in the first steps.
#[test]
fn loads_start_a_slip_in_the_first_steps() {
    let limit = STATIC_FRICTION * WEIGHT;
    let slip = FRICTION * WEIGHT;
    let ramp = [(0.0, 0.0), (1.0, 2.0 * limit)];
    let jump = [(0.0, 0.0), (0.3, 0.0), (0.3, 1.25 * limit), (1.0, 1.25 * limit)];
    // Impulses from the start of the slip to t = 1: on the ramp, the mean force of the second half is 1.5 limits.
    let exact = [0.5 * (1.5 * limit - slip), 0.7 * (1.25 * limit - slip)];
    for (points, exact) in [(ramp.to_vec(), exact[0]), (jump.to_vec(), exact[1])] {
        for dt in [0.5, 0.4, 0.2, 0.1, 0.05] {
            let mut scene = Scene::new("rail");
            let mesh = Mesh::bspline(4, 3, 2).unwrap();
            let rod = add_beam(&mut scene, line(at(-5.0, 0.0), at(5.0, 0.0)), &mesh, RIGID);
            for along in [0.0, 10.0] {
                let end = scene.station(rod, along).unwrap();
                scene.join(JointKind::Rigid, end, Partner::Ground).unwrap();
            }
            scene.gravity = at(0.0, -WEIGHT);
            let block = moving_particle(&mut scene, Vec2::zeros(), Vec2::zeros(), 1.0);
            let slider = Slider::new("slider1", block, rod, 5.0);
            let (friction, static_friction) = (FRICTION, Some(STATIC_FRICTION));
            scene.add_slider(Slider { friction, static_friction, ..slider }).unwrap();
            let push =
                LoadKind::Force { station: block, force: at(1.0, 0.0), frame: LoadFrame::Dead };
            scene.add_load(push, Schedule::Table(points.clone()));
            let mut simulation =
                Simulation::start(scene, settings(Method::EnergyMomentum, dt)).unwrap();
            run(&mut simulation, 1.0).unwrap();
            let velocity = simulation.history().samples().last().unwrap().measures.momentum.x;
            assert!((velocity - exact).abs() < 0.02 * exact, "{dt}: {velocity} {exact}");
        }
    }
}
