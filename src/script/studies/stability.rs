//! Stability maps: a run for every combination of parameters, and what became of each.

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

/// Columns of text that a map on a terminal may take.
const WIDTH: usize = 160;
/// What a cell of a script says of its run.
const RESULTS: [&str; 7] =
    ["finished", "outcome", "energy_growth", "iterations", "most_iterations", "retries", "steps"];
/// Maps beside each other on a page.
const ABREAST: usize = 2;

/// What colours the cells of a stability map.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum MapColouring {
    /// The largest relative growth of the energy colours the cells.
    EnergyGrowth,
    /// The Newton iterations of a step, on average, colour the cells.
    Iterations,
    /// The failed tries of steps colour the cells.
    Retries,
}

impl MapColouring {
    /// All that may colour the cells, by their names in scripts.
    pub const ALL: [(&'static str, Self); 3] = [
        ("energy growth", Self::EnergyGrowth),
        ("iterations", Self::Iterations),
        ("retries", Self::Retries),
    ];

    /// The number that is shown.
    fn of(self, verdict: &StabilityVerdict) -> f64 {
        match self {
            Self::EnergyGrowth => verdict.energy_growth,
            Self::Iterations => verdict.mean_iterations,
            Self::Retries => verdict.retries as f64,
        }
    }

    /// What it is called, and the powers of ten at which colours begin and end.
    fn scale(self) -> (&'static str, (i32, i32)) {
        match self {
            Self::EnergyGrowth => ("energy growth", (-12, 0)),
            Self::Iterations => ("Newton iterations a step", (0, 2)),
            Self::Retries => ("halved steps", (0, 4)),
        }
    }
}

/// The plan of a stability study: maps of rows and columns of cells.
#[derive(Clone, Debug)]
pub struct StabilityPlan {
    /// The name of the study and of its files.
    pub name: String,
    /// The swept parameter with one map for each value.
    pub maps: StudyParameter,
    /// The swept parameter of the rows of a map, from above.
    pub rows: StudyParameter,
    /// The swept parameter of the columns of a map, from the left.
    pub columns: StudyParameter,
}

/// A stability map: a plan with what became of its cells.
#[derive(Clone, Debug)]
pub struct StabilityMap {
    plan: StabilityPlan,
    shown: MapColouring,
    /// Map by map, row by row.
    verdicts: Vec<StabilityVerdict>,
}

impl StabilityPlan {
    /// Reads the options of a study.
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
                let told = format!("{key}: '{name}' is what a cell says of its run");
                let hint = format!("give it another name; cells have {}", RESULTS.join(", "));
                return Err(at_key(call, key, told, hint));
            }
            if let Some((other, _)) = axes[..at].iter().find(|(_, of)| of.name == *name) {
                let told = format!("{other} and {key} both have the name '{name}'");
                return Err(at_key(call, key, told, "a cell has one value under each name"));
            }
        }
        Ok(Self { name: study_name(call, &options.name)?, maps, rows, columns })
    }

    /// Numbers of map, row and column of all cells, in order.
    fn cells(&self) -> impl Iterator<Item = [usize; 3]> + '_ {
        let (rows, columns) = (self.rows.values.len(), self.columns.values.len());
        let all = self.maps.values.len() * rows * columns;
        (0..all).map(move |at| [at / (rows * columns), at / columns % rows, at % columns])
    }

    /// The values of a cell by their names.
    fn values(&self, [map, row, column]: [usize; 3]) -> Map {
        let mut values = Map::new();
        self.maps.put(map, &mut values);
        self.rows.put(row, &mut values);
        self.columns.put(column, &mut values);
        values
    }

    /// The parameters that have a name, and which of their values a cell has.
    fn axes(
        &self,
        [map, row, column]: [usize; 3],
    ) -> impl Iterator<Item = (&StudyParameter, usize)> {
        let all = [(&self.maps, map), (&self.rows, row), (&self.columns, column)];
        all.into_iter().filter(|(of, _)| !of.name.is_empty())
    }

    /// The labels of a cell, with their names.
    fn labels(&self, [map, row, column]: [usize; 3]) -> Vec<(&str, &str)> {
        let axes = self.axes([map, row, column]);
        axes.map(|(of, at)| (of.name.as_str(), of.labels[at].as_str())).collect()
    }

    /// The run of each cell of the plan, from what the function of the script gives for its values, or what it throws.
    ///
    /// # Errors
    /// When it gives something wrong, fails otherwise, or throws at every cell: then it is the function that is wrong.
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

    /// The stability map of the plan with the verdicts on its cells.
    pub fn judged(self, shown: MapColouring, verdicts: Vec<StabilityVerdict>) -> StabilityMap {
        StabilityMap { plan: self, shown, verdicts }
    }
}

impl StabilityMap {
    fn judged(&self) -> impl Iterator<Item = ([usize; 3], &StabilityVerdict)> {
        self.plan.cells().zip(&self.verdicts)
    }

    /// How many cells the map has, and how many came to their end.
    pub fn counts(&self) -> (usize, usize) {
        let finished = self.verdicts.iter().filter(|verdict| verdict.outcome.is_finished());
        (self.verdicts.len(), finished.count())
    }

    /// The name of the study.
    pub fn name(&self) -> &str {
        &self.plan.name
    }

    /// The cells of the map as maps of a script: the values, and what became of each.
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

    /// A map for each value of the plan's; `words` writes what is in a finished cell.
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
            CaseOutcome::GaveUp { time, .. } => early("gave up", *time),
            CaseOutcome::Panicked { .. } => HeatCell { value: None, text: "panicked".into() },
            CaseOutcome::Finished => {
                let value = Some(self.shown.of(verdict));
                HeatCell { value, text: words(self, verdict) }
            }
        }
    }

    /// The number that colours a finished cell.
    fn coloured(&self, verdict: &StabilityVerdict) -> String {
        let value = self.shown.of(verdict);
        match self.shown {
            MapColouring::EnergyGrowth => scientific(value, 1),
            MapColouring::Iterations | MapColouring::Retries => significant(value, 3),
        }
    }

    /// What is in a finished cell of a picture.
    fn in_lines(&self, verdict: &StabilityVerdict) -> String {
        let halved = match verdict.retries {
            0 => String::new(),
            retries => format!("\n{retries} halved"),
        };
        let iterations = significant(verdict.mean_iterations, 2);
        format!("{}\n{iterations} it.{halved}", self.coloured(verdict))
    }

    /// The same in a few characters, for a table.
    fn in_short(&self, verdict: &StabilityVerdict) -> String {
        let halved = match verdict.retries {
            0 => String::new(),
            retries => format!(" {retries}h"),
        };
        format!("{} {}{halved}", self.coloured(verdict), significant(verdict.mean_iterations, 2))
    }

    /// All maps of the study on one page.
    pub fn page(&self) -> Page {
        let maps = self.heat_maps(Self::in_lines);
        let page = Page::grid(ABREAST.min(maps.len()));
        // A lone map has the name of the study itself.
        let is_lone = matches!(self.plan.maps.labels.as_slice(), [label] if label.is_empty());
        let page = if is_lone { page } else { page.title(&self.plan.name) };
        maps.into_iter().fold(page, Page::panel)
    }

    /// The maps of the study as text, and why cells did not come to their end.
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
            let told = format!(
                "{missing} of {all} cells did not come to their end; all that is known of it is in {file}"
            );
            text.push_str(&format!("\n\n{told}"));
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

    /// All cells of the study as a table for other programs.
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
