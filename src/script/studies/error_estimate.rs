//! Estimated discretisation error of a run, from companion runs with larger steps and on other meshes.

use std::ops::ControlFlow;
use std::sync::atomic::AtomicBool;
use std::time::Duration;

use crate::analysis::{
    Case, CaseOutcome, DiscretisationError, ErrorVerdict, ExpectedOrder, RefinementLevels,
    RunLimits, Trace, TraceSource, TracedQuantity, is_of_the_motion, on_all_cores,
};
use crate::geometry::larger;
use crate::output::{
    Cell, DataColumn, DataTable, DataValues, NpzArchive, NpzArray, TextTable, scientific,
    significant,
};
use crate::script::handles::captured_variables::{expect_no_side_effects, functions_of_time};
use crate::script::handles::simulation::{Companion, RunStart, SimulationHandle};
use crate::script::messages::error::ScriptError;
use crate::script::state::context::Context;
use crate::simulation::{History, Simulation};
use crate::system::Scene;

use super::plan::stations_and_middles;

/// Name of the row with the largest error of all stations.
pub const POSITIONS: &str = "positions";

/// Name of the row with the largest error of all angular frequencies.
pub const FREQUENCIES: &str = "frequencies";
pub const CRITICAL_LOADS: &str = "critical loads";

/// Largest number of rows of a printed table.
const MOST_ROWS: usize = 24;

/// Smallest number of spans of a beam that allows two coarser meshes in the estimate.
/// The beam of the scene with the fewest spans is decisive.
/// With fewer spans, at least one of the two additional meshes is finer than the mesh of the simulation.
const SPANS_TO_COARSEN: usize = 4;

/// Smallest ratio of the mesh sizes of consecutive levels [-].
const LEAST_RATIO: f64 = 1.1;

#[derive(Debug, Clone)]
pub struct ErrorEstimate {
    pub name: String,
    /// Time of a simulation, with the tolerance of adaptive steps, or load factor of an equilibrium, as text after its name.
    /// The text is empty for modes.
    pub moment: String,
    /// Largest errors of all stations or of all frequencies, followed by the errors of each station, frequency and column.
    pub quantities: Vec<QuantityError>,
    pub missing: Vec<String>,
}

#[derive(Debug, Clone)]
pub struct QuantityError {
    pub name: String,
    pub dimension: &'static str,
    /// Scale of the quantity: for positions the size of the scene, for columns of a run the largest value of all columns of the same dimension.
    pub scale: f64,
    pub in_time: Option<DiscretisationError>,
    pub in_space: Option<DiscretisationError>,
}

impl QuantityError {
    /// Errors of a quantity in a dry run, without an estimate.
    pub fn unknown(name: &str) -> Self {
        let verdict = ErrorVerdict::PreAsymptotic;
        let none = Some(DiscretisationError { over_time: Vec::new(), order: Some(0.0), verdict });
        let name = name.to_owned();
        Self { name, dimension: "-", scale: 0.0, in_time: none.clone(), in_space: none }
    }

    /// Sums of the errors in time and space: sum of the errors at the present time, and sum of the largest errors during the run.
    pub fn total(&self) -> (f64, f64) {
        (self.sum(DiscretisationError::present), self.sum(DiscretisationError::largest))
    }

    /// Sum of the errors in time and space at a time of the run.
    pub fn at(&self, time: f64) -> f64 {
        self.sum(|error| error.at(time))
    }

    fn sum(&self, read: impl Fn(&DiscretisationError) -> f64) -> f64 {
        [&self.in_time, &self.in_space].into_iter().flatten().map(read).sum()
    }

