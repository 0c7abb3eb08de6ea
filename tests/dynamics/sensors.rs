//! Sensors, compared with balances, differences and closed forms. Sensors do not change the motion.
#![allow(clippy::unwrap_used)]

use crate::common::machine_scenes::actuated;
use crate::common::steered_scenes::is_steered;
use crate::common::{
    at, body_scenes, is_damped, orders, run, scenes, sci, settings, simulate, sleeve_scenes,
    sliding_scenes,
};
use withy::beams::{Mesh, Section, Station};
use withy::geometry::Vec2;
use withy::integrators::{INTEGRATORS, Method};
use withy::joints::{JointKind, Partner, SlidingRule};
use withy::simulation::{NoMonitor, Simulation};
use withy::system::{Anchor, Scene, Spring, SystemError, ValueTime};

fn smooth(spans: usize) -> Mesh {
    Mesh::bspline(spans, 3, 2).unwrap()
}

/// Records all available sensors, except means of steps, whose sums are part of the state and which not all methods have, and angles of sections that the
/// model does not track yet.
fn with_all_sensors(mut scene: Scene) -> Scene {
    let names = scene.sensor_names();
    let names = names.iter().filter(|name| !name.ends_with(".middle.angle"));
    names.for_each(|name| scene.record(name).unwrap());
    scene.sensors.retain(|sensor| sensor.quantity.timing != ValueTime::SummedMean);
    if let Some(beam) = scene.beams.first() {
        let (name, length) = (beam.name.clone(), beam.axis.length());
        scene.record(&format!("{name}[{}].M", 0.37 * length)).unwrap();
    }
    scene
}

#[test]
fn reading_changes_no_bit_of_the_motion() {
    let mesh = smooth(5);
    let sliding = sliding_scenes::all(&mesh, SlidingRule::Conserving);
    let others = body_scenes::all(&mesh).into_iter().chain(sleeve_scenes::all(&mesh));
    for scene in scenes::all(&mesh).into_iter().chain(others).chain(sliding) {
        for entry in INTEGRATORS {
            let plain = simulate(scene.clone(), entry.method, 0.02, 0.2);
            let watched = with_all_sensors(scene.clone());
            let watched = simulate(watched, entry.method, 0.02, 0.2);
            let label = format!("{}, {}", scene.name, entry.name);
            assert!(watched.history().columns().count() > plain.history().columns().count() + 10);
            let mut extra = watched.model().state();
            // The angles of tracked sections are part of the state. The states are comparable only if both runs track the same sections.
            if watched.scene().stations.len() != plain.scene().stations.len() {
                extra = plain.model().state();
            }
            assert_eq!(format!("{:?}", plain.model().state()), format!("{extra:?}"), "{label}");
            let rows = |of: &Simulation| format!("{:?}", of.history().samples());
            assert_eq!(rows(&plain), rows(&watched), "{label}");
            for (name, _) in watched.history().columns() {
                let column = watched.history().column(name).unwrap();
                assert!(column.iter().all(|value| value.is_finite()), "{label}: {name}");
            }
        }
    }
}

#[test]
fn energies_of_bodies_sum_to_that_of_the_scene() {
    for scene in scenes::all(&smooth(5)).into_iter().chain(body_scenes::all(&smooth(5))) {
        let name = scene.name.clone();
        let bodies = scene.beams.len() + scene.particles.len() + scene.rigid_bodies.len();
        let mut simulation = simulate(scene, Method::default(), 0.02, 0.4);
        let total = simulation.history().samples().last().unwrap().measures.energy;
        let mut sums = [0.0; 3];
        for body in 0..bodies {
            let energy = simulation.energy_of(body);
            sums[0] += energy.kinetic;
            sums[1] += energy.axial + energy.shear + energy.bending;
            sums[2] += energy.potential;
        }
        for (sum, whole) in sums.into_iter().zip([total.kinetic, total.strain, total.potential]) {
            assert!((sum - whole).abs() <= 1e-12 * total.total().abs(), "{name}: {sum} {whole}");
        }
    }
}

