//! Sweeps and random scenes of obstacles with friction and unilateral sliders: balances at rounding, and bounds of the number of failed runs.
#![allow(clippy::unwrap_used)]

use super::obstacles::{disc, wall};
use crate::common::scenes::{add_beam, line};
use crate::common::sliding::particle;
use crate::common::{Random, at, settings};
use withy::beams::{Mesh, Section, Station};
use withy::geometry::{Vec2, perpendicular, unit};
use withy::integrators::Method;
use withy::joints::{JointKind, Partner, Restraint, Side, Slider};
use withy::simulation::{Invariant, NoMonitor, Simulation, SimulationError};
use withy::system::{
    ContactTarget, Obstacle, ObstacleShape, RigidBodyDefinition, Scene, StartMotion,
    StationVelocity,
};

fn is_long() -> bool {
    std::env::var_os("WITHY_LONG").is_some()
}

/// Largest drift of the balances of energy and momenta in a run to a time.
fn drift_of_run(scene: Scene, dt: f64, end: f64) -> Result<f64, SimulationError> {
    let mut simulation = Simulation::start(scene, settings(Method::EnergyMomentum, dt))?;
    simulation.run_to(end, &mut NoMonitor)?;
    let drift = |(_, invariant)| simulation.history().drift(invariant);
    Ok(Invariant::ALL.into_iter().map(drift).fold(0.0, f64::max))
}

/// Results of many runs.
#[derive(Debug, Default)]
struct Tally {
    runs: usize,
    failures: usize,
    /// Largest drift of the runs that complete [-].
    drift: f64,
}

impl Tally {
    fn add(&mut self, label: &str, run: Result<f64, SimulationError>) {
        self.runs += 1;
        match run {
            Ok(drift) => self.drift = self.drift.max(drift),
            Err(error) => {
                println!("{label}: {error}");
                self.failures += 1;
            }
        }
    }
}

/// Body of mass 1 above a floor. Its contact surface is a circle about a point.
fn wheel(radius: f64, inertia: f64, offset: Vec2, floor: Obstacle) -> Scene {
    let mut scene = Scene::new("wheel");
    scene.gravity = at(0.1, -1.0);
    let wheel = RigidBodyDefinition {
        name: "wheel".into(),
        position: at(0.0, 1.0),
        angle: 0.0,
        points: vec![("rim".into(), offset)],
        outline: Vec::new(),
        motion: StartMotion::default(),
    };
    let body = scene.add_rigid_body(wheel, 1.0, inertia).unwrap();
    let point = usize::from(offset != Vec2::zeros());
    let targets = vec![ContactTarget::Point(Station::on_rigid_body(body, point))];
    scene.add_obstacle(Obstacle { radius, targets, ..floor }).unwrap();
    scene
}

fn wheels(offset: Vec2) -> Tally {
    let mut tally = Tally::default();
    let stiffnesses: &[f64] =
        if is_long() { &[1e2, 1e4, 1e6, 1e7, 1e9, 1e10] } else { &[1e6, 1e9] };
    let steps: &[f64] = if is_long() { &[1e-3, 0.01, 0.03, 0.1] } else { &[0.03, 0.1] };
    for (stiffness, dt) in stiffnesses.iter().flat_map(|k| steps.iter().map(move |dt| (*k, *dt))) {
        for (restitution, friction) in
            [0.1, 0.5, 1.0].into_iter().flat_map(|e| [0.1, 0.5, 1.2].map(|mu| (e, mu)))
        {
            for (radius, inertia) in [0.05, 0.5, 1.0]
                .into_iter()
                .flat_map(|radius| [0.01, 0.1, 0.5, 10.0].map(|inertia| (radius, inertia)))
            {
                let floor = wall(Vec2::zeros(), at(0.0, 1.0), stiffness, restitution);
                let scene = wheel(radius, inertia, offset, Obstacle { friction, ..floor });
                let label = format!(
                    "k {stiffness:e}, dt {dt}, e {restitution}, μ {friction}, r {radius}, J {inertia}"
                );
                tally.add(&label, drift_of_run(scene, dt, (60.0 * dt).clamp(0.5, 4.0)));
            }
        }
    }
    println!("{offset:?}: {tally:?}");
    tally
}

