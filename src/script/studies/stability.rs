//! Stability maps: one run per combination of parameters, with its outcome.

use rhai::{Dynamic, INT, Map};

use super::cell::{case, thrown};
use super::labels;
use super::options::StabilityOptions;
use super::parameters::StudyParameter;
use super::plan::{at_key, study_name};
use crate::analysis::{Case, CaseOutcome, StabilityVerdict};
use crate::output::{
    Colours, CsvRecords, Glyphs, HeatCell, HeatMap, Page, TerminalStyle, TextTable, format_number,
    scientific, significant,
};
use crate::script::bindings::call::Call;
use crate::script::messages::error::ScriptError;

const WIDTH: usize = 160;
const RESULTS: [&str; 7] =
    ["finished", "outcome", "energy_growth", "iterations", "most_iterations", "retries", "steps"];
const COLUMNS: usize = 2;

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum MapColouring {
    EnergyGrowth,
    Iterations,
    Retries,
}

impl MapColouring {
    pub const ALL: [(&'static str, Self); 3] = [
        ("energy growth", Self::EnergyGrowth),
        ("iterations", Self::Iterations),
        ("retries", Self::Retries),
    ];

    fn of(self, verdict: &StabilityVerdict) -> f64 {
        match self {
            Self::EnergyGrowth => verdict.energy_growth,
            Self::Iterations => verdict.mean_iterations,
            Self::Retries => verdict.retries as f64,
        }
    }

    fn scale(self) -> (&'static str, (i32, i32)) {
        match self {
            Self::EnergyGrowth => ("energy growth", (-12, 0)),
            Self::Iterations => ("Newton iterations a step", (0, 2)),
            Self::Retries => ("halved steps", (0, 4)),
        }
    }
}

#[derive(Clone, Debug)]
pub struct StabilityPlan {
    pub name: String,
    pub maps: StudyParameter,
    pub rows: StudyParameter,
    pub columns: StudyParameter,
}

#[derive(Clone, Debug)]
pub struct StabilityMap {
    plan: StabilityPlan,
    shown: MapColouring,
    verdicts: Vec<StabilityVerdict>,
}

impl StabilityPlan {
    pub fn read(call: &Call, options: &StabilityOptions) -> Result<Self, ScriptError> {
        let maps = match &options.maps {
            Some(maps) => StudyParameter::read(call, "maps", maps)?,
            None => StudyParameter::none(),
        };
        let rows = StudyParameter::read(call, "rows", &options.rows)?;
        let columns = StudyParameter::read(call, "columns", &options.columns)?;
        let axes = [("maps", &maps), ("rows", &rows), ("columns", &columns)];
        for (at, (key, axis)) in axes.iter().enumerate() {
            let name = &axis.name;
            if RESULTS.contains(&name.as_str()) {
                let message = format!("{key}: the name '{name}' is used for results of a cell");
                let hint =
                    format!("choose another name; results have the names {}", RESULTS.join(", "));
                return Err(at_key(call, key, message, hint));
            }
            if let Some((other, _)) = axes[..at].iter().find(|(_, of)| of.name == *name) {
                let message = format!("{other} and {key} both have the name '{name}'");
                return Err(at_key(call, key, message, "a cell has one value under each name"));
            }
        }
        Ok(Self { name: study_name(call, &options.name)?, maps, rows, columns })
    }

    fn cells(&self) -> impl Iterator<Item = [usize; 3]> + '_ {
        let (rows, columns) = (self.rows.values.len(), self.columns.values.len());
        let all = self.maps.values.len() * rows * columns;
        (0..all).map(move |at| [at / (rows * columns), at / columns % rows, at % columns])
    }

    fn values(&self, [map, row, column]: [usize; 3]) -> Map {
        let mut values = Map::new();
        self.maps.put(map, &mut values);
        self.rows.put(row, &mut values);
        self.columns.put(column, &mut values);
        values
    }

    fn axes(
        &self,
        [map, row, column]: [usize; 3],
    ) -> impl Iterator<Item = (&StudyParameter, usize)> {
        let all = [(&self.maps, map), (&self.rows, row), (&self.columns, column)];
        all.into_iter().filter(|(of, _)| !of.name.is_empty())
    }

