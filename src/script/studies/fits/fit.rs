//! Parameter fits: least squares between a script function and data.

use std::cell::{OnceCell, RefCell};
use std::time::Duration;

use rhai::{Array, Dynamic, FnPtr};

use super::ranges::Ranges;
use crate::fitting::{Estimate, Fitted, LeastSquares, SearchRange, Sloped, TerminationReason};
use crate::output::{Cell, LineChart, Marker, Page, Panel, Series, Stroke, TextTable, significant};
use crate::script::bindings::call::Call;
use crate::script::bindings::parameter_variants::{RELATIVE_DISTANCE, VariantValue};
use crate::script::messages::error::ScriptError;
use crate::script::studies::calls::evaluator::{FunctionQuery, FunctionResult};
use crate::script::studies::calls::function::RunFunction;
use crate::script::studies::plan::at_key;

const DIGITS: usize = 7;
const ERROR_DIGITS: usize = 2;

#[derive(Clone, Debug, PartialEq)]
pub enum Compared {
    Residuals,
    Model { measured: Vec<f64>, over: Option<Vec<f64>> },
}

pub struct FitRequest<'o> {
    pub name: String,
    pub ranges: Ranges,
    pub key: &'static str,
    pub function: &'o FnPtr,
    /// Second argument of the fitted function, after the map of parameters; `None` if it has one argument.
    pub data: Option<Dynamic>,
    pub compared: Compared,
    /// Weights of the squares; `None` if all weights are one.
    pub weights: Option<Vec<f64>>,
    pub confidence: f64,
    /// Perturbation for finite differences, relative to the size of a parameter.
    pub step: f64,
    pub derivatives: Derivatives,
    pub wall: Duration,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Derivatives {
    /// Derivatives from the runs, or finite differences for runs without derivatives.
    Known,
    /// Derivatives of the runs are not used: finite differences, or a search without derivatives.
    Unknown,
}

#[derive(Clone)]
pub struct Fit {
    pub name: String,
    pub names: Vec<String>,
    pub fitted: Fitted,
    pub residuals: Vec<f64>,
    pub compared: Compared,
    pub confidence: f64,
}

impl Derivatives {
    pub fn of(word: &str) -> Self {
        if word == "differences" { Self::Unknown } else { Self::Known }
    }
}