    /// Verdict in words. If only one of the errors in time and in space has converged, the other error is ignored if it is smaller.
    pub fn verdict(&self) -> String {
        let both = [("in time", &self.in_time), ("in space", &self.in_space)];
        let known = both.into_iter().filter_map(|(of, error)| Some((of, error.as_ref()?)));
        let known: Vec<(&str, &DiscretisationError)> = known.collect();
        let chaos = known.iter().filter_map(|(_, error)| match error.verdict {
            ErrorVerdict::Chaotic { until } => Some(until),
            _ => None,
        });
        if let Some(until) = chaos.reduce(f64::min) {
            return format!("chaotic, meaningful until t = {}", significant(until, 3));
        }
        let with =
            |verdict: ErrorVerdict| known.iter().filter(move |(_, error)| error.verdict == verdict);
        let converged = with(ErrorVerdict::Converged).map(|(_, error)| error.largest());
        let converged = converged.reduce(larger);
        let counts = |error: &DiscretisationError| converged.is_none_or(|of| error.largest() >= of);
        let bad = with(ErrorVerdict::PreAsymptotic).filter(|(_, error)| counts(error));
        match (known.is_empty(), bad.map(|(of, _)| *of).collect::<Vec<_>>().as_slice()) {
            (true, _) => "not estimated".to_owned(),
            (_, []) if converged.is_none() => ErrorVerdict::Exact.describe().to_owned(),
            (_, []) => ErrorVerdict::Converged.describe().to_owned(),
            (_, [of]) => format!("{} {of}", ErrorVerdict::PreAsymptotic.describe()),
            _ => ErrorVerdict::PreAsymptotic.describe().to_owned(),
        }
    }
}

/// Companion runs of an estimate.
pub(super) struct Plan {
    /// Meshes and step sizes of the companion runs. The first two have the mesh of the simulation, with twice and four times its step size.
    pub(super) companions: Vec<Companion>,
    /// Indices of the runs for the estimate in space, from the finest to the coarsest mesh.
    pub(super) meshes: Option<[usize; 3]>,
    /// Mesh sizes of the runs for the estimate in space, relative to the mesh of the simulation.
    pub(super) mesh_sizes: [f64; 3],
    /// Index of the mesh of the simulation in `mesh_sizes`.
    pub(super) level: usize,
}

impl Plan {
    pub(super) fn of(scene: &Scene) -> Result<Self, ScriptError> {
        let at = |span_ratio, step_ratio| Companion { span_ratio, step_ratio };
        let steps = [at(1.0, 2.0), at(1.0, 4.0)];
        let spans = |scene: &Scene| scene.beams.iter().map(|beam| beam.mesh.spans()).sum::<usize>();
        let choices =
            [([0.75, 0.5], [0, 2, 3], 0), ([2.0, 0.5], [2, 0, 3], 1), ([4.0, 2.0], [2, 3, 0], 2)];
        let first = match scene.beams.iter().map(|beam| beam.mesh.spans()).min() {
            Some(SPANS_TO_COARSEN..) => 0,
            Some(2..) => 1,
            Some(_) => 2,
            None => choices.len(),
        };
        for (ratios, meshes, level) in choices.into_iter().skip(first) {
            let scaled = ratios.map(|ratio| at(ratio, 2.0));
            let companions = [steps, scaled].concat();
            let mut mesh_sizes = [1.0; 3];
            for (size, run) in mesh_sizes.iter_mut().zip(meshes) {
                let scaled = scene.with_span_ratio(companions[run].span_ratio)?;
                *size = spans(scene) as f64 / spans(&scaled) as f64;
            }
            // Spans between repeated knots cannot be merged, so a coarser mesh may have the same spans.
            if mesh_sizes.is_sorted_by(|finer, coarser| *coarser >= LEAST_RATIO * finer) {
                return Ok(Self { companions, meshes: Some(meshes), mesh_sizes, level });
            }
        }
        Ok(Self { companions: steps.to_vec(), meshes: None, mesh_sizes: [1.0; 3], level: 0 })
    }
}

struct FinishedRun(Vec<Trace>);

/// Result of a companion run: its traces, or its description and the reason for its failure.
type CompanionResult = Result<FinishedRun, (String, String)>;

impl FinishedRun {
    fn of(simulation: &Simulation, quantities: &[TracedQuantity]) -> Self {
        Self(quantities.iter().map(|quantity| Trace::of(simulation, quantity)).collect())
    }
}

