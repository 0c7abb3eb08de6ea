//! Refinement of steps and mesh until the estimated error of a run meets a tolerance.

use std::time::Instant;

use super::error_estimate::{ErrorEstimate, POSITIONS};
use crate::analysis::{DiscretisationError, ErrorVerdict};
use crate::elementary::{ln, power};
use crate::integrators::Method;
use crate::output::{Cell, TextTable, scientific, significant};
use crate::script::handles::scene::SceneHandle;
use crate::script::handles::simulation::SimulationHandle;
use crate::script::messages::error::ScriptError;
use crate::script::state::context::Context;
use crate::simulation::SimulationSettings;

const FIRST_STEPS: f64 = 50.0;

const MOST_RUNS: usize = 12;

const MOST_REFINEMENT: [f64; 2] = [8.0, 4.0];

/// Largest error estimate that is accepted although it has not converged, as a fraction of the allowed error [-].
const NEGLIGIBLE: f64 = 0.1;

/// Largest allowed error due to the steps, and due to the mesh, each as a fraction of the tolerance.
const PART: f64 = 0.5;

pub struct RefinedRunRequest {
    pub name: String,
    /// End of the run [time].
    pub end: f64,
    /// Largest estimated error of positions, relative to the size of the scene [-].
    pub tolerance: f64,
    pub method: Method,
    /// Time after which no further run is started [s].
    pub max_time: f64,
}

#[derive(Clone)]
pub struct RefinedRun {
    pub simulation: SimulationHandle,
    pub rows: Vec<RefinedRunRow>,
    /// Reason why the tolerance was not reached; `None` if it was reached.
    pub failure: Option<String>,
    tolerance: f64,
}

#[derive(Debug, Clone)]
pub struct RefinedRunRow {
    pub spans: usize,
    /// Step size [time].
    pub dt: f64,
    /// Number of steps; zero if the run failed.
    pub steps: usize,
    /// Largest error due to the steps, relative to the size of the scene [-]; NaN if unknown.
    pub in_time: f64,
    /// Largest error due to the mesh, relative to the size of the scene [-]; NaN if unknown.
    pub in_space: f64,
    pub verdict: String,
    /// Run time without the estimate [s].
    pub seconds: f64,
}

fn refinement_factor(
    error: Option<&DiscretisationError>,
    length: f64,
    tolerance: f64,
    most: f64,
) -> f64 {
    let Some(error) = error else { return 1.0 };
    let ratio = error.largest() / (length * PART * tolerance);
    match (error.verdict, error.order) {
        (ErrorVerdict::Exact, _) => 1.0,
        _ if ratio <= 1.0 && error.verdict == ErrorVerdict::Converged => 1.0,
        (ErrorVerdict::Converged, Some(order)) => {
            // The factor is a power of two, so that all runs have times and knots in common.
            let halvings = (ln(power(ratio, 1.0 / order)) / ln(2.0)).ceil().max(1.0);
            power(2.0, halvings).min(most)
        }
        (ErrorVerdict::PreAsymptotic, _) if ratio <= NEGLIGIBLE => 1.0,
        _ => 2.0,
    }
}

impl RefinedRun {
    /// Runs a scene with smaller steps and finer meshes until the estimated error of the positions is within the tolerance,
    /// or the time or the number of runs reaches its limit.
    pub fn run(
        scene: &SceneHandle,
        request: &RefinedRunRequest,
        context: &Context,
    ) -> Result<Self, ScriptError> {
        let begun = Instant::now();
        let (mut span_ratio, mut dt) = (1.0, request.end / FIRST_STEPS);
        let mut rows: Vec<RefinedRunRow> = Vec::new();
        loop {
            let started = Instant::now();
            let settings = SimulationSettings::new(request.method, dt);
            let name = request.name.clone();
            let run = SimulationHandle::start_refined(scene, span_ratio, settings, name)?;
            let spans = {
                let simulation = run.simulation();
                simulation.scene().beams.iter().map(|beam| beam.mesh.spans()).sum()
            };
            let ran = run.run_silently(request.end, context);
            context.proceed()?;
            let seconds = started.elapsed().as_secs_f64();
            let steps = run.simulation().counts().steps;
            let may_refine =
                rows.len() + 1 < MOST_RUNS && begun.elapsed().as_secs_f64() < request.max_time;
            let mut row = RefinedRunRow {
                spans,
                dt,
                steps,
                in_time: f64::NAN,
                in_space: f64::NAN,
                verdict: String::new(),
                seconds,
            };
            match ran {
                Ok(()) => (),
                // The equations of a step that is too large may have no solution, so smaller steps are tried.
                Err(ScriptError::Failure(failure)) if may_refine => {
                    row.steps = 0;
                    row.verdict = failure.message;
                    rows.push(row);
                    dt *= 0.5;
                    continue;
                }
                Err(error) => return Err(error),
            }
            let estimate = ErrorEstimate::estimate(&run, context, None)?;
            let positions = estimate.of(POSITIONS);
            let size = positions.map_or(1.0, |positions| positions.scale);
            let [in_time, in_space] = [
                positions.and_then(|of| of.in_time.as_ref()),
                positions.and_then(|of| of.in_space.as_ref()),
            ];
            let relative = |error: Option<&DiscretisationError>| {
                error.map_or(f64::NAN, |error| error.largest() / size)
            };
            (row.in_time, row.in_space) = (relative(in_time), relative(in_space));
            row.verdict =
                positions.map_or_else(|| estimate.summary(), |positions| positions.verdict());
            let is_chaotic = [in_time, in_space]
                .into_iter()
                .flatten()
                .any(|error| matches!(error.verdict, ErrorVerdict::Chaotic { .. }));
            let next = |error, most| refinement_factor(error, size, request.tolerance, most);
            let finer_steps = next(in_time, MOST_REFINEMENT[0]);
            let finer_mesh = next(in_space, MOST_REFINEMENT[1]);
            let is_within = finer_steps == 1.0 && finer_mesh == 1.0 && in_time.is_some();
            rows.push(row);
            let failure = match (is_within, positions.is_some(), may_refine) {
                (true, ..) => None,
                (_, false, _) => Some("the error cannot be estimated".to_owned()),
                (.., false) if is_chaotic => Some("nearby runs separate".to_owned()),
                (.., false) => Some(format!(
                    "not reached in {} runs and {} s",
                    rows.len(),
                    significant(begun.elapsed().as_secs_f64(), 3)
                )),
                _ => {
                    dt /= finer_steps;
                    span_ratio *= finer_mesh;
                    continue;
                }
            };
            run.report_as_latest(context);
            return Ok(Self { simulation: run, rows, failure, tolerance: request.tolerance });
        }
    }