impl FitRequest<'_> {
    /// Finds the parameters.
    pub fn run(self, call: &Call) -> Result<Fit, ScriptError> {
        let mut function = RunFunction::read(call, self.key, self.function)?;
        if let Some(data) = &self.data {
            function.with_extra_argument(call, "data", data)?;
        }
        let question = FunctionQuery {
            key: self.key,
            names: &self.ranges.names,
            function: &function,
            read: numbers,
            wall: self.wall,
        };
        let problem = LeastSquares {
            relative_step: self.step,
            ..LeastSquares::new(self.ranges.ranges.clone())
        };
        let roots: Option<Vec<f64>> = self
            .weights
            .as_ref()
            .map(|weights| weights.iter().map(|weight| weight.sqrt()).collect());
        let counted = OnceCell::new();
        let fitted = question.with_evaluator(call, |evaluator| {
            let evaluator = RefCell::new(evaluator);
            let mut evaluate = |points: &[Vec<f64>]| {
                let found = evaluator.borrow_mut().evaluate(points)?;
                for (numbers, point) in found.iter().zip(points) {
                    if let Ok(numbers) = numbers {
                        self.expect_as_many(call, &counted, (numbers.len(), point))?;
                    }
                }
                let of = |found: Result<Vec<f64>, String>| -> Result<Vec<f64>, String> {
                    Ok(weighted(roots.as_deref(), self.differences(found?)?))
                };
                Ok(found.into_iter().map(of).collect())
            };
            let mut slopes = |x: &[f64]| {
                let small =
                    |(x, range): (&f64, &SearchRange)| (*x, RELATIVE_DISTANCE * range.size(*x));
                let point: Vec<(f64, f64)> = x.iter().zip(&self.ranges.ranges).map(small).collect();
                let found = evaluator.borrow_mut().slopes(&point)?;
                if let Ok(rows) = &found {
                    self.expect_as_many(call, &counted, (rows.len(), x))?;
                }
                Ok(found.and_then(|rows| self.differences_with(rows, roots.as_deref())))
            };
            match self.derivatives {
                Derivatives::Known => problem.solve_with(&mut evaluate, &mut slopes),
                Derivatives::Unknown => problem.solve(&mut evaluate),
            }
        })?;
        let start: Vec<f64> = self.ranges.ranges.iter().map(|range| range.first()).collect();
        let fitted = fitted.map_err(|reason| question.located_error(call, &start, &reason))?;
        let residuals = match &roots {
            None => fitted.residuals.clone(),
            Some(roots) => fitted.residuals.iter().zip(roots).map(|(r, root)| r / root).collect(),
        };
        let Self { name, ranges: Ranges { names, .. }, compared, confidence, .. } = self;
        Ok(Fit { name, names, fitted, residuals, compared, confidence })
    }

    fn expect_as_many(
        &self,
        call: &Call,
        counted: &OnceCell<usize>,
        (count, point): (usize, &[f64]),
    ) -> Result<(), ScriptError> {
        let before = *counted.get_or_init(|| count);
        if count == before {
            return Ok(());
        }
        let pairs = self.ranges.names.iter().zip(point);
        let at: Vec<String> =
            pairs.map(|(name, x)| format!("{name} = {}", significant(*x, 6))).collect();
        let message = format!(
            "{}: with {} it returns {count} numbers, but at the start it returned {before}",
            self.key,
            at.join(", ")
        );
        let hint = "it must return the same number of values for all parameters: one for each measured \
            value";
        Err(at_key(call, self.key, message, hint))
    }

    pub fn dry_run(self, call: &Call) -> Result<Fit, ScriptError> {
        let mut function = RunFunction::read(call, self.key, self.function)?;
        if let Some(data) = &self.data {
            function.with_extra_argument(call, "data", data)?;
        }
        let start: Vec<f64> = self.ranges.ranges.iter().map(|range| range.first()).collect();
        let _ = function.call_here(call, self.key, self.ranges.named(&start))?;
        let residuals = match &self.compared {
            Compared::Model { measured, .. } => vec![0.0; measured.len()],
            Compared::Residuals => Vec::new(),
        };
        let free = vec![true; start.len()];
        let rows = nalgebra::DMatrix::identity(start.len() + 1, start.len());
        let fitted = Fitted {
            parameters: start,
            residuals: residuals.clone(),
            estimate: Estimate::of(&rows, 0.0, &free),
            settling: TerminationReason::Settled,
            runs: 0,
            gradient_runs: 0,
            differences: None,
            steps: 0,
        };
        let Self { name, ranges: Ranges { names, .. }, compared, confidence, .. } = self;
        Ok(Fit { name, names, fitted, residuals, compared, confidence })
    }

    fn differences_with(&self, rows: Vec<(f64, Vec<f64>)>, roots: Option<&[f64]>) -> Sloped {
        let (values, mut slopes): (Vec<f64>, Vec<Vec<f64>>) = rows.into_iter().unzip();
        let residuals = weighted(roots, self.differences(values)?);
        for (row, root) in slopes.iter_mut().zip(roots.into_iter().flatten()) {
            row.iter_mut().for_each(|slope| *slope *= root);
        }
        Ok(residuals.into_iter().zip(slopes).collect())
    }

    fn differences(&self, found: Vec<f64>) -> Result<Vec<f64>, String> {
        let expected = match &self.compared {
            Compared::Model { measured, .. } => Some(measured.len()),
            Compared::Residuals => self.weights.as_ref().map(Vec::len),
        };
        match (expected, &self.compared) {
            (Some(count), _) if count != found.len() => {
                Err(format!("it returns {} numbers, but {count} are measured", found.len()))
            }
            (_, Compared::Model { measured, .. }) => {
                Ok(found.iter().zip(measured).map(|(found, measured)| found - measured).collect())
            }
            (_, Compared::Residuals) => Ok(found),
        }
    }
}

fn weighted(roots: Option<&[f64]>, residuals: Vec<f64>) -> Vec<f64> {
    match roots {
        None => residuals,
        Some(roots) => residuals.iter().zip(roots).map(|(r, root)| r * root).collect(),
    }
}

