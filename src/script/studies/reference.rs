//! Reference solutions of studies: an independent table, or a run with finer steps and mesh.

use rhai::{Dynamic, Map};

use super::case_runner::{CaseRunner, CaseTask};
use super::labels;
use super::options::{ErrorOptions, ReferenceOption};
use super::plan::{ErrorStudyPlan, at_key, expect_same_observables, scene_on_mesh};
use crate::analysis::{
    Case, CaseOutcome, PART_OF_THE_SMALLEST_STEP, ParsedCsv, ReferenceSolution, RunResult,
    finest_mesh, highest_order,
};
use crate::elementary::square;
use crate::geometry::Vec2;
use crate::integrators::Method;
use crate::script::bindings::call::Call;
use crate::script::bindings::kind::Scripted;
use crate::script::messages::error::ScriptError;
use crate::script::messages::numbers::format_number;
use crate::simulation::{StepControl, StepSize};

#[derive(Clone, Default)]
pub struct FinestRun {
    pub mesh: Option<Dynamic>,
    /// Step size [time] of the reference run; `None` for the step size given by [`finer`].
    pub dt: Option<f64>,
    pub method: Option<Method>,
}

impl Scripted for FinestRun {
    const NAME: &'static str = "finest run";
    const DOC: &'static str = "A fine run that a study uses as its reference.";

    fn show(&self) -> String {
        let dt = self.dt.map(|dt| format!(", dt = {}", format_number(dt)));
        let method = self.method.map(|method| format!(", {}", labels::method(&method)));
        let mesh = self.mesh.as_ref().map(|_| ", on a finer mesh");
        let settings =
            [mesh.unwrap_or_default(), &method.unwrap_or_default(), &dt.unwrap_or_default()];
        format!("reference: own finest run{}", settings.concat())
    }
}

/// Step size of the reference run: a fraction of the smallest fixed step size or, without fixed steps, of the smallest tolerance.
fn finer(dts: &[StepSize]) -> StepSize {
    let fixed = dts.iter().filter_map(|dt| match dt {
        StepSize::Fixed(dt) => Some(*dt),
        StepSize::Adaptive(_) => None,
    });
    let controls = dts.iter().filter_map(|dt| match dt {
        StepSize::Fixed(_) => None,
        StepSize::Adaptive(control) => Some(control.tolerance),
    });
    let smallest = controls.fold(f64::INFINITY, f64::min);
    let tolerance =
        (square(PART_OF_THE_SMALLEST_STEP) * smallest).max(StepControl::LEAST_TOLERANCE);
    let control = StepControl { tolerance, first: None, smallest: None, largest: None };
    fixed
        .reduce(f64::min)
        .map_or(StepSize::Adaptive(control), |dt| StepSize::Fixed(PART_OF_THE_SMALLEST_STEP * dt))
}

/// Doubled fixed step size, or four times the tolerance, which doubles the adaptive steps of a second-order method.
fn doubled_step(dt: StepSize) -> StepSize {
    match dt {
        StepSize::Fixed(dt) => StepSize::Fixed(2.0 * dt),
        StepSize::Adaptive(control) => {
            StepSize::Adaptive(StepControl { tolerance: 4.0 * control.tolerance, ..control })
        }
    }
}

pub enum Reference {
    Table(String, ParsedCsv),
    /// Description of the reference run, its case, and a case with twice the step size for an error estimate.
    /// The second case is omitted if all runs of the study have the same time settings, because errors in time then cancel.
    ReferenceRun(String, Vec<Case>),
}

pub fn read_sheet(call: &Call, key: &str, file: &str) -> Result<ParsedCsv, ScriptError> {
    let bytes = call.context().read_file(file)?;
    let text = String::from_utf8_lossy(&bytes);
    ParsedCsv::parse(&text).map_err(|error| {
        at_key(call, key, format!("\"{file}\": {error}"), "a table is CSV, with # before comments")
    })
}

/// Rejects a reference run on a compared mesh, whose error would be zero.
pub fn expect_finer_than_all_meshes(
    call: &Call,
    reference: Option<&ReferenceOption>,
) -> Result<(), ScriptError> {
    match reference {
        Some(ReferenceOption::Table(_)) => return Ok(()),
        Some(ReferenceOption::Run(run)) if run.mesh.is_some() => return Ok(()),
        _ => (),
    }
    let message =
        "a run on the finest mesh of the study cannot be the reference for errors of meshes";
    let hint = "add reference: finest_run(#{ mesh: … }) with a finer mesh, or the name of a table";
    Err(at_key(call, "meshes", message, hint))
}