    pub fn dry_run(
        scene: &SceneHandle,
        request: &RefinedRunRequest,
        context: &Context,
    ) -> Result<Self, ScriptError> {
        let dt = request.end / FIRST_STEPS;
        let settings = SimulationSettings::new(request.method, dt);
        let name = request.name.clone();
        let simulation = SimulationHandle::start_refined(scene, 1.0, settings, name)?;
        simulation.dry_run(context, request.end)?;
        simulation.report_as_latest(context);
        let (in_time, in_space, verdict) = (0.0, 0.0, String::new());
        let row =
            RefinedRunRow { spans: 1, dt, steps: 1, in_time, in_space, verdict, seconds: 0.0 };
        Ok(Self { simulation, rows: vec![row], failure: None, tolerance: request.tolerance })
    }

    pub fn table(&self) -> String {
        let heads = ["spans", "dt", "steps", "in time", "in space", "run time [s]", "verdict"];
        let title = format!(
            "runs of '{}' up to t = {}; largest errors of positions relative to the size of the scene",
            self.simulation.name(),
            significant(self.simulation.time(), 6)
        );
        let mut table = TextTable::new(&heads).title(title);
        for row in &self.rows {
            let error = |error: f64| match error.is_nan() {
                true => "-".to_owned(),
                false => scientific(error, 2),
            };
            let numbers = [
                row.spans.to_string(),
                significant(row.dt, 4),
                row.steps.to_string(),
                error(row.in_time),
                error(row.in_space),
                significant(row.seconds, 2),
            ];
            let verdict = Cell::Text(row.verdict.clone());
            table.row(numbers.map(Cell::Number).into_iter().chain([verdict]));
        }
        let tolerance = significant(self.tolerance, 3);
        let result = match &self.failure {
            None => format!("the tolerance of {tolerance} is reached"),
            Some(reason) => format!("the tolerance of {tolerance} is not reached: {reason}"),
        };
        format!("{}\n{result}", table.to_string().trim_end())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn refinement(largest: f64, order: Option<f64>, verdict: ErrorVerdict) -> f64 {
        let error = DiscretisationError { over_time: vec![(1.0, largest)], order, verdict };
        refinement_factor(Some(&error), 2.0, 1e-3, 8.0)
    }

    #[test]
    fn refinement_factor_follows_from_error_and_order() {
        let converged = ErrorVerdict::Converged;
        assert_eq!(refinement(1e-3, Some(2.0), converged), 1.0);
        assert_eq!(refinement(2e-3, Some(2.0), converged), 2.0);
        assert_eq!(refinement(3e-3, Some(2.0), converged), 2.0);
        assert_eq!(refinement(1e-2, Some(2.0), converged), 4.0);
        assert_eq!(refinement(10.0, Some(2.0), converged), 8.0);
        assert_eq!(refinement(1e-2, Some(4.0), converged), 2.0);
        assert_eq!(refinement(5e-4, None, ErrorVerdict::PreAsymptotic), 2.0);
        assert_eq!(refinement(1e-9, None, ErrorVerdict::PreAsymptotic), 1.0);
        assert_eq!(refinement(1e-12, None, ErrorVerdict::Exact), 1.0);
    }
}
