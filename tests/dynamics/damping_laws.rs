//! Dampers with nonlinear force laws: a closed form with every integrator, and the energy balance.
#![allow(clippy::unwrap_used)]

use crate::common::scenes::absorber;
use crate::common::{at, orders, sci, simulate};
use withy::beams::Station;
use withy::integrators::{EnergyClaim, INTEGRATORS, Method};
use withy::simulation::{Invariant, Simulation};
use withy::system::{
    Anchor, DampingLaw, Origin, ParticleDefinition, Scene, Spring, SpringKind, SpringLaw,
    StationVelocity, SystemError,
};

const MASS: f64 = 2.0;
const DRAG: f64 = 0.8;
const SPEED: f64 = 3.0;

fn damped(law: DampingLaw, speed: f64) -> Scene {
    let mut scene = Scene::new("bead");
    let bead = ParticleDefinition { name: "bead".to_owned(), position: at(6.0, 1.0) };
    let station = scene.add_particle(bead, MASS).unwrap();
    scene.velocities.push(StationVelocity { station, velocity: at(speed, 0.0), spin: None });
    let kind = SpringKind::Length(vec![Anchor::Ground(at(1.0, 1.0)), Anchor::Station(station)]);
    let (name, origin) = ("oil".to_owned(), Origin::Zero);
    scene.add_spring(Spring { name, kind, law: None, origin, damping: law, rest: None }).unwrap();
    scene
}

/// `c |q̇| q̇` as a piecewise linear law with steps `h`, with an error of `c h²/4`.
fn fluid() -> DampingLaw {
    let corners = (-4000..=4000).map(|at| f64::from(at) * 1e-3);
    absorber(&corners.map(|rate| (rate, DRAG * rate.abs() * rate)).collect::<Vec<_>>())
}

fn place(simulation: &Simulation) -> f64 {
    simulation.model().control_points().next().unwrap()[0].x - 6.0
}

#[test]
fn bead_in_a_fluid_converges_at_the_order_of_the_method() {
    let (end, rate) = (2.0, DRAG / MASS);
    let expected = (1.0 + rate * SPEED * end).ln() / rate;
    for entry in INTEGRATORS {
        let error = |dt: f64| {
            (place(&simulate(damped(fluid(), SPEED), entry.method, dt, end)) - expected).abs()
        };
        let steps = if entry.claims.order == 4 { [0.8, 0.4, 0.2] } else { [0.1, 0.05, 0.025] };
        let errors = steps.map(error);
        let found = orders(&errors);
        println!("{:18} {} {found:.2?}", entry.name, sci(&errors));
        let near = if entry.claims.order == 4 { 0.5 } else { 0.25 };
        let last = *found.last().unwrap();
        assert!(
            last > f64::from(entry.claims.order) - near,
            "{}: {} {found:.2?}",
            entry.name,
            sci(&errors)
        );
    }
}

#[test]
fn energy_balance_includes_nondecreasing_dissipation_of_damping_laws() {
    let one_sided = absorber(&[(-1.0, 0.0), (0.0, 0.0), (0.5, 2.0), (1.0, 2.0)]);
    let corner = absorber(&[(-3.0, -3.0), (-1e-3, -3.0), (1e-3, 3.0), (3.0, 3.0)]);
    for (law, speed) in
        [(fluid(), -SPEED), (one_sided.clone(), SPEED), (one_sided, -1.0), (corner, SPEED)]
    {
        for dt in [0.03, 0.3] {
            let simulation = simulate(damped(law.clone(), speed), Method::EnergyMomentum, dt, 1.5);
            let history = simulation.history();
            for (name, invariant) in Invariant::ALL {
                let drift = history.drift(invariant);
                assert!(drift < 1e-13, "{name}, {dt}: {drift:.1e}");
            }
            let taken: Vec<f64> =
                history.samples().iter().map(|row| row.measures.dissipated).collect();
            assert!(taken.windows(2).all(|pair| pair[1] >= pair[0]), "{taken:?}");
            let all = speed * speed * MASS * 0.5;
            let is_free = speed == -1.0;
            assert!((*taken.last().unwrap() > 0.2 * all) != is_free, "{taken:?}");
        }
    }
}

