//! Equilibrium of cantilevers: roll-up, elastica, Reissner's cantilever, and an arc that unrolls.
#![allow(clippy::unwrap_used)]

mod common;

use std::f64::consts::{FRAC_PI_2, TAU};

use common::reference::{number, text};
use common::{at, orders, scenes, sci};
use withy::beams::{Mesh, Section};
use withy::geometry::{Curve, Vec2};
use withy::joints::{JointKind, Partner};
use withy::loads::{Frame, LoadKind, Schedule};
use withy::model::Scene;
use withy::statics::{Equilibrium, Loading};

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
    scene.add_load(LoadKind::Force { station, force, frame: Frame::Dead }, constant.clone());
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
fn the_elastica_is_met_at_third_order() {
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
    // A mesh with zero-energy modes has no equilibrium that one could find: its stiffness is singular.
    let is_stiff = |(name, _): &(&str, Mesh)| *name != "cubic C1, 2 points";
    for (name, mesh) in common::meshes(32).into_iter().filter(is_stiff) {
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