/// The balance of a very short step gives the present forces and accelerations of the equations of motion.
#[test]
fn forces_and_accelerations_are_those_of_a_very_short_step() {
    let short = 1e-6;
    // A release within the short step would remove its reaction, and a controller could change its value.
    let lets_go = |scene: &Scene| {
        is_steered(scene) || is_damped(scene) || scene.release_times().any(|time| time == 0.4)
    };
    for scene in scenes::all(&smooth(5)).into_iter().filter(|scene| !lets_go(scene)) {
        let station = Station::on_beam(0, scene.beams[0].axis.length());
        let name = scene.name.clone();
        let held: Vec<Station> = scene
            .joints
            .iter()
            .filter(|joint| joint.partner == Partner::Ground)
            .map(|joint| joint.station)
            .collect();
        let gravity = scene.gravity;
        let is_ground = |anchor: &Anchor| matches!(anchor, Anchor::Ground(_));
        let has_loads = scene.springs().flat_map(Spring::anchors).any(is_ground)
            || scene.loads().count()
                + scene.drags().count()
                + scene.obstacles().count()
                + scene.drives.len()
                > 0;
        let mut simulation = simulate(scene, Method::default(), 0.02, 0.4);
        let read = |simulation: &mut Simulation| {
            let now = simulation.instant().unwrap();
            let place = simulation.place(&station).unwrap();
            let model = simulation.model();
            let reaction = held.iter().map(|station| {
                model.reaction(now.reactions(), &simulation.place(station).unwrap()).unwrap().0
            });
            let measures = simulation.history().samples().last().unwrap().measures;
            let acceleration = model.acceleration(&now, &place);
            (acceleration, model.velocity(&place), reaction.sum::<Vec2>(), measures.impulse)
        };
        let before = read(&mut simulation);
        run(&mut simulation, 0.4 + short).unwrap();
        let after = read(&mut simulation);
        let accelerated = (after.1 - before.1) / short;
        let message = (before.0 + after.0) * 0.5;
        let scale = 1.0 + message.norm();
        println!("{name:20} acceleration {:.1e}", (accelerated - message).norm() / scale);
        assert!((accelerated - message).norm() < 1e-6 * scale, "{name}: {accelerated} {message}");
        if !has_loads {
            let given = (after.3 - before.3) / short - gravity * simulation.model().total_mass();
            let message = (before.2 + after.2) * 0.5;
            assert!(
                (given - message).norm() < 1e-6 * (1.0 + message.norm()),
                "{name}: {given} {message}"
            );
        }
    }
}

/// Section forces at the ends of beams, from strains, equal the reactions of joints, from inertia and loads.
#[test]
fn joint_forces_equal_section_forces() {
    let errors = [8, 16, 32].map(|spans| {
        let mut worst = [0.0_f64; 2];
        let mut linkage = scenes::four_bar_linkage(&smooth(spans));
        linkage.elements.clear();
        for scene in [linkage, scenes::curved_pendulum(&smooth(spans))] {
            let joints = scene.joints.clone();
            let mut simulation = simulate(scene, Method::EnergyDecaying { chi: 1.0 }, 0.02, 4.0);
            let now = simulation.instant().unwrap();
            for (index, joint) in joints.iter().enumerate() {
                let model = simulation.model();
                let transmission = model.transmission(simulation.scene(), index).unwrap();
                let (force, moment) = transmission.read(now.reactions());
                let section = simulation.section_forces(&joint.station).unwrap();
                let size = section.axial.hypot(section.shear);
                worst[0] = worst[0].max((force.norm() - size).abs() / (1.0 + size));
                worst[1] = worst[1].max(moment.abs()).max(section.moment.abs());
            }
        }
        worst
    });
    let forces = errors.map(|error| error[0]);
    let moments = errors.map(|error| error[1]);
    println!("joints and sections: forces {}, moments at hinges {}", sci(&forces), sci(&moments));
    assert!(forces[2] < 2e-5 && orders(&forces).iter().all(|order| *order > 0.8), "{forces:?}");
    assert!(moments[2] < 4e-3 && orders(&moments).iter().all(|order| *order > 1.5), "{moments:?}");
}

#[test]
fn clamp_moment_equals_section_moment() {
    let mesh = smooth(16);
    let mut scene = scenes::cantilever(&mesh, scenes::spaghetti_section(1e4, 100.0));
    scene.gravity = at(0.0, -0.1);
    scene.record("clamp1.moment").unwrap();
    scene.record("beam1.start.M").unwrap();
    let simulation = simulate(scene, Method::EnergyDecaying { chi: 1.0 }, 0.05, 10.0);
    let [given, section] =
        ["clamp1.moment", "beam1.start.M"].map(|name| simulation.history().column(name).unwrap());
    let largest = given.iter().fold(0.0_f64, |largest, moment| largest.max(moment.abs()));
    for (row, (given, section)) in given.iter().zip(&section).enumerate().skip(100) {
        // The section moment acts on the part before the section, and the reaction of the clamp on the beam after it, so the signs are opposite.
        assert!((given + section).abs() < 5e-3 * largest, "{row}: {given} {section}");
    }
}

