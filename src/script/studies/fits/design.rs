//! Design optimisation: parameters that minimise or maximise a result under constraints.

use std::cell::RefCell;
use std::time::Duration;

use rhai::{Array, Dynamic, FnPtr, Map};

use super::fit::Derivatives;
use super::ranges::Ranges;
use super::scales::ResultScales;
use crate::fitting::{Design, Rating, SearchRange, SlopesOfRating};
use crate::output::{Cell, TextTable, significant};
use crate::script::bindings::call::Call;
use crate::script::bindings::parameter_variants::{RELATIVE_DISTANCE, VariantValue};
use crate::script::messages::error::{CallPart, ScriptError};
use crate::script::messages::numbers::{as_number, format_number};
use crate::script::studies::calls::evaluator::{FunctionQuery, FunctionResult};
use crate::script::studies::calls::function::RunFunction;
use crate::script::studies::plan::at_key;

const DIGITS: usize = 6;

#[derive(Clone, Debug, PartialEq)]
pub enum Objective {
    Least(String),
    Largest(String),
}

#[derive(Clone, Debug, PartialEq)]
pub struct Limit {
    pub name: String,
    pub low: Option<f64>,
    pub high: Option<f64>,
}

pub struct DesignRequest<'o> {
    pub ranges: Ranges,
    pub function: &'o FnPtr,
    pub goal: Objective,
    pub limits: Vec<Limit>,
    pub tolerance: f64,
    pub most_runs: usize,
    pub derivatives: Derivatives,
    pub wall: Duration,
}

#[derive(Clone)]
pub struct BestDesign {
    pub parameters: Vec<(String, f64)>,
    pub results: Vec<(String, f64)>,
    pub is_settled: bool,
    /// Index of an unbounded parameter that diverged because the objective decreases without limit.
    pub runaway: Option<usize>,
    pub runs: usize,
    pub derivatives: String,
}

const CONSTRAINT_HINT: &str = "return a number that must not be negative, such as #{ room: limit - sag }, and write \
    constraints: #{ room: [0, ()] }";

impl Objective {
    fn name(&self) -> &str {
        match self {
            Self::Least(name) | Self::Largest(name) => name,
        }
    }
}

impl Limit {
    pub fn read_all(call: &Call, given: &Dynamic) -> Result<Vec<Self>, ScriptError> {
        let shape = "write constraints: #{ sag: [-1e-3, 1e-3], mass: [(), 5] }: lower and upper limit, \
            () for none";
        let Some(map) = given.read_lock::<Map>() else {
            let message = format!("constraints are {}", call.describe(given));
            return Err(at_key(call, "constraints", message, shape));
        };
        let limit = |(name, value): (&rhai::Identifier, &Dynamic)| {
            let wrong = |what: String| {
                let message = format!("the constraint on '{name}' {what}");
                let hint = if value.is_bool() { CONSTRAINT_HINT } else { shape };
                at_key(call, "constraints", message, hint)
            };
            let Some(array) = value.clone().try_cast::<Array>() else {
                return Err(wrong(format!("is {}", call.describe(value))));
            };
            let end = |value: &Dynamic| match value.is_unit() {
                true => Ok(None),
                false => match as_number(value).filter(|x| x.is_finite()) {
                    Some(end) => Ok(Some(end)),
                    None => {
                        Err(wrong(format!("has {}, which is not a number", call.describe(value))))
                    }
                },
            };
            let [low, high] = array.as_slice() else {
                let count = array.len();
                let plural = if count == 1 { "" } else { "s" };
                return Err(wrong(format!("has {count} number{plural} instead of two")));
            };
            let (low, high) = (end(low)?, end(high)?);
            match (low, high) {
                (None, None) => Err(wrong("has neither a lower nor an upper limit".into())),
                (Some(low), Some(high)) if low > high => {
                    let [low, high] = [low, high].map(format_number);
                    Err(wrong(format!("has a lower limit {low} above the upper limit {high}")))
                }
                _ => Ok(Self { name: name.to_string(), low, high }),
            }
        };
        map.iter().map(limit).collect()
    }

