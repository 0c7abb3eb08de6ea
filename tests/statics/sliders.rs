//! Sliders in equilibria: tangents, positions and forces, stops, stability, modes, and starts of simulations.
#![allow(clippy::unwrap_used)]

use std::f64::consts::{FRAC_PI_2, PI};

use nalgebra::DMatrix;

use crate::common::probe::differences;
use crate::common::scenes::{add_beam, end_of, line};
use crate::common::sliding::{hinge_start, particle, slider};
use crate::common::{Random, at, energies, meshes, run, settings, sliding_scenes};
use withy::beams::{Mesh, Section, Station};
use withy::geometry::Curve;
use withy::integrators::{Constraints, Mechanism, Method};
use withy::joints::{EndAction, JointKind, Partner, SLIDING_RULES, Slider, SlidingRule};
use withy::linalg::BorderedMatrix;
use withy::loads::{LoadFrame, LoadKind, Schedule};
use withy::simulation::Simulation;
use withy::statics::{ArcLength, Control, Equilibrium, Loading, Stability, StaticsError};
use withy::system::{MasterEnd, MasterLimit, Scene, SliderState, System};

const GRAVITY: f64 = 9.81;

fn section(stiffness: f64) -> Section {
    Section {
        axial_stiffness: stiffness,
        shear_stiffness: stiffness,
        bending_stiffness: 100.0,
        mass_per_length: 0.1,
        rotary_inertia: 1e-3,
    }
}

fn smooth(spans: usize) -> Mesh {
    Mesh::bspline(spans, 3, 2).unwrap()
}

fn rests(scene: Scene, steps: usize) -> Result<Equilibrium, StaticsError> {
    Equilibrium::find(scene, Loading { steps, ..Loading::default() }, &mut |_| true)
}

/// Adds a particle on a beam, at an arc length in the undeformed configuration.
fn bead(scene: &mut Scene, master: usize, along: f64, mass: f64, rule: SlidingRule) -> Station {
    let axis = &scene.beams[master].axis;
    let xi = axis.parameter_at(along).unwrap();
    let place = axis.point(xi).unwrap();
    let station = particle(scene, place, mass);
    let name = scene.free_name("slider");
    scene.add_slider(Slider { name, ..slider(station, master, along, rule) }).unwrap();
    station
}

/// Beam between two hinges with a bead.
fn sag(spans: usize, shear: f64, along: f64, mass: f64, rule: SlidingRule) -> Scene {
    let mut scene = Scene::new("sag");
    let section = Section { mass_per_length: 1e-6, rotary_inertia: 1e-8, ..section(shear) };
    let wire = add_beam(&mut scene, line(at(0.0, 0.0), at(4.0, 0.0)), &smooth(spans), section);
    hinge_start(&mut scene, wire);
    let end = end_of(&mut scene, wire);
    scene.join(JointKind::Hinge, end, Partner::Ground).unwrap();
    bead(&mut scene, wire, along, mass, rule);
    scene.gravity = at(0.0, -GRAVITY);
    scene
}

#[test]
fn tangent_of_contacts_at_rest_is_an_exact_derivative() {
    let mut random = Random(33);
    for rule in [SlidingRule::Conserving, SlidingRule::Kinked] {
        for (mesh_name, mesh) in meshes(4) {
            for scene in sliding_scenes::all(&mesh, rule) {
                let mut model = System::assemble(&scene).unwrap();
                let (movements, shape) = (model.unknowns(), model.constraint_shape());
                for leans in [false, true] {
                    for slider in (0..scene.sliders.len()).filter(|_| leans) {
                        model.hold_at_stop(MasterLimit { slider, end: MasterEnd::End });
                    }
                    let label = format!("{rule:?}, {}, {mesh_name}, leans: {leans}", scene.name);
                    let mut unknowns = random.vector(movements + shape.width, 0.05);
                    for (index, value) in unknowns[movements..].iter_mut().enumerate() {
                        *value *= if index % 5 == 4 { 0.1 } else { 40.0 };
                    }
                    assert_tangent(&label, &mut model, &unknowns);
                }
            }
        }
    }
}

