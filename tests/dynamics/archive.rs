//! Archives of simulations: a restored run continues bit for bit, and invalid files are refused without side effects.
#![allow(clippy::unwrap_used)]

use std::rc::Rc;

use crate::common::steered_scenes::is_steered;
use crate::common::{
    Random, body_scenes, meshes, run, scenes, settings, sleeve_scenes, sliding_scenes,
};
use withy::beams::Mesh;
use withy::geometry::Vec2;
use withy::integrators::{INTEGRATORS, Method};
use withy::joints::{JointKind, Partner, SlidingRule};
use withy::loads::{LoadKind, Operation, Schedule};
use withy::simulation::{ArchiveError, Monitor, NoMonitor, Recording, Simulation};
use withy::system::{Element, Scene, StartMotion};

/// Content of a saved simulation, without the elapsed time.
fn content(simulation: &Simulation) -> Vec<u8> {
    let file = simulation.to_bytes("same").unwrap();
    let (_, again) = Simulation::from_bytes(&file).unwrap();
    // Everything in the file except the scene, which both simulations share.
    let history = again.history();
    let columns: Vec<_> = history.columns().map(|(name, _)| history.column(name)).collect();
    let counts = withy::simulation::WorkCounts { wall: Default::default(), ..*again.counts() };
    let last = again.trajectory().configuration(again.trajectory().times().len() - 1);
    let seen = (again.model().state(), columns, again.trajectory().times(), last);
    format!("{seen:?} {:?} {counts:?}", again.arrivals()).into_bytes()
}

fn assert_survives(
    label: &str,
    scene: Scene,
    (method, recording): (Method, Recording),
    dt: f64,
    end: f64,
) {
    let mut simulation = Simulation::start(scene, settings(method, dt)).unwrap();
    simulation.cut_at(0.77 * end);
    simulation.record(recording);
    run(&mut simulation, 0.5 * end).unwrap();
    let file = simulation.to_bytes("half way").unwrap();
    let (name, mut loaded) = Simulation::from_bytes(&file).unwrap();
    assert_eq!(name, "half way", "{label}");
    assert_eq!(loaded.to_bytes("half way").unwrap(), file, "{label}");
    for simulation in [&mut simulation, &mut loaded] {
        run(simulation, end).unwrap();
    }
    assert!(content(&loaded) == content(&simulation), "{label}");
}

#[test]
fn restored_scenes_continue_bit_for_bit() {
    for entry in INTEGRATORS {
        for (name, mesh) in meshes(4) {
            let has_friction = entry.method != Method::FourthOrder;
            let friction = if has_friction { 0.1 } else { 0.0 };
            let all = scenes::all(&mesh).into_iter().chain(body_scenes::all(&mesh));
            let all = all.chain(sleeve_scenes::all(&mesh));
            let all = all.chain([scenes::crowded(&mesh, friction)]);
            // Controllers are functions, which files cannot store.
            for scene in all.filter(|scene| !is_steered(scene)) {
                let label = format!("{}, {}, {name}", entry.name, scene.name);
                assert_survives(&label, scene, (entry.method, Recording::default()), 0.05, 0.6);
            }
        }
        for rule in [SlidingRule::Conserving, SlidingRule::Exact, SlidingRule::Kinked] {
            for scene in sliding_scenes::all(&Mesh::bspline(4, 3, 2).unwrap(), rule) {
                let label = format!("{}, {}", entry.name, scene.name);
                assert_survives(&label, scene, (entry.method, Recording::Nothing), 0.02, 0.4);
            }
        }
    }
}

fn spaghetti() -> Simulation {
    let scene = scenes::spaghetti(&Mesh::bspline(4, 3, 2).unwrap(), 1e4);
    let mut simulation = Simulation::start(scene, settings(Method::EnergyMomentum, 0.1)).unwrap();
    run(&mut simulation, 0.5).unwrap();
    simulation
}

