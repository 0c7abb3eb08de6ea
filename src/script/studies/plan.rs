//! Plan of an error study, read from its options.

use rhai::{Dynamic, FnPtr, Map};

use super::labels;
use super::options::ErrorOptions;
use crate::analysis::{Case, Observable, ObservedScene, ParsedCsv, RunLimits, SYMBOLS};
use crate::beams::{Mesh, Station};
use crate::integrators::Method;
use crate::newton::Tolerance;
use crate::script::bindings::accept::readable;
use crate::script::bindings::call::Call;
use crate::script::handles::scene::SceneHandle;
use crate::script::handles::station::StationHandle;
use crate::script::handles::step_size::{STEP_SIZE, step_size};
use crate::script::messages::error::{CallPart, ScriptError};
use crate::script::messages::numbers::{as_number, format_number};
use crate::simulation::{History, SimulationSettings, StepSize};
use crate::system::Scene;

pub struct ErrorStudyPlan {
    pub name: String,
    pub subjects: Vec<ObservedScene>,
    pub methods: Vec<Method>,
    pub dts: Vec<StepSize>,
    /// Times at which the runs are compared, in increasing order [time].
    pub times: Vec<f64>,
    /// Length by which errors of positions are divided [length].
    pub length: f64,
    pub limits: RunLimits,
}

impl ErrorStudyPlan {
    pub fn read(call: &Call, options: &ErrorOptions) -> Result<Self, ScriptError> {
        let name = study_name(call, &options.name)?;
        let methods = all_of::<Method>(call, "integrators", &options.integrators, "an integrator")?;
        let dts = step_sizes(call, &options.dts)?;
        expect_positive(call, "times", &options.times)?;
        let times = options.times.clone();
        if times.windows(2).any(|pair| pair[0] >= pair[1]) {
            return Err(at_key(call, "times", "the times must ascend", "the last one ends a run"));
        }
        let meshes = &options.meshes;
        if meshes.is_empty() {
            return Err(at_key(call, "meshes", "there is no mesh", "for example [bspline(14)]"));
        }
        let scene_of = &options.scene;
        call.expect_arguments(scene_of, 1, "|mesh| …, a function that makes the scene on a mesh")?;
        expect_all_different(call, "integrators", &methods, labels::method)?;
        expect_all_different(call, "dts", &dts, StepSize::to_string)?;
        let named = |mesh: &Dynamic| {
            (label_of(call, mesh), mesh.read_lock::<Mesh>().map(|mesh| mesh.clone()))
        };
        let named: Vec<(String, Option<Mesh>)> = meshes.iter().map(named).collect();
        expect_all_different(call, "meshes", &named, |(label, _)| label.clone())?;
        let subjects: Vec<ObservedScene> = meshes
            .iter()
            .map(|mesh| scene_on_mesh(call, scene_of, mesh))
            .collect::<Result<_, _>>()?;
        expect_same_observables(call, &subjects[0], &subjects[1..])?;
        let length = options.length.unwrap_or_else(|| size_of(&subjects[0].scene));
        let limits = case_limits(call, options.time_limit);
        Ok(Self { name, subjects, methods, dts, times, length, limits })
    }

    pub fn settings(method: Method, dt: StepSize) -> SimulationSettings {
        SimulationSettings { method, dt, tolerance: Tolerance::default() }
    }

    pub fn all_settings(&self) -> Vec<SimulationSettings> {
        let with = |method: &Method| {
            let method = *method;
            self.dts.iter().map(move |dt| Self::settings(method, *dt))
        };
        self.methods.iter().flat_map(with).collect()
    }

    pub fn observables(&self) -> &[Observable] {
        &self.subjects[0].observables
    }

    pub fn history(&self) -> Result<History, ScriptError> {
        let (scene, stops) = (self.subjects[0].scene.clone(), self.times.clone());
        let case = Case { scene, settings: self.all_settings()[0], stops };
        let built =
            case.start(self.limits).map_err(|outcome| ScriptError::new(outcome.describe()))?;
        Ok(built.history().clone())
    }

    /// Adds columns of the history to the observables: all columns, or those in the reference table if there is one.
    /// Columns of the table are named by symbols (E, KE, SE, px, py or Lz) or as in the history.
    /// `given`, the option `columns`, assigns history columns to further names, and replaces columns with the same names.
    pub fn add_columns(
        &mut self,
        call: &Call,
        given: Option<Map>,
        table: Option<&ParsedCsv>,
    ) -> Result<(), ScriptError> {
        let history = self.history()?;
        let mut columns: Vec<Observable> = match table {
            None => Observable::of_history(&history).collect(),
            Some(sheet) => {
                let symbols = SYMBOLS.iter().map(|(name, of)| Observable::of_column(name, of, 1.0));
                let all = symbols.chain(Observable::of_history(&history));
                all.filter(|of| sheet.has(&of.name)).collect()
            }
        };
        for (name, meant) in given.unwrap_or_default() {
            let observable = column_of(call, &name, &meant, &history)?;
            columns.retain(|other| other.name != observable.name);
            columns.push(observable);
        }
        for subject in &mut self.subjects {
            subject.observables.extend(columns.iter().cloned());
        }
        Ok(())
    }
}