fn assert_tangent(label: &str, model: &mut System, unknowns: &[f64]) {
    let (movements, shape) = (model.unknowns(), model.constraint_shape());
    let (size, all) = (movements + shape.width, model.degrees_of_freedom());
    let mut tangent = BorderedMatrix::zeros(movements, model.half_bandwidth(), shape);
    model.begin_movement();
    model.add_linearised_static_forces(unknowns, 1.0, &mut vec![0.0; all], &mut tangent);
    let expected = differences(unknowns, 1e-5, &mut |unknowns| {
        model.begin_movement();
        let mut out = vec![0.0; all];
        model.add_static_forces(unknowns, 1.0, &mut out);
        out.truncate(size);
        out
    });
    // Other tests check the tangent of beams. Contacts do not contribute to it, because their forces are unknowns.
    let is_ours = |row: usize, column: usize| row >= movements || column >= movements;
    let ours = |matrix: &dyn Fn(usize, usize) -> f64| {
        DMatrix::from_fn(size, size, |i, j| if is_ours(i, j) { matrix(i, j) } else { 0.0 })
    };
    let (found, expected) = (ours(&|i, j| tangent.get(i, j)), ours(&|i, j| expected[(i, j)]));
    let error = (&found - &expected).amax() / expected.amax().max(1.0);
    assert!(error < 1e-7, "{label}: off by {error:.1e} of the largest entry");
}

#[test]
fn bead_rests_in_the_sag_of_its_wire() {
    for entry in SLIDING_RULES {
        let scene = sag(9, 1e5, 1.0, 2.0, entry.rule);
        let rest = rests(scene, 4).unwrap();
        let model = rest.model();
        let force = model.contact_force(0);
        println!("{}: at {}, force {force}", entry.name, model.slider_position(0));
        assert!((model.slider_position(0) - 0.5).abs() < 1e-9, "{}", entry.name);
        assert!((force - at(0.0, -2.0 * GRAVITY)).norm() < 1e-8, "{}: {force}", entry.name);
        assert_eq!(rest.stability(&mut || true), Stability::Stable);
        assert!(rest.path().points().iter().skip(2).all(|point| point.iterations <= 5));
        let place = |model: &System| *model.control_points().nth(1).unwrap().last().unwrap();
        let there = place(model);
        let mut simulation =
            Simulation::start_at_rest(&rest, settings(Method::EnergyMomentum, 0.01)).unwrap();
        run(&mut simulation, 2.0).unwrap();
        let off = (place(simulation.model()) - there).norm();
        let kinetic = simulation.history().samples().last().unwrap().measures.energy.kinetic;
        println!("  after 200 steps off by {off:.1e}, kinetic energy {kinetic:.1e}");
        assert!(off < 1e-9 && kinetic < 1e-14, "{}: {off} {kinetic}", entry.name);
    }
}

#[test]
fn sliding_load_on_a_slender_beam_deflects_it_as_timoshenko_theory() {
    // P L³/48 EI + P L/4 GA in the middle, for a load in the linear range.
    let (mass, shear) = (1e-6, 2e3);
    let load = mass * GRAVITY;
    let exact = load * (64.0 / 4800.0 + 4.0 / (4.0 * shear));
    for rule in [SlidingRule::Conserving, SlidingRule::Kinked] {
        let errors = [5, 9, 17].map(|spans| {
            let rest = rests(sag(spans, shear, 1.7, mass, rule), 1).unwrap();
            let sunk = -rest.model().control_points().nth(1).unwrap()[0].y;
            // Deflection by the small weight of the wire, with the factors 5/384 and 1/8.
            let wire = 4e-6 * GRAVITY * (5.0 * 64.0 / 38400.0 + 4.0 / (8.0 * shear));
            ((sunk - wire) / exact - 1.0).abs()
        });
        println!("{rule:?}: relative errors {errors:?}");
        let largest = if rule == SlidingRule::Kinked { 3e-4 } else { 3e-3 };
        assert!(errors[2] < largest, "{rule:?}: {errors:?}");
    }
}

#[test]
fn a_bead_in_a_stiff_arc_swings_as_a_pendulum() {
    for rule in [SlidingRule::Conserving, SlidingRule::Kinked] {
        let mut scene = Scene::new("bowl");
        let axis = Curve::arc(at(0.0, 0.0), 2.0, PI, 2.0 * PI).unwrap();
        let stiff = Section { bending_stiffness: 1e9, ..section(1e9) };
        let bowl = add_beam(&mut scene, axis, &smooth(96), stiff);
        let start = scene.station(bowl, 0.0).unwrap();
        scene.join(JointKind::Rigid, start, Partner::Ground).unwrap();
        let end = end_of(&mut scene, bowl);
        scene.join(JointKind::Rigid, end, Partner::Ground).unwrap();
        bead(&mut scene, bowl, 2.0, 1.0, rule);
        scene.gravity = at(0.0, -GRAVITY);
        let rest = rests(scene, 2).unwrap();
        assert!((rest.model().slider_position(0) - 0.5).abs() < 1e-6);
        let lowest = rest.modes(1, &mut || true).unwrap().all()[0].angular_frequency();
        let pendulum = (GRAVITY / 2.0).sqrt();
        println!("{rule:?}: {lowest} for {pendulum}");
        assert!((lowest / pendulum - 1.0).abs() < 1e-4, "{rule:?}: {lowest} {pendulum}");
    }
}

