//! Linear buckling of a scene: critical load factors and buckling shapes.

use std::fmt;

use super::continuation::Continuation;
use super::equilibrium::{at_rest, prepare};
use super::{Control, Loading, StaticsError};
use crate::integrators::Mechanism;
use crate::joints::Slider;
use crate::system::{Scene, System};
use crate::vibration::{
    CriticalLoad, CriticalLoads, ModeShapes, Modes, VibrationError, critical_loads,
};

/// Critical load factors of a scene, with its buckling shapes.
///
/// At a critical load factor `λ`, the stiffness `K + λ K_g` is singular. `K` is the stiffness without loads.
/// `K_g` is the geometric stiffness of the section forces that the loads cause to first order. Displacements before buckling are neglected.
#[derive(Debug, Clone)]
pub struct Buckling {
    scene: Scene,
    loading: Loading,
    critical: Vec<CriticalLoad>,
    shapes: ModeShapes,
    displacement_before: f64,
}

fn few_critical_loads(requested: usize, available: usize) -> String {
    match available {
        0 => "no critical load found: the loads compress no part, or every critical load has a strain above 0.5".to_owned(),
        _ => format!("{requested} critical loads requested, but only {available} with a strain of at most 0.5 were found"),
    }
}

/// Error of a buckling analysis.
#[expect(missing_docs, reason = "the messages describe the variants and their fields")]
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum BucklingError {
    #[error(transparent)]
    Statics(#[from] StaticsError),
    #[error(transparent)]
    Modes(#[from] VibrationError),
    #[error(
        "scene '{scene}' has no critical load: without loads, {part} moves freely (a mechanism or a missing support)"
    )]
    Mechanism { scene: String, part: String },
    #[error("scene '{scene}' has no critical load: it is unstable without loads")]
    Unstable { scene: String },
    #[error("no load acts on the scene at t = {time}; prestress is not a load")]
    NoLoad { time: f64 },
    #[error("load '{load}' follows its beam, so that it may cause flutter instead of buckling")]
    Follower { load: String },
    #[error("{object} {reason}; linear buckling is not available")]
    Unavailable { object: String, reason: NonlinearPart },
    #[error("{}", few_critical_loads(*requested, *available))]
    FewCriticalLoads { requested: usize, available: usize },
    #[error(
        "critical load {number} (from 0) is inaccurate because of rounding: its residual is {residual:.1e}, but at most 1e-6 is allowed; request fewer, use a coarser mesh, or reduce the largest stiffness"
    )]
    InaccurateLoad { number: usize, residual: f64 },
    #[error(
        "critical loads may be missing below those that were found, because of rounding; use a coarser mesh, or reduce the largest stiffness"
    )]
    Uncounted,
    #[error(
        "the critical loads did not converge in {restarts} restarts of the Lanczos method; request a few more or fewer, or use a coarser mesh"
    )]
    NotConverged { restarts: usize },
}

impl BucklingError {
    fn of_search(error: VibrationError) -> Self {
        match error {
            VibrationError::FewEigenvalues { requested, available } => {
                Self::FewCriticalLoads { requested, available }
            }
            VibrationError::BelowRounding { modes: number, residual } => {
                Self::InaccurateLoad { number, residual }
            }
            VibrationError::Uncounted => Self::Uncounted,
            VibrationError::NotConverged { restarts } => Self::NotConverged { restarts },
            error => Self::Modes(error),
        }
    }
}

/// Property of a part of a scene that linear buckling does not include.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum NonlinearPart {
    /// Contact with an obstacle or between bodies.
    Contact,
    /// Prescribed motion.
    Drive,
    /// Sleeve, whose direction turns with its holder.
    Sleeve,
}

impl fmt::Display for NonlinearPart {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Contact => "can lose contact",
            Self::Drive => "prescribes a motion",
            Self::Sleeve => "has a contact force that turns with its holder",
        })
    }
}

