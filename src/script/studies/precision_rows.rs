//! Rows of a work-precision study as text, script maps and CSV.

use rhai::{Dynamic, INT, Map};

use super::labels;
use crate::analysis::{Precision, PrecisionRow, Timing};
use crate::output::{Cell, CsvRecords, TextTable, format_number};
use crate::simulation::StepSize;

pub fn table(study: &Precision) -> String {
    let mut text = format!(
        "study '{}': error at {} against run time\nreference: {}",
        study.name,
        labels::at_times(&study.times),
        study.reference.source
    );
    for rows in study.rows.chunk_by(|row, next| row.mesh == next.mesh) {
        text += &format!("\n\n{}", table_of_mesh(rows).to_string().trim_end());
    }
    let failed: Vec<_> =
        study.rows.iter().filter(|row| !row.result.outcome.is_finished()).collect();
    if !failed.is_empty() {
        text += &format!("\n\n{} of {} did not finish:", failed.len(), study.rows.len());
    }
    for row in failed {
        text += &format!("\n{}: {}", with(row), row.result.outcome.describe());
    }
    text
}

fn table_of_mesh(rows: &[PrecisionRow]) -> TextTable {
    let heads =
        ["", "integrator", "dt", "error", "run [ms]", "set-up", "steps", "iterations", "drift E"];
    let unknowns = rows.iter().map(|row| row.result.unknowns).max().unwrap_or(0);
    let mut table = TextTable::new(&heads).title(format!("{}: {unknowns} unknowns", rows[0].mesh));
    for row in rows {
        let time = |read: fn(&Timing) -> f64| {
            let time = row.timing.map(|timing| labels::milliseconds(read(&timing)));
            labels::number(time.unwrap_or_else(|| "-".to_owned()))
        };
        table.row([
            Cell::Text(if row.is_on_front { "●" } else { "" }.to_owned()),
            Cell::Text(labels::method(&row.settings.method)),
            labels::number(labels::step_size(&row.settings)),
            labels::number(labels::deviation(row.error)),
            time(Timing::cost),
            time(|of| of.setup.as_secs_f64()),
            Cell::from(row.result.steps),
            Cell::from(row.result.newton_iterations),
            labels::number(labels::drift(row.result.drifts[0])),
        ]);
    }
    table
}

fn facts(study: &Precision, row: &PrecisionRow) -> Vec<(String, Dynamic)> {
    let trial = &row.result;
    let seconds = |read: fn(&Timing) -> f64| row.timing.map_or(f64::NAN, |timing| read(&timing));
    let error = |of: Option<crate::analysis::Deviation>| of.map_or(f64::NAN, |of| of.error());
    let number = |name: &str, value: f64| (name.to_owned(), Dynamic::from(value));
    let count = |name: &str, value: usize| (name.to_owned(), Dynamic::from(value as INT));
    let text = |name: &str, value: String| (name.to_owned(), Dynamic::from(value));
    let mut facts = vec![
        text("mesh", row.mesh.clone()),
        text("integrator", labels::method(&row.settings.method)),
        match row.settings.dt {
            StepSize::Fixed(dt) => number("dt", dt),
            StepSize::Adaptive(_) => text("dt", labels::step_size(&row.settings)),
        },
        number("error", error(row.error)),
        number("run_time", seconds(Timing::cost)),
        number("clock_time", seconds(|of| of.run.as_secs_f64())),
        number("shortest", seconds(|of| of.shortest.as_secs_f64())),
        number("setup_time", seconds(|of| of.setup.as_secs_f64())),
        count("unknowns", trial.unknowns),
        count("steps", trial.steps),
        count("newton_iterations", trial.newton_iterations),
        count("factorisations", trial.factorisations),
        count("retries", trial.retries),
        number("energy_drift", trial.drifts[0]),
        number("momentum_drift", trial.drifts[1]),
        number("angular_momentum_drift", trial.drifts[2]),
        number("free_energy_drift", trial.free_energy_drift),
        ("on_front".to_owned(), row.is_on_front.into()),
        text("outcome", trial.outcome.describe()),
    ];
    let known = (0..study.observables.len()).filter(|index| study.reference.knows(*index));
    facts.extend(known.map(|index| {
        let name = format!("error of {}", study.observables[index].describe());
        number(&name, error(row.deviations.get(index).copied().flatten()))
    }));
    facts
}

pub fn map_of(study: &Precision, row: &PrecisionRow) -> Map {
    facts(study, row).into_iter().map(|(name, value)| (name.into(), value)).collect()
}

pub fn records(study: &Precision) -> CsvRecords {
    let text = |value: Dynamic| match value.as_float() {
        Ok(number) => format_number(number),
        Err(_) => value.to_string(),
    };
    let rows: Vec<_> = study.rows.iter().map(|row| facts(study, row)).collect();
    let names = rows.first().map(|row| row.iter().map(|(name, _)| name.clone()).collect());
    let comments = vec![
        format!(
            "study '{}': error at {} against run time",
            study.name,
            labels::at_times(&study.times)
        ),
        format!("reference: {}", study.reference.source),
        format!(
            "errors relative to length {}, but those of single quantities; times in seconds",
            study.length
        ),
    ];
    let texts =
        |row: Vec<(String, Dynamic)>| row.into_iter().map(|(_, value)| text(value)).collect();
    let rows = rows.into_iter().map(texts).collect();
    CsvRecords { comments, names: names.unwrap_or_default(), rows }
}

pub fn with(row: &PrecisionRow) -> String {
    let (method, dt) = (labels::method(&row.settings.method), labels::step_size(&row.settings));
    format!("{}, {method}, dt = {dt}", row.mesh)
}