#[test]
fn disturbed_equilibrium_oscillates_with_the_frequencies_of_its_modes() {
    // Bead on a sagging wire with a short downward force. The second mode is that of wire and bead.
    for rule in [SlidingRule::Conserving, SlidingRule::Kinked] {
        let mut scene = sag(8, 2e3, 1.0, 2.0, rule);
        scene.beams[0].section = section(2e3).into();
        let blow = Schedule::hold_for(1e-3).unwrap();
        let station = scene.sliders[0].slave;
        let kind = LoadKind::Force { station, force: at(0.0, -20.0), frame: LoadFrame::Dead };
        let still = rests(scene.clone(), 4).unwrap();
        let modes = still.modes(2, &mut || true).unwrap();
        let period = modes.all()[1].period();
        scene.add_load(kind, blow);
        let loading = Loading { steps: 4, time: 1.0, ..Loading::default() };
        let rest = Equilibrium::find(scene, loading, &mut |_| true).unwrap();
        let place = |model: &System| model.control_points().nth(1).unwrap()[0].y;
        let there = place(rest.model());
        let mut simulation =
            Simulation::start_at_rest(&rest, settings(Method::FourthOrder, period / 100.0))
                .unwrap();
        let mut crossings = Vec::new();
        let (mut time, mut height) = (0.0, 0.0);
        while crossings.len() < 9 {
            let next = simulation.time() + period / 100.0;
            run(&mut simulation, next).unwrap();
            let now = place(simulation.model()) - there;
            if time > 0.01 && height < 0.0 && now >= 0.0 {
                crossings.push(time - height * (next - time) / (now - height));
            }
            (time, height) = (next, now);
        }
        let energies = energies(simulation.history());
        let drift =
            energies.iter().skip(2).fold(0.0_f64, |most, e| most.max((e - energies[2]).abs()));
        assert!(
            drift < 1e-11 * energies[2].abs().max(1.0),
            "{rule:?}: energy drifts by {drift:.1e}"
        );
        let measured = (crossings[8] - crossings[0]) / 8.0;
        println!("{rule:?}: period {measured} for {period}, slow one {}", modes.all()[0].period());
        assert!((measured / period - 1.0).abs() < 2e-3, "{rule:?}: {measured} {period}");
    }
}

#[test]
fn slider_rests_on_its_lower_stop_or_leaves_without_one() {
    let slope = |ends: EndAction| {
        let mut scene = Scene::new("slope");
        let rail = add_beam(&mut scene, line(at(0.0, 2.0), at(4.0, 0.0)), &smooth(8), section(1e6));
        let start = scene.station(rail, 0.0).unwrap();
        scene.join(JointKind::Rigid, start, Partner::Ground).unwrap();
        let end = end_of(&mut scene, rail);
        scene.join(JointKind::Hinge, end, Partner::Ground).unwrap();
        bead(&mut scene, rail, 1.0, 2.0, SlidingRule::Kinked);
        scene.sliders[0].ends = ends;
        scene.gravity = at(0.0, -GRAVITY);
        rests(scene, 3)
    };
    for ends in [EndAction::Stop, EndAction::Bounce] {
        let rest = slope(ends).unwrap();
        assert_eq!(rest.model().slider_state(0), SliderState::Held(MasterEnd::End));
        assert_eq!(rest.model().slider_position(0), 1.0);
        let force = rest.model().contact_force(0);
        assert!((force - at(0.0, -2.0 * GRAVITY)).norm() < 1e-8, "{force}");
        assert_eq!(rest.stability(&mut || true), Stability::Stable);
        let mut simulation =
            Simulation::start_at_rest(&rest, settings(Method::EnergyMomentum, 0.01)).unwrap();
        run(&mut simulation, 1.0).unwrap();
        assert!(!simulation.has_ended() && simulation.time() == 1.0);
        assert!(simulation.history().samples().last().unwrap().measures.energy.kinetic < 1e-14);
    }
    let error = slope(EndAction::Release).map(|_| ()).unwrap_err();
    assert!(error.to_string().contains("would leave its beam at its end"), "{error}");
}

#[test]
fn body_held_only_by_its_load_reaches_equilibrium() {
    // A hinged beam, and a chain of three beams, both initially horizontal. They hang vertically and are elongated by their weight.
    for links in [1, 3] {
        let mut scene = Scene::new("chain");
        let axial = 1e4;
        let mut last: Option<Station> = None;
        for link in 0..links {
            let (from, to) = (at(link as f64, 0.0), at(link as f64 + 1.0, 0.0));
            let beam = add_beam(&mut scene, line(from, to), &smooth(4), section(axial));
            let start = scene.station(beam, 0.0).unwrap();
            let partner = last.map_or(Partner::Ground, Partner::Station);
            scene.join(JointKind::Hinge, start, partner).unwrap();
            last = Some(end_of(&mut scene, beam));
        }
        scene.gravity = at(0.0, -GRAVITY);
        let length = f64::from(links);
        let rest = rests(scene, 3).unwrap();
        let tip = *rest.model().control_points().last().unwrap().last().unwrap();
        let hangs = length + 0.1 * GRAVITY * length * length / (2.0 * axial);
        println!("{links} links: tip {tip}, {} steps", rest.path().points().len());
        assert!((tip - at(0.0, -hangs)).norm() < 1e-7, "{links} links: {tip}, not {hangs}");
        assert_eq!(rest.stability(&mut || true), Stability::Stable);
    }
}