fn column_of(
    call: &Call,
    name: &str,
    meant: &Dynamic,
    history: &History,
) -> Result<Observable, ScriptError> {
    let name =
        &readable("columns", name).map_err(|error| error.at(CallPart::Key("columns".into())))?;
    let parts = meant.clone().into_array().unwrap_or_else(|_| vec![meant.clone()]);
    let text = |value: &Dynamic| value.clone().into_string().ok();
    let (column, factor) = match parts.as_slice() {
        [column] => (text(column), Some(1.0)),
        [column, factor] => (text(column), as_number(factor)),
        _ => (None, None),
    };
    let (Some(column), Some(factor)) = (column, factor) else {
        let message = format!("columns: '{name}' is {}", call.describe(meant));
        let hint = "write the name of a column of the history, or that and a factor: [\"slider1.position\", 3.2]";
        return Err(at_key(call, "columns", message, hint));
    };
    if factor == 0.0 || !factor.is_finite() {
        let message = format!("columns: the factor of '{name}' is {}", format_number(factor));
        let hint = "it converts the column of the history to that of the reference: give a number \
            other than zero";
        return Err(at_key(call, "columns", message, hint));
    }
    if history.dimension(&column).is_none() {
        let message = format!("columns: the history has no column \"{column}\"");
        let names: Vec<_> = history.columns().map(|(name, _)| name).collect();
        return Err(at_key(call, "columns", message, format!("columns: {}", names.join(", "))));
    }
    Ok(Observable::of_column(name, &column, factor))
}

/// Returns the name of a study, if no other study of the run has this name.
pub fn study_name(call: &Call, name: &str) -> Result<String, ScriptError> {
    if !call.context().claim_study(name) {
        let message = format!("this run already has a study '{name}'");
        let hint = "give each study its own name, otherwise its files are overwritten";
        return Err(at_key(call, "name", message, hint));
    }
    Ok(name.to_owned())
}

fn expect_all_different<T: PartialEq>(
    call: &Call,
    key: &str,
    values: &[T],
    show: impl Fn(&T) -> String,
) -> Result<(), ScriptError> {
    let again = (1..values.len()).find(|at| values[..*at].contains(&values[*at]));
    again.map_or(Ok(()), |at| {
        let message = format!("{key} holds {} twice", show(&values[at]));
        Err(at_key(call, key, message, "give each once"))
    })
}

pub fn at_key(
    call: &Call,
    key: &str,
    message: impl std::fmt::Display,
    hint: impl Into<String>,
) -> ScriptError {
    call.error(message).hint(hint).at(CallPart::Key(key.to_owned()))
}

/// Elements of a non-empty array, which must have the same type.
fn all_of<T: Clone + 'static>(
    call: &Call,
    key: &str,
    array: &[Dynamic],
    what: &str,
) -> Result<Vec<T>, ScriptError> {
    let one = |value: &Dynamic| {
        value.clone().try_cast::<T>().ok_or_else(|| {
            let message = format!("{key} must hold {what} each, got {}", call.describe(value));
            at_key(call, key, message, "for example [energy_momentum(), fourth_order()]")
        })
    };
    match array {
        [] => Err(at_key(call, key, format!("{key} is empty"), format!("give {what} or more"))),
        values => values.iter().map(one).collect(),
    }
}

pub fn case_limits(call: &Call, seconds: f64) -> RunLimits {
    let steps = call.context().meter().limits().steps;
    RunLimits {
        steps: steps.map_or(usize::MAX, |limit| usize::try_from(limit).unwrap_or(usize::MAX)),
        wall: std::time::Duration::from_secs_f64(seconds.min(1e9)),
    }
}

fn step_sizes(call: &Call, dts: &[Dynamic]) -> Result<Vec<StepSize>, ScriptError> {
    let one = |value: &Dynamic| {
        step_size(value).ok_or_else(|| {
            at_key(call, "dts", format!("dts holds {}", call.describe(value)), STEP_SIZE)
        })
    };
    match dts {
        [] => Err(at_key(call, "dts", "dts is empty", "give one step size or more")),
        values => values.iter().map(one).collect(),
    }
}

fn expect_positive(call: &Call, key: &str, numbers: &[f64]) -> Result<(), ScriptError> {
    match numbers.iter().find(|number| **number <= 0.0) {
        _ if numbers.is_empty() => {
            Err(at_key(call, key, format!("{key} is empty"), "give one positive number or more"))
        }
        Some(wrong) => {
            let message = format!("{key} holds {}", format_number(*wrong));
            Err(at_key(call, key, message, "give positive numbers"))
        }
        None => Ok(()),
    }
}

