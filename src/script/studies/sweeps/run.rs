//! A sweep at work: its rows on all engines, with a journal, progress and limits.

use std::fmt::Write;
use std::ops::ControlFlow;
use std::time::Duration;

use rhai::{Dynamic, FnPtr};

use super::design::SweepPlan;
use super::function::RunFunction;
use super::rows::{Made, Row, changes, found, make};
use super::table::Swept;
use crate::analysis::{Journal, RowEntry, Sweep, SweepResults};
use crate::script::engine::workers::{Blueprint, on_all_engines};
use crate::script::rows::call::Call;
use crate::script::rows::sources::Sources;
use crate::script::state::context::Context;
use crate::script::state::journals::RowKeeper;
use crate::script::studies::plan::at_key;
use crate::script::words::error::ScriptError;

/// Why a run of a sweep writes no files.
const NO_FILES: &str = "a run of a sweep writes no files: give what is to be kept in its map";

/// What a sweep is asked for.
pub struct Order<'o> {
    /// The name of the sweep and of its files.
    pub name: String,
    /// What it goes through.
    pub plan: SweepPlan,
    /// The function that makes a run.
    pub function: &'o FnPtr,
    /// The longest that a run may take by the clock.
    pub wall: Duration,
}

/// What is known of the rows so far.
struct Ledger {
    results: SweepResults,
    /// Whether a row has been heard of.
    is_known: Vec<bool>,
    done: usize,
    rows: usize,
    /// The first row that came to its end, from which the names are.
    model: Option<usize>,
}

/// Why a sweep breaks off.
enum Trouble {
    /// The function seems wrong, or gives something that is: what it was, and in which row.
    Row(usize, String),
    /// Another error.
    Other(ScriptError),
}

impl Ledger {
    fn new(rows: usize) -> Self {
        let results = SweepResults::default();
        Self { results, is_known: vec![false; rows], done: 0, rows, model: None }
    }

    fn know(&mut self, row: usize) -> bool {
        let is_new = self.is_known.get(row) == Some(&false);
        if is_new {
            self.is_known[row] = true;
            self.done += 1;
        }
        is_new
    }

    /// Takes an entry of a journal; what fits nothing is left out.
    fn recall(&mut self, entry: RowEntry) {
        match entry {
            RowEntry::Sweep { .. } => (),
            RowEntry::Names(names) => {
                if self.results.names.is_empty() && !names.is_empty() {
                    self.results.begin(names, self.rows);
                }
            }
            RowEntry::Found(row, values) => {
                let fits = values.len() == self.results.names.len();
                if let Some(row) = usize::try_from(row).ok().filter(|_| fits)
                    && self.know(row)
                {
                    self.model.get_or_insert(row);
                    self.results.find(row, &values);
                }
            }
            RowEntry::Failed(row, reason) => {
                if let Ok(row) = usize::try_from(row)
                    && self.know(row)
                {
                    self.results.fail(row, &reason);
                }
            }
        }
    }

    /// Takes what became of a row; gives the entries for the journal.
    fn hear(&mut self, at: usize, row: Row) -> Result<Vec<RowEntry>, Trouble> {
        let number = at as u64;
        match row {
            Row::Found(names, values) => {
                let mut entries = Vec::new();
                if self.model.is_none() {
                    self.model = Some(at);
                    self.results.begin(names.to_vec(), self.rows);
                    entries.push(RowEntry::Names(names.to_vec()));
                } else if *names != *self.results.names {
                    let told = format!("it gives {} here", listed(&names));
                    return Err(Trouble::Row(at, told));
                }
                self.know(at);
                self.results.find(at, &values);
                entries.push(RowEntry::Found(number, values));
                Ok(entries)
            }
            // As long as no run has come to its end, the function may be wrong for all.
            Row::Wrong(told) if self.model.is_none() => Err(Trouble::Row(at, told)),
            Row::Failed(reason) | Row::Wrong(reason) => {
                self.know(at);
                self.results.fail(at, &reason);
                Ok(vec![RowEntry::Failed(number, reason)])
            }
        }
    }
}

fn listed(names: &[String]) -> String {
    names.join(", ")
}