#[test]
fn beam_slides_through_a_fixed_ring_to_its_equilibrium() {
    // Heavy beam on a hinge that passes through a fixed ring. The contact force is transverse, so the beam lies on the line from the hinge to the ring.
    let mut scene = Scene::new("through a ring");
    let rod = add_beam(&mut scene, line(at(0.0, 0.0), at(3.0, 1.0)), &smooth(12), section(1e6));
    hinge_start(&mut scene, rod);
    let ring = particle(&mut scene, at(1.5, 0.5), 1.0);
    scene.join(JointKind::Hinge, ring, Partner::Ground).unwrap();
    let along = at(1.5, 0.5).norm();
    scene.add_slider(slider(ring, rod, along, SlidingRule::Kinked)).unwrap();
    scene.gravity = at(0.0, -GRAVITY);
    let rest = rests(scene, 2).unwrap();
    let force = rest.model().contact_force(0);
    let weight = 0.1 * 10.0_f64.sqrt() * GRAVITY;
    // Moments about the hinge, neglecting bending: F·ring = W·1.5.
    assert!(force.dot(&at(3.0, 1.0).normalize()).abs() < 2e-2 * force.norm(), "{force}");
    assert!((force.norm() * along / (weight * 1.5) - 1.0).abs() < 2e-2, "{force}");
    assert!((rest.model().slider_position(0) - 0.5).abs() < 1e-2);
}

#[test]
fn a_path_of_given_length_follows_a_slider_past_its_limit_load() {
    // Shallow arch with hinged ends, loaded by a bead. It snaps through: the load decreases and increases again.
    let arch = |control: Control, rule: SlidingRule| {
        let mut scene = Scene::new("arch");
        let axis = Curve::arc(at(0.0, -4.5), 5.0, FRAC_PI_2 + 0.4, FRAC_PI_2 - 0.4).unwrap();
        let arch = add_beam(&mut scene, axis, &smooth(12), section(1e5));
        hinge_start(&mut scene, arch);
        let end = end_of(&mut scene, arch);
        scene.join(JointKind::Hinge, end, Partner::Ground).unwrap();
        let half = 0.5 * scene.beams[arch].axis.length();
        let station = bead(&mut scene, arch, half, 1.0, rule);
        let kind = LoadKind::Force { station, force: at(0.0, -1500.0), frame: LoadFrame::Dead };
        scene.add_load(kind, Schedule::constant(1.0).unwrap());
        Equilibrium::find(scene, Loading { steps: 40, control, ..Loading::default() }, &mut |_| {
            true
        })
    };
    let path = Control::ArcLength(ArcLength { longest: 0.03, points: 60 });
    for rule in [SlidingRule::Conserving, SlidingRule::Kinked] {
        let followed = arch(path, rule).unwrap();
        let limits = followed.path().limit_points();
        println!("{rule:?}: limit points {limits:?}, ends at {}", followed.path().load_factor());
        assert!(!limits.is_empty(), "{rule:?}");
    }
}

#[test]
fn bead_beside_the_top_of_an_arch_descends_to_its_stop() {
    for (part, end) in [(0.502, MasterEnd::End), (0.47, MasterEnd::Start)] {
        let mut scene = Scene::new("hill");
        let axis = Curve::arc(at(0.0, 0.0), 2.0, 0.75 * PI, 0.25 * PI).unwrap();
        let hill = add_beam(&mut scene, axis, &smooth(12), section(1e6));
        let start = scene.station(hill, 0.0).unwrap();
        scene.join(JointKind::Rigid, start, Partner::Ground).unwrap();
        let last = end_of(&mut scene, hill);
        scene.join(JointKind::Rigid, last, Partner::Ground).unwrap();
        let along = part * scene.beams[hill].axis.length();
        bead(&mut scene, hill, along, 0.5, SlidingRule::Kinked);
        scene.gravity = at(0.0, -GRAVITY);
        let rest = rests(scene, 2).unwrap();
        assert_eq!(rest.model().slider_state(0), SliderState::Held(end), "{part}");
        assert_eq!(rest.stability(&mut || true), Stability::Stable, "{part}");
    }
}
