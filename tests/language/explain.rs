//! Output of `explain`, compared with the assembled model.
#![allow(clippy::unwrap_used)]

use std::cell::Cell;
use std::rc::Rc;

use withy::beams::{Mesh, Section, Station};
use withy::geometry::{Curve, Vec2};
use withy::integrators::{Constraints, INTEGRATORS, Mechanism};
use withy::joints::{
    EndAction, JointKind, Partner, Restraint, Slider, SlidingRule, StartVelocities,
};
use withy::loads::{LoadFrame, LoadKind, Schedule};
use withy::newton::Tolerance;
use withy::simulation::{NoMonitor, Simulation, SimulationSettings};
use withy::system::{
    BeamDefinition, ParticleDefinition, RigidBodyDefinition, Scene, StartMotion, System,
    SystemFeature, Usage,
};

fn add_beam(scene: &mut Scene, name: &str, from: Vec2, to: Vec2) -> usize {
    let section = Section {
        axial_stiffness: 1e4,
        shear_stiffness: 1e4,
        bending_stiffness: 100.0,
        mass_per_length: 1.0,
        rotary_inertia: 1.0,
    };
    let beam = BeamDefinition {
        name: name.to_owned(),
        axis: Curve::line(from, to).unwrap(),
        mesh: Mesh::bspline(4, 3, 2).unwrap(),
        section: section.into(),
        motion: StartMotion::default(),
    };
    scene.add_beam(beam).unwrap()
}

fn rod() -> (Scene, Station) {
    let mut scene = Scene::new("rod");
    let beam = add_beam(&mut scene, "rod", Vec2::new(0.0, 0.0), Vec2::new(2.0, 0.0));
    let end = scene.station(beam, 2.0).unwrap();
    (scene, end)
}

fn with_bead() -> Scene {
    let (mut scene, _) = rod();
    let start = scene.station(0, 0.0).unwrap();
    scene.join(JointKind::Rigid, start, Partner::Ground).unwrap();
    let bead = ParticleDefinition { name: "bead".into(), position: Vec2::new(0.5, 0.0) };
    let slave = scene.add_particle(bead, 1.0).unwrap();
    let slider = Slider {
        name: "ring".into(),
        slave,
        master: 0,
        track: None,
        arc_length: 0.5,
        rule: SlidingRule::Conserving,
        ends: EndAction::Stop,
        restitution: 1.0,
        friction: 0.0,
        static_friction: None,
        restraint: Restraint::Place,
        velocities: StartVelocities::Check,
    };
    scene.add_slider(slider).unwrap();
    scene.gravity = Vec2::new(0.0, -9.81);
    scene
}

fn usage(parts: &[SystemFeature], name: &str) -> Usage {
    let found = parts.iter().find(|part| part.name == name);
    found.unwrap_or_else(|| panic!("no '{name}' in {parts:?}")).usage.clone()
}

fn used(parts: &[SystemFeature], name: &str) -> String {
    match usage(parts, name) {
        Usage::Used(how) => how,
        Usage::Omitted(saved) => panic!("'{name}' is left out: {saved}"),
    }
}

fn is_left_out(parts: &[SystemFeature], name: &str) -> bool {
    matches!(usage(parts, name), Usage::Omitted(_))
}

#[test]
fn explanation_of_a_free_beam_omits_other_features() {
    let (scene, _) = rod();
    let parts = scene.explain().unwrap();
    for name in [
        "particles",
        "point masses",
        "joints",
        "supports",
        "sliders",
        "gravity",
        "loads",
        "start velocities",
    ] {
        assert!(is_left_out(&parts, name), "{name}: {parts:?}");
    }
    let mut model = System::assemble(&scene).unwrap();
    assert_eq!(model.constraint_shape().width, 0);
    assert_eq!(model.degrees_of_freedom(), model.unknowns());
    assert_eq!(model.measure().energy.potential, 0.0);
    assert!(model.rates().iter().all(|rate| *rate == 0.0));
    assert_eq!(
        used(&parts, "unknowns"),
        format!("21 degrees of freedom, half-bandwidth {}", model.half_bandwidth())
    );
    assert_eq!(model.unknowns(), 21);
    let beam = used(&parts, "beam 'rod'");
    assert!(beam.contains("7 control points") && beam.contains("Γ 6, κ 8, mass 16"), "{beam}");
}

