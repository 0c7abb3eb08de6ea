//! Execution of a sweep on worker threads, with a journal, progress and limits.

use std::collections::BTreeMap;
use std::time::Duration;

use rhai::{Dynamic, FnPtr};

use super::design::SweepPlan;
use super::rows::{RowOutcome, found};
use super::sweep_progress::{SweepError, SweepProgress, listed};
use super::table::FinishedSweep;
use crate::analysis::Sweep;
use crate::script::bindings::call::Call;
use crate::script::engine::workers::{EngineConfig, WorkerEvent, WorkerPool, with_worker_pool};
use crate::script::messages::error::ScriptError;
use crate::script::state::context::Context;
use crate::script::state::journals::RowKeeper;
use crate::script::studies::calls::calling::{CallWork, call, thrown};
use crate::script::studies::calls::function::RunFunction;
use crate::script::studies::plan::at_key;

const NO_FILES: &str = "a run of a sweep cannot write files: return the data in its map";

/// Number of queued rows per worker, so that workers need not wait while results are collected.
const AHEAD: usize = 4096;

pub struct SweepRequest<'o> {
    pub name: String,
    pub plan: SweepPlan,
    pub function: &'o FnPtr,
    pub wall: Duration,
}

impl SweepRequest<'_> {
    /// Runs all rows.
    ///
    /// # Errors
    /// Fails if the function cannot be sent to workers, is wrong, or fails in all rows.
    /// If the run is stopped, it also fails, but the journal contains the finished rows.
    pub fn run(self, call: &Call) -> Result<FinishedSweep, ScriptError> {
        let context = call.context();
        let function = RunFunction::read(call, "run", self.function)?;
        let rows = self.plan.design.rows;
        let mut progress = SweepProgress::new(rows);
        let mut keeper = self.keeper(call, &function, &mut progress)?;
        if context.studies().merge.is_empty() {
            report_known(context, &self.name, progress.done, rows);
        }
        let part = context.studies().part;
        part.into_iter().for_each(|part| progress.mark_other_parts(part));
        context.progress().begin_cases(&self.name, rows);
        let outcome = match EngineConfig::of(call.engine(), context, NO_FILES) {
            _ if progress.done == rows => Ok(()),
            Some(config) => {
                self.on_all_cores(call, &config, &function, (&mut progress, &mut keeper))
            }
            None => self.on_this_thread(call, &mut progress, &mut keeper),
        };
        context.progress().end();
        if let Some(keeper) = &mut keeper {
            keeper.flush()?;
        }
        match outcome {
            Err(SweepError::Other(error)) => return Err(error),
            Err(SweepError::Row(row, message)) => {
                return Err(self.located_error(call, &progress, row, &message));
            }
            Ok(()) if progress.done < rows => return Err(context.why_stopped("a sweep")),
            Ok(()) => (),
        }
        if part.is_some() {
            progress.fill_other_parts();
        }
        let SweepProgress { results, model, .. } = progress;
        if model.is_none()
            && part.is_none()
            && let Some((row, reason)) = results.failures().next()
        {
            let message = format!("no run finished; the first one failed: {reason}");
            return Err(context
                .without_output_or_files(NO_FILES, || self.invoked(call, row))
                .err()
                .unwrap_or_else(|| {
                    at_key(call, "run", message, "check the errors of the function")
                }));
        }
        let sweep = Sweep { name: self.name, design: self.plan.design.clone(), results };
        Ok(FinishedSweep { sweep, plan: self.plan })
    }

    fn on_all_cores(
        &self,
        calling: &Call,
        config: &EngineConfig,
        function: &RunFunction,
        (progress, keeper): (&mut SweepProgress, &mut Option<RowKeeper>),
    ) -> Result<(), SweepError> {
        let plan = &self.plan;
        let wall = format!("{} s, the time limit", self.wall.as_secs_f64());
        let work = |worker: &_, row| {
            let values =
                |function_of: &dyn Fn(&str, usize) -> Option<FnPtr>| plan.values(row, function_of);
            call(worker, function, values, &wall, RowOutcome::of)
        };
        let panicked = |message: String| CallWork {
            result: RowOutcome::Failed(format!("internal error of withy: {message}")),
            steps: 0,
        };
        let driven = with_worker_pool(config, self.wall, work, panicked, |pool| {
            drive(pool, calling.context(), (progress, keeper))
        });
        driven.map_err(SweepError::Other)?
    }

    /// Runs the rows one by one in the engine of the script.
    /// Workers are not available without a complete script, or with too little address space.
    fn on_this_thread(
        &self,
        call: &Call,
        progress: &mut SweepProgress,
        keeper: &mut Option<RowKeeper>,
    ) -> Result<(), SweepError> {
        let context = call.context();
        for row in 0..self.plan.design.rows {
            if progress.knows(row) {
                continue;
            }
            let of = match context.without_output_or_files(NO_FILES, || self.invoked(call, row)) {
                Ok(given) => found(&given),
                Err(error @ (ScriptError::Stopped(_) | ScriptError::Internal(_))) => {
                    return Err(SweepError::Other(error));
                }
                Err(ScriptError::Engine(error)) if context.is_stopped() => {
                    return Err(SweepError::Other(ScriptError::Engine(error)));
                }
                Err(ScriptError::Engine(error)) => match thrown(&error) {
                    Some(reason) => RowOutcome::Failed(reason),
                    None => return Err(SweepError::Other(ScriptError::Engine(error))),
                },
                Err(ScriptError::Failure(failure)) => RowOutcome::Failed(failure.message),
            };
            take(context, (progress, keeper), row, of)?;
        }
        Ok(())
    }

    /// Calls the function of the sweep with the parameters of a row, in the engine of the script instead of a worker.
    ///
    /// # Errors
    /// Fails with the error of the function and its position, or if the function changes a captured variable.
    pub fn invoked(&self, call: &Call, row: usize) -> Result<Dynamic, ScriptError> {
        let values = self.plan.values(row, &|name, count| call.function_named(name, count));
        RunFunction::read(call, "run", self.function)?.call_here(call, "run", values)
    }

    fn located_error(
        &self,
        call: &Call,
        progress: &SweepProgress,
        row: usize,
        message: &str,
    ) -> ScriptError {
        let found = call.context().without_output_or_files(NO_FILES, || self.invoked(call, row));
        match found {
            Err(error) => error,
            Ok(_) => {
                let values = self.row_in_words(row);
                let other = progress.model.map_or(String::new(), |model| {
                    let names = listed(&progress.results.names);
                    format!("; the run with {} returned {names}", self.row_in_words(model))
                });
                let message = format!("run: with {values}, {message}{other}");
                at_key(
                    call,
                    "run",
                    message,
                    "its last expression must be a map of numbers, with the same names in all \
                    runs: #{ peak: peak }",
                )
            }
        }
    }

    fn row_in_words(&self, row: usize) -> String {
        let of = &self.plan.design.parameters;
        let words = of.iter().map(|of| {
            format!("{} = {}", of.name, of.values.in_words(row, crate::output::format_number))
        });
        words.collect::<Vec<_>>().join(", ")
    }
}

