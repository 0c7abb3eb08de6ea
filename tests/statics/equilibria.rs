//! Equilibrium of cantilevers: roll-up, elastica, Reissner's cantilever, and an arc that unrolls.
#![allow(clippy::unwrap_used)]

use std::f64::consts::{FRAC_PI_2, PI, TAU};

use crate::common::reference::{number, text};
use crate::common::{at, orders, scenes, sci};
use withy::beams::{Mesh, Section, Station};
use withy::geometry::{Basis, Curve, KnotVector, Vec2};
use withy::integrators::Method;
use withy::joints::{JointKind, Partner};
use withy::loads::{LoadFrame, LoadKind, Schedule};
use withy::simulation::Simulation;
use withy::statics::{ArcLength, Control, Equilibrium, Loading, Stability, StaticsError};
use withy::system::Scene;

const LENGTH: f64 = 10.0;
const BENDING: f64 = 100.0;

fn section(axial_stiffness: f64, shear_stiffness: f64) -> Section {
    Section { axial_stiffness, shear_stiffness, ..scenes::spaghetti_section(1.0, BENDING) }
}

fn clamped(axis: Curve, mesh: &Mesh, section: Section) -> Scene {
    let mut scene = Scene::new("cantilever");
    let beam = scenes::add_beam(&mut scene, axis, mesh, section);
    let start = scene.station(beam, 0.0).unwrap();
    scene.join(JointKind::Rigid, start, Partner::Ground).unwrap();
    scene
}

fn straight() -> Curve {
    scenes::line(Vec2::zeros(), at(LENGTH, 0.0))
}

fn smooth(spans: usize) -> Mesh {
    Mesh::bspline(spans, 3, 2).unwrap()
}

struct Tip {
    position: Vec2,
    angle: f64,
    iterations: usize,
    strain_energy: f64,
}

/// Loads the tip of a cantilever in equal steps.
fn load_tip(mut scene: Scene, force: Vec2, moment: f64, steps: usize) -> Tip {
    let station = scenes::end_of(&mut scene, 0);
    let constant = Schedule::constant(1.0).unwrap();
    scene.add_load(LoadKind::Force { station, force, frame: LoadFrame::Dead }, constant.clone());
    scene.add_load(LoadKind::Moment { station, moment }, constant);
    let rest =
        Equilibrium::find(scene, Loading { steps, ..Loading::default() }, &mut |_| true).unwrap();
    let model = rest.model();
    let end = rest.path().points().last().unwrap();
    Tip {
        position: *model.control_points().next().unwrap().last().unwrap(),
        angle: model.end_angles(0).1,
        iterations: rest.path().points().iter().map(|point| point.iterations).max().unwrap(),
        strain_energy: end.strain_energy,
    }
}

#[test]
fn a_cantilever_closes_to_a_circle_with_three_iterations_a_load_step() {
    for stiffness in [1e4, 1e8] {
        let moment = TAU * BENDING / LENGTH;
        let errors = [(4, 2e-2), (8, 1.5e-3), (16, 5e-5)].map(|(spans, design)| {
            let scene = clamped(straight(), &smooth(spans), section(stiffness, stiffness));
            let tip = load_tip(scene, Vec2::zeros(), moment, 8);
            println!(
                "circle, EA = {stiffness:e}, {spans:2} spans: \
                 tip off by {:.2e} (design: {design:e}), angle by {:.1e}, {} iterations",
                tip.position.norm(),
                tip.angle - TAU,
                tip.iterations
            );
            assert!(tip.position.norm() < 1.2 * design, "{spans} spans: {}", tip.position);
            assert!((tip.angle - TAU).abs() < 1e-10 && tip.iterations <= 3);
            tip.position.norm()
        });
        println!("circle, EA = {stiffness:e}: orders {:.2?}", orders(&errors));
        assert!(orders(&errors).iter().all(|order| *order > 2.85));
    }
}