    fn labels(&self, [map, row, column]: [usize; 3]) -> Vec<(&str, &str)> {
        let axes = self.axes([map, row, column]);
        axes.map(|(of, at)| (of.name.as_str(), of.labels[at].as_str())).collect()
    }

    /// Case of each cell, or the message of the value that the script function threw for it.
    pub fn cases(
        &self,
        call: &Call,
        options: &StabilityOptions,
    ) -> Result<Vec<Result<Case, String>>, ScriptError> {
        let mut first = None;
        let mut made = Vec::new();
        for at in self.cells() {
            let values = self.values(at);
            made.push(match call.invoke(&options.scene, [Dynamic::from(values.clone())]) {
                Ok(given) => Ok(case(call, options, &values, given)?),
                Err(ScriptError::Engine(error)) => match thrown(call, &error) {
                    Some(reason) => {
                        first.get_or_insert(error);
                        Err(reason)
                    }
                    None => return Err(ScriptError::Engine(error)),
                },
                Err(error) => return Err(error),
            });
        }
        match first {
            Some(error) if made.iter().all(Result::is_err) => Err(ScriptError::Engine(error)),
            _ => Ok(made),
        }
    }

    pub fn judged(self, shown: MapColouring, verdicts: Vec<StabilityVerdict>) -> StabilityMap {
        StabilityMap { plan: self, shown, verdicts }
    }
}

impl StabilityMap {
    fn judged(&self) -> impl Iterator<Item = ([usize; 3], &StabilityVerdict)> {
        self.plan.cells().zip(&self.verdicts)
    }

    pub fn counts(&self) -> (usize, usize) {
        let finished = self.verdicts.iter().filter(|verdict| verdict.outcome.is_finished());
        (self.verdicts.len(), finished.count())
    }

    pub fn name(&self) -> &str {
        &self.plan.name
    }

    pub fn cells(&self) -> Vec<Map> {
        let cell = |(at, verdict): ([usize; 3], &StabilityVerdict)| {
            let mut cell = self.plan.values(at);
            let whole = |count: usize| Dynamic::from(count as INT);
            let results: [Dynamic; RESULTS.len()] = [
                verdict.outcome.is_finished().into(),
                verdict.outcome.describe().into(),
                verdict.energy_growth.into(),
                verdict.mean_iterations.into(),
                whole(verdict.most_iterations),
                whole(verdict.retries),
                whole(verdict.steps),
            ];
            cell.extend(RESULTS.map(Into::into).into_iter().zip(results));
            cell
        };
        self.judged().map(cell).collect()
    }

    fn heat_maps(&self, words: fn(&Self, &StabilityVerdict) -> String) -> Vec<HeatMap> {
        let StabilityPlan { name, maps, rows, columns } = &self.plan;
        let per_map = rows.values.len() * columns.values.len();
        let (shows, powers) = self.shown.scale();
        let one = |(map, verdicts): (usize, &[StabilityVerdict])| {
            let title = match maps.labels[map].as_str() {
                "" => name.clone(),
                label => label.to_owned(),
            };
            let empty = HeatMap::new(title, shows, powers)
                .columns(&columns.name, columns.labels.clone())
                .rows(&rows.name)
                .hatched("did not finish");
            let rows = rows.labels.iter().zip(verdicts.chunks(columns.values.len()));
            rows.fold(empty, |map, (label, row)| {
                map.row(label, row.iter().map(|verdict| self.heat_cell(verdict, words)).collect())
            })
        };
        self.verdicts.chunks(per_map).enumerate().map(one).collect()
    }