    pub(super) fn distances(&self, value: f64) -> impl Iterator<Item = f64> {
        let low = self.low.map(|low| (value - low) / self.size());
        low.into_iter().chain(self.high.map(|high| (high - value) / self.size()))
    }

    pub(super) fn slopes(&self, slopes: &[f64]) -> impl Iterator<Item = Vec<f64>> {
        let along = |sign: f64| slopes.iter().map(|slope| sign * slope / self.size()).collect();
        let low: Option<Vec<f64>> = self.low.map(|_| along(1.0));
        low.into_iter().chain(self.high.map(|_| along(-1.0)))
    }

    fn size(&self) -> f64 {
        let size = [self.low, self.high].into_iter().flatten().map(f64::abs).fold(0.0, f64::max);
        if size > 0.0 { size } else { 1.0 }
    }

    fn describe(&self) -> String {
        let name = &self.name;
        match (self.low.map(format_number), self.high.map(format_number)) {
            (Some(low), Some(high)) => format!("{low} ≤ {name} ≤ {high}"),
            (Some(low), None) => format!("{name} ≥ {low}"),
            (None, Some(high)) => format!("{name} ≤ {high}"),
            (None, None) => name.clone(),
        }
    }
}

fn values(given: &Dynamic) -> FunctionResult {
    let Some(map) = given.read_lock::<Map>() else {
        return FunctionResult::Wrong(
            "it does not return a map of numbers, such as #{ mass: mass, sag: sag }".into(),
        );
    };
    let mut numbers = Vec::with_capacity(map.len());
    for (name, value) in map.iter() {
        match VariantValue::number(value) {
            Some(number) if number.is_finite() => numbers.push(number),
            Some(_) => return FunctionResult::Failed(format!("'{name}' is not a finite number")),
            None if value.is_bool() => {
                return FunctionResult::Wrong(format!(
                    "it returns '{name}', which is a truth value: a search needs numbers, such \
                    as the distance from a limit"
                ));
            }
            None if value.is::<Map>() => {
                return FunctionResult::Wrong(format!(
                    "it returns '{name}', which is a map: p.x is one number of the argument p"
                ));
            }
            None => {
                return FunctionResult::Wrong(format!(
                    "it returns '{name}', which is not a number"
                ));
            }
        }
    }
    FunctionResult::Numbers(numbers)
}

fn names(given: &Dynamic) -> Vec<String> {
    given
        .read_lock::<Map>()
        .map(|map| map.keys().map(ToString::to_string).collect())
        .unwrap_or_default()
}

