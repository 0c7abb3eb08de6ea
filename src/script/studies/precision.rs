//! Error against run time: the study made, its table, its file and its picture.

use rhai::{Dynamic, INT, Map};

use super::desk::{Desk, Task};
use super::labels;
use super::plan::{Plan, at_key};
use super::reference::{Reference, read_sheet};
use crate::analysis::{
    Case, Outcome, Precision, PrecisionRow, Rival, Timing, Trial, Truth, all_combinations, machines,
};
use crate::output::{
    Cell, CsvRecords, Ink, LineChart, Marker, Scale, Series, Stroke, Table, format_number,
    scientific,
};
use crate::script::call::Call;
use crate::script::context::Mode;
use crate::script::error::ScriptError;
use crate::script::options::Options;
use crate::simulation::StepSize;

/// Makes the study that the options ask for; in a dry build nothing runs.
pub fn study(call: &Call, options: &Options) -> Result<Precision, ScriptError> {
    let mut plan = Plan::read(call, options)?;
    let reference = Reference::read(call, options, &mut plan)?;
    let rivals = match options.text("rivals") {
        Ok(file) => Some((read_sheet(call, "rivals", &file)?, file)),
        Err(_) => None,
    };
    let compared = |truth: &Truth| {
        let Some((sheet, file)) = &rivals else { return Ok(Vec::new()) };
        let by = (plan.times.as_slice(), plan.length);
        Rival::of_sheet(sheet, plan.observables(), truth, by).map_err(|error| {
            let hint = "rivals are compared at one time, at stations named as in the reference";
            at_key(call, "rivals", format!("\"{file}\": {error}"), hint)
        })
    };
    // Wrong rivals are told of before anything runs.
    compared(&reference.foreseen(call, &plan)?)?;
    let mut desk = Desk::open(call.context(), &plan.name)?;
    let combinations = all_combinations(&plan.subjects, &plan.all_settings());
    let cases: Vec<Case> =
        combinations.iter().map(|of| of.case(&plan.subjects, &plan.times)).collect();
    let repeats = call.context().studies().repeats.unwrap_or(options.count("repeats")?);
    let (trials, timings, truth) = match call.context().mode() {
        Mode::DryBuild => {
            let reason = "a check runs nothing".to_owned();
            let trial = Trial::without_a_run(Outcome::Failed { time: 0.0, reason });
            (vec![trial; cases.len()], vec![None; cases.len()], Truth::of_run("none", &Vec::new()))
        }
        Mode::Run => {
            let (trials, truth) = reference.trials(call, &mut desk, &plan, &cases)?;
            let timings = timings(&mut desk, &plan, (&cases, &trials), repeats)?;
            (trials, timings, truth)
        }
    };
    let rivals = match call.context().mode() {
        Mode::Run => compared(&truth)?,
        Mode::DryBuild => Vec::new(),
    };
    let judge = (plan.observables(), &truth, plan.length);
    let found = combinations.iter().zip(trials).zip(timings);
    let rows = found.map(|((of, trial), timing)| {
        let mesh = plan.subjects[of.subject].mesh.clone();
        PrecisionRow::new((mesh, of.settings), trial, timing, judge)
    });
    let mut study = Precision {
        rows: rows.collect(),
        name: plan.name.clone(),
        times: plan.times.clone(),
        length: plan.length,
        observables: plan.observables().to_vec(),
        truth,
        rivals,
    };
    study.mark_front();
    write(call, &study)?;
    desk.close()?;
    Ok(study)
}

/// The run times of those that came to their end.
fn timings(
    desk: &mut Desk,
    plan: &Plan,
    (cases, trials): (&[Case], &[Trial]),
    repeats: usize,
) -> Result<Vec<Option<Timing>>, ScriptError> {
    let is_finished = |trial: &Trial| trial.outcome.is_finished();
    let both = cases.iter().zip(trials).filter(|(_, trial)| is_finished(trial));
    let finished: Vec<Case> = both.map(|(case, _)| case.clone()).collect();
    let task = Task { name: "run times", parts: &repeats.to_le_bytes() };
    let timed = desk.one_by_one(task, &finished, |case, may_go_on| {
        Timing::of(case, plan.patience, repeats, may_go_on)
    })?;
    let mut timed = timed.into_iter();
    let of = |trial: &Trial| if is_finished(trial) { timed.next().flatten() } else { None };
    Ok(trials.iter().map(of).collect())
}

/// Table and picture in the output folder.
fn write(call: &Call, study: &Precision) -> Result<(), ScriptError> {
    let output = call.context().output();
    output.write(&format!("{}.csv", study.name), records(study).to_text()?.as_bytes())?;
    let picture = crate::output::Panel::figure(&chart(study))?.to_svg()?;
    output.write(&format!("{}.svg", study.name), picture.as_bytes())?;
    Ok(())
}