impl ErrorEstimate {
    /// Estimate without results, for the given reason.
    pub fn not_estimated(handle: &SimulationHandle, reason: &str) -> Self {
        let name = handle.name().to_owned();
        let control = handle.step_control();
        let moment = format!(" at t = {}{control}", significant(handle.time(), 6));
        let missing = vec![reason.to_owned()];
        Self { name, moment, quantities: Vec::new(), missing }
    }

    /// Estimates the errors of a simulation at its present time and over its run.
    /// With a time limit, companion runs that are computed in parallel stop after this time. Others have no time limit.
    ///
    /// # Errors
    /// Fails if the simulation was loaded from a file, if its mesh cannot be scaled, or if the script is stopped.
    pub fn estimate(
        handle: &SimulationHandle,
        context: &Context,
        limit: Option<Duration>,
    ) -> Result<Self, ScriptError> {
        if let RunStart::Loaded = handle.start() {
            let message = format!(
                "the error of '{}' cannot be estimated: a saved simulation does not contain its start",
                handle.name()
            );
            let hint = "estimate the error before sim.save(…)";
            return Err(ScriptError::new(message).hint(hint));
        }
        if handle.simulation().counts().steps == 0 {
            return Ok(Self::not_estimated(handle, "the simulation has taken no step"));
        }
        let mut estimate = Self { missing: Vec::new(), ..Self::not_estimated(handle, "") };
        let (plan, quantities, own) = {
            let simulation = handle.simulation();
            let quantities = traced_quantities(&simulation);
            let own = FinishedRun::of(&simulation, &quantities);
            (Plan::of(simulation.scene())?, quantities, own)
        };
        let runs = run_companions(handle, &plan.companions, &quantities, context, limit)?;
        let settings = *handle.simulation().settings();
        let time_levels = [Some(&own), runs[0].as_ref().ok(), runs[1].as_ref().ok()];
        let mesh_levels = plan.meshes.map(|meshes| meshes.map(|run| runs[run].as_ref().ok()));
        let failures = || runs.iter().filter_map(|run| run.as_ref().err());
        match failures().next() {
            Some((_, reason)) if failures().all(|(_, other)| other == reason) => {
                estimate.missing.push(reason.clone());
            }
            _ => estimate.missing.extend(failures().map(|(of, reason)| format!("{of}: {reason}"))),
        }
        if runs.iter().all(Result::is_err) {
            return Ok(estimate);
        }
        if plan.meshes.is_none() {
            estimate.missing.push(format!("in space: {}", no_meshes(handle.simulation().scene())));
        }
        let claims = settings.method.entry().claims;
        let orders = [claims.order, claims.largest_order()].map(f64::from);
        let mesh_order = handle.simulation().scene().mesh_order();
        let scales = Scales::of(&handle.simulation(), &quantities, &own.0);
        for (index, quantity) in quantities.iter().enumerate() {
            let scale = scales.of_quantity(quantity);
            if scale > 0.0 {
                let steps = RefinementLevels {
                    sizes: [1.0, 2.0, 4.0],
                    traces: time_levels.map(|run| Some(&run?.0[index])),
                    level: 0,
                    order: ExpectedOrder::Between(orders[0], orders[1]),
                    scale,
                };
                let meshes = mesh_levels.map(|runs| RefinementLevels {
                    sizes: plan.mesh_sizes,
                    traces: runs.map(|run| Some(&run?.0[index])),
                    level: plan.level,
                    order: ExpectedOrder::AtLeast(mesh_order),
                    scale,
                });
                let (in_time, in_space) = (steps.error(), meshes.and_then(|levels| levels.error()));
                let (name, dimension) = (quantity.name.clone(), quantity.dimension);
                let error = QuantityError { name, dimension, scale, in_time, in_space };
                estimate.quantities.push(error);
            }
        }
        let is_position =
            |quantity: &&TracedQuantity| matches!(quantity.source, TraceSource::Position(_));
        let stations = quantities.iter().filter(is_position).count().min(estimate.quantities.len());
        if let Some(first) = estimate.quantities.first().filter(|_| stations > 0) {
            let of_stations = |of: fn(&QuantityError) -> &Option<DiscretisationError>| {
                let errors =
                    estimate.quantities[..stations].iter().filter_map(|one| of(one).clone());
                errors.reduce(largest_of_both)
            };
            let together = QuantityError {
                name: POSITIONS.to_owned(),
                in_time: of_stations(|of| &of.in_time),
                in_space: of_stations(|of| &of.in_space),
                ..first.clone()
            };
            estimate.quantities.insert(0, together);
        }
        Ok(estimate)
    }