/// Rejects a reference with fixed steps that are not smaller than those of the compared runs.
/// The flag `is_of_a_mesh` is true if the reference has the mesh of a compared run.
/// Equal steps are allowed if it has another mesh, or if its integrator has a higher order.
fn expect_finer_steps(
    call: &Call,
    plan: &ErrorStudyPlan,
    finest: &Case,
    is_of_a_mesh: bool,
) -> Result<(), ScriptError> {
    let size = |dt: &StepSize| match dt {
        StepSize::Fixed(dt) => Some(*dt),
        StepSize::Adaptive(_) => None,
    };
    let smallest = plan.dts.iter().filter_map(size).reduce(f64::min);
    let Some((own, smallest)) = size(&finest.settings.dt).zip(smallest) else { return Ok(()) };
    let order = |method: &Method| method.entry().claims.order;
    let is_of_higher_order =
        plan.methods.iter().all(|other| order(other) < order(&finest.settings.method));
    if own < smallest || (own == smallest && (is_of_higher_order || !is_of_a_mesh)) {
        return Ok(());
    }
    let (own, smallest, usual) = (
        format_number(own),
        format_number(smallest),
        format_number(PART_OF_THE_SMALLEST_STEP * smallest),
    );
    let message = format!(
        "the reference must be finer than the finest run of the study: it has dt = {own}, but \
        the study has {smallest}"
    );
    let hint = format!(
        "omit dt in finest_run(…), default: {usual}; or give a smaller one, or the name of a \
        table"
    );
    Err(at_key(call, "reference", message, hint))
}

/// Rejects a reference whose steps do not change if the step size is doubled, because its error cannot be estimated.
fn expect_other_steps_if_doubled(call: &Call, finest: &Case) -> Result<(), ScriptError> {
    match finest.settings.dt {
        StepSize::Fixed(dt) if finest.is_one_step_from_stop_to_stop(dt) => {
            let dt = format_number(dt);
            let message = format!(
                "the reference, dt = {dt}, takes the same steps with twice the step size, so \
                that its error is unknown"
            );
            let hint = "choose step sizes smaller than the times of the study: reference: finest_run(#{ dt: … }), or smaller dts";
            Err(at_key(call, "reference", message, hint))
        }
        _ => Ok(()),
    }
}

fn columns_of(call: &Call, options: &ErrorOptions) -> Result<Option<Map>, ScriptError> {
    let Some(given) = &options.columns else { return Ok(None) };
    let got = call.describe(given);
    given.clone().try_cast::<Map>().map(Some).ok_or_else(|| {
        let hint = "write names of the reference with columns of the history: #{ S: \"slider1.position\" }";
        at_key(call, "columns", format!("'columns' must be a map, got {got}"), hint)
    })
}

impl Reference {
    pub fn read(
        call: &Call,
        options: &ErrorOptions,
        plan: &mut ErrorStudyPlan,
    ) -> Result<Self, ScriptError> {
        let columns = columns_of(call, options)?;
        let run = match &options.reference {
            Some(ReferenceOption::Table(file)) => {
                let sheet = read_sheet(call, "reference", file)?;
                plan.add_columns(call, columns, Some(&sheet))?;
                let reference = Self::Table(file.clone(), sheet);
                reference.reference_solution(call, plan, &[])?;
                return Ok(reference);
            }
            Some(ReferenceOption::Run(run)) => run.clone(),
            None => FinestRun::default(),
        };
        let dt = run.dt.map_or_else(|| finer(&plan.dts), StepSize::from);
        let method = run.method.or_else(|| highest_order(&plan.methods)).unwrap_or_default();
        let finest = finest_mesh(&plan.subjects).unwrap_or(0);
        let subject = match run.mesh {
            None => plan.subjects[finest].clone(),
            Some(mesh) => {
                let own = [scene_on_mesh(call, &options.scene, &mesh)?];
                expect_same_observables(call, &plan.subjects[0], &own)?;
                let [own] = own;
                own
            }
        };
        plan.add_columns(call, columns, None)?;
        let (method_name, mesh) = (labels::method(&method), subject.mesh.clone());
        let source =
            format!("own finest run ({mesh}, {method_name}, {dt}), no independent solution");
        let case = |dt| {
            let settings = ErrorStudyPlan::settings(method, dt);
            Case { scene: subject.scene.clone(), settings, stops: plan.times.clone() }
        };
        let finest = case(dt);
        let is_of_a_mesh = plan.subjects.iter().any(|of| of.mesh == mesh);
        expect_finer_steps(call, plan, &finest, is_of_a_mesh)?;
        let is_common = plan.all_settings().iter().all(|other| *other == finest.settings);
        if !is_common {
            expect_other_steps_if_doubled(call, &finest)?;
        }
        let coarser = (!is_common).then(|| case(doubled_step(dt)));
        Ok(Self::ReferenceRun(source, [finest].into_iter().chain(coarser).collect()))
    }

