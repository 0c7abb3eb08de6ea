//! Small cases for tests.

use std::rc::Rc;
use std::sync::atomic::AtomicBool;

use super::Case;
use crate::beams::{Mesh, Section};
use crate::geometry::{Curve, Vec2};
use crate::integrators::Method;
use crate::loads::{LoadFrame, LoadKind, Schedule};
use crate::newton::Tolerance;
use crate::simulation::SimulationSettings;
use crate::system::{BeamDefinition, Scene, StartMotion};

pub fn never() -> AtomicBool {
    AtomicBool::new(false)
}

pub fn spinning(dt: f64, stops: &[f64]) -> Case {
    let mut scene = Scene::new("spinning");
    let section = Section {
        axial_stiffness: 1e4,
        shear_stiffness: 1e4,
        bending_stiffness: 100.0,
        mass_per_length: 1.0,
        rotary_inertia: 10.0,
    };
    let motion = StartMotion { spin: 1.0, ..StartMotion::default() };
    let beam = BeamDefinition {
        name: "rod".to_owned(),
        axis: Curve::line(Vec2::zeros(), Vec2::new(2.0, 0.0)).unwrap(),
        mesh: Mesh::bspline(2, 3, 2).unwrap(),
        section: section.into(),
        motion,
    };
    scene.add_beam(beam).unwrap();
    let settings = SimulationSettings {
        method: Method::default(),
        dt: dt.into(),
        tolerance: Tolerance::default(),
    };
    Case { scene, settings, stops: stops.to_vec() }
}

/// Spinning beam whose force has a script function as schedule, so that the case cannot be sent to other threads.
pub fn pushed_by_a_function(dt: f64, stops: &[f64]) -> Case {
    let mut case = spinning(dt, stops);
    let station = case.scene.station(0, 0.0).unwrap();
    let force = LoadKind::Force { station, force: Vec2::new(1.0, 0.0), frame: LoadFrame::Dead };
    let function = Rc::new(|t: f64| Ok(t));
    case.scene.add_load(force, Schedule::Function { function, breaks: Vec::new() });
    case
}