#[test]
fn every_step_of_the_roll_up_lies_on_its_circle() {
    let json: serde_json::Value = serde_json::from_str(&text("P4_statics.json")).unwrap();
    for case in json["rollup"]["cases"].as_array().unwrap() {
        let angle = number(&case["phi_over_pi"]) * 0.5 * TAU;
        let exact = at(number(&case["x_over_L"]), number(&case["y_over_L"])) * LENGTH;
        let scene = clamped(straight(), &smooth(32), section(1e4, 1e4));
        let tip = load_tip(scene, Vec2::zeros(), angle * BENDING / LENGTH, 8);
        let error = (tip.position - exact).norm();
        println!("rolled up by {angle:.3} rad: tip off by {error:.1e}");
        assert!(error < 1e-5, "{error}");
    }
}

#[test]
fn elastica_agrees_with_elliptic_integrals_for_every_load() {
    let json: serde_json::Value = serde_json::from_str(&text("P4_statics.json")).unwrap();
    for case in json["elastica"]["cases"].as_array().unwrap() {
        let load = number(&case["a2"]) * BENDING / LENGTH.powi(2);
        let exact = at(number(&case["x_over_L"]), number(&case["y_over_L"])) * LENGTH;
        let scene = clamped(straight(), &smooth(32), section(1e10, 1e10));
        let tip = load_tip(scene, at(0.0, load), 0.0, 8);
        let error = (tip.position - exact).norm() / LENGTH;
        assert!(error < 1e-6, "{}: {error}", case["a2"]);
        assert!((tip.angle - number(&case["theta_L"])).abs() < 2e-6, "{}", case["a2"]);
    }
}

#[test]
fn elastica_converges_at_third_order() {
    let json: serde_json::Value = serde_json::from_str(&text("P4_statics.json")).unwrap();
    let case = &json["elastica"]["cases"][9];
    let exact = at(number(&case["x_over_L"]), number(&case["y_over_L"])) * LENGTH;
    let errors = [(8, 2e-4), (16, 4e-5), (32, 4e-6)].map(|(spans, design)| {
        let scene = clamped(straight(), &smooth(spans), section(1e10, 1e10));
        let tip = load_tip(scene, at(0.0, 10.0 * BENDING / LENGTH.powi(2)), 0.0, 8);
        let error = (tip.position - exact).norm() / LENGTH;
        println!(
            "elastica, {spans} spans: \
             tip off by {error:.1e} (design: {design:e}), angle by {:.1e}, {} iterations",
            tip.angle - number(&case["theta_L"]),
            tip.iterations
        );
        error
    });
    println!("elastica: {} orders {:.2?}", sci(&errors), orders(&errors));
    assert!(errors[2] < 1e-5 && (errors[0] / errors[2]).log2() > 2.0 * 2.85);
}

#[test]
fn reissners_cantilever_has_the_tip_of_the_exact_solution() {
    let json: serde_json::Value = serde_json::from_str(&text("P4_statics.json")).unwrap();
    for case in json["reissner"]["cases"].as_array().unwrap() {
        let section = section(number(&case["EA"]), number(&case["GAs"]));
        let scene = clamped(straight(), &smooth(32), section);
        let tip = load_tip(scene, at(0.0, number(&case["P"])), 0.0, 8);
        let error = (tip.position - at(number(&case["x_tip"]), number(&case["y_tip"]))).norm();
        let turn = tip.angle - number(&case["theta_L"]);
        println!(
            "Reissner, EA = {}, GA = {}: tip off by {error:.1e}, angle by {turn:.1e}",
            case["EA"], case["GAs"]
        );
        let tolerance = 1.0 / number(&case["EA"]);
        assert!(error < tolerance && turn.abs() < tolerance, "{error} {turn}");
    }
}