    fn cases(&self) -> &[Case] {
        match self {
            Self::Table(..) => &[],
            Self::ReferenceRun(_, cases) => cases,
        }
    }

    fn reference_solution(
        &self,
        call: &Call,
        plan: &ErrorStudyPlan,
        own: &[RunResult],
    ) -> Result<ReferenceSolution, ScriptError> {
        match (self, own) {
            (Self::Table(file, sheet), _) => {
                let source = format!("{file}, an independent solution");
                ReferenceSolution::of_sheet(source, sheet, plan.observables(), &plan.times).map_err(
                    |error| {
                        let hint = "give times and stations that the table has";
                        at_key(call, "reference", format!("\"{file}\": {error}"), hint)
                    },
                )
            }
            (Self::ReferenceRun(source, _), [finest, coarser @ ..]) => {
                if let Some(failed) = own.iter().find(|trial| !trial.outcome.is_finished()) {
                    let why = failed.outcome.describe();
                    let hint =
                        "choose another reference: finest_run(#{ … }) or the name of a table";
                    let message = format!("the reference failed: {source}: {why}");
                    return Err(at_key(call, "reference", message, hint));
                }
                let reference_solution = ReferenceSolution::of_run(source, &finest.readings);
                Ok(coarser.iter().fold(reference_solution, |reference_solution, other| {
                    reference_solution.with_errors_from(&other.readings)
                }))
            }
            (Self::ReferenceRun(..), []) => {
                Err(ScriptError::internal_error("a study has lost its reference"))
            }
        }
    }

    pub fn placeholder(
        &self,
        call: &Call,
        plan: &ErrorStudyPlan,
    ) -> Result<ReferenceSolution, ScriptError> {
        match self {
            Self::Table(..) => self.reference_solution(call, plan, &[]),
            Self::ReferenceRun(source, _) => {
                let nothing = vec![vec![Vec2::zeros(); plan.observables().len()]; plan.times.len()];
                Ok(ReferenceSolution::of_run(source, &nothing))
            }
        }
    }

    /// Runs all cases of a study and of its reference; `None` if only a part of the cases was computed.
    pub fn trials(
        &self,
        call: &Call,
        runner: &CaseRunner,
        plan: &ErrorStudyPlan,
        cases: &[Case],
    ) -> Result<Option<(Vec<RunResult>, ReferenceSolution)>, ScriptError> {
        let all: Vec<Case> = self.cases().iter().chain(cases).cloned().collect();
        let (observables, limits) = (plan.observables(), plan.limits);
        let parts = postcard::to_stdvec(observables).unwrap_or_default();
        let task = CaseTask { name: "runs", parts: &parts };
        let work = |case: &Case, stop: &_| RunResult::of(case, observables, limits, stop);
        let steps_of = |trial: &RunResult| trial.steps + trial.retries;
        let Some(results) = runner.in_parallel(task, &all, steps_of, work)? else {
            return Ok(None);
        };
        let panicked = |message| RunResult::not_started(CaseOutcome::Panicked { message });
        let mut own: Vec<RunResult> =
            results.into_iter().map(|result| result.unwrap_or_else(panicked)).collect();
        let trials = own.split_off(self.cases().len());
        let reference_solution = self.reference_solution(call, plan, &own)?;
        Ok(Some((trials, reference_solution)))
    }

    pub fn no_trials(cases: &[Case]) -> (Vec<RunResult>, ReferenceSolution) {
        let reason = "nothing is run here".to_owned();
        let trial = RunResult::not_started(CaseOutcome::Failed { time: 0.0, reason });
        (vec![trial; cases.len()], ReferenceSolution::of_run("none", &Vec::new()))
    }
}
