//! Evaluation of a function of parameters at several points, by worker threads or on this thread.

use std::time::Duration;

use rhai::{Array, Dynamic, Map};

use super::calling::{CallOutcome, CallWork, call, thrown};
use super::function::RunFunction;
use crate::fitting::{Evaluation, Sloped};
use crate::script::bindings::call::Call;
use crate::script::bindings::parameter_variants::{ParameterSet, VariantValue};
use crate::script::engine::workers::{EngineConfig, WorkerEvent, WorkerPool, with_worker_pool};
use crate::script::messages::error::ScriptError;
use crate::script::messages::numbers::as_number;

const NO_FILES: &str = "a run of a study cannot write files: return the data as its result";

pub enum FunctionResult {
    Numbers(Vec<f64>),
    Failed(String),
    Wrong(String),
}

pub type ResultReader = fn(&Dynamic) -> FunctionResult;

pub struct FunctionQuery<'q> {
    pub key: &'static str,
    pub names: &'q [String],
    pub function: &'q RunFunction,
    pub read: ResultReader,
    pub wall: Duration,
}

#[derive(Clone)]
enum QueryPoint {
    Value(Vec<f64>),
    Slopes(Vec<(f64, f64)>),
}

enum Executor<'w> {
    Workers(&'w WorkerPool<'w, QueryPoint, CallWork<FunctionResult>>),
    ThisThread,
}

/// Evaluates the function of a query, by worker threads if they are available (see [`EngineConfig::of`]), otherwise on this thread.
pub struct Evaluator<'w> {
    call: &'w Call<'w, 'w>,
    question: &'w FunctionQuery<'w>,
    whom: Executor<'w>,
    has_answered: bool,
}

impl FunctionQuery<'_> {
    fn values(&self, point: &QueryPoint) -> Map {
        let named = |(name, value): (&String, Dynamic)| (name.as_str().into(), value);
        match point {
            QueryPoint::Value(point) => {
                let values = point.iter().map(|x| Dynamic::from(*x));
                self.names.iter().zip(values).map(named).collect()
            }
            QueryPoint::Slopes(point) => {
                let family = ParameterSet::new();
                let values = self.names.iter().zip(point).map(|(name, (x, distance))| {
                    let varied = family.declare(name, *x, Some(*distance));
                    varied.map_or(Dynamic::from(*x), Dynamic::from)
                });
                self.names.iter().zip(values.collect::<Vec<_>>()).map(named).collect()
            }
        }
    }

    fn read(&self, point: &QueryPoint, given: &Dynamic) -> FunctionResult {
        match point {
            QueryPoint::Value(_) => (self.read)(given),
            QueryPoint::Slopes(_) => slopes_of(given, self.names.len()),
        }
    }

    pub fn with_evaluator<T>(
        &self,
        calling: &Call,
        drive: impl FnOnce(&mut Evaluator) -> Result<T, ScriptError>,
    ) -> Result<T, ScriptError> {
        let Some(config) = EngineConfig::of(calling.engine(), calling.context(), NO_FILES) else {
            return drive(&mut Evaluator::of(calling, self, Executor::ThisThread));
        };
        let wall = format!("{} s, the time limit", self.wall.as_secs_f64());
        let work = |worker: &_, point: QueryPoint| {
            call(
                worker,
                self.function,
                |_| self.values(&point),
                &wall,
                |called| self.record_result(&point, called),
            )
        };
        let panicked = |message: String| CallWork {
            result: FunctionResult::Failed(format!("internal error of withy: {message}")),
            steps: 0,
        };
        with_worker_pool(&config, self.wall, work, panicked, |pool| {
            drive(&mut Evaluator::of(calling, self, Executor::Workers(pool)))
        })?
    }

    fn record_result(&self, point: &QueryPoint, called: CallOutcome) -> FunctionResult {
        match called {
            CallOutcome::Returned(given) => self.read(point, &given),
            CallOutcome::Failed(reason) => FunctionResult::Failed(reason),
            CallOutcome::Wrong(reason) => FunctionResult::Wrong(reason),
        }
    }

    /// Value of the function at a point, in the engine of the script.
    ///
    /// # Errors
    /// Returns the error of the function with its position.
    pub fn here(&self, calling: &Call, point: &[f64]) -> Result<Dynamic, ScriptError> {
        self.call_here(calling, &QueryPoint::Value(point.to_vec()))
    }

    fn call_here(&self, calling: &Call, point: &QueryPoint) -> Result<Dynamic, ScriptError> {
        self.function.call_here(calling, self.key, self.values(point))
    }

    pub fn located_error(&self, calling: &Call, point: &[f64], reason: &str) -> ScriptError {
        let found =
            calling.context().without_output_or_files(NO_FILES, || self.here(calling, point));
        found.err().unwrap_or_else(|| {
            let pairs = self.names.iter().zip(point);
            let at: Vec<String> = pairs.map(|(name, x)| format!("{name} = {x}")).collect();
            calling
                .error(format!("{}: with {} {reason}", self.key, at.join(", ")))
                .at(crate::script::messages::error::CallPart::Key(self.key.to_owned()))
        })
    }
}

impl<'w> Evaluator<'w> {
    fn of(call: &'w Call<'w, 'w>, question: &'w FunctionQuery<'w>, whom: Executor<'w>) -> Self {
        Self { call, question, whom, has_answered: false }
    }