impl DesignRequest<'_> {
    /// Finds the best design.
    pub fn run(self, call: &Call) -> Result<BestDesign, ScriptError> {
        let function = RunFunction::read(call, "run", self.function)?;
        let question = FunctionQuery {
            key: "run",
            names: &self.ranges.names,
            function: &function,
            read: values,
            wall: self.wall,
        };
        let start: Vec<f64> = self.ranges.ranges.iter().map(|range| range.first()).collect();
        let results = names(&call.context().silently(|| question.here(call, &start))?);
        let place = |name: &str| {
            results.iter().position(|known| known == name).ok_or_else(|| {
                let message = format!("the function of 'run' returns no '{name}'");
                call.error(message)
                    .hint(format!("it returns {}", results.join(", ")))
                    .at(CallPart::Key("run".into()))
            })
        };
        let goal = place(self.goal.name())?;
        let limits = self.limits.iter().map(|limit| Ok((place(&limit.name)?, limit)));
        let limits: Vec<(usize, &Limit)> = limits.collect::<Result<_, ScriptError>>()?;
        let constraints = limits.iter().map(|(_, limit)| limit.distances(0.0).count()).sum();
        let design = Design {
            ranges: self.ranges.ranges.clone(),
            constraints,
            tolerance: self.tolerance,
            most_runs: self.most_runs,
        };
        let scales = ResultScales::of(&self.goal, goal, &limits);
        let failure: RefCell<Option<String>> = RefCell::default();
        let found = question.with_evaluator(call, |evaluator| {
            let evaluator = RefCell::new(evaluator);
            let mut rate = |x: &[f64]| -> Result<Option<Rating>, ScriptError> {
                let answer = evaluator.borrow_mut().evaluate(&[x.to_vec()])?.into_iter().next();
                let numbers = match answer {
                    Some(Ok(numbers)) => numbers,
                    Some(Err(reason)) => {
                        let _ = failure.borrow_mut().get_or_insert(reason);
                        return Ok(None);
                    }
                    None => return Ok(None),
                };
                Ok((numbers.len() == results.len()).then(|| scales.rating(&numbers)))
            };
            let mut sloped = |x: &[f64]| -> Result<SlopesOfRating, ScriptError> {
                let small =
                    |(x, range): (&f64, &SearchRange)| (*x, RELATIVE_DISTANCE * range.size(*x));
                let point: Vec<(f64, f64)> = x.iter().zip(&self.ranges.ranges).map(small).collect();
                let found = evaluator.borrow_mut().slopes(&point)?;
                Ok(found.and_then(|rows| scales.with_slopes(rows, results.len())))
            };
            let found = match self.derivatives {
                Derivatives::Known => design.solve_with(&mut sloped, &mut rate)?,
                Derivatives::Unknown => design.solve(&mut rate)?,
            };
            let Some(found) = found else { return Ok(None) };
            let again = evaluator.borrow_mut().evaluate(std::slice::from_ref(&found.parameters))?;
            Ok(Some((found, again)))
        })?;
        let Some((found, again)) = found else {
            let reason = failure.into_inner().map_or_else(String::new, |of| format!(": {of}"));
            let message = format!("it fails, as at all other designs tried{reason}");
            return Err(question.located_error(call, &start, &message));
        };
        if !found.is_feasible {
            let wanted: Vec<String> = self.limits.iter().map(Limit::describe).collect();
            let message = format!(
                "none of {} runs satisfies the constraints {}",
                found.runs,
                wanted.join(", ")
            );
            let hint = "start at parameters that satisfy them, or widen the limits";
            return Err(at_key(call, "constraints", message, hint));
        }
        let numbers = again.into_iter().next().and_then(Result::ok).unwrap_or_default();
        Ok(BestDesign {
            parameters: self.ranges.names.into_iter().zip(found.parameters).collect(),
            results: results.into_iter().zip(numbers).collect(),
            is_settled: found.is_settled,
            runaway: found.runaway,
            runs: found.runs,
            derivatives: match (self.derivatives, found.derivative_free_reason, found.gradient_runs)
            {
                (Derivatives::Unknown, ..) => "none".into(),
                (_, None, _) => "those of the runs".into(),
                (_, Some(reason), 0) => format!("none: {reason}"),
                (_, Some(reason), _) => format!("those of the runs, then none: {reason}"),
            },
        })
    }
}

impl DesignRequest<'_> {
    pub fn dry_run(self, call: &Call) -> Result<BestDesign, ScriptError> {
        let function = RunFunction::read(call, "run", self.function)?;
        let start: Vec<f64> = self.ranges.ranges.iter().map(|range| range.first()).collect();
        let given = function.call_here(call, "run", self.ranges.named(&start))?;
        let results = given.read_lock::<Map>().map(|map| {
            map.iter()
                .map(|(name, value)| (name.to_string(), VariantValue::number(value).unwrap_or(0.0)))
                .collect()
        });
        let parameters = self.ranges.names.into_iter().zip(start).collect();
        Ok(BestDesign {
            parameters,
            results: results.unwrap_or_default(),
            is_settled: true,
            runaway: None,
            runs: 0,
            derivatives: "none".into(),
        })
    }
}

impl BestDesign {
    pub fn text(&self) -> String {
        let outcome = match self.runaway.map(|at| &self.parameters[at].0) {
            Some(name) => format!("no least value: '{name}' has no bound and ran off,"),
            None if self.is_settled => "settled".to_owned(),
            None => "the most runs were made".to_owned(),
        };
        let mut table = TextTable::new(&["", "value"]);
        for (name, value) in self.parameters.iter().chain(&self.results) {
            table.row([Cell::from(name.as_str()), Cell::Number(significant(*value, DIGITS))]);
        }
        format!("design: {outcome} after {} runs\n{}", self.runs, table.to_string().trim_end())
    }
}