/// Simulation, stopped before its end, of a scene with every feature that a file can store.
fn rich() -> Simulation {
    let mesh = Mesh::bspline(2, 3, 2).unwrap();
    let mut scene = sliding_scenes::loaded_slave(&mesh, SlidingRule::Conserving);
    let station = scenes::end_of(&mut scene, 0);
    let sum = Schedule::combined(
        Operation::Sum,
        Schedule::ramp(0.0, 1.0).unwrap(),
        Schedule::sine(0.1, 2.0, 0.0).unwrap(),
    );
    scene.add_load(LoadKind::Moment { station, moment: 0.1 }, sum.unwrap());
    let curve = scenes::towed(&mesh).beams.swap_remove(0);
    scene.add_beam(withy::system::BeamDefinition { name: "curve".into(), ..curve }).unwrap();
    let arc = scenes::curved_pendulum(&Mesh::lagrange(2, 2).unwrap()).beams.swap_remove(0);
    scene.add_beam(withy::system::BeamDefinition { name: "arc".into(), ..arc }).unwrap();
    let mut simulation = Simulation::start(scene, settings(Method::EnergyMomentum, 0.02)).unwrap();
    run(&mut simulation, 0.1).unwrap();
    simulation
}

#[test]
fn load_with_a_function_is_rejected_by_name() {
    let mut scene = scenes::towed(&Mesh::bspline(2, 3, 2).unwrap());
    let station = scenes::end_of(&mut scene, 0);
    let function = Schedule::Function { function: Rc::new(Ok), breaks: vec![] };
    scene.add_load(LoadKind::Moment { station, moment: 1.0 }, function);
    let simulation = Simulation::start(scene, settings(Method::EnergyMomentum, 0.1)).unwrap();
    let refusal = simulation.to_bytes("towed").unwrap_err();
    assert!(refusal.to_string().contains("moment at the end of beam 'beam1'"), "{refusal}");
    let advice = withy::script::messages::advice::hint_for(&refusal);
    assert!(advice.as_ref().is_some_and(|message| message.contains("smooth_pulse")), "{advice:?}");
}

#[test]
fn truncated_file_is_rejected_at_every_length() {
    let file = spaghetti().to_bytes("cut").unwrap();
    println!("{} bytes for 5 steps of the spaghetti", file.len());
    for length in (0..200).chain((200..file.len()).step_by(97)) {
        let refused = Simulation::from_bytes(&file[..length]).err().unwrap();
        let right = matches!(refused, ArchiveError::Truncated { .. } | ArchiveError::Foreign);
        assert!(right && (length > 0) == (refused != ArchiveError::Foreign), "{length}: {refused}");
    }
}

fn with_right_checksum(mut file: Vec<u8>) -> Vec<u8> {
    let end = file.len() - 4;
    let checksum = crc32fast::hash(&file[..end]);
    file[end..].copy_from_slice(&checksum.to_le_bytes());
    file
}

struct Patience(usize);

impl Monitor for Patience {
    fn continues(&mut self, _time: f64) -> bool {
        self.0 = self.0.saturating_sub(1);
        self.0 > 0
    }
}

#[test]
fn flipped_bytes_fail_the_checksum_and_never_cause_a_panic() {
    let file = rich().to_bytes("flipped").unwrap();
    let mut random = Random(3);
    let mut choose = |below: usize| ((random.next() + 1.0) * 0.5 * below as f64) as usize;
    let (mut refused, mut accepted) = (0, 0);
    for case in 0..6000 {
        let mut flipped = file.clone();
        for _ in 0..=choose(3) {
            // Most of the file is the state and the history. The scene comes first.
            let at = if case % 3 == 0 { choose(file.len()) } else { 20 + choose(1500) };
            flipped[at] =
                if case % 2 == 0 { choose(256) as u8 } else { flipped[at] ^ (1 << choose(8)) };
        }
        if flipped != file {
            assert!(Simulation::from_bytes(&flipped).is_err());
        }
        match Simulation::from_bytes(&with_right_checksum(flipped)) {
            Ok((_, mut simulation)) => {
                accepted += 1;
                // The step may fail, as the content is random.
                let _ = simulation.step(&mut Patience(20));
            }
            Err(error) => {
                refused += 1;
                assert!(!error.to_string().is_empty());
            }
        }
    }
    println!("{refused} refused, {accepted} accepted");
    assert!(refused > 500 && accepted > 500);
}

