//! Sleeves without length in equilibrium, held by the ground, by turning bodies and by beams, compared with closed forms.
//!
//! The sling is that of Cazzolli & Dal Corso (Eur. J. Mech. A/Solids 105, 2024). The shape and the thrust of the rod follow from elliptic integrals.
#![allow(clippy::unwrap_used)]

use std::f64::consts::{FRAC_PI_2, FRAC_PI_4};

use crate::common::at;
use crate::common::body_scenes::add_body;
use crate::common::scenes::{add_beam, drive, end_of, line, start_of};
use withy::beams::{Mesh, Section, Station};
use withy::geometry::{Curve, Vec2, cross};
use withy::joints::{
    Component, Components, EndAction, JointKind, Partner, Restraint, Slider, SlidingRule,
};
use withy::loads::{LoadFrame, LoadKind, PrescribedMotion, Schedule};
use withy::statics::{Equilibrium, Loading, Stability};
use withy::system::Scene;

fn section(stiff: f64, bending: f64) -> Section {
    Section {
        axial_stiffness: stiff,
        shear_stiffness: stiff,
        bending_stiffness: bending,
        mass_per_length: 1.0,
        rotary_inertia: 1e-3,
    }
}

fn sleeve(scene: &mut Scene, holder: Station, rod: usize, along: f64) {
    let name = scene.free_name("sleeve");
    let slider = Slider::new(name, holder, rod, along);
    scene.add_slider(Slider { restraint: Restraint::PlaceAndDirection, ..slider }).unwrap();
}

fn hub(scene: &mut Scene, position: Vec2) -> Station {
    Station::on_rigid_body(add_body(scene, position, 0.0, (1.0, 1.0), &[]), 0)
}

/// Motion from zero to a value at t = 1.
fn growing(to: f64) -> PrescribedMotion {
    let rows = vec![(0.0, 0.0), (0.5, 0.0), (1.0, to)];
    PrescribedMotion::Position(Schedule::table(rows).unwrap())
}

fn push(scene: &mut Scene, station: Station, force: Vec2) {
    let kind = LoadKind::Force { station, force, frame: LoadFrame::Dead };
    scene.add_load(kind, Schedule::constant(1.0).unwrap());
}

fn rests(scene: Scene, steps: usize) -> Equilibrium {
    let loading = Loading { steps, time: 1.0, ..Loading::default() };
    Equilibrium::find(scene, loading, &mut |_| true).unwrap()
}

/// Straight rod in two sleeves at a distance of 1 that turn by 45° in opposite directions, in a scene turned by an angle.
fn sling(mesh: &Mesh, turn: f64) -> Equilibrium {
    let half = 0.8;
    let (sine, cosine) = turn.sin_cos();
    let along = at(cosine, sine);
    let mut scene = Scene::new("sling");
    let rod = add_beam(&mut scene, line(along * -half, along * half), mesh, section(1e8, 1.0));
    let crown = scene.station(rod, half).unwrap();
    scene.join(JointKind::InclinedRoller(at(-sine, cosine)), crown, Partner::Ground).unwrap();
    for side in [-1.0, 1.0] {
        let holder = hub(&mut scene, along * (0.5 * side));
        scene.join(JointKind::Hinge, holder, Partner::Ground).unwrap();
        drive(&mut scene, holder, &[(Component::Rotation, growing(-side * FRAC_PI_4))]);
        sleeve(&mut scene, holder, rod, half + 0.5 * side);
    }
    rests(scene, 4)
}

#[test]
fn rod_between_rotated_sleeves_agrees_with_the_elastica() {
    let (arc, thrust) = (1.11634123, 1.1079741491);
    let moment = (2.0_f64 * thrust).sqrt() * FRAC_PI_4.cos().sqrt();
    for (degree, tolerance) in [(3, 5e-7), (4, 2e-7), (5, 2e-7)] {
        let rest = sling(&Mesh::bspline(64, degree, degree - 1).unwrap(), 0.0);
        let model = rest.model();
        let found = model.slider_arc_length(1) - model.slider_arc_length(0);
        let force = model.contact_force(0);
        println!(
            "degree {degree}: arc {:e}, thrust {:e}, couple {:e}",
            found / arc - 1.0,
            force.x / thrust - 1.0,
            model.sleeve_couple(0) / moment - 1.0
        );
        assert!((found / arc - 1.0).abs() < tolerance);
        // The thrust is 200 times as sensitive to the geometry as the arc.
        assert!((force.x / thrust - 1.0).abs() < 5e-5);
        assert!((model.sleeve_couple(0) / moment - 1.0).abs() < 5e-6);
        assert!((model.sleeve_couple(0) + model.sleeve_couple(1)).abs() < 1e-6);
        assert_eq!(rest.stability(&mut || true), Stability::Stable);
    }
}

