//! Cost studies: run time of a scene with features that are added one at a time.

use rhai::{Dynamic, FnPtr, Map};

use super::labels;
use super::options::CostOptions;
use crate::analysis::{Case, CostCase, FEATURES, StepCost};
use crate::integrators::{INTEGRATORS, Method};
use crate::newton::Tolerance;
use crate::output::{BarChart, Cell, CsvRecords, TextTable, format_number, significant};
use crate::script::bindings::call::Call;
use crate::script::handles::scene::SceneHandle;
use crate::script::messages::error::{CallPart, ScriptError};
use crate::simulation::{Recording, SimulationSettings};
use crate::system::Scene;

/// Memory for snapshots [bytes] in the row that measures the cost of snapshots.
const SNAPSHOTS: usize = 256_000_000;

const PLAIN: [&str; 2] = ["the scene alone", "the same again"];

const TRUSTED_RATIO: f64 = 1.1;

/// Settings of all cases of a cost study. The cases that compare other integrators have another `method`.
#[derive(Clone, Copy)]
pub struct CostStepping {
    pub method: Method,
    /// Step size [time].
    pub dt: f64,
    pub steps: usize,
}

#[derive(Clone)]
pub struct CostTable {
    name: String,
    costs: Vec<StepCost>,
}

impl CostStepping {
    fn case(&self, name: impl Into<String>, scene: Scene) -> CostCase {
        let settings = SimulationSettings {
            method: self.method,
            dt: self.dt.into(),
            tolerance: Tolerance::default(),
        };
        let case = Case { scene, settings, stops: vec![self.dt * self.steps as f64] };
        CostCase { name: name.into(), case, recording: Recording::default(), snapshots: 0 }
    }
}

pub fn cases(
    call: &Call,
    options: &CostOptions,
    stepping: CostStepping,
) -> Result<Vec<CostCase>, ScriptError> {
    let make = &options.scene;
    call.expect_arguments(make, 0, "|| …, a function that makes the scene")?;
    let handle = || {
        let given = call.invoke(make, [])?;
        given.clone().try_cast::<SceneHandle>().ok_or_else(|| {
            let got = call.describe(&given);
            call.error(format!("the function returns {got} instead of a scene"))
                .hint("its last expression must be the scene")
                .at(CallPart::Key("scene".into()))
        })
    };
    let fresh = || {
        let handle = handle()?;
        handle.expect_no_callbacks()?;
        Ok::<_, ScriptError>(handle.scene().borrow().clone())
    };
    let mut cases = Vec::new();
    for name in PLAIN {
        cases.push(stepping.case(name, fresh()?));
    }
    match &options.features {
        Some(features) => {
            let features: Map = features.clone().try_cast().ok_or_else(|| {
                call.error("features must be a map of names and functions")
                    .hint("for example #{ gravity: |scene| scene.gravity([0, -9.81]) }")
                    .at(CallPart::Key("features".into()))
            })?;
            for (name, add) in features {
                let handle = handle()?;
                let add: FnPtr = add.try_cast().ok_or_else(|| {
                    call.error(format!("the feature '{name}' is not a function"))
                        .hint("write |scene| …, a function that adds it")
                        .at(CallPart::Key("features".into()))
                })?;
                call.expect_arguments(&add, 1, "|scene| …, a function that adds the feature")?;
                let _ = call.invoke(&add, [Dynamic::from(handle.clone())])?;
                let scene = handle.scene().borrow().clone();
                cases.push(stepping.case(name.as_str(), scene));
            }
        }
        None => {
            let has_beams = !cases[0].case.scene.beams.is_empty();
            for feature in FEATURES.iter().filter(|_| has_beams) {
                let mut scene = fresh()?;
                // A feature that is impossible in the scene, such as a second hinge at the same station, gives no row.
                if (feature.add)(&mut scene).is_ok() {
                    cases.push(stepping.case(feature.name, scene));
                }
            }
        }
    }
    let quiet = stepping.case("nothing recorded", fresh()?);
    cases.push(CostCase { recording: Recording::Nothing, ..quiet });
    cases.push(CostCase { snapshots: SNAPSHOTS, ..stepping.case("snapshots", fresh()?) });
    for entry in INTEGRATORS.iter().filter(|entry| entry.method != stepping.method) {
        cases.push(
            CostStepping { method: entry.method, ..stepping }
                .case(labels::method(&entry.method), fresh()?),
        );
    }
    Ok(cases)
}

impl CostTable {
    pub fn new(name: String, costs: Vec<StepCost>) -> Self {
        Self { name, costs }
    }

    pub fn name(&self) -> &str {
        &self.name
    }

    fn ratio(&self, cost: &StepCost) -> f64 {
        let alone = self.costs.first().map_or(f64::NAN, |first| first.shortest.as_secs_f64());
        cost.shortest.as_secs_f64() / alone
    }

    pub fn rows(&self) -> Vec<Map> {
        let row = |cost: &StepCost| {
            let whole = |count: usize| Dynamic::from(count as rhai::INT);
            let entries: [(&str, Dynamic); 11] = [
                ("feature", cost.name.clone().into()),
                ("outcome", cost.outcome.describe().into()),
                ("shortest", cost.shortest.as_secs_f64().into()),
                ("median", cost.median.as_secs_f64().into()),
                ("ratio", self.ratio(cost).into()),
                ("iterations", cost.iterations.into()),
                ("factorisations", cost.factorisations.into()),
                ("unknowns", whole(cost.unknowns)),
                ("half_bandwidth", whole(cost.half_bandwidth)),
                ("border", whole(cost.border)),
                ("columns", whole(cost.columns)),
            ];
            entries.map(|(name, value)| (name.into(), value)).into_iter().collect()
        };
        self.costs.iter().map(row).collect()
    }