#[test]
fn a_quarter_arc_unrolls_to_a_line() {
    let radius = LENGTH / FRAC_PI_2;
    // A mesh with zero-energy modes has a singular stiffness, so no equilibrium can be found.
    let is_stiff = |(name, _): &(&str, Mesh)| *name != "cubic C1, 2 points";
    for (name, mesh) in crate::common::meshes(32).into_iter().filter(is_stiff) {
        let arc = Curve::arc(at(0.0, radius), radius, -FRAC_PI_2, 0.0).unwrap();
        let tip =
            load_tip(clamped(arc, &mesh, section(1e4, 1e4)), Vec2::zeros(), -BENDING / radius, 8);
        let error = (tip.position - at(LENGTH, 0.0)).norm();
        let expected = 0.5 * BENDING * LENGTH / radius.powi(2);
        println!(
            "{name:24} unrolled: tip off by {error:.1e}, \
             angle by {:.1e}, strain energy by {:.1e}",
            tip.angle,
            tip.strain_energy / expected - 1.0
        );
        assert!(error < 1e-2);
    }
}

fn with_force(mut scene: Scene, station: Station, force: Vec2) -> Scene {
    let load = LoadKind::Force { station, force, frame: LoadFrame::Dead };
    scene.add_load(load, Schedule::constant(1.0).unwrap());
    scene
}

fn find(scene: Scene, loading: Loading) -> Result<Equilibrium, StaticsError> {
    Equilibrium::find(scene, loading, &mut |_| true)
}

fn along(steps: usize, points: usize) -> Loading {
    let control = Control::ArcLength(ArcLength { longest: 0.05, points });
    Loading { steps, control, ..Loading::default() }
}

/// Circular arch of 215°, clamped at one end and hinged at the other, with a downward force at its crown.
fn deep_arch(force: f64) -> Scene {
    let (radius, lean) = (100.0, 17.5_f64.to_radians());
    let axis = Curve::arc(Vec2::zeros(), radius, -lean, PI + lean).unwrap();
    let length = axis.length();
    let section = Section { bending_stiffness: 1e6, ..section(1e8, 1e8) };
    let mut scene = clamped(axis, &smooth(40), section);
    let end = scene.station(0, length).unwrap();
    scene.join(JointKind::Hinge, end, Partner::Ground).unwrap();
    let crown = scene.station(0, 0.5 * length).unwrap();
    with_force(scene, crown, at(0.0, -force))
}

/// D. A. DaDeppo & R. Schmidt, Instability of clamped-hinged circular arches subjected to a point load, J. Appl. Mech. 42 (1975) 894–896: limit load 897
/// without extension and shear.
#[test]
fn the_deep_arch_of_dadeppo_and_schmidt_buckles_at_897() {
    let rest = find(deep_arch(1000.0), along(20, 150)).unwrap();
    let limits = rest.path().limit_points();
    println!("deep arch: limit points {limits:.5?}, {} points", rest.path().points().len());
    assert!((limits[0] * 1000.0 / 897.0 - 1.0).abs() < 2e-3, "{limits:?}");
    // Load steps succeed up to the limit load, and find no equilibrium beyond it.
    let under = |factor| Loading { steps: 20, factor, ..Loading::default() };
    find(deep_arch(1000.0), under(0.99 * limits[0])).unwrap();
    let beyond = find(deep_arch(1000.0), under(1.01 * limits[0])).map(|_| ()).unwrap_err();
    let StaticsError::NoEquilibrium { reached, .. } = beyond else { panic!("{beyond}") };
    assert!(reached > 0.98 * limits[0] && reached <= 1.001 * limits[0], "{reached}");
}