#[test]
fn wheels_with_friction_run_at_any_stiffness_and_step() {
    let tally = wheels(Vec2::zeros());
    assert!(tally.failures == 0 && tally.drift < 1e-9, "{tally:?}");
}

/// At a contact point off the centre, the friction force changes the normal velocity. The runs that fail have a ratio of both above 1 (Painlevé).
#[test]
fn bodies_with_friction_at_eccentric_points_run_with_few_failures() {
    let tally = wheels(at(0.2, -0.1));
    assert!(100 * tally.failures <= tally.runs && tally.drift < 1e-8, "{tally:?}");
}

/// Draw of random numbers, with a rotated or mirrored frame of the scene.
struct Draw {
    random: Random,
    angle: f64,
    /// 1, or -1 for a mirrored scene.
    mirror: f64,
}

impl Draw {
    /// Draws of the same numbers for a scene and for its rotated and mirrored copies.
    fn copies(seed: u64) -> [Self; 3] {
        [(0.0, 1.0), (0.7, 1.0), (-2.1, -1.0)].map(|(angle, mirror)| Self {
            random: Random(seed),
            angle,
            mirror,
        })
    }

    fn between(&mut self, low: f64, high: f64) -> f64 {
        low + (high - low) * 0.5 * (self.random.next() + 1.0)
    }

    /// Random number between powers of ten, with logarithmic distribution.
    fn power(&mut self, low: f64, high: f64) -> f64 {
        10.0_f64.powf(self.between(low, high))
    }

    fn one_of<T: Copy>(&mut self, of: &[T]) -> T {
        of[((self.between(0.0, 1.0) * of.len() as f64) as usize).min(of.len() - 1)]
    }

    fn vector(&self, x: f64, y: f64) -> Vec2 {
        unit(self.angle) * x + perpendicular(unit(self.angle)) * (self.mirror * y)
    }
}

fn flexible(draw: &mut Draw) -> Section {
    Section {
        axial_stiffness: 1e4,
        shear_stiffness: 4e3,
        bending_stiffness: draw.power(-1.0, 2.0),
        mass_per_length: draw.power(-2.0, 0.0),
        rotary_inertia: 1e-4,
    }
}

/// Flexible beam and a rigid body that move against a floor and a peg with friction. Distances scale with the step, so contact starts within a few steps.
fn obstacles(draw: &mut Draw, dt: f64) -> Scene {
    let mut scene = Scene::new("obstacles");
    let speed = draw.between(0.5, 3.0);
    let height = speed * dt * draw.between(0.0, 10.0);
    let [aside, weight, drift] =
        [(-1.0, 1.0), (1.0, 10.0), (-2.0, 2.0)].map(|(low, high)| draw.between(low, high));
    scene.gravity = draw.vector(aside, -weight);
    let motion = StartMotion {
        velocity: draw.vector(drift, -speed),
        spin: draw.mirror * draw.between(-3.0, 3.0),
        centre: None,
    };
    let radius = draw.between(0.0, 0.3);
    let section = flexible(draw);
    let tilt = 0.2 * draw.between(0.0, 1.0);
    let ends = [draw.vector(0.0, radius + height), draw.vector(1.5, radius + height + tilt)];
    let mesh = Mesh::bspline(6, 3, 2).unwrap();
    let rod = add_beam(&mut scene, line(ends[0], ends[1]), &mesh, section);
    scene.beams[rod].motion = motion;
    let (mass, inertia) = (draw.power(-1.0, 1.0), draw.power(-2.0, 1.0));
    let offset = at(draw.between(-0.2, 0.2), draw.mirror * draw.between(-0.2, 0.2));
    let definition = RigidBodyDefinition {
        name: "wheel".into(),
        position: draw.vector(-1.0, radius + height + 0.3),
        angle: draw.angle,
        points: vec![("rim".into(), offset)],
        outline: Vec::new(),
        motion,
    };
    let wheel = scene.add_rigid_body(definition, mass, inertia).unwrap();
    let centre = ContactTarget::Point(Station::on_rigid_body(wheel, 0));
    let targets = vec![ContactTarget::Beam(rod), centre];
    let (stiffness, restitution) = (draw.power(2.0, 10.0), draw.between(0.05, 1.0));
    let friction = draw.one_of(&[0.0, 0.2, 0.5, 1.0]);
    let floor = wall(Vec2::zeros(), draw.vector(0.0, 1.0), stiffness, restitution);
    let floor = Obstacle { friction, radius, targets: targets.clone(), ..floor };
    scene.add_obstacle(floor).unwrap();
    let peg = disc(draw.vector(0.7, -0.3), 0.3, stiffness, restitution);
    let shape = ObstacleShape::Disc { centre: draw.vector(0.7, -0.3), radius: 0.31 };
    scene.add_obstacle(Obstacle { friction, radius, targets, shape, ..peg }).unwrap();
    scene
}