/// Rod that swings about its end under gravity, compared with the closed forms of the axial and transverse reactions.
#[test]
fn hinge_force_of_a_pendulum_equals_that_of_a_rigid_rod() {
    let (length, g) = (1.0, 9.81);
    let section = Section {
        axial_stiffness: 1e7,
        shear_stiffness: 1e7,
        bending_stiffness: 1e5,
        mass_per_length: 1.0,
        rotary_inertia: 1e-4,
    };
    let mut scene = Scene::new("pendulum");
    let axis = scenes::line(Vec2::zeros(), at(length, 0.0));
    let beam = scenes::add_beam(&mut scene, axis, &smooth(4), section);
    let start = scene.station(beam, 0.0).unwrap();
    scene.join(JointKind::Hinge, start, Partner::Ground).unwrap();
    scene.gravity = at(0.0, -g);
    ["hinge1.present_fx", "hinge1.present_fy", "beam1.end.angle", "beam1.end.spin"]
        .iter()
        .for_each(|name| scene.record(name).unwrap());
    // The method damps the vibration after the sudden start, but not the swing.
    let simulation = simulate(scene, Method::EnergyDecaying { chi: 1.0 }, 0.001, 0.8);
    let history = simulation.history();
    let [fx, fy, angle, spin] =
        ["hinge1.present_fx", "hinge1.present_fy", "beam1.end.angle", "beam1.end.spin"]
            .map(|name| history.column(name).unwrap());
    let inertia = length / 3.0 + 1e-4;
    let mut worst = 0.0_f64;
    for row in 200..angle.len() {
        let (along, across) =
            (at(angle[row].cos(), angle[row].sin()), at(-angle[row].sin(), angle[row].cos()));
        let turning = -g * 0.5 * length * angle[row].cos() / inertia;
        let centre =
            across * (0.5 * length * turning) - along * (0.5 * length * spin[row] * spin[row]);
        let exact = centre + at(0.0, g);
        worst = worst.max((at(fx[row], fy[row]) - exact).norm());
    }
    println!("pendulum: reaction off by {worst:.1e} of {:.1}", 2.5 * g);
    assert!(worst < 0.02 * g, "{worst}");
}

/// Second differences of the arc length of a bead equal its acceleration by the contact force alone.
#[test]
fn bead_acceleration_agrees_with_its_contact_force() {
    let errors = [0.01, 0.005, 0.0025].map(|dt| {
        let scene = sliding_scenes::bead_on_an_arc(&smooth(8), SlidingRule::Conserving);
        let bead = scene.sliders[0].slave;
        let gravity = scene.gravity;
        let mass: f64 =
            scene.masses().filter(|mass| mass.station == bead).map(|mass| mass.mass).sum();
        let mut simulation = Simulation::start(scene, settings(Method::default(), dt)).unwrap();
        let place = simulation.place(&bead).unwrap();
        let mut positions = Vec::new();
        let mut forces = Vec::new();
        while simulation.time() < 0.3 - 0.1 * dt {
            simulation.step(&mut NoMonitor).unwrap();
            positions.push(simulation.model().position(&place));
            let now = simulation.instant().unwrap();
            let acceleration = simulation.model().acceleration(&now, &place);
            let by_contact = gravity - now.contact(0) / mass;
            assert!((by_contact - acceleration).norm() < 1e-9 * (1.0 + acceleration.norm()));
            forces.push(acceleration);
        }
        let skipped = forces.len() / 3;
        let of_three = positions.windows(3).zip(&forces[1..]).skip(skipped);
        let mean: f64 = of_three
            .clone()
            .map(|(x, message)| ((x[2] - x[1] * 2.0 + x[0]) / (dt * dt) - message).norm())
            .sum();
        mean / of_three.count() as f64
    });
    println!("bead: acceleration against differences {} {:.2?}", sci(&errors), orders(&errors));
    assert!(orders(&errors).iter().all(|order| *order > 1.2), "{errors:?}");
}

/// Records the quantities with this name of all objects and returns their sensors.
fn recorded(scene: &mut Scene, quantity: &str) -> Vec<String> {
    let names = scene.sensor_names().into_iter();
    let names: Vec<String> = names.filter(|name| name.ends_with(quantity)).collect();
    names.iter().for_each(|name| scene.record(name).unwrap());
    names
}