/// Two hinged legs with a rigid corner, and a downward force at a fifth of the upper leg.
fn lees_frame(force: f64) -> Scene {
    let side = 120.0;
    let section = Section { bending_stiffness: 14400.0, ..section(4.32e4, 4.32e6) };
    let mut scene = Scene::new("Lee's frame");
    let leg = scenes::line(Vec2::zeros(), at(0.0, side));
    let leg = scenes::add_beam(&mut scene, leg, &smooth(16), section);
    let top = scenes::line(at(0.0, side), at(side, side));
    let top = scenes::add_beam(&mut scene, top, &smooth(20), section);
    let corner = [(leg, side), (top, 0.0)].map(|(beam, s)| scene.station(beam, s).unwrap());
    scene.join(JointKind::Rigid, corner[0], Partner::Station(corner[1])).unwrap();
    for (beam, s) in [(leg, 0.0), (top, side)] {
        let station = scene.station(beam, s).unwrap();
        scene.join(JointKind::Hinge, station, Partner::Ground).unwrap();
    }
    let fifth = scene.station(top, 0.2 * side).unwrap();
    with_force(scene, fifth, at(0.0, -force))
}

/// S.-L. Lee, F. S. Manuel & E. C. Rossow, Large deflections and stability of elastic frames, J. Eng. Mech. Div. ASCE 94
/// (1968) 521–547: first limit load 18.55.
#[test]
fn lees_frame_is_followed_through_both_its_limit_points() {
    let rest = find(lees_frame(25.0), along(20, 400)).unwrap();
    let limits: Vec<f64> = rest.path().limit_points().iter().map(|factor| 25.0 * factor).collect();
    println!("Lee's frame: limit loads {limits:.4?}, {} points", rest.path().points().len());
    assert_eq!(limits.len(), 2);
    assert!((limits[0] / 18.55 - 1.0).abs() < 5e-3, "{limits:?}");
    assert!(limits[1] < 0.0, "{limits:?}");
    assert_eq!(rest.path().load_factor(), 1.0);
}

#[test]
fn a_configuration_between_limit_points_is_unstable() {
    let before = find(lees_frame(25.0), along(20, 8)).unwrap();
    assert!(
        before.path().limit_points().is_empty()
            && before.modes(2, &mut || true).unwrap().is_stable()
    );
    let paths =
        (10..60).step_by(2).map(|points| find(lees_frame(25.0), along(20, points)).unwrap());
    let is_beyond = |rest: &Equilibrium| !rest.path().limit_points().is_empty();
    let between = paths.into_iter().find(is_beyond).unwrap();
    let modes = between.modes(2, &mut || true).unwrap();
    assert!(!modes.is_stable() && modes.all()[0].growth_rate() > 0.0);
    assert_eq!(modes.all()[0].angular_frequency(), 0.0);
}

/// Patch test: a constant strain is exact on spans of any length.
#[test]
fn a_bar_under_tension_is_exact_on_every_mesh_with_the_patch_rule() {
    let graded = [0.0, 0.0, 0.0, 0.0, 0.1, 0.25, 0.3, 0.7, 1.0, 1.0, 1.0, 1.0];
    let meshes = crate::common::meshes(16).into_iter().chain([
        ("graded", Mesh::new(Basis::BSpline(KnotVector::new(3, graded.to_vec()).unwrap()))),
        ("with a break", smooth(9).with_breaks(&[0.4]).unwrap()),
    ]);
    for (name, mesh) in meshes {
        // The patch rule does not apply to even degrees, which have an extra quadrature point. Two points per C1 span leave zero-energy modes.
        if ["quadratic C1", "degree 4, C3", "cubic C1, 2 points"].contains(&name) {
            continue;
        }
        let tip = load_tip(clamped(straight(), &mesh, section(1e4, 1e4)), at(50.0, 0.0), 0.0, 1);
        let error = (tip.position - at(LENGTH + 50.0 * LENGTH / 1e4, 0.0)).norm();
        assert!(error < 1e-11, "{name}: {error:e}");
    }
}