fn numbers(given: &Dynamic) -> FunctionResult {
    let Some(array) = given.read_lock::<Array>() else {
        return FunctionResult::Wrong("it does not return an array of numbers".into());
    };
    let mut numbers = Vec::with_capacity(array.len());
    for (at, value) in array.iter().enumerate() {
        match VariantValue::number(value) {
            Some(number) if number.is_finite() => numbers.push(number),
            Some(_) => {
                return FunctionResult::Failed(format!("number {at} of its result is not finite"));
            }
            None => {
                return FunctionResult::Wrong(format!("its result at index {at} is not a number"));
            }
        }
    }
    match numbers.is_empty() {
        true => FunctionResult::Wrong("it returns an empty array".into()),
        false => FunctionResult::Numbers(numbers),
    }
}

impl Fit {
    /// Half width of the confidence interval of a parameter; `None` if unknown.
    pub fn half_width(&self, parameter: usize) -> Option<f64> {
        let estimate = self.fitted.estimate.as_ref()?;
        estimate.half_width(parameter, self.confidence)
    }

    pub fn outcome(&self) -> &'static str {
        match self.fitted.settling {
            TerminationReason::Settled => "settled",
            TerminationReason::Stalled => {
                "no step improves the fit, although the derivatives predict it"
            }
            TerminationReason::Unfinished => "not settled after the most steps",
        }
    }

    pub fn derivatives(&self) -> String {
        match (&self.fitted.differences, self.fitted.gradient_runs) {
            (None, _) => "those of the runs".into(),
            (Some(reason), 0) => format!("central differences: {reason}"),
            (Some(reason), _) => format!("those of the runs, then central differences: {reason}"),
        }
    }

    pub fn text(&self) -> String {
        let Fitted { parameters, estimate, runs, .. } = &self.fitted;
        let interval_heading = format!("± at {} %", significant(100.0 * self.confidence, 3));
        let mut table =
            TextTable::new(&["parameter", "value", "standard error", &interval_heading]);
        for (at, name) in self.names.iter().enumerate() {
            let error = |x: Option<f64>| {
                Cell::Number(x.map_or("-".to_owned(), |x| significant(x, ERROR_DIGITS)))
            };
            table.row([
                Cell::from(name.as_str()),
                Cell::Number(significant(parameters[at], DIGITS)),
                error(estimate.as_ref().and_then(|of| of.error(at))),
                error(self.half_width(at)),
            ]);
        }
        let scatter = estimate.as_ref().map_or(String::new(), |of| {
            let deviation = significant(of.deviation, 3);
            format!(", standard deviation of residuals {deviation}")
        });
        let count = self.residuals.len();
        let unknown = |of: &Estimate| {
            let names = self.names.iter().enumerate();
            let without = names.filter(|(at, _)| of.error(*at).is_none());
            without.map(|(_, name)| format!("\nno residual depends on '{name}'")).collect()
        };
        let without: String = estimate.as_ref().map(unknown).unwrap_or_default();
        format!(
            "fit '{}': {} after {runs} runs, {count} residuals{scatter}{without}\n{}",
            self.name,
            self.outcome(),
            table.to_string().trim_end()
        )
    }

    pub fn page(&self) -> Page {
        let count = self.residuals.len();
        let places: Vec<f64> = match &self.compared {
            Compared::Model { over: Some(over), .. } => over.clone(),
            _ => (0..count).map(|at| at as f64).collect(),
        };
        let over = |values: &[f64]| places.iter().copied().zip(values.iter().copied()).collect();
        let residuals = LineChart::new("").y_label("residual").series(
            Series::new("", over(&self.residuals))
                .stroke(Stroke::MarkersOnly)
                .marker(Marker::Ring)
                .thin(),
        );
        let page = Page::grid(1).title(&self.name);
        match &self.compared {
            Compared::Residuals => page.panel(residuals),
            Compared::Model { measured, .. } => {
                let fitted: Vec<f64> =
                    measured.iter().zip(&self.residuals).map(|(m, r)| m + r).collect();
                let chart = LineChart::new("").series(Series::new("fitted", over(&fitted))).series(
                    Series::new("measured", over(measured))
                        .stroke(Stroke::MarkersOnly)
                        .marker(Marker::Ring)
                        .thin(),
                );
                page.panel(chart).panel(residuals)
            }
        }
    }

    pub fn picture(&self) -> Result<String, ScriptError> {
        Ok(self.page().figure()?.to_svg()?)
    }
}