    fn heat_cell(
        &self,
        verdict: &StabilityVerdict,
        words: fn(&Self, &StabilityVerdict) -> String,
    ) -> HeatCell {
        let early = |what: &str, time: f64| HeatCell {
            value: None,
            text: format!("{what}\nt = {}", significant(time, 3)),
        };
        match &verdict.outcome {
            CaseOutcome::Failed { time, .. } => early("failed", *time),
            CaseOutcome::LimitExceeded { time, .. } => early("gave up", *time),
            CaseOutcome::Panicked { .. } => HeatCell { value: None, text: "panicked".into() },
            CaseOutcome::Finished => {
                let value = Some(self.shown.of(verdict));
                HeatCell { value, text: words(self, verdict) }
            }
        }
    }

    fn coloured(&self, verdict: &StabilityVerdict) -> String {
        let value = self.shown.of(verdict);
        match self.shown {
            MapColouring::EnergyGrowth => scientific(value, 1),
            MapColouring::Iterations | MapColouring::Retries => significant(value, 3),
        }
    }

    fn in_lines(&self, verdict: &StabilityVerdict) -> String {
        let halved = match verdict.retries {
            0 => String::new(),
            retries => format!("\n{retries} halved"),
        };
        let iterations = significant(verdict.mean_iterations, 2);
        format!("{}\n{iterations} it.{halved}", self.coloured(verdict))
    }

    fn in_short(&self, verdict: &StabilityVerdict) -> String {
        let halved = match verdict.retries {
            0 => String::new(),
            retries => format!(" {retries}h"),
        };
        format!("{} {}{halved}", self.coloured(verdict), significant(verdict.mean_iterations, 2))
    }

    pub fn page(&self) -> Page {
        let maps = self.heat_maps(Self::in_lines);
        let page = Page::grid(COLUMNS.min(maps.len()));
        let is_lone = matches!(self.plan.maps.labels.as_slice(), [label] if label.is_empty());
        let page = if is_lone { page } else { page.title(&self.plan.name) };
        maps.into_iter().fold(page, Page::panel)
    }

    pub fn text(&self) -> String {
        let style = TerminalStyle {
            glyphs: Glyphs::Braille,
            colours: Colours::None,
            width: WIDTH,
            height: 1,
        };
        let maps =
            self.heat_maps(Self::in_short).iter().map(|map| map.text(&style)).collect::<Vec<_>>();
        let early: Vec<_> =
            self.judged().filter(|(_, verdict)| !verdict.outcome.is_finished()).collect();
        let (all, missing) = (self.verdicts.len(), early.len());
        let mut text = maps.join("\n\n");
        let (shows, _) = self.shown.scale();
        text.push_str(&format!("\nin a cell: {shows}, Newton iterations a step, halved steps (h)"));
        if missing > 0 {
            let file = format!("{}.csv", self.plan.name);
            let message = format!("{missing} of {all} cells did not finish; details are in {file}");
            text.push_str(&format!("\n\n{message}"));
            let mut table = TextTable::new(&["cell", "what happened"]);
            for (at, verdict) in early {
                let labels = self.plan.labels(at);
                let labels = labels.iter().map(|(name, label)| format!("{name} {label}"));
                let cell = labels.collect::<Vec<_>>().join(", ");
                table.row([cell, labels::first_sentence(&verdict.outcome.describe())]);
            }
            text.push_str(&format!("\n{}", table.to_string().trim_end()));
        }
        text
    }

    pub fn records(&self) -> CsvRecords {
        let numbers = ["energy growth", "mean iterations", "most iterations", "retries", "steps"];
        let first = self.plan.labels([0; 3]);
        let own = first.iter().map(|(name, _)| (*name).to_owned());
        let names = own.chain(["outcome".to_owned()]).chain(numbers.map(str::to_owned));
        let row = |(at, verdict): ([usize; 3], &StabilityVerdict)| {
            let own = self.plan.axes(at).map(|(of, at)| of.exact(at));
            let found = [
                verdict.outcome.describe(),
                format_number(verdict.energy_growth),
                format_number(verdict.mean_iterations),
                verdict.most_iterations.to_string(),
                verdict.retries.to_string(),
                verdict.steps.to_string(),
            ];
            own.chain(found).collect()
        };
        CsvRecords {
            comments: vec![format!("stability study: {}", self.plan.name)],
            names: names.collect(),
            rows: self.judged().map(row).collect(),
        }
    }
}