#[test]
fn reactions_balance_the_loads() {
    let scene = clamped(straight(), &smooth(16), section(1e4, 1e4));
    let (start, mut scene) = (scene.stations[0], scene);
    let end = scenes::end_of(&mut scene, 0);
    let mut rest =
        find(with_force(scene, end, at(0.0, 10.0)), Loading { steps: 8, ..Loading::default() })
            .unwrap();
    let place = |station: &Station| rest.scene().place(station, rest.model().meshes()).unwrap();
    let (start, end) = (place(&start), place(&end));
    let tip = rest.model().position(&end);
    let (force, moment) = rest.reaction(&start).unwrap();
    assert!((force - at(0.0, -10.0)).norm() < 1e-9, "{force}");
    assert!((moment + 10.0 * tip.x).abs() < 1e-8, "{moment}");
    assert_eq!(rest.reaction(&end), None);
}

/// The bending stiffness is 1e-14 of the axial stiffness and is lost in rounding, but Newton's method converges.
#[test]
fn nearly_inextensible_beam_bends_correctly() {
    let bend = |stiffness: f64| {
        let scene = clamped(straight(), &smooth(8), section(stiffness, stiffness));
        load_tip(scene, at(0.0, 1.0), 0.0, 8).position
    };
    let (stiff, extreme) = (bend(1e8), bend(1e14));
    assert!((stiff - extreme).norm() < 1e-5, "{stiff} {extreme}");
}

#[test]
fn stability_agrees_with_eulers_column_or_is_unknown() {
    let at_part = |part: f64, frame: LoadFrame| {
        let mut scene = clamped(straight(), &smooth(16), section(1e7, 1e7));
        let station = scenes::end_of(&mut scene, 0);
        let force = at(-part * PI.powi(2) * BENDING / (4.0 * LENGTH * LENGTH), 0.0);
        let load = LoadKind::Force { station, force, frame };
        scene.add_load(load, Schedule::constant(1.0).unwrap());
        find(scene, Loading::default()).unwrap().stability(&mut || true)
    };
    assert_eq!(at_part(0.99, LoadFrame::Dead), Stability::Stable);
    assert_eq!(at_part(1.01, LoadFrame::Dead), Stability::Unstable);
    assert_eq!(at_part(0.5, LoadFrame::Follower), Stability::Follower);
}

/// A column with a small lateral force buckles in the direction of this force, for any step and force. Near the Euler load there are two more branches, on
/// which a step may end.
#[test]
fn a_pushed_column_buckles_to_the_side_it_is_pushed_to() {
    let critical = PI.powi(2) * BENDING / (4.0 * LENGTH * LENGTH);
    let tip = |push: f64, part: f64, loading: Loading| {
        let mut scene = clamped(straight(), &smooth(8), section(1e7, 1e7));
        let end = scenes::end_of(&mut scene, 0);
        let scene = with_force(scene, end, at(-part, push) * critical);
        let rest = find(scene, loading).unwrap();
        assert_eq!(rest.stability(&mut || true), Stability::Stable, "{push} {part} {loading:?}");
        let place = rest.scene().place(&end, rest.model().meshes()).unwrap();
        rest.model().position(&place)
    };
    for (push, part) in [(1e-1, 2.0), (3e-2, 1.5), (1e-2, 1.29), (1e-3, 1.29), (1e-3, 1.05)] {
        let followed = tip(push, part, along(50, 1000));
        for steps in [10, 15, 20, 30, 50, 70, 100] {
            let found = tip(push, part, Loading { steps, ..Loading::default() });
            assert!((found - followed).norm() < 1e-6 * LENGTH, "{push} {part} {steps}: {found}");
        }
    }
}