    /// Largest errors of all positions or of all frequencies; `None` without an estimate.
    pub fn together(&self) -> Option<&QuantityError> {
        [POSITIONS, FREQUENCIES, CRITICAL_LOADS].iter().find_map(|name| self.of(name))
    }

    pub fn of(&self, name: &str) -> Option<&QuantityError> {
        self.quantities.iter().find(|quantity| quantity.name == name)
    }

    /// Errors of a column at the times of all rows of a history.
    ///
    /// # Errors
    /// Fails if the error of the column is not estimated.
    pub fn of_rows(&self, column: &str, history: &History) -> Result<Vec<f64>, ScriptError> {
        let Some(quantity) = self.of(column) else {
            let message = format!("the error of column \"{column}\" is not estimated");
            let reason = match self.quantities.is_empty() {
                true => self.missing.join("; "),
                false => "it is zero in all rows, or describes the computation".to_owned(),
            };
            return Err(ScriptError::new(message).hint(reason));
        };
        Ok(history.samples().iter().map(|row| quantity.at(row.measures.time)).collect())
    }

    /// Adds the errors of the columns of a history to its table. Each error column follows the column of its values.
    pub fn add_columns(&self, table: &mut DataTable, history: &History) {
        let columns = std::mem::take(&mut table.columns).into_iter();
        let with_errors = columns.flat_map(|column| {
            let errors = self.of_rows(&column.name, history).ok().map(|errors| DataColumn {
                name: format!("{}.error", column.name),
                dimension: column.dimension.clone(),
                values: DataValues::Numbers(errors.into_iter().map(Some).collect()),
            });
            [Some(column), errors].into_iter().flatten()
        });
        table.columns = with_errors.collect();
    }

    /// Adds the errors of all stations and columns at the times of a history to its archive.
    pub fn add_arrays(&self, archive: &mut NpzArchive, history: &History) {
        archive.arrays.extend(self.quantities.iter().map(|quantity| {
            let errors = history.samples().iter().map(|row| quantity.at(row.measures.time));
            NpzArray::row(format!("error.{}", quantity.name), errors.collect())
        }));
    }

    pub fn summary(&self) -> String {
        let Some(together) = self.together() else {
            return format!("not estimated: {}", self.missing.join("; "));
        };
        let part = |of: &str, error: &Option<DiscretisationError>| match error {
            None => format!("{of} not estimated"),
            Some(error) => format!("{of} {}", scientific(error.present(), 2)),
        };
        let parts = match self.is_of_run() {
            false => String::new(),
            true => {
                let in_space = part("in space", &together.in_space);
                format!("{}, {in_space}; ", part("in time", &together.in_time))
            }
        };
        format!(
            "{} {}{}, {} ({parts}size {})",
            together.name,
            scientific(together.total().0, 2),
            self.moment,
            together.verdict(),
            significant(together.scale, 3),
        )
    }

    /// True for a run, false for a computation without time.
    fn is_of_run(&self) -> bool {
        self.quantities.iter().any(|quantity| quantity.in_time.is_some())
    }

