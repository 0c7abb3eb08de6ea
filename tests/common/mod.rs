//! Shared helpers of the tests: scenes, meshes, reference tables and random numbers.
#![allow(dead_code, clippy::unwrap_used)]

pub mod body_scenes;
pub mod corpus;
pub mod fingerprint;
pub mod fixed_way;
pub mod machine_scenes;
pub mod notepad;
pub mod probe;
pub mod rails;
pub mod reference;
pub mod release_scenes;
pub mod roller_scenes;
pub mod scenes;
pub mod sleeve_scenes;
pub mod sliding;
pub mod sliding_scenes;
pub mod steered_scenes;
pub mod tracks;
pub mod wild_scenes;

use withy::beams::{Mesh, Quadrature};
use withy::geometry::Vec2;
use withy::integrators::Method;
use withy::simulation::{
    History, Monitor, NoMonitor, Simulation, SimulationError, SimulationSettings, StepSize,
};
use withy::system::{Element, Scene};

pub fn at(x: f64, y: f64) -> Vec2 {
    Vec2::new(x, y)
}

pub fn settings(method: Method, dt: impl Into<StepSize>) -> SimulationSettings {
    SimulationSettings::new(method, dt)
}

pub fn simulate(scene: Scene, method: Method, dt: impl Into<StepSize>, end: f64) -> Simulation {
    let (name, dt) = (scene.name.clone(), dt.into());
    steered_scenes::reset(&scene);
    let mut simulation = Simulation::start(scene, settings(method, dt)).unwrap();
    run(&mut simulation, end).unwrap_or_else(|error| panic!("{name}, {dt}: {error}"));
    simulation
}

/// Runs to a time. Controllers, if any, are evaluated before every step.
pub fn run(simulation: &mut Simulation, end: f64) -> Result<(), SimulationError> {
    let is_steered = steered_scenes::is_steered(simulation.scene());
    loop {
        steered_scenes::steer(simulation);
        let until = if is_steered { end - simulation.slack() } else { f64::NEG_INFINITY };
        let mut pause = Pause { until, is_paused: false };
        let ran = simulation.run_to(end, &mut pause);
        if ran.is_ok() || !pause.is_paused {
            return ran;
        }
    }
}

/// Returns true if a beam of the scene has a damped material. If steps do not resolve the relaxation, the rates of a very short step alternate, but the
/// present section forces do not.
pub fn is_damped(scene: &Scene) -> bool {
    scene.elements.iter().any(|element| matches!(element, Element::Damping(_)))
}

/// Takes a step of fixed size. Controllers, if any, are evaluated before it.
pub fn step(simulation: &mut Simulation) -> Result<(), SimulationError> {
    steered_scenes::steer(simulation);
    simulation.step(&mut NoMonitor)
}

/// Interrupts a run after every step until a time.
struct Pause {
    until: f64,
    is_paused: bool,
}

impl Monitor for Pause {
    fn continues(&mut self, time: f64) -> bool {
        self.is_paused = time < self.until;
        !self.is_paused
    }
}

/// `E - W` after each step.
pub fn energies(history: &History) -> Vec<f64> {
    let rows = history.samples().iter();
    rows.map(|row| row.measures.energy.total() - row.measures.work).collect()
}

/// Asserts that the energy increases in no step by more than rounding.
pub fn assert_energy_never_grows(label: &str, history: &History) {
    let sizes = history.samples().iter().map(|row| {
        let (energy, work) = (row.measures.energy, row.measures.work);
        energy.kinetic + energy.strain + energy.potential.abs() + work.abs()
    });
    let largest = sizes.fold(f64::MIN_POSITIVE, f64::max);
    for pair in energies(history).windows(2) {
        let growth = (pair[1] - pair[0]) / largest;
        assert!(growth < 1e-13, "{label}: the energy grows by {growth:.1e} in a step");
    }
}

pub fn ends(simulation: &Simulation) -> [Vec2; 2] {
    let points = simulation.model().control_points().next().unwrap();
    [points[0], points[points.len() - 1]]
}

/// One mesh of every kind, with its name. Smooth meshes have `spans` spans, the others fewer.
pub fn meshes(spans: usize) -> Vec<(&'static str, Mesh)> {
    let bspline = |spans, degree, continuity| Mesh::bspline(spans, degree, continuity).unwrap();
    let lagrange = |elements, degree| Mesh::lagrange(elements, degree).unwrap();
    let half = spans.div_ceil(2);
    vec![
        ("cubic C2", bspline(spans, 3, 2)),
        ("cubic C1", bspline(half, 3, 1)),
        ("cubic C1, 2 points", points(bspline(half, 3, 1), 2)),
        ("cubic C0", bspline(half, 3, 0)),
        ("linear", lagrange(spans, 1)),
        ("quadratic Lagrange", lagrange(half, 2)),
        ("cubic Lagrange", lagrange(half, 3)),
        ("quadratic C1", bspline(spans, 2, 1)),
        ("degree 4, C3", bspline(spans, 4, 3)),
        ("degree 5, C4", bspline(spans, 5, 4)),
    ]
}

pub fn points(mesh: Mesh, number: usize) -> Mesh {
    mesh.with_quadrature(Quadrature::Points(number)).unwrap()
}

/// Random numbers from a seed (SplitMix64: Steele, Lea & Flood 2014), equal on all platforms.
pub struct Random(pub u64);

impl Random {
    /// Uniform random number in [-1, 1].
    pub fn next(&mut self) -> f64 {
        self.0 = self.0.wrapping_add(0x9E37_79B9_7F4A_7C15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
        ((z ^ (z >> 31)) >> 11) as f64 / (1_u64 << 52) as f64 - 1.0
    }

    pub fn vector(&mut self, size: usize, magnitude: f64) -> Vec<f64> {
        (0..size).map(|_| magnitude * self.next()).collect()
    }
}

/// Observed orders of convergence of errors with step sizes that are halved from one to the next.
pub fn orders(errors: &[f64]) -> Vec<f64> {
    errors.windows(2).map(|pair| (pair[0] / pair[1]).log2()).collect()
}

/// Row of a printed table in scientific notation.
pub fn sci(values: &[f64]) -> String {
    values.iter().map(|value| format!("{value:8.1e}")).collect::<Vec<_>>().join(" ")
}