/// Two beams joined at one clamped corner: the reaction at either beam is the same total reaction.
#[test]
fn support_reaction_includes_only_bodies_joined_to_it() {
    let mut scene = clamped(straight(), &smooth(8), section(1e4, 1e4));
    let up = scenes::line(Vec2::zeros(), at(0.0, LENGTH));
    let up = scenes::add_beam(&mut scene, up, &smooth(8), section(1e4, 1e4));
    let corner = [0, up].map(|beam| scene.station(beam, 0.0).unwrap());
    scene.join(JointKind::Rigid, corner[1], Partner::Station(corner[0])).unwrap();
    let ends = [0, up].map(|beam| scene.station(beam, LENGTH).unwrap());
    let beside = scene.station(0, 0.05).unwrap();
    let scene = with_force(with_force(scene, ends[0], at(0.0, 2.0)), ends[1], at(1.0, 0.0));
    let mut rest = find(scene, Loading { steps: 4, ..Loading::default() }).unwrap();
    let place = |station: &Station| rest.scene().place(station, rest.model().meshes()).unwrap();
    let (corner, beside) = (corner.map(|station| place(&station)), place(&beside));
    for corner in corner {
        let (force, _) = rest.reaction(&corner).unwrap();
        assert!((force - at(-1.0, -2.0)).norm() < 1e-9, "{force}");
    }
    assert_eq!(rest.reaction(&beside), None);
}

/// Two shallow bars that meet under a force, and snap through beyond the limit load.
fn truss(force: f64) -> Scene {
    let mut scene = Scene::new("truss");
    // The bending stiffness prevents buckling of the bars before the snap-through.
    let section = Section { bending_stiffness: 1e4, ..section(1e4, 1e4) };
    let top = at(10.0, 1.0);
    let bars = [(Vec2::zeros(), top), (top, at(20.0, 0.0))].map(|(from, to)| {
        scenes::add_beam(&mut scene, scenes::line(from, to), &smooth(4), section)
    });
    let length = (top - Vec2::zeros()).norm();
    let [left, right] = bars.map(|bar| [0.0, length].map(|s| scene.station(bar, s).unwrap()));
    scene.join(JointKind::Hinge, left[1], Partner::Station(right[0])).unwrap();
    scene.join(JointKind::Hinge, left[0], Partner::Ground).unwrap();
    scene.join(JointKind::Hinge, right[1], Partner::Ground).unwrap();
    with_force(scene, left[1], at(0.0, -force))
}

#[test]
fn load_control_does_not_snap_through() {
    let limit = find(truss(12.0), along(40, 300)).unwrap().path().limit_points()[0];
    for steps in [1, 4, 10, 40] {
        let error =
            find(truss(12.0), Loading { steps, ..Loading::default() }).map(|_| ()).unwrap_err();
        let StaticsError::NoEquilibrium { reached, .. } = error else { panic!("{error}") };
        println!("truss, {steps:2} steps: lost at {reached:.4}, limit point {limit:.4}");
        assert!(reached <= 1.001 * limit, "{steps}: {reached} {limit}");
    }
}

#[test]
fn last_load_factor_is_the_requested_one() {
    for (factor, steps) in [(0.1, 3), (0.11, 10), (0.81, 7), (-0.3, 10)] {
        let scene = clamped(straight(), &smooth(4), section(1e4, 1e4));
        let mut scene = scene;
        let end = scenes::end_of(&mut scene, 0);
        let scene = with_force(scene, end, at(0.0, 1.0));
        let rest = find(scene, Loading { steps, factor, ..Loading::default() }).unwrap();
        assert_eq!(rest.path().load_factor(), factor);
        assert_eq!(rest.path().points().len(), steps + 1);
    }
}

