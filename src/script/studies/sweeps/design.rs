//! Design of a sweep, read from its options.

use rhai::{Array, Dynamic, FnPtr, Map};

use crate::analysis::{Choice, RowLayout, SweepDesign, SweptParameter, SweptValues};
use crate::output::format_number;
use crate::sampling::{Distribution, MOST_DIMENSIONS, latin_hypercube, saltelli, sobol};
use crate::script::bindings::accept::readable;
use crate::script::bindings::call::Call;
use crate::script::messages::error::{CallPart, ScriptError};
use crate::script::messages::numbers::as_number;
use crate::script::studies::calls::portable::Portable;
use crate::script::studies::parameters::label;
use crate::script::studies::plan::at_key;

const MOST_ROWS: usize = 100_000_000;

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Samples {
    pub kind: SampleKind,
    pub count: usize,
    pub seed: u64,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum SampleKind {
    LatinHypercube,
    Sobol,
    Saltelli,
}

impl Samples {
    fn rows(self, parameters: usize) -> usize {
        match self.kind {
            SampleKind::Saltelli => self.count.saturating_mul(parameters + 2),
            _ => self.count,
        }
    }
}

struct ParameterInput {
    name: String,
    spread: Spread,
}

enum Spread {
    Levels(Vec<Portable>, Vec<String>),
    Distribution(Distribution),
}

pub struct SweepPlan {
    pub design: SweepDesign,
    /// Level values of each parameter; empty if each row has a separate value.
    levels: Vec<Vec<Portable>>,
    spread_by_ratios: Vec<String>,
}

impl SweepPlan {
    pub fn read(
        call: &Call,
        parameters: &Map,
        samples: Option<Samples>,
    ) -> Result<Self, ScriptError> {
        let wrong = |message: String, hint: &str| at_key(call, "parameters", message, hint);
        if parameters.is_empty() {
            return Err(wrong("there are no parameters".into(), EXAMPLE));
        }
        let given: Vec<ParameterInput> = parameters
            .iter()
            .map(|(name, value)| given(call, name, value))
            .collect::<Result<_, _>>()?;
        let rows = match samples {
            Some(samples) => samples.rows(given.len()),
            None => {
                let spread = given.iter().find(|of| matches!(of.spread, Spread::Distribution(_)));
                if let Some(ParameterInput { name, .. }) = spread {
                    let message = format!("'{name}' is a distribution, but samples are not given");
                    return Err(wrong(
                        message,
                        "add samples: latin_hypercube(1000), or give an array of values",
                    ));
                }
                let lengths = given.iter().map(|of| of.levels().len());
                lengths.fold(1, usize::saturating_mul)
            }
        };
        if rows > MOST_ROWS {
            let message = format!("the sweep has {rows} rows; the limit is {MOST_ROWS}");
            return Err(wrong(
                message,
                "use fewer values, or sampled points: samples: sobol(100000)",
            ));
        }
        if let Some(Samples { kind, .. }) = samples {
            let dimensions =
                if kind == SampleKind::Saltelli { 2 * given.len() } else { given.len() };
            if kind != SampleKind::LatinHypercube && dimensions > MOST_DIMENSIONS {
                let message = format!(
                    "a Sobol' sequence for {} parameters has {dimensions} coordinates; the \
                    limit is {MOST_DIMENSIONS}",
                    given.len()
                );
                return Err(at_key(call, "samples", message, "use latin_hypercube(…)"));
            }
        }
        let columns = samples.map(|Samples { kind, count, seed }| match kind {
            SampleKind::LatinHypercube => latin_hypercube(count, given.len(), seed),
            SampleKind::Sobol => sobol(count, given.len(), seed),
            SampleKind::Saltelli => saltelli(count, given.len(), seed),
        });
        let arrangement = match samples {
            None => RowLayout::Grid,
            Some(Samples { kind: SampleKind::Saltelli, .. }) => RowLayout::Saltelli,
            Some(_) => RowLayout::Points,
        };
        let by_ratios = given.iter().filter(|of| of.is_spread_by_ratios());
        let spread_by_ratios = by_ratios.map(|of| of.name.clone()).collect();
        let mut columns = columns.map(Vec::into_iter);
        let (mut repeats, mut swept, mut levels) = (rows, Vec::new(), Vec::new());
        for of in given {
            let points = columns.as_mut().and_then(Iterator::next);
            let (values, of_levels) = of.spread.values(points, &mut repeats);
            swept.push(SweptParameter { name: of.name, values });
            levels.push(of_levels);
        }
        let design = SweepDesign { parameters: swept, rows, arrangement };
        Ok(Self { design, levels, spread_by_ratios })
    }

    pub fn checksum_data(&self) -> Vec<u8> {
        let of = |(of, levels): (&SweptParameter, &Vec<Portable>)| {
            let mut hasher = crc32fast::Hasher::new();
            for row in 0..self.design.rows {
                let place = of.values.level(row).map_or(0, |level| level as u64);
                let number = of.values.number(row).map_or(place, f64::to_bits);
                hasher.update(&number.to_le_bytes());
            }
            format!("{} {levels:?} {}", of.name, hasher.finalize()).into_bytes()
        };
        let rows = self.design.rows.to_le_bytes().to_vec();
        let all = self.design.parameters.iter().zip(&self.levels).flat_map(of);
        rows.into_iter().chain(all).collect()
    }

    pub fn is_spread_by_ratios(&self, name: &str) -> bool {
        self.spread_by_ratios.iter().any(|of| of == name)
    }

    pub fn values(&self, row: usize, function_of: &dyn Fn(&str, usize) -> Option<FnPtr>) -> Map {
        let value = |(of, levels): (&SweptParameter, &Vec<Portable>)| {
            let level =
                of.values.level(row).and_then(|level| levels.get(level)?.value(function_of));
            let value = level.or_else(|| of.values.number(row).map(Dynamic::from));
            (of.name.as_str().into(), value.unwrap_or(Dynamic::UNIT))
        };
        self.design.parameters.iter().zip(&self.levels).map(value).collect()
    }
}

const EXAMPLE: &str = "for example parameters: #{ speed: linspace(0.1, 2, 20), mass: [1, 2] }";

fn given(call: &Call, name: &str, value: &Dynamic) -> Result<ParameterInput, ScriptError> {
    let at = |error: ScriptError| error.at(CallPart::Key(name.to_owned()));
    let name = readable("parameters", name).map_err(at)?;
    if let Some(distribution) = value.read_lock::<Distribution>() {
        return Ok(ParameterInput { name, spread: Spread::Distribution(distribution.clone()) });
    }
    let wrong = |message: String| {
        call.error(message)
            .hint("give an array of values, such as linspace(0.1, 2, 20), or a distribution, such as uniform(0.1, 2)")
            .at(CallPart::Key(name.clone()))
    };
    let Some(array) = value.read_lock::<Array>() else {
        return Err(wrong(format!("the values of '{name}' are {}", call.describe(value))));
    };
    if array.is_empty() {
        return Err(wrong(format!("'{name}' has no values")));
    }
    let parameters_of = |function: &FnPtr| call.definition(function).map(|of| of.params.len());
    let portable = |value: &Dynamic| {
        Portable::of(call.engine(), value, &parameters_of).map_err(|_| {
            wrong(format!(
                "'{name}' has the value {}, which cannot be copied to other threads",
                call.describe(value)
            ))
        })
    };
    let labels = array
        .iter()
        .map(|value| as_number(value).map_or_else(|| label(call, value), format_number));
    let labels: Vec<String> = labels.collect();
    if let Some(again) = (1..labels.len()).find(|at| labels[..*at].contains(&labels[*at])) {
        return Err(wrong(format!("'{name}' has the value {} twice", labels[again])));
    }
    let levels = array.iter().map(portable).collect::<Result<_, _>>()?;
    Ok(ParameterInput { name, spread: Spread::Levels(levels, labels) })
}

impl ParameterInput {
    fn is_spread_by_ratios(&self) -> bool {
        matches!(&self.spread, Spread::Distribution(of) if of.is_of_logarithms())
    }

    fn levels(&self) -> &[Portable] {
        match &self.spread {
            Spread::Levels(levels, _) => levels,
            Spread::Distribution(_) => &[],
        }
    }
}

impl Spread {
    /// Values of a parameter at sample points or on a grid.
    /// On a grid, `repeats` is the number of consecutive rows in which all earlier parameters are constant.
    fn values(self, points: Option<Vec<f64>>, repeats: &mut usize) -> (SweptValues, Vec<Portable>) {
        match self {
            Self::Distribution(distribution) => {
                let points = points.unwrap_or_default();
                let numbers = points.into_iter().map(|point| distribution.quantile(point));
                (SweptValues::Numbers(numbers.collect()), Vec::new())
            }
            Self::Levels(levels, labels) => {
                let numbers = levels.iter().map(Portable::number).collect();
                let count = levels.len();
                let choice = match points {
                    None => {
                        *repeats /= count;
                        Choice::Grid(*repeats)
                    }
                    Some(points) => {
                        let level = |point: f64| ((point * count as f64) as usize).min(count - 1);
                        Choice::Drawn(points.into_iter().map(|point| level(point) as u32).collect())
                    }
                };
                (SweptValues::Levels { labels, numbers, choice }, levels)
            }
        }
    }
}