    /// Table of at most [`MOST_ROWS`] quantities whose runs do not agree to rounding, with notes on the other quantities.
    pub fn table(&self) -> String {
        let heads: &[&str] = match self.is_of_run() {
            true => &["quantity", "in time", "largest", "order", "in space", "largest", "order"],
            false => &["quantity", "error", "order"],
        };
        let largest = if self.is_of_run() { ", and the largest of the run" } else { "" };
        let title = format!("estimated errors of '{}'{}{largest}", self.name, self.moment);
        let mut table = TextTable::new(&[heads, &["verdict"]].concat()).title(title);
        let is_shown = |quantity: &&QuantityError| {
            let both = [&quantity.in_time, &quantity.in_space];
            both.into_iter().flatten().any(|error| error.verdict != ErrorVerdict::Exact)
        };
        let shown: Vec<&QuantityError> = self.quantities.iter().filter(is_shown).collect();
        for quantity in shown.iter().take(MOST_ROWS) {
            let first = format!("{} [{}]", quantity.name, quantity.dimension);
            let in_space = error_cells(&quantity.in_space);
            let cells = match self.is_of_run() {
                true => [error_cells(&quantity.in_time), in_space].concat(),
                false => vec![in_space[0].clone(), in_space[2].clone()],
            };
            let verdict = Cell::Text(quantity.verdict());
            table.row([Cell::Text(first)].into_iter().chain(cells).chain([verdict]));
        }
        let mut text = match self.quantities.is_empty() {
            true => format!("no estimated errors of '{}'", self.name),
            false => table.to_string().trim_end().to_owned(),
        };
        let exact = self.quantities.len() - shown.len();
        let left_out = shown.len().saturating_sub(MOST_ROWS);
        if exact > 0 {
            let agree = if exact == 1 { "quantity agrees" } else { "quantities agree" };
            let of = if self.is_of_run() { "in all runs" } else { "on all meshes" };
            text += &format!("\n{exact} {agree} to rounding {of}");
        }
        if left_out > 0 {
            text += &format!("\n{left_out} further quantities are in .rows");
        }
        for reason in &self.missing {
            text += &format!("\nnot estimated: {reason}");
        }
        text
    }
}

/// Reason for the absence of an estimate in space.
pub(super) fn no_meshes(scene: &Scene) -> &'static str {
    match scene.beams.is_empty() {
        true => "the scene has no beams",
        false => "the meshes cannot be scaled",
    }
}

/// Cells of a table with the present error, the largest error and the observed order.
fn error_cells(error: &Option<DiscretisationError>) -> [Cell; 3] {
    let text = error.as_ref().map(|error| {
        let order = error.order.map_or_else(|| "-".to_owned(), |order| format!("{order:.1}"));
        [scientific(error.present(), 2), scientific(error.largest(), 2), order]
    });
    text.unwrap_or_else(|| ["-"; 3].map(str::to_owned)).map(Cell::Number)
}

/// Runs companions, in parallel if they start from the scene and no script function is called between their steps.
fn run_companions(
    handle: &SimulationHandle,
    companions: &[Companion],
    quantities: &[TracedQuantity],
    context: &Context,
    limit: Option<Duration>,
) -> Result<Vec<CompanionResult>, ScriptError> {
    let describe = |companion: &Companion, reason: String| {
        let of = match companion.span_ratio {
            1.0 => format!("the run with {} times the step", companion.step_ratio),
            ratio => format!("the run with {ratio} times the spans"),
        };
        (of, reason)
    };
    let is_from_scene = matches!(handle.start(), RunStart::Scene);
    if handle.has_callbacks() || !is_from_scene {
        let mut runs = Vec::new();
        for companion in companions {
            let run = handle.run_companion(*companion, context);
            context.proceed()?;
            runs.push(match run {
                Ok(run) => Ok(FinishedRun::of(&run.simulation(), quantities)),
                Err(ScriptError::Failure(failure)) => Err(describe(companion, failure.message)),
                Err(error) => return Err(error),
            });
        }
        return Ok(runs);
    }
    let stops = vec![handle.time()];
    let cases: Vec<Case> = companions
        .iter()
        .map(|companion| {
            let settings = handle.companion_settings(*companion);
            Ok(Case { scene: handle.companion_scene(*companion)?, settings, stops: stops.clone() })
        })
        .collect::<Result<_, ScriptError>>()?;
    let stop = AtomicBool::new(false);
    let limits = RunLimits { wall: limit.unwrap_or(Duration::MAX), ..RunLimits::default() };
    let work = |case: &Case| {
        let (outcome, simulation) = case.run(limits, &stop, |_| ());
        match (outcome, simulation) {
            (CaseOutcome::Finished, Some(run)) => Ok(FinishedRun::of(&run, quantities)),
            // A run may end by itself, for example when a slider leaves its beam.
            (_, Some(run)) if run.ending().is_some() => Ok(FinishedRun::of(&run, quantities)),
            (outcome, _) => Err(outcome.describe()),
        }
    };
    let scene = handle.simulation().scene().clone();
    let found = expect_no_side_effects(&functions_of_time(&scene), || {
        Ok(on_all_cores(&cases, &stop, work, |_| match context.is_stopped() {
            true => ControlFlow::Break(()),
            false => ControlFlow::Continue(()),
        }))
    });
    context.proceed()?;
    let found = match found {
        Err(ScriptError::Failure(failure)) => {
            let same = |companion: &Companion| Err(describe(companion, failure.message.clone()));
            return Ok(companions.iter().map(same).collect());
        }
        found => found?,
    };
    let runs = companions.iter().zip(found).map(|(companion, run)| {
        let run = run.unwrap_or_else(|| Err("it was stopped".to_owned())).and_then(|run| run);
        run.map_err(|reason| describe(companion, reason))
    });
    Ok(runs.collect())
}