/// Dry friction as a steep linear law stops a bead when its kinetic energy is dissipated, at any step size.
#[test]
fn saturated_damper_brakes_with_its_limit_force() {
    let law = absorber(&[(-1.0, -3.0), (-1e-6, -3.0), (1e-6, 3.0), (1.0, 3.0)]);
    for entry in INTEGRATORS.iter().filter(|entry| entry.claims.energy == EnergyClaim::Conserved) {
        let dt = if entry.claims.order == 4 { 0.01 } else { 0.1 };
        let simulation = simulate(damped(law.clone(), SPEED), entry.method, dt, 1.0);
        let expected = SPEED - 0.5 * 3.0 / MASS;
        assert!((place(&simulation) - expected).abs() < 1e-12, "{}", entry.name);
    }
}

/// Mass on a spring with dry friction as a steep linear law. The amplitude decreases by `2 F/k` per half period until the friction force holds the mass. From
/// 1 it comes to rest at 0.05, after seven half periods.
#[test]
fn dry_friction_stops_a_mass_after_the_exact_number_of_half_swings() {
    let (force, stiffness) = (0.3, 4.0);
    for steepness in [1e-3, 1e-6, 1e-9] {
        let corners = [(-1.0, -force), (-steepness, -force), (steepness, force), (1.0, force)];
        for entry in INTEGRATORS.iter().filter(|entry| entry.claims.order > 1) {
            for dt in [0.02, 0.0173] {
                let mut scene = damped(absorber(&corners), 0.0);
                let bead = Anchor::Station(Station::on_particle(0));
                let law = SpringLaw::Linear { stiffness: stiffness * MASS, natural: 2.0 };
                let kind = SpringKind::Length(vec![Anchor::Ground(at(3.0, 1.0)), bead]);
                let mut spring = scene.springs().next().unwrap().clone();
                spring.damping =
                    absorber(&corners.map(|(rate, force)| (rate, force * (MASS - 1.0))));
                spring.name = "spring".to_owned();
                (spring.kind, spring.law) = (kind, Some(law));
                scene.add_spring(spring).unwrap();
                let label = format!("{}, {steepness:e}, {dt}", entry.name);
                let simulation = simulate(scene, entry.method, dt, 12.0);
                let rest = place(&simulation) + 1.0;
                let near = 2e-3 + 20.0 * steepness;
                assert!((rest - 0.05).abs() < near, "{label}: {rest}");
                let work = simulation.counts();
                println!("{label}: {rest} {} steps, {} retries", work.steps, work.retries);
                if entry.claims.energy == EnergyClaim::Conserved {
                    let drift = simulation.history().drift(Invariant::Energy);
                    assert!(drift < 1e-12, "{label}: {drift:.1e}");
                }
            }
        }
    }
}

#[test]
fn damping_law_that_adds_energy_is_rejected() {
    let mut scene = damped(DampingLaw::Linear(1.0), 0.0);
    let mut spring = scene.springs().next().unwrap().clone();
    spring.name = "other".to_owned();
    spring.damping = absorber(&[(-1.0, 1.0), (0.0, 0.0), (1.0, 1.0)]);
    let refused = scene.add_spring(spring.clone());
    let message = "at the rate -1 its damping force is 1 and adds energy";
    let is_told = |error: &SystemError| error.to_string().contains(message);
    assert!(refused.as_ref().is_err_and(is_told), "{refused:?}");
    // The law is extrapolated linearly beyond its last rate.
    spring.damping = absorber(&[(-1.0, -1.0), (0.0, 0.0), (1.0, 1.0), (2.0, 0.5)]);
    let refused = scene.add_spring(spring.clone()).unwrap_err().to_string();
    assert!(
        refused.contains("beyond its last rate 2,") && refused.contains("from the rate 3 on"),
        "{refused}"
    );
    spring.damping = DampingLaw::Linear(-1.0);
    assert!(matches!(scene.add_spring(spring), Err(SystemError::Value { .. })));
}