fn label_of(call: &Call, mesh: &Dynamic) -> String {
    mesh.read_lock::<Mesh>().map_or_else(|| call.show(mesh), |mesh| mesh.describe())
}

pub fn scene_on_mesh(
    call: &Call,
    scene_of: &FnPtr,
    mesh: &Dynamic,
) -> Result<ObservedScene, ScriptError> {
    let made = call.invoke(scene_of, [mesh.clone()])?;
    subject(call, label_of(call, mesh), &made)
}

fn subject(call: &Call, mesh: String, made: &Dynamic) -> Result<ObservedScene, ScriptError> {
    let hint = "it must return the scene, or #{ scene: scene, stations: #{ tip: rod.end } }";
    let refused = || {
        let message = format!("the function `scene` returns {}", call.describe(made));
        at_key(call, "scene", message, hint)
    };
    let map = made.read_lock::<Map>().map(|map| map.clone());
    let handle = match &map {
        None => made.clone().try_cast::<SceneHandle>(),
        Some(map) => map.get("scene").and_then(|scene| scene.clone().try_cast()),
    };
    let handle = handle.ok_or_else(refused)?;
    handle.expect_no_callbacks()?;
    if let Some(unknown) =
        map.iter().flat_map(Map::keys).find(|key| !["scene", "stations"].contains(&key.as_str()))
    {
        let message =
            format!("the function `scene` returns a map with the unknown key '{unknown}'");
        return Err(at_key(call, "scene", message, hint));
    }
    let stations = map.and_then(|map| map.get("stations").cloned());
    let named: Vec<(String, Station)> = match stations {
        None => usual_stations(&handle.scene().borrow()),
        Some(stations) => {
            let stations = stations.try_cast::<Map>().ok_or_else(refused)?;
            let own = |(name, station): (&rhai::Identifier, &Dynamic)| {
                let station = station.clone().try_cast::<StationHandle>().ok_or_else(|| {
                    let message = format!("station '{name}' is {}", call.describe(station));
                    at_key(call, "scene", message, hint)
                })?;
                let name = readable("stations", name)
                    .map_err(|error| error.at(CallPart::Key("scene".into())))?;
                Ok((name, handle.own_station(&station)?))
            };
            stations.iter().map(own).collect::<Result<_, ScriptError>>()?
        }
    };
    if named.is_empty() {
        return Err(at_key(call, "scene", "the scene has no stations to compare", hint));
    }
    let observables =
        named.iter().flat_map(|(name, station)| Observable::of_station(name, *station));
    let observables = observables.collect();
    let scene = handle.scene().borrow().clone();
    Ok(ObservedScene { mesh, scene, observables })
}

pub fn usual_stations(scene: &Scene) -> Vec<(String, Station)> {
    let ends = scene.beams.iter().enumerate().flat_map(|(index, beam)| {
        [("start", 0.0), ("end", beam.axis.length())]
            .map(|(end, s)| (format!("{}.{end}", beam.name), Station::on_beam(index, s)))
    });
    let particles = scene.particles.iter().enumerate();
    let particles =
        particles.map(|(index, particle)| (particle.name.clone(), Station::on_particle(index)));
    let bodies = scene.rigid_bodies.iter().enumerate();
    let bodies = bodies.map(|(index, body)| (body.name.clone(), Station::on_rigid_body(index, 0)));
    ends.chain(particles).chain(bodies).collect()
}

/// Stations of `usual_stations`, and the middles of beams, because a middle may move even if both ends of the beam are fixed.
pub fn stations_and_middles(scene: &Scene) -> Vec<(String, Station)> {
    let middles = scene.beams.iter().enumerate().map(|(index, beam)| {
        let middle = Station::on_beam(index, 0.5 * beam.axis.length());
        (format!("{}.middle", beam.name), middle)
    });
    usual_stations(scene).into_iter().chain(middles).collect()
}

pub fn expect_same_observables(
    call: &Call,
    first: &ObservedScene,
    others: &[ObservedScene],
) -> Result<(), ScriptError> {
    let other = others.iter().find(|of| of.observables != first.observables);
    other.map_or(Ok(()), |other| {
        let message = format!(
            "the stations with the mesh '{}' differ from those with '{}'",
            other.mesh, first.mesh
        );
        Err(at_key(call, "scene", message, "a study compares the same stations on all meshes"))
    })
}

/// Length of the longest beam, or largest distance of a point mass from the first one; 1 if there is neither [length].
fn size_of(scene: &Scene) -> f64 {
    let first = scene.particles.first().map(|first| first.position).unwrap_or_default();
    let particles = scene.particles.iter().map(|other| (other.position - first).norm());
    let size = scene.longest_beam().or_else(|| particles.reduce(f64::max));
    size.filter(|size| *size > 0.0).unwrap_or(1.0)
}