#[test]
fn unsupported_unloaded_and_sliding_bodies_are_reported() {
    let mut free = Scene::new("free");
    scenes::add_beam(&mut free, straight(), &smooth(4), section(1e4, 1e4));
    let end = scenes::end_of(&mut free, 0);
    let loose = find(with_force(free.clone(), end, at(0.0, 1.0)), Loading::default());
    let error = loose.map(|_| ()).unwrap_err();
    assert!(matches!(error, StaticsError::Unrestrained { movements: 3, .. }), "{error}");
    let nothing = find(free, Loading::default()).map(|_| ()).unwrap_err();
    assert!(matches!(nothing, StaticsError::NoLoad { .. }), "{nothing}");
    let held = clamped(straight(), &smooth(4), section(1e4, 1e4));
    let mut stopped = held.clone();
    let end = scenes::end_of(&mut stopped, 0);
    let asked = Loading { steps: 4, ..Loading::default() };
    let mut goes_on = |reached: f64| reached < 0.5;
    let error = Equilibrium::find(with_force(stopped, end, at(0.0, 1.0)), asked, &mut goes_on);
    assert_eq!(error.map(|_| ()).unwrap_err(), StaticsError::Interrupted { reached: 0.5 });
    for loading in [
        Loading { steps: 0, ..Loading::default() },
        Loading { factor: f64::NAN, ..Loading::default() },
        Loading { time: f64::INFINITY, ..Loading::default() },
    ] {
        let error = find(held.clone(), loading).map(|_| ()).unwrap_err();
        assert!(matches!(error, StaticsError::Value { .. }), "{error}");
    }
}

#[test]
fn a_search_stops_within_an_iteration() {
    let load = |mut scene: Scene| {
        let end = scenes::end_of(&mut scene, 0);
        with_force(scene, end, at(3.0, 20.0))
    };
    let clamped = load(clamped(straight(), &smooth(4), section(1e4, 1e4)));
    let mut hanging = Scene::new("hanging");
    scenes::add_beam(&mut hanging, straight(), &smooth(4), section(1e4, 1e4));
    let start = scenes::start_of(&mut hanging, 0);
    hanging.join(JointKind::Hinge, start, Partner::Ground).unwrap();
    let arc = Control::ArcLength(ArcLength { longest: 1.0, points: 3 });
    for (scene, control) in
        [(&clamped, Control::Load), (&clamped, arc), (&load(hanging), Control::Load)]
    {
        let loading = Loading { steps: 1, control, ..Loading::default() };
        // Interrupts the search at each call in turn, until it completes.
        for stop in 1.. {
            let mut calls = 0;
            let found = Equilibrium::find(scene.clone(), loading, &mut |_| {
                calls += 1;
                calls < stop
            });
            if let Err(StaticsError::Interrupted { .. }) = found {
                assert!(calls <= stop + 1, "{control:?}: {calls} {stop}");
                continue;
            }
            let iterations: usize =
                found.unwrap().path().points().iter().map(|point| point.iterations).sum();
            println!("{control:?}: {iterations} iterations, {calls} calls");
            assert!(calls > iterations, "{control:?}: {iterations} {calls}");
            break;
        }
    }
}

#[test]
fn simulation_from_an_equilibrium_stays_at_rest_and_oscillates_after_unloading() {
    let mut scene = clamped(straight(), &smooth(8), section(1e4, 1e4));
    let station = scenes::end_of(&mut scene, 0);
    let load = LoadKind::Force { station, force: at(0.0, 5.0), frame: LoadFrame::Dead };
    scene.add_load(load, Schedule::hold_for(1.0).unwrap());
    let rest = find(scene, Loading { steps: 4, ..Loading::default() }).unwrap();
    let place = rest.scene().place(&station, rest.model().meshes()).unwrap();
    let tip = rest.model().position(&place);
    let settings = crate::common::settings(Method::EnergyMomentum, 0.05);
    let mut simulation = Simulation::start_at_rest(&rest, settings).unwrap();
    let strain = simulation.history().samples()[0].measures.energy.strain;
    crate::common::run(&mut simulation, 1.0).unwrap();
    assert!((simulation.model().position(&place) - tip).norm() < 1e-8);
    crate::common::run(&mut simulation, 3.0).unwrap();
    assert!((simulation.model().position(&place) - tip).norm() > 1.0);
    let energy = simulation.history().samples().last().unwrap().measures.energy.total();
    assert!((energy / strain - 1.0).abs() < 1e-9, "{energy} {strain}");
}