#[test]
fn a_turned_scene_has_the_same_equilibrium() {
    let mesh = Mesh::bspline(16, 3, 2).unwrap();
    let [one, turned] = [0.0, 0.7].map(|turn| sling(&mesh, turn));
    let (before, after) = (one.model(), turned.model());
    for index in [0, 1] {
        let apart = before.slider_arc_length(index) - after.slider_arc_length(index);
        assert!(apart.abs() < 1e-10, "{apart:e}");
        let couples = before.sleeve_couple(index) - after.sleeve_couple(index);
        assert!(couples.abs() < 1e-8, "{couples:e}");
        let forces = before.contact_force(index).norm() - after.contact_force(index).norm();
        assert!(forces.abs() < 1e-6, "{forces:e}");
    }
}

/// A rod that slides in a sleeve at the tip of a cantilever, under a small transverse load at its end.
#[test]
fn a_sleeve_on_a_beam_transmits_force_and_couple() {
    let (holder_bending, rod_bending, length, arm, load) = (3.0, 1.0, 1.0, 0.6, 1e-4);
    let mut scene = Scene::new("extension");
    let mesh = Mesh::bspline(16, 3, 2).unwrap();
    let from = at(0.0, 0.0);
    let holder =
        add_beam(&mut scene, line(from, at(length, 0.0)), &mesh, section(1e7, holder_bending));
    let rod = add_beam(
        &mut scene,
        line(at(length - 0.37, 0.0), at(length + arm, 0.0)),
        &Mesh::bspline(32, 3, 2).unwrap(),
        section(1e7, rod_bending),
    );
    let (root, mouth) = (start_of(&mut scene, holder), end_of(&mut scene, holder));
    let (back, tip) = (start_of(&mut scene, rod), end_of(&mut scene, rod));
    scene.join(JointKind::Rigid, root, Partner::Ground).unwrap();
    scene.join(JointKind::Support(Components::X), back, Partner::Ground).unwrap();
    sleeve(&mut scene, mouth, rod, 0.37);
    push(&mut scene, tip, at(0.0, load));
    let mut rest = rests(scene, 1);
    let (moment, model) = (load * arm, rest.model());
    let deflection = load * length.powi(3) / 3.0 + moment * length.powi(2) / 2.0;
    let rotation = load * length.powi(2) / 2.0 + moment * length;
    let expected =
        (deflection + arm * rotation) / holder_bending + load * arm.powi(3) / (3.0 * rod_bending);
    let place = rest.scene().place(&tip, model.meshes()).unwrap();
    let found = model.position(&place).y;
    println!(
        "tip {:e}, couple {:e}",
        found / expected - 1.0,
        model.sleeve_couple(0) / -moment - 1.0
    );
    assert!((found / expected - 1.0).abs() < 2e-6);
    assert!((model.sleeve_couple(0) / -moment - 1.0).abs() < 1e-6);
    assert!((model.contact_force(0).y / -load - 1.0).abs() < 1e-6);
    let root = rest.scene().place(&root, rest.model().meshes()).unwrap();
    let (force, reaction) = rest.reaction(&root).unwrap();
    assert!((force.y / -load - 1.0).abs() < 1e-8);
    assert!((reaction / -(load * (length + arm)) - 1.0).abs() < 1e-6, "{reaction:e}");
}

/// A cantilever between a sleeve on a hinged body with a spring and a support: soft, so that offsets of kinks are large.
#[test]
fn moments_about_a_soft_turning_sleeve_balance() {
    let mut scene = Scene::new("hub");
    let (section, mesh) = (section(30.0, 1.0), Mesh::bspline(8, 3, 2).unwrap());
    let rod = add_beam(&mut scene, line(at(-0.6, 0.0), at(1.0, 0.0)), &mesh, section);
    let holder = hub(&mut scene, at(0.0, 0.0));
    scene.join(JointKind::Hinge, holder, Partner::Ground).unwrap();
    drive(&mut scene, holder, &[(Component::Rotation, growing(0.4))]);
    sleeve(&mut scene, holder, rod, 0.6);
    let (back, tip) = (start_of(&mut scene, rod), end_of(&mut scene, rod));
    scene.join(JointKind::Hinge, back, Partner::Ground).unwrap();
    push(&mut scene, tip, at(0.3, -2.0));
    let mut rest = rests(scene, 4);
    assert!(rest.path().points().iter().all(|point| point.iterations <= 6));
    let [body, back, tip] = [holder, back, tip]
        .map(|station| rest.scene().place(&station, rest.model().meshes()).unwrap());
    let (hinge, moment) = rest.reaction(&body).unwrap();
    let (support, _) = rest.reaction(&back).unwrap();
    let [arm, end] = [back, tip].map(|place| rest.model().position(&place));
    let load = at(0.3, -2.0);
    let forces = hinge + support + load;
    let moments = moment + cross(arm, support) + cross(end, load);
    assert!(forces.norm() < 1e-10, "{forces}");
    assert!(moments.abs() < 1e-9, "{moments:e}");
    // The moment of the contact force about the smooth axis is small, but not zero.
    let couple = rest.model().sleeve_couple(0);
    assert!((moment - couple).abs() > 1e-5, "{moment} {couple}");
}