impl Order<'_> {
    /// Makes all runs.
    ///
    /// # Errors
    /// When the function cannot go to other engines, is wrong, or fails in all rows; or when the run is stopped: what was finished by then is in the
    /// journal.
    pub fn make(self, call: &Call) -> Result<Swept, ScriptError> {
        let context = call.context();
        let function = RunFunction::read(call, "run", self.function)?;
        let rows = self.plan.design.rows;
        let mut ledger = Ledger::new(rows);
        let mut keeper = self.keeper(call, &function, &mut ledger)?;
        tell_known(context, &self.name, ledger.done, rows);
        context.progress().begin_cases(&self.name, rows);
        let outcome = match Blueprint::of(call.engine(), context, NO_FILES) {
            Some(blueprint) => {
                self.on_all_cores(call, &blueprint, &function, (&mut ledger, &mut keeper))
            }
            None => self.on_this_thread(call, &mut ledger, &mut keeper),
        };
        context.progress().end();
        if let Some(keeper) = &mut keeper {
            keeper.flush()?;
        }
        match outcome {
            Err(Trouble::Other(error)) => return Err(error),
            Err(Trouble::Row(row, told)) => return Err(self.blame(call, &ledger, row, &told)),
            Ok(()) if ledger.done < rows => return Err(context.why_stopped("a sweep")),
            Ok(()) => (),
        }
        let Ledger { results, model, .. } = ledger;
        if model.is_none()
            && let Some((row, reason)) = results.failures().next()
        {
            let told = format!("no run came to its end; the first one failed: {reason}");
            return Err(self
                .invoked(call, row)
                .err()
                .unwrap_or_else(|| at_key(call, "run", told, "see what the function throws")));
        }
        let sweep = Sweep { name: self.name, design: self.plan.design.clone(), results };
        Ok(Swept { sweep, plan: self.plan })
    }

    /// The journal of the sweep, where the run wants one; what it knows is in the ledger then.
    fn keeper(
        &self,
        call: &Call,
        function: &RunFunction,
        ledger: &mut Ledger,
    ) -> Result<Option<RowKeeper>, ScriptError> {
        let context = call.context();
        let path = context.output().path_of(&format!("{}.journal", self.name))?;
        let fingerprint = self.fingerprint(call, function);
        let about =
            RowEntry::Sweep { fingerprint, rows: self.plan.design.rows as u64, part: (1, 1) };
        context
            .journals()
            .open_rows(path, context.studies().journal, about, |entry| ledger.recall(entry))
    }

    /// A number made of all that the rows depend on: the program, the texts of the script and of what it imports, what the function has captured, and
    /// the parameters with their values.
    fn fingerprint(&self, call: &Call, function: &RunFunction) -> u64 {
        let mut told = format!("{:?} {:?}", function.captured, self.wall);
        for row in [0, self.plan.design.rows / 2, self.plan.design.rows - 1] {
            // Writing into a text cannot fail.
            let _ = write!(told, "{:?}", self.plan.values(row, &|_, _| None));
        }
        for of in &self.plan.design.parameters {
            let _ = write!(told, "{} ", of.name);
        }
        let script =
            call.context().program().map(|program| program.text.to_string()).unwrap_or_default();
        let imports = Sources::of(call.engine()).imprint();
        Journal::fingerprint(&[script.as_bytes(), told.as_bytes(), &imports.to_le_bytes()])
    }

    fn on_all_cores(
        &self,
        call: &Call,
        blueprint: &Blueprint,
        function: &RunFunction,
        (ledger, keeper): (&mut Ledger, &mut Option<RowKeeper>),
    ) -> Result<(), Trouble> {
        let context = call.context();
        let unknown: Vec<bool> = ledger.is_known.iter().map(|known| !known).collect();
        let numbers = (0..self.plan.design.rows).filter(|row| unknown[*row]);
        let wall = format!("{} s, which is the patience of the sweep", self.wall.as_secs_f64());
        let mut trouble = None;
        let plan = &self.plan;
        let made = on_all_engines(
            blueprint,
            self.wall,
            numbers,
            |worker, row| {
                let values =
                    plan.values(row, &|name, parameters| worker.function(name, parameters));
                make(worker, function, values, &wall)
            },
            |told| Made { row: Row::Failed(format!("withy has made a mistake: {told}")), steps: 0 },
            |news| {
                trouble = match news {
                    None => beat(keeper).err().map(Trouble::Other),
                    Some((row, Made { row: of, steps })) => {
                        context.meter().count_steps(usize::try_from(steps).unwrap_or(usize::MAX));
                        take(context, (ledger, keeper), row, of).err()
                    }
                };
                let has_steps = ledger.done == ledger.rows || context.meter().allows_a_step();
                match trouble.is_none() && has_steps && context.stopped_by().is_none() {
                    true => ControlFlow::Continue(()),
                    false => ControlFlow::Break(()),
                }
            },
        );
        match (trouble, made) {
            (Some(trouble), _) => Err(trouble),
            (None, made) => made.map_err(Trouble::Other),
        }
    }

    /// Makes the runs in the engine of the script, one by one, where there is no whole script that others could read.
    fn on_this_thread(
        &self,
        call: &Call,
        ledger: &mut Ledger,
        keeper: &mut Option<RowKeeper>,
    ) -> Result<(), Trouble> {
        let context = call.context();
        for row in 0..self.plan.design.rows {
            if ledger.is_known[row] {
                continue;
            }
            let of = match context.silently(|| self.invoked(call, row)) {
                Ok(given) => found(&given, &call.type_of(&given)),
                Err(error @ (ScriptError::Stopped(_) | ScriptError::Bug(_))) => {
                    return Err(Trouble::Other(error));
                }
                Err(ScriptError::Engine(error)) if context.is_stopped() => {
                    return Err(Trouble::Other(ScriptError::Engine(error)));
                }
                Err(ScriptError::Engine(error)) => match super::rows::thrown(&error) {
                    Some(reason) => Row::Failed(reason),
                    None => return Err(Trouble::Other(ScriptError::Engine(error))),
                },
                Err(ScriptError::Failure(failure)) => Row::Failed(failure.message),
            };
            take(context, (ledger, keeper), row, of)?;
        }
        Ok(())
    }

    /// Makes a run in the engine of the script itself, with captured values of its own.
    pub fn invoked(&self, call: &Call, row: usize) -> Result<Dynamic, ScriptError> {
        let function_of = |name: &str, parameters| call.function_named(name, parameters);
        let values = self.plan.values(row, &function_of);
        let read = RunFunction::read(call, "run", self.function)?;
        let Some(mut function) = function_of(&read.name, read.captured.len() + 1) else {
            return Err(ScriptError::bug("the function of a sweep is not found again"));
        };
        let shared = |value: Option<Dynamic>| value.unwrap_or(Dynamic::UNIT).into_shared();
        let captured: Vec<Dynamic> =
            read.captured.iter().map(|(_, value)| shared(value.value(&function_of))).collect();
        function.extend(captured.clone());
        let given = call.invoke(&function, [values.into()])?;
        let changed = read.captured.iter().zip(&captured).find(|((_, was), is)| !was.is(is));
        match changed {
            Some(((name, _), _)) => {
                let told = format!("run: {}", changes(name));
                Err(at_key(call, "run", told, "each run begins with the values from outside"))
            }
            None => Ok(given),
        }
    }

    /// The error about a row for which the function seems wrong: that of the script itself, at its place, where it is found again.
    fn blame(&self, call: &Call, ledger: &Ledger, row: usize, told: &str) -> ScriptError {
        let found = call.context().silently(|| self.invoked(call, row));
        match found {
            Err(error) => error,
            Ok(_) => {
                let values = self.row_in_words(row);
                let other = ledger.model.map_or(String::new(), |model| {
                    let names = listed(&ledger.results.names);
                    format!("; the run with {} gave {names}", self.row_in_words(model))
                });
                let told = format!("run: with {values}, {told}{other}");
                at_key(
                    call,
                    "run",
                    told,
                    "its last expression is a map of numbers, with the same names in all runs: #{ peak: peak }",
                )
            }
        }
    }

    fn row_in_words(&self, row: usize) -> String {
        let of = &self.plan.design.parameters;
        let words = of.iter().map(|of| {
            let number = || of.values.number(row).map(crate::output::format_number);
            let value = of.values.label(row).map(str::to_owned).or_else(number);
            format!("{} = {}", of.name, value.unwrap_or_default())
        });
        words.collect::<Vec<_>>().join(", ")
    }
}

fn take(
    context: &Context,
    (ledger, keeper): (&mut Ledger, &mut Option<RowKeeper>),
    row: usize,
    of: Row,
) -> Result<(), Trouble> {
    let entries = ledger.hear(row, of)?;
    context.progress().reach_case(ledger.done);
    if let Some(keeper) = keeper {
        for entry in &entries {
            let bytes = keeper.write(context.journals(), entry).map_err(Trouble::Other)?;
            context.meter().allows_to_write(bytes);
        }
    }
    Ok(())
}

fn beat(keeper: &mut Option<RowKeeper>) -> Result<(), ScriptError> {
    keeper.as_mut().map_or(Ok(()), RowKeeper::beat)
}

fn tell_known(context: &Context, name: &str, known: usize, all: usize) {
    if known > 0 {
        context.tell(&format!(
            "study '{name}' goes on: {known} of {all} rows are known from an earlier run"
        ));
    }
}