    pub fn text(&self) -> String {
        let heads = [
            "feature",
            "µs a step",
            "median",
            "ratio",
            "iterations",
            "unknowns",
            "band",
            "border",
            "columns",
        ];
        let mut table = TextTable::new(&heads).title(format!("{}: cost of a step", self.name));
        for cost in &self.costs {
            if !cost.outcome.is_finished() {
                table.row([Cell::Text(cost.name.clone()), Cell::Number("-".to_owned())]);
                continue;
            }
            let number = |value: f64, digits| Cell::Number(significant(value, digits));
            table.row([
                Cell::Text(cost.name.clone()),
                number(cost.shortest.as_secs_f64() * 1e6, 3),
                number(cost.median.as_secs_f64() * 1e6, 3),
                Cell::Number(format!("{:.2}", self.ratio(cost))),
                number(cost.iterations, 3),
                cost.unknowns.into(),
                cost.half_bandwidth.into(),
                cost.border.into(),
                cost.columns.into(),
            ]);
        }
        let table = table.to_string();
        [Some(table.trim_end().to_owned()), self.failures(), self.warning()]
            .into_iter()
            .flatten()
            .collect::<Vec<_>>()
            .join("\n")
    }

    fn failures(&self) -> Option<String> {
        let failed: Vec<&StepCost> =
            self.costs.iter().filter(|cost| !cost.outcome.is_finished()).collect();
        let lines =
            failed.iter().map(|cost| format!("\n{}: {}", cost.name, cost.outcome.describe()));
        let lines: String = lines.collect();
        let (some, all) = (failed.len(), self.costs.len());
        (some > 0).then(|| format!("\n{some} of {all} did not finish:{lines}"))
    }

    fn warning(&self) -> Option<String> {
        let ratio = self.ratio(self.costs.get(1).filter(|cost| cost.name == PLAIN[1])?);
        (!(1.0 / TRUSTED_RATIO..=TRUSTED_RATIO).contains(&ratio)).then(|| {
            format!(
                "warning: {} took {ratio:.2} times as long, so ratios are not more accurate \
                than this. Repeat on an idle machine, or with more steps or repeats",
                PLAIN[1]
            )
        })
    }

    pub fn records(&self) -> CsvRecords {
        let rows = self.rows();
        let names = [
            "feature",
            "outcome",
            "shortest",
            "median",
            "ratio",
            "iterations",
            "factorisations",
            "unknowns",
            "half_bandwidth",
            "border",
            "columns",
        ];
        let cell = |row: &Map, name: &str| {
            let value = row.get(name).cloned().unwrap_or_default();
            value.as_float().map_or_else(|_| value.to_string(), format_number)
        };
        CsvRecords {
            comments: vec![format!("cost study: {}; times of a step in seconds", self.name)],
            names: names.map(str::to_owned).to_vec(),
            rows: rows.iter().map(|row| names.map(|name| cell(row, name)).to_vec()).collect(),
        }
    }

    pub fn chart(&self) -> BarChart {
        let micro = |cost: &StepCost| cost.shortest.as_secs_f64() * 1e6;
        let empty =
            BarChart::new(format!("{}: cost of a step", self.name), "µs a step, least of all runs");
        let marked = match self.costs.first() {
            Some(alone) => empty.mark(micro(alone)),
            None => empty,
        };
        self.costs.iter().fold(marked, |chart, cost| match cost.outcome.is_finished() {
            true => {
                let ratio =
                    format!("{} µs, × {:.2}", significant(micro(cost), 3), self.ratio(cost));
                chart.bar(&cost.name, micro(cost), ratio)
            }
            false => chart.bar(&cost.name, f64::NAN, "did not finish"),
        })
    }
}

#[cfg(test)]
mod tests {
    use std::time::Duration;

    use super::*;
    use crate::analysis::CaseOutcome;

    fn table(times: [u64; 2]) -> CostTable {
        let cost = |(name, micros): (&str, u64)| StepCost {
            name: name.to_owned(),
            outcome: CaseOutcome::Finished,
            unknowns: 9,
            half_bandwidth: 8,
            border: 0,
            columns: 9,
            iterations: 2.0,
            factorisations: 2.0,
            shortest: Duration::from_micros(micros),
            median: Duration::from_micros(micros),
        };
        let costs = PLAIN.into_iter().zip(times).map(cost).collect();
        CostTable::new("cost".to_owned(), costs)
    }

    #[test]
    fn failure_reasons_are_listed_below_the_cost_table() {
        let mut costs = table([100, 100]).costs;
        let reason =
            "a reason that is a good deal longer than any column of the table is wide".to_owned();
        let outcome = CaseOutcome::Failed { time: 0.5, reason: reason.clone() };
        costs.push(StepCost { name: "slider".into(), outcome, ..costs[0].clone() });
        let text = CostTable::new("cost".to_owned(), costs).text();
        let (rows, below) = text.split_once("\n\n1 of 3 did not finish:\n").unwrap();
        assert!(rows.lines().all(|line| line.chars().count() < 100), "{rows}");
        assert_eq!(below, format!("slider: failed at t = 0.5: {reason}"));
    }

    #[test]
    fn irreproducible_times_cause_a_warning() {
        assert!(!table([100, 109]).text().contains("warning"));
        assert!(table([100, 120]).text().contains("warning: the same again took 1.20 times"));
        assert!(table([100, 80]).text().contains("warning: the same again took 0.80 times"));
    }
}