#[test]
fn a_circular_rod_slides_through_a_sleeve_without_strain() {
    for (spans, couple) in [(24, 1e-4), (48, 1e-5)] {
        let mut scene = Scene::new("circular");
        let axis = Curve::arc(at(0.0, 0.0), 1.0, 0.5, 2.5).unwrap();
        let rod =
            add_beam(&mut scene, axis, &Mesh::bspline(spans, 3, 2).unwrap(), section(1e4, 1.0));
        let holder = scene.add_holder("eye", at(0.0, 1.0)).unwrap();
        sleeve(&mut scene, holder, rod, FRAC_PI_2 - 0.5);
        let (start, by) = (start_of(&mut scene, rod), 0.3_f64);
        let (from, to) = (at(0.5_f64.cos(), 0.5_f64.sin()), at((0.5 + by).cos(), (0.5 + by).sin()));
        let moved = to - from;
        let motions = [(Component::X, growing(moved.x)), (Component::Y, growing(moved.y))];
        drive(&mut scene, start, &motions);
        let rest = rests(scene, 4);
        let model = rest.model();
        assert!((model.slider_arc_length(0) - (FRAC_PI_2 - 0.5 - by)).abs() < 1e-5);
        assert!(model.sleeve_couple(0).abs() < couple, "{}", model.sleeve_couple(0));
        assert!(model.contact_force(0).norm() < 10.0 * couple);
    }
}

#[test]
fn a_rod_is_held_at_its_end_or_leaves_the_sleeve() {
    let scene = |ends: EndAction| {
        let mut scene = Scene::new("plunger");
        let (section, mesh) = (section(1e4, 1.0), Mesh::bspline(16, 3, 2).unwrap());
        let rod = add_beam(&mut scene, line(at(-0.2, 0.0), at(0.8, 0.0)), &mesh, section);
        let holder = scene.add_holder("eye", at(0.0, 0.0)).unwrap();
        let slider = Slider::new("sleeve", holder, rod, 0.2);
        let restraint = Restraint::PlaceAndDirection;
        scene.add_slider(Slider { restraint, ends, ..slider }).unwrap();
        let tip = end_of(&mut scene, rod);
        push(&mut scene, tip, at(1.0, 0.1));
        scene
    };
    let rest = rests(scene(EndAction::Stop), 2);
    assert_eq!(rest.model().slider_held_by(0), Some("start"));
    assert!((rest.model().contact_force(0) + at(1.0, 0.1)).norm() < 1e-8);
    // A clamped rod under a small transverse load, with a tension of 1 that stiffens it.
    let couple = rest.model().sleeve_couple(0);
    assert!(couple < -0.06 && couple > -0.1, "{couple}");
    let loading = Loading { steps: 2, ..Loading::default() };
    assert!(Equilibrium::find(scene(EndAction::Release), loading, &mut |_| true).is_err());
}

#[test]
fn sleeves_with_friction_stops_or_other_rules_are_rejected() {
    let mut scene = Scene::new("refused");
    let (section, mesh) = (section(1e4, 1.0), Mesh::bspline(16, 3, 2).unwrap());
    let rod = add_beam(&mut scene, line(at(-0.2, 0.0), at(0.8, 0.0)), &mesh, section);
    let holder = scene.add_holder("eye", at(0.0, 0.0)).unwrap();
    let slider = Slider {
        restraint: Restraint::PlaceAndDirection,
        ..Slider::new("sleeve", holder, rod, 0.2)
    };
    for wrong in [
        Slider { friction: 0.1, ..slider.clone() },
        Slider { rule: SlidingRule::Kinked, ..slider.clone() },
        Slider { ends: EndAction::Bounce, ..slider },
    ] {
        let error = scene.add_slider(wrong).unwrap_err().to_string();
        assert!(error.contains("a sleeve is not available with"), "{error}");
    }
}