/// The times in words: `t = 2.5, 7.5`.
pub fn at_times(times: &[f64]) -> String {
    let times: Vec<String> = times.iter().map(|time| format_number(*time)).collect();
    format!("t = {}", times.join(", "))
}

/// All combinations, a table for each mesh, those on the front marked; below, why some failed.
pub fn table(study: &Precision) -> String {
    let mut text = format!(
        "study '{}': error at {} against run time\nreference: {}",
        study.name,
        at_times(&study.times),
        study.truth.source
    );
    for rows in study.rows.chunk_by(|row, next| row.mesh == next.mesh) {
        text += &format!("\n\n{}", table_of_mesh(rows).to_string().trim_end());
    }
    let failed: Vec<_> = study.rows.iter().filter(|row| !row.trial.outcome.is_finished()).collect();
    if !failed.is_empty() {
        text += &format!("\n\n{} of {} did not finish:", failed.len(), study.rows.len());
    }
    for row in failed {
        text += &format!("\n{}: {}", with(row), row.trial.outcome.describe());
    }
    text
}

fn table_of_mesh(rows: &[PrecisionRow]) -> Table {
    let heads =
        ["", "integrator", "dt", "error", "run [ms]", "set-up", "steps", "iterations", "drift E"];
    let unknowns = rows.iter().map(|row| row.trial.unknowns).max().unwrap_or(0);
    let mut table = Table::new(&heads).title(format!("{}: {unknowns} unknowns", rows[0].mesh));
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
            time(Timing::price),
            time(|of| of.setup.as_secs_f64()),
            Cell::from(row.trial.steps),
            Cell::from(row.trial.newton_iterations),
            labels::number(labels::drift(row.trial.drifts[0])),
        ]);
    }
    table
}

/// What is known of a row: names and values.
fn facts(study: &Precision, row: &PrecisionRow) -> Vec<(String, Dynamic)> {
    let trial = &row.trial;
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
        number("run_time", seconds(Timing::price)),
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
    let known = (0..study.observables.len()).filter(|index| study.truth.knows(*index));
    facts.extend(known.map(|index| {
        let name = format!("error of {}", study.observables[index].describe());
        number(&name, error(row.deviations.get(index).copied().flatten()))
    }));
    facts
}

/// A row as a map of a script.
pub fn map_of(study: &Precision, row: &PrecisionRow) -> Map {
    facts(study, row).into_iter().map(|(name, value)| (name.into(), value)).collect()
}