#[test]
fn random_content_with_a_valid_checksum_is_rejected() {
    let mut random = Random(5);
    let file = spaghetti().to_bytes("random").unwrap();
    let header = 8 + 2 + 1 + usize::from(file[10]) + 8;
    for _ in 0..2000 {
        let mut wild = file.clone();
        wild[header..].iter_mut().for_each(|byte| *byte = (128.0 * (random.next() + 1.0)) as u8);
        assert!(Simulation::from_bytes(&with_right_checksum(wild)).is_err());
    }
    let more = [&file[..file.len() - 4], &[0; 5], &[0; 4]].concat();
    let mut more = more;
    let length = (more.len() - header - 4) as u64;
    more[header - 8..header].copy_from_slice(&length.to_le_bytes());
    let message = Simulation::from_bytes(&with_right_checksum(more)).err().unwrap().to_string();
    assert!(message.contains("bytes after its end"), "{message}");
}

#[test]
fn loaded_run_can_be_rewound_to_its_loading() {
    let (_, mut loaded) = Simulation::from_bytes(&spaghetti().to_bytes("back").unwrap()).unwrap();
    loaded.enable_snapshots(1 << 20);
    loaded.step(&mut NoMonitor).unwrap();
    loaded.back(1).unwrap();
    assert_eq!(loaded.time(), 0.5);
    assert!(loaded.back(1).is_err());
}

#[test]
fn unreadable_names_in_files_are_rejected_and_derived_names_are_recomputed() {
    const WRONG: &str = "\u{1b}]0;title\u{7}";
    let stored = |scene, name: &str| {
        let simulation = Simulation::start(scene, settings(Method::EnergyMomentum, 0.1)).unwrap();
        Simulation::from_bytes(&simulation.to_bytes(name).unwrap())
    };
    let mesh = Mesh::bspline(2, 3, 2).unwrap();
    let scene = || {
        let mut scene = scenes::sprung(&mesh);
        let rest = StartMotion { velocity: Vec2::zeros(), spin: 0.0, centre: None };
        scene.beams.iter_mut().for_each(|beam| beam.motion = rest);
        let station = scenes::end_of(&mut scene, 0);
        scene.join(JointKind::Hinge, station, Partner::Ground).unwrap();
        scene.add_load(LoadKind::Moment { station, moment: 0.1 }, Schedule::Constant(1.0));
        scene
    };
    assert!(stored(scene(), "good").is_ok());
    assert!(stored(scene(), WRONG).is_err());
    type Forge = fn(&mut Scene);
    let forgeries: [Forge; 4] = [
        |scene| scene.name = WRONG.into(),
        |scene| scene.beams[0].name = WRONG.into(),
        |scene| {
            scene.elements.iter_mut().for_each(|element| {
                if let Element::Spring(spring) = element
                    && spring.name == "spring1"
                {
                    spring.name = WRONG.into();
                }
            });
        },
        |scene| {
            scene.elements.iter_mut().for_each(|element| {
                if let Element::Load(load) = element {
                    load.title = Some(WRONG.into());
                }
            });
        },
    ];
    for (at, forge) in forgeries.into_iter().enumerate() {
        let mut scene = scene();
        forge(&mut scene);
        assert!(stored(scene, "good").is_err(), "{at}");
    }
    let mut forged = scene();
    let right = (forged.joints[0].name.clone(), forged.loads().next().unwrap().name.clone());
    forged.joints[0].name = WRONG.into();
    for element in &mut forged.elements {
        if let Element::Load(load) = element {
            load.name = WRONG.into();
        }
    }
    let (_, loaded) = stored(forged, "good").unwrap();
    let scene = loaded.scene();
    assert_eq!((scene.joints[0].name.clone(), scene.loads().next().unwrap().name.clone()), right);
}