/// Larger of two errors at each time, with the order and verdict of the error that is larger over the whole run.
fn largest_of_both(a: DiscretisationError, b: DiscretisationError) -> DiscretisationError {
    let pairs = a.over_time.iter().zip(&b.over_time);
    let over_time = pairs.map(|((time, a), (_, b))| (*time, larger(*a, *b))).collect();
    DiscretisationError { over_time, ..if b.largest() > a.largest() { b } else { a } }
}

fn traced_quantities(simulation: &Simulation) -> Vec<TracedQuantity> {
    let stations = stations_and_middles(simulation.scene()).into_iter().map(|(name, station)| {
        TracedQuantity { name, dimension: "length", source: TraceSource::Position(station) }
    });
    let columns = simulation.history().columns().filter(|(name, _)| is_of_the_motion(name));
    let columns = columns.map(|(name, dimension)| TracedQuantity {
        name: name.to_owned(),
        dimension,
        source: match simulation.is_step_mean(name) {
            true => TraceSource::StepMean,
            false => TraceSource::Column,
        },
    });
    stations.chain(columns).collect()
}

/// Scales of quantities: the size of the scene for positions, and the largest value of all columns of a dimension for columns.
struct Scales {
    length: f64,
    by_dimension: Vec<(&'static str, f64)>,
}

impl Scales {
    fn of(simulation: &Simulation, quantities: &[TracedQuantity], traces: &[Trace]) -> Self {
        let scene = simulation.scene();
        let is_position =
            |quantity: &TracedQuantity| matches!(quantity.source, TraceSource::Position(_));
        let all = || quantities.iter().zip(traces);
        let range = all().filter(|(quantity, _)| is_position(quantity)).map(|(_, of)| of.range());
        let length = scene.size().unwrap_or_else(|| range.fold(0.0, larger));
        // The scale of momenta is computed from the kinetic energy, because the momenta of a scene that does not move as a whole are zero within rounding.
        let kinetic = largest(simulation.history(), "kinetic");
        let momentum = (2.0 * simulation.model().total_mass() * kinetic).sqrt();
        let mut by_dimension =
            vec![("mass·length/time", momentum), ("mass·length²/time", momentum * length)];
        for (quantity, trace) in all().filter(|(quantity, _)| !is_position(quantity)) {
            let own = trace.largest();
            match by_dimension.iter_mut().find(|(other, _)| *other == quantity.dimension) {
                Some((_, scale)) => *scale = larger(*scale, own),
                None => by_dimension.push((quantity.dimension, own)),
            }
        }
        Self { length, by_dimension }
    }

    fn of_quantity(&self, quantity: &TracedQuantity) -> f64 {
        match quantity.source {
            TraceSource::Position(_) => self.length,
            _ => {
                let found =
                    self.by_dimension.iter().find(|(other, _)| *other == quantity.dimension);
                found.map_or(0.0, |(_, scale)| *scale)
            }
        }
    }
}

fn largest(history: &History, column: &str) -> f64 {
    history.column(column).unwrap_or_default().into_iter().map(f64::abs).fold(0.0, larger)
}