/// Particles that fall on a hinged flexible beam, with unilateral sliders on one of its sides.
fn unilateral_sliders(draw: &mut Draw) -> Scene {
    let mut scene = Scene::new("unilateral sliders");
    let section = flexible(draw);
    let ends = [draw.vector(-1.0, 0.0), draw.vector(1.0, 0.0)];
    let mesh = Mesh::bspline(8, 3, 2).unwrap();
    let rod = add_beam(&mut scene, line(ends[0], ends[1]), &mesh, section);
    for along in [0.0, 2.0] {
        let end = scene.station(rod, along).unwrap();
        scene.join(JointKind::Hinge, end, Partner::Ground).unwrap();
    }
    scene.gravity = draw.vector(0.0, -9.81);
    for number in 0..draw.one_of(&[2, 2, 3]) {
        let x = draw.between(-0.8, 0.8);
        let y = if number == 0 { 0.0 } else { draw.between(0.0, 0.2) };
        let mass = draw.power(-2.5, 0.0);
        let station = particle(&mut scene, draw.vector(x, y), mass);
        let speed = draw.between(-0.5, 0.5);
        let velocity = draw.vector(speed, 0.0);
        scene.velocities.push(StationVelocity { station, velocity, spin: None });
        let side = if draw.mirror > 0.0 { Side::Left } else { Side::Right };
        let restitution = draw.one_of(&[0.0, 0.5, 0.9]);
        let slider = Slider::new(scene.free_name("slider"), station, rod, x + 1.0);
        scene
            .add_slider(Slider { restraint: Restraint::OneSided(side), restitution, ..slider })
            .unwrap();
    }
    scene
}

#[test]
fn random_scenes_with_frictional_obstacles_are_balanced() {
    let mut tally = Tally::default();
    for seed in 0..if is_long() { 400 } else { 40 } {
        for mut draw in Draw::copies(seed) {
            let dt = draw.power(-4.0, -1.0);
            let scene = obstacles(&mut draw, dt);
            let label = format!("seed {seed}, dt {dt:.1e}, turned by {}", draw.angle);
            tally.add(&label, drift_of_run(scene, dt, 60.0 * dt));
        }
    }
    println!("{tally:?}");
    assert!(100 * tally.failures <= tally.runs && tally.drift < 1e-8, "{tally:?}");
}

/// Two sliders on one beam must not take off and land alternately without end.
#[test]
fn random_scenes_with_unilateral_sliders_are_balanced() {
    let mut tally = Tally::default();
    for seed in 0..if is_long() { 100 } else { 30 } {
        for mut draw in Draw::copies(seed) {
            let dt = draw.power(-4.0, -1.0);
            let scene = unilateral_sliders(&mut draw);
            let label = format!("seed {seed}, dt {dt:.1e}, turned by {}", draw.angle);
            tally.add(&label, drift_of_run(scene, dt, (150.0 * dt).clamp(0.2, 2.0)));
        }
    }
    println!("{tally:?}");
    assert!(tally.failures == 0 && tally.drift < 1e-8, "{tally:?}");
}
