use withy_mechanics::beams::{Mesh, Section, Station};
use withy_mechanics::geometry::{Curve, Vec2};
use withy_mechanics::integrators::Method;
use withy_mechanics::joints::{EndAction, JointKind, Partner, Slider, StartVelocities, Component};
use withy_mechanics::simulation::{Invariant, NoMonitor, Simulation, SimulationSettings};
use withy_mechanics::system::*;
use withy_mechanics::loads::*;

fn stiff(k: f64) -> Section {
    Section { axial_stiffness: k, shear_stiffness: k, bending_stiffness: k, mass_per_length: 1.0, rotary_inertia: 1e-2 }
}
fn bead(scene: &mut Scene, position: Vec2, velocity: Vec2, mass: f64) -> Station {
    let name = scene.free_name("bead");
    let at = scene.add_particle(ParticleDefinition { name, position }, mass).unwrap();
    scene.velocities.push(StationVelocity { station: at.clone(), velocity, spin: None });
    at
}
fn report(label: &str, mut sim: Simulation, times: &[f64], read: impl Fn(&Simulation) -> f64, exact: &[f64]) {
    print!("{label}: ");
    for (t, e) in times.iter().zip(exact) {
        if let Err(error) = sim.run_to(*t, &mut NoMonitor) { println!("FAILED {error}"); return; }
        print!(" {:.2e}", read(&sim) - e);
    }
    let c = sim.counts();
    let h = sim.history();
    println!("  E {:.1e} p {:.1e} L {:.1e} gap {:.1e}  steps {} it {} tries", h.drift(Invariant::Energy), h.drift(Invariant::Momentum), h.drift(Invariant::AngularMomentum), h.drift(Invariant::Gap), c.steps, c.newton_iterations);
}
fn incline(degrees: f64, mu: f64, dt: f64) -> Simulation {
    let mut scene = Scene::new("incline");
    let (s, c) = f64::to_radians(degrees).sin_cos();
    let u = Vec2::new(c, s);
    let axis = Curve::line(-u * 5.0, u * 5.0).unwrap();
    let rod = scene.add_beam(BeamDefinition::new("rod", axis, Mesh::bspline(4, 3, 2).unwrap(), stiff(1e10))).unwrap();
    for x in [0.0, 10.0] { let at = scene.station(rod, x).unwrap(); scene.join(JointKind::Rigid, at, Partner::Ground).unwrap(); }
    scene.gravity = Vec2::new(0.0, -9.81);
    let b = bead(&mut scene, Vec2::zeros(), u * 2.0, 1.0);
    scene.add_slider(Slider { ends: EndAction::Release, friction: mu, ..Slider::new("ring", b, rod, 5.0) }).unwrap();
    Simulation::start(scene, SimulationSettings::new(Method::EnergyMomentum, dt)).unwrap()
}
fn bar(mu: f64, v: f64, dt: f64) -> Simulation {
    let mut scene = Scene::new("bar");
    let axis = Curve::line(Vec2::new(-3.0, 0.0), Vec2::new(3.0, 0.0)).unwrap();
    let mut def = BeamDefinition::new("rod", axis, Mesh::bspline(4, 3, 2).unwrap(), stiff(1e10));
    def.motion = StartMotion { velocity: Vec2::zeros(), spin: 1.0, centre: Some(Vec2::zeros()) };
    let rod = scene.add_beam(def).unwrap();
    let mid = scene.station(rod, 3.0).unwrap();
    scene.join(JointKind::Hinge, mid.clone(), Partner::Ground).unwrap();
    let rate = PrescribedMotion::Rate(Schedule::Constant(1.0));
    scene.drives.push(Drive { name: "motor".into(), kind: DriveKind::Motor, station: mid, motions: [None, None, Some(rate)] });
    let b = bead(&mut scene, Vec2::new(1.0, 0.0), Vec2::new(v, 1.0), 1.0);
    scene.add_slider(Slider { ends: EndAction::Release, friction: mu, ..Slider::new("ring", b, rod, 4.0) }).unwrap();
    Simulation::start(scene, SimulationSettings::new(Method::EnergyMomentum, dt)).unwrap()
}
fn free(mu: f64, dt: f64) -> Simulation {
    let mut scene = Scene::new("free");
    let axis = Curve::line(Vec2::new(0.0, 0.0), Vec2::new(4.0, 0.0)).unwrap();
    let section = Section { axial_stiffness: 1e4, shear_stiffness: 4e3, bending_stiffness: 20.0, mass_per_length: 0.5, rotary_inertia: 1e-2 };
    let mut def = BeamDefinition::new("rod", axis, Mesh::bspline(6, 3, 2).unwrap(), section);
    def.motion = StartMotion { velocity: Vec2::zeros(), spin: 1.0, centre: Some(Vec2::new(2.0, 0.0)) };
    let rod = scene.add_beam(def).unwrap();
    let b = bead(&mut scene, Vec2::new(1.0, 0.0), Vec2::new(2.0, -1.0), 1.0);
    scene.add_slider(Slider { ends: EndAction::Bounce, friction: mu, velocities: StartVelocities::Check, ..Slider::new("ring", b, rod, 1.0) }).unwrap();
    Simulation::start(scene, SimulationSettings::new(Method::EnergyMomentum, dt)).unwrap()
}
fn main() {
    let along = |degrees: f64| move |s: &Simulation| { let (a, b) = f64::to_radians(degrees).sin_cos(); s.model().slider_arc_length(0) - 5.0 + 0.0*a*b };
    for dt in [0.1, 0.05, 0.025, 0.0125] {
        report("incline 30", incline(30.0, 0.3, dt), &[0.25, 0.5, 1.0], along(30.0), &[0.2670714761, 0.2050865127, -0.3623985771]);
        report("incline 15", incline(15.0, 0.3, dt), &[0.25, 0.5, 1.0], along(15.0), &[0.3318207956, 0.3716273973, 0.3716273973]);
    }
    for n in [20.0, 40.0, 80.0, 160.0] {
        let dt = 2.0 / n;
        let r = |s: &Simulation| s.model().slider_arc_length(0) - 3.0;
        report("bar 0.3", bar(0.3, -1.5, dt), &[0.5, 1.0, 2.0], r, &[0.4404660608, 0.1230826508, -0.2576974203]);
        report("bar 0.8", bar(0.8, 0.0, dt), &[0.5, 1.0, 2.0], r, &[1.0993247161, 1.3370634234, 2.1271833188]);
    }
    for mu in [0.3, 0.8] {
        for dt in [0.01, 0.05, 0.2] {
            report(&format!("free {mu} {dt}"), free(mu, dt), &[5.0], |s| s.model().slider_arc_length(0), &[0.0]);
        }
    }
    let _ = Component::ALL;
}