/// Sends a limited number of unknown rows at a time to the workers, until all rows are known or the run is stopped.
/// The first successful row defines the names of the results. Until then, results are processed in the order of the rows.
/// Therefore the names do not depend on the timing of the workers.
fn drive(
    pool: &WorkerPool<usize, CallWork<RowOutcome>>,
    context: &Context,
    (progress, keeper): (&mut SweepProgress, &mut Option<RowKeeper>),
) -> Result<(), SweepError> {
    let unknown: Vec<u32> =
        (0..progress.rows).filter(|row| !progress.knows(*row)).map(|row| row as u32).collect();
    let mut in_order = unknown.iter().map(|row| *row as usize).peekable();
    let mut early = BTreeMap::new();
    let mut rows = unknown.iter().map(|row| *row as usize);
    rows.by_ref().take(AHEAD * pool.size()).for_each(|row| pool.submit(row, row));
    while progress.done < progress.rows {
        match pool.receive_batch() {
            WorkerEvent::Done(row, CallWork { result, steps }) => {
                context.meter().count_steps(usize::try_from(steps).unwrap_or(usize::MAX));
                early.insert(row, result);
                while let Some(row) = match progress.model {
                    Some(_) => early.keys().next().copied(),
                    None => in_order.next_if(|next| early.contains_key(next)),
                } && let Some(result) = early.remove(&row)
                {
                    take(context, (progress, keeper), row, result)?;
                }
                rows.by_ref().take(1).for_each(|row| pool.submit(row, row));
            }
            WorkerEvent::Timeout => sync_periodically(keeper).map_err(SweepError::Other)?,
            WorkerEvent::NoWorkers => break,
        }
        let has_steps = progress.done == progress.rows || context.meter().allows_a_step();
        if !has_steps || context.stopped_by().is_some() {
            break;
        }
    }
    Ok(())
}

fn take(
    context: &Context,
    (progress, keeper): (&mut SweepProgress, &mut Option<RowKeeper>),
    row: usize,
    of: RowOutcome,
) -> Result<(), SweepError> {
    let entries = progress.record_result(row, of)?;
    context.progress().report_case(progress.done);
    if let Some(keeper) = keeper {
        for entry in &entries {
            let bytes = keeper.write(context.journals(), entry).map_err(SweepError::Other)?;
            context.meter().allows_to_write(bytes);
        }
    }
    Ok(())
}

fn sync_periodically(keeper: &mut Option<RowKeeper>) -> Result<(), ScriptError> {
    keeper.as_mut().map_or(Ok(()), RowKeeper::sync_periodically)
}

fn report_known(context: &Context, name: &str, known: usize, all: usize) {
    if known > 0 {
        context.print_message(&format!(
            "study '{name}' continues: {known} of {all} rows are known from an earlier run"
        ));
    }
}