#[test]
fn powers_integrate_to_the_works_of_drives_loads_and_actuators() {
    let all = INTEGRATORS.iter().flat_map(|entry| {
        [scenes::driven(&smooth(5)), actuated(&smooth(5))].map(|scene| (entry, scene))
    });
    for (entry, mut scene) in all {
        let names = recorded(&mut scene, ".power");
        let expected: &[&str] = match scene.name.as_str() {
            "actuated" => &["actuator1.power", "actuator2.power", "actuator3.power"],
            _ => &["move1.power", "push.power"],
        };
        assert_eq!(names, expected);
        let simulation = simulate(scene, entry.method, 0.02, 0.6);
        let history = simulation.history();
        assert_eq!(history.dimension(&names[0]), Some("energy/time"));
        let dt = history.column("dt").unwrap();
        for name in names {
            let power = history.column(&name).unwrap();
            let work = format!("work.{}", name.strip_suffix(".power").unwrap());
            let work = history.column(&work).unwrap();
            let largest = work.iter().fold(0.0_f64, |largest, work| largest.max(work.abs()));
            assert!(largest > 1e-3, "{}, {name}", entry.name);
            let mut sum = 0.0;
            for row in 1..work.len() {
                sum += power[row] * dt[row];
                let off = (sum - work[row]).abs();
                assert!(off < 1e-13 * largest, "{}, {name}, row {row}: {off:.1e}", entry.name);
            }
        }
    }
}

/// Sum over the prescribed components: the mean force times the mean velocity, the mean moment times the mean spin.
#[test]
fn the_power_of_a_drive_is_force_times_velocity_and_moment_times_spin() {
    let mut scene = scenes::driven(&smooth(5));
    recorded(&mut scene, "move1.power");
    let sensors = ["beam1.start.vx", "beam1.start.vy", "beam1.start.spin"];
    sensors.iter().for_each(|name| scene.record(name).unwrap());
    let simulation = simulate(scene, Method::default(), 1e-4, 0.02);
    let column = |name: &str| simulation.history().column(name).unwrap();
    let forces = ["move1.x", "move1.y", "move1.angle"].map(column);
    let rates = sensors.map(column);
    let power = column("move1.power");
    let largest = power.iter().fold(0.0_f64, |largest, power| largest.max(power.abs()));
    for row in 0..power.len() {
        let before = row.saturating_sub(1);
        let of_component = forces.iter().zip(&rates);
        let message =
            of_component.map(|(force, rate)| force[row] * 0.5 * (rate[before] + rate[row]));
        let off = (power[row] - message.sum::<f64>()).abs();
        assert!(off < 1e-6 * largest, "row {row}: {off:.1e} of {largest:.1e}");
    }
}

#[test]
fn magnitude_and_angle_of_a_joint_force_are_those_of_its_components() {
    let mut scene = scenes::curved_pendulum(&smooth(4));
    let quantities = ["force", "force_angle", "fx", "fy"];
    quantities.iter().for_each(|name| scene.record(&format!("hinge1.{name}")).unwrap());
    let simulation = simulate(scene, Method::default(), 0.02, 2.0);
    let column = |name: &str| simulation.history().column(&format!("hinge1.{name}")).unwrap();
    let [force, angle, fx, fy] = quantities.map(column);
    assert_eq!(simulation.history().dimension("hinge1.force_angle"), Some("rad"));
    for row in 0..force.len() {
        let found = at(angle[row].cos(), angle[row].sin()) * force[row];
        let off = (found - at(fx[row], fy[row])).norm();
        assert!(off <= 4.0 * f64::EPSILON * force[row] && force[row] > 0.0, "{row}: {off:.1e}");
    }
}

#[test]
fn the_arc_length_of_a_slider_is_its_position_times_the_length() {
    for mut scene in sliding_scenes::all(&smooth(5), SlidingRule::Conserving) {
        let names = recorded(&mut scene, ".arc_length");
        assert_eq!(names.len(), scene.sliders.len());
        let guide = |slider: &withy::joints::Slider| match slider.track {
            Some(track) => scene.track_length(track),
            None => scene.beams[slider.master].axis.length(),
        };
        let lengths: Vec<f64> = scene.sliders.iter().map(guide).collect();
        let simulation = simulate(scene, Method::default(), 0.02, 0.2);
        for (name, length) in names.iter().zip(lengths) {
            let along = simulation.history().column(name).unwrap();
            let position = name.replace("arc_length", "position");
            let position = simulation.history().column(&position).unwrap();
            for (along, position) in along.iter().zip(position) {
                assert!((along - position * length).abs() < 1e-13 * length, "{name}");
            }
        }
    }
}