/// All rows for other programs.
fn records(study: &Precision) -> CsvRecords {
    let text = |value: Dynamic| match value.as_float() {
        Ok(number) => format_number(number),
        Err(_) => value.to_string(),
    };
    let rows: Vec<_> = study.rows.iter().map(|row| facts(study, row)).collect();
    let names = rows.first().map(|row| row.iter().map(|(name, _)| name.clone()).collect());
    let comments = vec![
        format!("study '{}': error at {} against run time", study.name, at_times(&study.times)),
        format!("reference: {}", study.truth.source),
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

/// The fastest of ours and of every rival for each of some errors.
pub fn comparison(study: &Precision, errors: &[f64]) -> String {
    let heads = [
        "error ≤",
        "ours [ms]",
        "error",
        "drift E",
        "with",
        "rival",
        "[ms]",
        "error",
        "drift E",
        "with",
        "times slower",
    ];
    let mut table = Table::new(if study.rivals.is_empty() { &heads[..5] } else { &heads });
    let none = || labels::number("-".to_owned());
    let number = |text: String| labels::number(text);
    let pairs = errors
        .iter()
        .flat_map(|error| able_peers(study, *error).into_iter().map(move |of| (error, of)));
    for (error, peer) in pairs {
        let ours = study.cheapest(*error);
        let rival = peer.and_then(|peer| study.cheapest_of(peer, *error));
        let mut cells = vec![number(format_number(*error))];
        cells.extend(match ours {
            Some(row) => [
                number(labels::milliseconds(row.price_and_error().0)),
                number(labels::deviation(row.error)),
                number(labels::drift(row.trial.free_energy_drift)),
                Cell::Text(with(row)),
            ],
            None => [none(), none(), none(), Cell::Text("no combination".to_owned())],
        });
        if let Some(peer) = peer {
            cells.push(Cell::Text(peer.to_owned()));
            cells.extend(match rival {
                Some(rival) => [
                    number(labels::milliseconds(rival.run_time)),
                    number(scientific(rival.error, 2)),
                    number(labels::drift(rival.energy_drift)),
                    Cell::Text(format!("{}, {}", rival.series, rival.setting)),
                ],
                None => [none(), none(), none(), Cell::Text("no run".to_owned())],
            });
            let ratio =
                ours.zip(rival).map(|(row, rival)| rival.run_time / row.price_and_error().0);
            cells.push(ratio.map_or_else(none, |ratio| number(format!("{ratio:.1}"))));
        }
        table.row(cells);
    }
    let machines = machines(&study.rivals);
    let measured = match machines.as_slice() {
        [] => String::new(),
        machines => format!("\nrivals measured on {}", machines.join("; ")),
    };
    format!("{}{measured}", table.to_string().trim_end())
}

/// The programs of rivals that have a run with at most this error, the first of all when none has; nobody without rivals.
fn able_peers(study: &Precision, error: f64) -> Vec<Option<&str>> {
    let peers = study.peers();
    let able = peers.iter().copied().filter(|peer| study.cheapest_of(peer, error).is_some());
    match able.map(Some).collect::<Vec<_>>() {
        able if able.is_empty() => vec![peers.first().copied()],
        able => able,
    }
}

/// How a row was computed.
fn with(row: &PrecisionRow) -> String {
    let (method, dt) = (labels::method(&row.settings.method), labels::step_size(&row.settings));
    format!("{}, {method}, dt = {dt}", row.mesh)
}

/// Error over run time, one colour for an integrator or a rival, the front of ours drawn through.
pub fn chart(study: &Precision) -> LineChart {
    let mut chart = LineChart::new(format!(
        "{}: error at {} against run time",
        study.name,
        at_times(&study.times)
    ))
    .caption(format!("reference: {}", study.truth.source))
    .x_label("run time [s], set-up apart")
    .y_label("error / length")
    .x_scale(Scale::Logarithmic)
    .y_scale(Scale::Logarithmic)
    .sized(900.0, 640.0);
    for machine in machines(&study.rivals) {
        chart = chart.caption(format!("rivals measured on {machine}"));
    }
    let finite = |(price, error): &(f64, f64)| price.is_finite() && error.is_finite();
    let mut methods: Vec<String> = Vec::new();
    for row in &study.rows {
        let name = labels::method(&row.settings.method);
        if !methods.contains(&name) {
            methods.push(name);
        }
    }
    for (number, name) in methods.iter().enumerate() {
        let own = study.rows.iter().filter(|row| labels::method(&row.settings.method) == *name);
        let look =
            |series: Series| series.ink(Ink::OfSeries(number)).marker(Marker::of_index(number));
        let mut of_mesh: Vec<(&str, Vec<(f64, f64)>)> = Vec::new();
        for row in own.clone() {
            match of_mesh.last_mut() {
                Some((mesh, points)) if *mesh == row.mesh => points.push(row.price_and_error()),
                _ => of_mesh.push((&row.mesh, vec![row.price_and_error()])),
            }
        }
        for (_, points) in of_mesh {
            let points = points.into_iter().filter(finite).collect();
            chart = chart.series(look(Series::new("", points)).stroke(Stroke::Marked).faint());
        }
        let best = own.filter(|row| row.is_on_front).map(PrecisionRow::price_and_error);
        chart = chart.series(look(Series::new(name, best.collect())).stroke(Stroke::Unjoined));
    }
    let mut series: Vec<&str> = Vec::new();
    for rival in &study.rivals {
        if !series.contains(&rival.series.as_str()) {
            series.push(&rival.series);
        }
    }
    for (number, name) in series.into_iter().enumerate() {
        let own: Vec<_> = study.rivals.iter().filter(|rival| rival.series == name).collect();
        let points: Vec<(f64, f64)> =
            own.iter().map(|rival| (rival.run_time, rival.error)).collect();
        let is_best = crate::analysis::pareto_front(&points);
        let number = methods.len() + number;
        let look = |points: Vec<(f64, f64)>, name: &str| {
            Series::new(name, points).ink(Ink::OfSeries(number)).marker(Marker::of_index(number))
        };
        let mut best: Vec<(f64, f64)> =
            points.iter().zip(is_best).filter(|(_, is_best)| *is_best).map(|(at, _)| *at).collect();
        best.sort_by(|a, b| a.0.total_cmp(&b.0));
        chart = chart
            .series(look(points, "").stroke(Stroke::Unjoined).faint())
            .series(look(best.clone(), name).stroke(Stroke::Unjoined))
            .series(look(best, "").stroke(Stroke::Dashed).thin());
    }
    let front = study.front().into_iter().map(PrecisionRow::price_and_error).collect();
    chart.series(Series::new("our front", front).ink(Ink::Black).stroke(Stroke::Solid).thin())
}