#[test]
fn explanation_counts_contact_unknowns_and_fixed_motions() {
    let scene = with_bead();
    let (parts, mut model) = (scene.explain().unwrap(), System::assemble(&scene).unwrap());
    assert_eq!(model.constraint_shape().width, 5);
    assert!(used(&parts, "sliders").contains("1 conserving: a border of 5 columns"));
    assert!(used(&parts, "unknowns").contains("5 contact unknowns, in the border of the matrix"));
    assert_eq!(model.unknowns(), 20);
    assert!(used(&parts, "supports").contains("1 clamp: 3 movements fixed"));
    // The rotation of the particle is also fixed, but not by a support.
    assert_eq!(model.degrees_of_freedom() - model.unknowns() - 5, 4);
    assert_eq!(used(&parts, "particles"), "1, without rotation");
    assert!(is_left_out(&parts, "point masses") && is_left_out(&parts, "loads"));
    assert!(used(&parts, "gravity").contains("(0, -9.81)"));
    assert!((model.total_mass() - 3.0).abs() < 1e-12 && model.measure().gap < 1e-15);
    assert!(is_left_out(&parts, "start velocities"));
}

#[test]
fn joined_degrees_of_freedom_are_one_unknown() {
    let (mut scene, end) = rod();
    let free = System::assemble(&scene).unwrap().unknowns();
    let arm = add_beam(&mut scene, "arm", Vec2::new(2.0, 0.0), Vec2::new(2.0, 1.0));
    let start = scene.station(arm, 0.0).unwrap();
    scene.join(JointKind::Hinge, end, Partner::Station(start)).unwrap();
    let parts = scene.explain().unwrap();
    assert!(
        used(&parts, "joints")
            .contains("1 hinge: joined movements share unknowns, which removes 2 unknowns")
    );
    assert_eq!(System::assemble(&scene).unwrap().unknowns(), 2 * free - 2);
    assert!(is_left_out(&parts, "supports"));
}

#[test]
fn script_functions_are_called_as_often_as_explained() {
    for method in INTEGRATORS.iter().map(|entry| entry.method) {
        let (mut scene, station) = rod();
        let calls = Rc::new(Cell::new(0));
        let counter = Rc::clone(&calls);
        let function = Rc::new(move |time: f64| {
            counter.set(counter.get() + 1);
            Ok(time)
        });
        let schedule = Schedule::Function { function, breaks: vec![0.25] };
        let force = Vec2::new(1.0, 0.0);
        scene.add_load(LoadKind::Force { station, force, frame: LoadFrame::Follower }, schedule);
        let said = used(&scene.explain().unwrap(), "force at the end of beam 'rod'");
        let settings =
            SimulationSettings { method, dt: 0.1.into(), tolerance: Tolerance::default() };
        let mut simulation = Simulation::start(scene, settings).unwrap();
        assert_eq!(calls.get(), 0, "starting and explaining call nothing");
        simulation.step(&mut NoMonitor).unwrap();
        assert_eq!(simulation.counts().retries, 0);
        let message = format!("{} calls per step with {}", calls.get(), method.entry().name);
        assert!(said.contains(&message), "{said} / {message}");
        assert!(
            said.contains("follower load at 1 section") && said.contains("steps end at t = 0.25")
        );
        let parts = simulation.explain();
        assert!(used(&parts, "steps").contains("steps will end at t = 0.25"), "{parts:?}");
        simulation.run_to(0.3, &mut NoMonitor).unwrap();
        assert_eq!(simulation.counts().steps, 4);
        assert!(is_left_out(&simulation.explain(), "start velocities"), "though it moves now");
        assert!(used(&simulation.explain(), "steps").contains("no prescribed ends of steps"));
    }
}

#[test]
fn many_beams_and_loads_are_summarised() {
    let mut scene = Scene::new("many");
    for index in 0..20 {
        let y = f64::from(index);
        let beam = add_beam(&mut scene, &format!("b{index}"), Vec2::new(0.0, y), Vec2::new(1.0, y));
        let (force, frame) = (Vec2::new(1.0, 0.0), LoadFrame::Dead);
        scene.add_load(LoadKind::Line { beam, force, frame }, Schedule::Constant(1.0));
    }
    let parts = scene.explain().unwrap();
    assert!(used(&parts, "beams").starts_with("20; points for Γ 120, κ 160"));
    assert!(used(&parts, "loads").starts_with("14 more"));
    assert!(parts.len() < 25, "{parts:#?}");
}

#[test]
fn start_velocities_are_given_checked_or_projected() {
    let mut scene = with_bead();
    scene.sliders[0].velocities = StartVelocities::Project;
    assert!(
        used(&scene.explain().unwrap(), "start velocities")
            .contains("projected onto the slider constraints")
    );
    let (mut scene, _) = rod();
    scene.beams[0].motion.spin = 1.0;
    assert_eq!(used(&scene.explain().unwrap(), "start velocities"), "as given");
    let mut scene = Scene::new("wheel");
    let wheel = RigidBodyDefinition {
        name: "wheel".into(),
        position: Vec2::zeros(),
        angle: 0.0,
        points: Vec::new(),
        outline: Vec::new(),
        motion: StartMotion { velocity: Vec2::x(), ..StartMotion::default() },
    };
    scene.add_rigid_body(wheel, 1.0, 1.0).unwrap();
    assert_eq!(used(&scene.explain().unwrap(), "start velocities"), "as given");
}