    /// Values of the function at several points, in order.
    ///
    /// # Errors
    /// Fails if the run is stopped, or the script is wrong before the function has ever succeeded.
    pub fn evaluate(&mut self, points: &[Vec<f64>]) -> Result<Vec<Evaluation>, ScriptError> {
        let answers =
            self.evaluate_points(points.iter().cloned().map(QueryPoint::Value).collect())?;
        let mut found = Vec::with_capacity(points.len());
        for (answer, point) in answers.into_iter().zip(points) {
            found.push(match answer {
                FunctionResult::Numbers(numbers) => {
                    self.has_answered = true;
                    Ok(numbers)
                }
                FunctionResult::Wrong(reason) if !self.has_answered => {
                    return Err(self.question.located_error(self.call, point, &reason));
                }
                FunctionResult::Failed(reason) | FunctionResult::Wrong(reason) => Err(reason),
            });
        }
        Ok(found)
    }

    /// Values and derivatives with respect to all parameters from one call with values that depend on parameters.
    /// `point` contains the value and perturbation of each parameter. The inner error is the reason why derivatives are missing.
    pub fn slopes(&mut self, point: &[(f64, f64)]) -> Result<Sloped, ScriptError> {
        let answers = match self.evaluate_points(vec![QueryPoint::Slopes(point.to_vec())]) {
            Err(error) if self.call.context().is_stopped() => return Err(error),
            Err(error) => return Ok(Err(in_words(error))),
            Ok(answers) => answers,
        };
        Ok(match answers.into_iter().next() {
            Some(FunctionResult::Numbers(numbers)) => {
                let rows = numbers.chunks(1 + point.len());
                Ok(rows.filter_map(|row| Some((*row.first()?, row[1..].to_vec()))).collect())
            }
            Some(FunctionResult::Failed(reason) | FunctionResult::Wrong(reason)) => Err(reason),
            None => Err("nothing was found".into()),
        })
    }

    fn evaluate_points(&self, points: Vec<QueryPoint>) -> Result<Vec<FunctionResult>, ScriptError> {
        match self.whom {
            Executor::Workers(pool) => self.evaluate_in_workers(pool, &points),
            Executor::ThisThread => points.iter().map(|point| self.evaluate_here(point)).collect(),
        }
    }

    fn evaluate_in_workers(
        &self,
        pool: &WorkerPool<QueryPoint, CallWork<FunctionResult>>,
        points: &[QueryPoint],
    ) -> Result<Vec<FunctionResult>, ScriptError> {
        let context = self.call.context();
        let mut answers: Vec<Option<FunctionResult>> = points.iter().map(|_| None).collect();
        points.iter().enumerate().for_each(|(number, point)| pool.submit(number, point.clone()));
        while answers.iter().any(Option::is_none) {
            match pool.receive() {
                WorkerEvent::Done(number, CallWork { result, steps }) => {
                    context.meter().count_steps(usize::try_from(steps).unwrap_or(usize::MAX));
                    context.meter().allows_a_step();
                    answers[number] = Some(result);
                }
                WorkerEvent::Timeout => (),
                WorkerEvent::NoWorkers => return Err(ScriptError::new("no worker has begun")),
            }
            context.proceed()?;
        }
        Ok(answers.into_iter().flatten().collect())
    }

    fn evaluate_here(&self, point: &QueryPoint) -> Result<FunctionResult, ScriptError> {
        let context = self.call.context();
        match context
            .without_output_or_files(NO_FILES, || self.question.call_here(self.call, point))
        {
            Ok(given) => Ok(self.question.read(point, &given)),
            Err(ScriptError::Engine(error)) if !context.is_stopped() => match thrown(&error) {
                Some(reason) => Ok(FunctionResult::Failed(reason)),
                None => Err(ScriptError::Engine(error)),
            },
            Err(error) => Err(error),
        }
    }
}

fn slopes_of(given: &Dynamic, parameters: usize) -> FunctionResult {
    let (array, map) = (given.read_lock::<Array>(), given.read_lock::<Map>());
    let values = array.iter().flat_map(|array| array.iter());
    let values: Vec<&Dynamic> = values.chain(map.iter().flat_map(|map| map.values())).collect();
    if array.is_none() && map.is_none() {
        return FunctionResult::Wrong("it returns neither an array nor a map of numbers".into());
    }
    let mut slopes = Vec::with_capacity(values.len() * (1 + parameters));
    for value in values {
        match as_number(&VariantValue::project(value, 0)).filter(|number| number.is_finite()) {
            Some(number) => slopes.push(number),
            None => {
                return FunctionResult::Wrong(
                    "it returns a value that is not a finite number".into(),
                );
            }
        }
        let Some(varied) = value.read_lock::<VariantValue>() else {
            slopes.extend(std::iter::repeat_n(0.0, parameters));
            continue;
        };
        if varied.parameter_set().branches_on_parameter() {
            return FunctionResult::Failed("a function |t| … decides by a parameter".into());
        }
        for parameter in 0..parameters {
            match varied.derivative(parameter) {
                Ok(slope) => slopes.push(as_number(&slope).unwrap_or(f64::NAN)),
                Err(error) => return FunctionResult::Failed(in_words(error)),
            }
        }
    }
    FunctionResult::Numbers(slopes)
}

fn in_words(error: ScriptError) -> String {
    match error {
        ScriptError::Failure(failure) => failure.message,
        ScriptError::Engine(error) => thrown(&error).unwrap_or_else(|| error.to_string()),
        _ => "the run was stopped".into(),
    }
}