#[test]
fn every_station_of_a_beam_has_the_same_quantities() {
    let scene = scenes::curved_pendulum(&smooth(4));
    let names = scene.sensor_names();
    let of_place = |place: &str| -> Vec<String> {
        let prefix = format!("beam1.{place}.");
        names.iter().filter_map(|name| name.strip_prefix(&prefix)).map(str::to_owned).collect()
    };
    assert_eq!(of_place("middle"), of_place("start"));
    assert_eq!(of_place("middle"), of_place("end"));
    assert_eq!(of_place("middle").len(), 15);
    let mut watched = scene;
    let middle = format!("[{}]", 0.5 * watched.beams[0].axis.length());
    for quantity in of_place("middle") {
        watched.record(&format!("beam1.middle.{quantity}")).unwrap();
        watched.record(&format!("beam1{middle}.{quantity}")).unwrap();
    }
    let simulation = simulate(watched, Method::default(), 0.02, 0.2);
    for quantity in of_place("middle") {
        let [one, other] = [".middle".to_owned(), middle.clone()]
            .map(|place| simulation.history().column(&format!("beam1{place}.{quantity}")).unwrap());
        assert_eq!(one, other, "{quantity}");
        assert!(one.iter().all(|value| value.is_finite()), "{quantity}");
    }
}

#[test]
fn sensors_are_stored_by_name_and_rewound_with_the_run() {
    let mut bead = sliding_scenes::bead_on_an_arc(&smooth(4), SlidingRule::Conserving);
    recorded(&mut bead, ".arc_length");
    let mut driven = scenes::driven(&smooth(4));
    recorded(&mut driven, ".power");
    recorded(&mut driven, ".force_angle");
    let mut scene = scenes::curved_pendulum(&smooth(4));
    for name in ["beam1.end.x", "beam1[1].M", "beam1.energy", "hinge1.present_force", "hinge1.fx"] {
        scene.record(name).unwrap();
    }
    [bead, driven, scene].into_iter().for_each(goes_back_and_on);
}

/// Saves a run, rewinds and forks it, and compares all columns.
fn goes_back_and_on(scene: Scene) {
    let mut simulation = Simulation::start(scene, settings(Method::default(), 0.02)).unwrap();
    simulation.enable_snapshots(1 << 24);
    run(&mut simulation, 0.4).unwrap();
    let bytes = simulation.to_bytes("swing").unwrap();
    let (_, mut again) = Simulation::from_bytes(&bytes).unwrap();
    let columns = |of: &Simulation| {
        let columns = of.history().columns().map(|(name, _)| of.history().column(name).unwrap());
        format!("{:?}", columns.collect::<Vec<_>>())
    };
    assert_eq!(columns(&simulation), columns(&again));
    simulation.back(5).unwrap();
    run(&mut simulation, 0.6).unwrap();
    run(&mut again, 0.6).unwrap();
    assert_eq!(columns(&simulation), columns(&again));
    let fork = simulation.fork().unwrap();
    assert_eq!(columns(&simulation), columns(&fork));
}

#[test]
fn unknown_quantity_is_rejected_with_a_list_of_quantities() {
    let mut scene = scenes::curved_pendulum(&smooth(4));
    let length = scene.beams[0].axis.length();
    for (name, message) in [
        ("beam2.end.x", "begin with the name of a beam"),
        ("beam1.end.z", "one of x, y, vx"),
        ("beam1.x", "beam1.end.x"),
        ("beam1[99].x", &format!("s from 0 to {length}")[..]),
        ("hinge1.x", "one of force, fx, fy, moment"),
        ("hinge2.fx", "begin with the name of a beam"),
        ("beam1.middle.z", "one of x, y, vx"),
    ] {
        let error = scene.record(name).unwrap_err();
        assert!(matches!(error, SystemError::NoSensor { .. }), "{error}");
        assert!(error.to_string().contains(message), "{error}");
    }
    let unread = ["=1+1", "\u{1b}[2J", "a\0b", "\u{202e}b", "a\u{200b}b", "e\u{301}", "end "];
    for name in ["", " ", "a,b", "two\nlines"].into_iter().chain(unread) {
        assert!(scene.record(name).is_err(), "{name:?}");
        let outside = scene.record_outside(name);
        assert!(matches!(outside, Err(SystemError::Unnamed { .. })), "{name:?}");
    }
    scene.record("beam1.end.x").unwrap();
    assert!(matches!(scene.record("beam1.end.x"), Err(SystemError::DuplicateSensor { .. })));
}
