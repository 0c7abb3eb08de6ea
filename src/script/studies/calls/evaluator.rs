//! A function of parameters, asked at several points at once: by workers where there is a whole script for them, else on this thread.

use std::time::Duration;

use rhai::{Dynamic, Map};

use super::calling::{Called, Made, call, thrown};
use super::function::RunFunction;
use crate::fitting::Evaluation;
use crate::script::engine::workers::{Blueprint, Crew, News, with_crew};
use crate::script::rows::call::Call;
use crate::script::words::error::ScriptError;

/// Why a function of a study writes no files.
const NO_FILES: &str = "a run of a study writes no files: give what is to be kept as its result";

/// What a function gave at a point.
pub enum Answer {
    /// It gave numbers.
    Numbers(Vec<f64>),
    /// It failed: the reason.
    Failed(String),
    /// The script itself is wrong, as it seems: the reason.
    Wrong(String),
}

/// How what a function gives is read.
pub type Read = fn(&Dynamic) -> Answer;

/// A function of parameters.
pub struct Question<'q> {
    /// The key of the option under which the function is given.
    pub key: &'static str,
    /// The names of its parameters.
    pub names: &'q [String],
    /// The function.
    pub function: &'q RunFunction,
    /// How what it gives is read.
    pub read: Read,
    /// The longest that a call may take by the clock.
    pub wall: Duration,
}

/// Who answers.
enum Whom<'w> {
    Workers(&'w Crew<'w, Vec<f64>, Made<Answer>>),
    ThisThread,
}

/// A function that can be asked.
pub struct Evaluator<'w> {
    call: &'w Call<'w, 'w>,
    question: &'w Question<'w>,
    whom: Whom<'w>,
    has_answered: bool,
}

impl Question<'_> {
    fn values(&self, point: &[f64]) -> Map {
        let pairs = self.names.iter().zip(point);
        pairs.map(|(name, x)| (name.as_str().into(), Dynamic::from(*x))).collect()
    }

    /// Lets `drive` ask the function.
    ///
    /// # Errors
    /// When there is no worker; also those of `drive`.
    pub fn with_evaluator<T>(
        &self,
        calling: &Call,
        drive: impl FnOnce(&mut Evaluator) -> Result<T, ScriptError>,
    ) -> Result<T, ScriptError> {
        let Some(blueprint) = Blueprint::of(calling.engine(), calling.context(), NO_FILES) else {
            return drive(&mut Evaluator::of(calling, self, Whom::ThisThread));
        };
        let wall = format!("{} s, which is its patience", self.wall.as_secs_f64());
        let work = |worker: &_, point: Vec<f64>| {
            call(
                worker,
                self.function,
                |_| self.values(&point),
                &wall,
                |called| self.answer(called),
            )
        };
        let panicked = |told: String| Made {
            result: Answer::Failed(format!("withy has made a mistake: {told}")),
            steps: 0,
        };
        with_crew(&blueprint, self.wall, work, panicked, |crew| {
            drive(&mut Evaluator::of(calling, self, Whom::Workers(crew)))
        })?
    }

    fn answer(&self, called: Called) -> Answer {
        match called {
            Called::Given(given) => (self.read)(&given),
            Called::Failed(reason) => Answer::Failed(reason),
            Called::Wrong(reason) => Answer::Wrong(reason),
        }
    }

    /// The function's value at a point, in the engine of the script itself.
    ///
    /// # Errors
    /// The function's own, at their places.
    pub fn here(&self, calling: &Call, point: &[f64]) -> Result<Dynamic, ScriptError> {
        self.function.call_here(calling, self.key, self.values(point))
    }

    /// The error of a function that fails at a point where it must not: that of the script itself, at its place, where it is found again.
    pub fn blame(&self, calling: &Call, point: &[f64], reason: &str) -> ScriptError {
        let found = calling.context().tracelessly(NO_FILES, || self.here(calling, point));
        found.err().unwrap_or_else(|| {
            let pairs = self.names.iter().zip(point);
            let at: Vec<String> = pairs.map(|(name, x)| format!("{name} = {x}")).collect();
            calling
                .error(format!("{}: with {} {reason}", self.key, at.join(", ")))
                .at(crate::script::words::error::Place::Key(self.key.to_owned()))
        })
    }
}

impl<'w> Evaluator<'w> {
    fn of(call: &'w Call<'w, 'w>, question: &'w Question<'w>, whom: Whom<'w>) -> Self {
        Self { call, question, whom, has_answered: false }
    }

    /// What the function gives at some points, in their order.
    ///
    /// # Errors
    /// When the run is stopped, or the script is wrong as long as the function has given nothing.
    pub fn ask(&mut self, points: &[Vec<f64>]) -> Result<Vec<Evaluation>, ScriptError> {
        let answers = match self.whom {
            Whom::Workers(crew) => self.ask_workers(crew, points)?,
            Whom::ThisThread => {
                points.iter().map(|point| self.ask_here(point)).collect::<Result<_, _>>()?
            }
        };
        let mut found = Vec::with_capacity(points.len());
        for (answer, point) in answers.into_iter().zip(points) {
            found.push(match answer {
                Answer::Numbers(numbers) => {
                    self.has_answered = true;
                    Ok(numbers)
                }
                Answer::Wrong(reason) if !self.has_answered => {
                    return Err(self.question.blame(self.call, point, &reason));
                }
                Answer::Failed(reason) | Answer::Wrong(reason) => Err(reason),
            });
        }
        Ok(found)
    }

    fn ask_workers(
        &self,
        crew: &Crew<Vec<f64>, Made<Answer>>,
        points: &[Vec<f64>],
    ) -> Result<Vec<Answer>, ScriptError> {
        let context = self.call.context();
        let mut answers: Vec<Option<Answer>> = points.iter().map(|_| None).collect();
        points.iter().enumerate().for_each(|(number, point)| crew.give(number, point.clone()));
        while answers.iter().any(Option::is_none) {
            match crew.hear() {
                News::Done(number, Made { result, steps }) => {
                    context.meter().count_steps(usize::try_from(steps).unwrap_or(usize::MAX));
                    context.meter().allows_a_step();
                    answers[number] = Some(result);
                }
                News::Nothing => (),
                News::Nobody => return Err(ScriptError::new("no worker has begun")),
            }
            context.proceed()?;
        }
        Ok(answers.into_iter().flatten().collect())
    }

    fn ask_here(&self, point: &[f64]) -> Result<Answer, ScriptError> {
        let context = self.call.context();
        match context.tracelessly(NO_FILES, || self.question.here(self.call, point)) {
            Ok(given) => Ok((self.question.read)(&given)),
            Err(ScriptError::Engine(error)) if !context.is_stopped() => match thrown(&error) {
                Some(reason) => Ok(Answer::Failed(reason)),
                None => Err(ScriptError::Engine(error)),
            },
            Err(error) => Err(error),
        }
    }
}