impl Buckling {
    /// Finds the `count` smallest positive critical factors of the loads of a scene.
    /// The factors are multiples of the loads times the load factor of `loading`, which may be negative. Steps and control of `loading` have no effect.
    /// Before every step of the search, `goes_on` is called.
    ///
    /// # Errors
    /// Fails if the scene cannot be built, no load acts, a part moves freely or is unstable without loads, or a load is a follower load.
    /// Also fails for contacts, sleeves and drives, if there are fewer critical loads, and if the search does not converge or is stopped.
    pub fn find(
        scene: Scene,
        loading: Loading,
        count: usize,
        goes_on: &mut dyn FnMut() -> bool,
    ) -> Result<Self, BucklingError> {
        let loading = Loading { control: Control::Load, ..loading };
        check_is_linear(&scene)?;
        let model = prepare(&scene, &loading, &mut |_| goes_on()).map_err(|error| match error {
            StaticsError::NoLoad { time } => BucklingError::NoLoad { time },
            error => error.into(),
        })?;
        if let Some(load) = model.follower() {
            return Err(BucklingError::Follower { load: load.to_owned() });
        }
        let mut model = without_loads(&scene, model, loading, goes_on)?;
        let loads = loads(&mut model, &loading)?;
        check_is_stable(&scene, &model, goes_on)?;
        let unstable = || BucklingError::Unstable { scene: scene.name.clone() };
        let CriticalLoads { critical, displacement } =
            critical_loads(&model, &loads, count, goes_on)
                .map_err(BucklingError::of_search)?
                .ok_or_else(unstable)?;
        let shapes = ModeShapes::of(&model, critical.iter().map(|load| &*load.shape));
        let moved = model.displacements(&displacement);
        let largest = moved.iter().flatten().map(|by| by.norm()).fold(0.0, f64::max);
        let lowest = critical.first().map_or(0.0, |load| load.factor);
        let displacement_before = lowest * largest / scene.size().unwrap_or(1.0);
        Ok(Self { scene, loading, critical, shapes, displacement_before })
    }

    /// Scene whose buckling was analysed.
    pub fn scene(&self) -> &Scene {
        &self.scene
    }

    /// Loading for which the factors were computed.
    pub fn loading(&self) -> &Loading {
        &self.loading
    }

    /// Critical loads in increasing order.
    pub fn critical(&self) -> &[CriticalLoad] {
        &self.critical
    }

    /// Buckling shapes, in the order of the critical loads.
    pub fn shapes(&self) -> &ModeShapes {
        &self.shapes
    }

    /// Type and name of the body with the largest displacement in a shape.
    pub fn most_displaced_body(&self, shape: usize) -> String {
        let body = self.shapes.most_displaced_body(shape);
        body.map(|body| self.scene.name_of_body_at(body)).unwrap_or_default()
    }

    /// Largest displacement before buckling at the lowest critical factor, linear in the loads, as a fraction of the size of the scene [-].
    pub fn displacement_before(&self) -> f64 {
        self.displacement_before
    }
}

fn check_is_linear(scene: &Scene) -> Result<(), BucklingError> {
    let named = |object: String, reason| Err(BucklingError::Unavailable { object, reason });
    let contact = scene.obstacles().map(|one| one.object());
    if let Some(object) = contact.chain(scene.contacts().map(|one| one.object())).next() {
        return named(object, NonlinearPart::Contact);
    }
    if let Some(sleeve) = scene.sliders.iter().find(|slider: &&Slider| slider.is_sleeve()) {
        return named(format!("sleeve '{}'", sleeve.name), NonlinearPart::Sleeve);
    }
    match scene.drives.first() {
        Some(drive) => named(format!("drive '{}'", drive.name), NonlinearPart::Drive),
        None => Ok(()),
    }
}

/// Moves a model with prestress to its equilibrium without loads.
fn without_loads(
    scene: &Scene,
    model: System,
    loading: Loading,
    goes_on: &mut dyn FnMut() -> bool,
) -> Result<System, BucklingError> {
    if !model.is_strung() {
        return Ok(model);
    }
    let goes_on = &mut |_| goes_on();
    let at_rest_without_loads = Continuation::new(scene, model, loading, goes_on).solve_at(0.0)?;
    let mut model = at_rest(scene, goes_on)?;
    model.restore(&at_rest_without_loads);
    model
        .evaluate_loads_at(loading.time)
        .map_err(|(load, source)| StaticsError::Load { load, source })?;
    Ok(model)
}

fn loads(model: &mut System, loading: &Loading) -> Result<Vec<f64>, BucklingError> {
    let mut forces = vec![0.0; model.degrees_of_freedom()];
    let standstill = vec![0.0; model.unknowns()];
    model.subtract_static_loads(&standstill, -loading.factor, &mut forces);
    forces.truncate(model.unknowns());
    if forces.iter().all(|force| *force == 0.0) {
        return Err(BucklingError::NoLoad { time: loading.time });
    }
    Ok(forces)
}

fn check_is_stable(
    scene: &Scene,
    model: &System,
    goes_on: &mut dyn FnMut() -> bool,
) -> Result<(), BucklingError> {
    let mechanism = |part| BucklingError::Mechanism { scene: scene.name.clone(), part };
    let modes = match Modes::of(model, 1, goes_on) {
        Err(VibrationError::Indefinite) => return Err(mechanism("a part without inertia".into())),
        found => found?,
    };
    match modes.all() {
        [lowest, ..] if lowest.is_free() => {
            let body = modes.shapes().most_displaced_body(0);
            Err(mechanism(body.map_or("a part".into(), |body| scene.name_of_body_at(body))))
        }
        [lowest, ..] if lowest.square < 0.0 => {
            Err(BucklingError::Unstable { scene: scene.name.clone() })
        }
        _ => Ok(()),
    }
}
