//! Command `:plot`, which draws columns of the history and expressions.

use std::collections::BTreeSet;

use rhai::Map;

use super::inspection::{draw, options_of};
use crate::output::LineChart;
use crate::repl::curves::{CurveAbscissa, PlotCurve, PlotShape, parts, shape, summary};
use crate::repl::history_expression::{Followed, evaluate_history, moves};
use crate::repl::session::Reply;
use crate::repl::shell::{CommandOutcome, ReplyTarget, Shell, no_simulation};
use crate::script::diagnose::Diagnostic;
use crate::script::handles::simulation::{Revisit, SimulationHandle};
use crate::script::messages::error::ScriptError;
use crate::script::messages::nouns::with_article;
use crate::script::packages::pictures::curves::typed_charts;
use crate::script::presentation::plots;
use crate::script::source::scanner::{TokenKind, scan};
use crate::simulation::History;

const ENERGIES: [&str; 3] = ["kinetic", "strain", "energy"];

const PLOT_EXAMPLE: &str = ":plot energy, #{ y_log: true }";

enum PlotPart {
    Columns(Vec<String>),
    Expression(String),
}

pub fn plot(shell: &mut Shell, operand: &str) -> CommandOutcome {
    let (operand, options) = with_options(operand);
    let options = match options.map(|text| options_of(shell, text, PLOT_EXAMPLE)).transpose() {
        Ok(options) => options,
        Err(outcome) => return outcome,
    };
    let found: Vec<PlotPart> = parts(operand).into_iter().map(|part| read(shell, part)).collect();
    let mut columns = Vec::new();
    for part in &found {
        match part {
            PlotPart::Columns(names) => columns.extend(names.iter().cloned()),
            PlotPart::Expression(_) => return plot_curves(shell, found, options),
        }
    }
    if columns.is_empty() {
        columns = ENERGIES.map(str::to_owned).to_vec();
    }
    match options {
        Some(_) => plot_curves(shell, vec![PlotPart::Columns(columns)], options),
        None => plot_columns(shell, &columns),
    }
}

fn with_options(operand: &str) -> (&str, Option<&str>) {
    let mut depth = 0;
    for token in scan(operand) {
        match token.of(operand) {
            "#{" if depth == 0 => {
                let (curves, options) = operand.split_at(token.start);
                return (curves.trim_end().trim_end_matches(','), Some(options));
            }
            "(" | "[" | "{" | "#{" => depth += 1,
            ")" | "]" | "}" => depth -= 1,
            _ => {}
        }
    }
    (operand, None)
}

fn plot_columns(shell: &mut Shell, columns: &[String]) -> CommandOutcome {
    for name in columns.iter().filter(|name| shell.session().variables().contains(name)) {
        shell.print_note(&format!(
            "note: '{name}' is a column of the history here; write ({name}) for the variable"
        ));
    }
    let has_one_row = has_one_row(shell);
    let outcome = draw(shell, |simulation, screen| match screen {
        ReplyTarget::Terminal(_) if has_one_row && columns != ["drift"] => {
            column_summaries(simulation.history(), columns)
        }
        ReplyTarget::Terminal(style) if columns == ["drift"] => {
            Ok(plots::drift_chart(simulation.history(), &style))
        }
        ReplyTarget::Terminal(style) => plots::history_chart(simulation.history(), columns, &style),
        ReplyTarget::Pipe if columns == ["drift"] => Ok(plots::drift_summary(simulation.history())),
        ReplyTarget::Pipe => column_summaries(simulation.history(), columns),
    });
    if outcome == CommandOutcome::Success {
        print_single_state_note(shell);
    }
    outcome
}

fn has_one_row(shell: &Shell) -> bool {
    shell.latest().is_some_and(|of| of.simulation().history().samples().len() == 1)
}

fn print_single_state_note(shell: &mut Shell) {
    if has_one_row(shell) && matches!(shell.screen(), ReplyTarget::Terminal(_)) {
        shell.print_note("note: there is only one state so far; :run T or :step 10 adds more");
    }
}

fn column_summaries(history: &History, columns: &[String]) -> Result<String, ScriptError> {
    let line = |column: &String| plots::column_summary(history, column);
    Ok(columns.iter().map(line).collect::<Result<Vec<_>, _>>()?.join("\n"))
}

/// Interprets a part of the operand of `:plot` as column names if each word can be a column, otherwise as an expression.
fn read(shell: &Shell, part: &str) -> PlotPart {
    let words: Vec<String> =
        part.split_whitespace().map(|word| word.trim_matches('"').to_owned()).collect();
    let latest = shell.latest();
    let is_known = |name: &String| {
        shell.session().variables().contains(name)
            || shell.session().catalog().constants().any(|constant| constant == name.as_str())
    };
    // Without a simulation, only the standard columns of all histories are known.
    let is_column = |name: &String| match &latest {
        Some(latest) => name == "drift" || latest.simulation().history().dimension(name).is_some(),
        None => History::COLUMNS.iter().any(|column| column.name == name) && !is_known(name),
    };
    let is_word = |name: &String| {
        matches!(scan(name).as_slice(), [token] if token.kind == TokenKind::Word)
            && !is_known(name)
            && (latest.is_some() || words.len() > 1)
    };
    match words.iter().all(|word| is_column(word) || is_word(word)) {
        true => PlotPart::Columns(words),
        false => PlotPart::Expression(part.to_owned()),
    }
}

fn plot_curves(shell: &mut Shell, found: Vec<PlotPart>, options: Option<Map>) -> CommandOutcome {
    let mut curves = Vec::new();
    let mut said = BTreeSet::new();
    for part in found {
        let outcome = match part {
            PlotPart::Columns(names) => columns(shell, &names),
            PlotPart::Expression(text) => expression(shell, &text),
        };
        match outcome {
            Ok((more, words)) => {
                curves.extend(more);
                said.extend(words);
            }
            Err(outcome) => return outcome,
        }
    }
    let Some(first) = curves.first().map(|curve: &PlotCurve| curve.over) else {
        return CommandOutcome::Success;
    };
    if let Some(empty) = curves.iter().find(|curve| !curve.has_points()) {
        let message = format!("'{}' has no finite value", empty.name);
        return shell
            .report_error(&Diagnostic::general(message).with_hint("there is nothing to draw"));
    }
    if let Some(other) = curves.iter().find(|curve| curve.over != first) {
        let (one, two) = (first.in_words(), other.over.in_words());
        let message =
            format!("'{}' is plotted over {one}, but '{}' over {two}", curves[0].name, other.name);
        return shell.report_error(
            &Diagnostic::general(message).with_hint("plot them one after the other"),
        );
    }
    let is_one_state =
        |curve: &PlotCurve| curve.over == CurveAbscissa::Time && curve.points.len() == 1;
    let charts = match charts(shell, &options.unwrap_or_default(), &curves, first.label()) {
        Ok(charts) => charts,
        Err(error) => return shell.report_native_error(error),
    };
    match shell.screen() {
        ReplyTarget::Terminal(_) if curves.iter().any(is_one_state) => {
            curves.iter().for_each(|curve| shell.print(&summary(curve)));
        }
        ReplyTarget::Pipe => {
            curves.iter().for_each(|curve| shell.print(&summary(curve)));
        }
        ReplyTarget::Terminal(style) => {
            shell.print(plots::stacked_text(&charts, &style).trim_end());
        }
    }
    said.iter().for_each(|words| shell.print_note(words));
    print_single_state_note(shell);
    CommandOutcome::Success
}

fn charts(
    shell: &Shell,
    options: &Map,
    curves: &[PlotCurve],
    over: &str,
) -> Result<Vec<LineChart>, ScriptError> {
    let first = curves.iter().find_map(|curve| curve.dimension);
    let groups = plots::by_dimension(curves, |curve| curve.dimension.or(first));
    let plain = |curve: PlotCurve| (curve.name, curve.points);
    let groups = groups.into_iter().map(|group| group.into_iter().map(plain).collect());
    typed_charts(shell.session().engine(), options, over, groups.collect())
}

type PlotData = Result<(Vec<PlotCurve>, Option<String>), CommandOutcome>;

fn columns(shell: &mut Shell, names: &[String]) -> PlotData {
    let Some(latest) = shell.latest() else { return Err(shell.report_error(&no_simulation())) };
    let simulation = latest.simulation();
    let history = simulation.history();
    let mut curves = Vec::new();
    for name in names {
        let Some(values) = history.column(name) else {
            let message = format!("the history has no column {name:?}");
            let hint = plots::column_hint(history, name);
            return Err(shell.report_error(&Diagnostic::general(message).with_hint(hint)));
        };
        let times = history.samples().iter().map(|row| row.measures.time);
        let points = times.zip(values).collect();
        let (name, dimension) = (name.clone(), history.dimension(name));
        curves.push(PlotCurve { name, over: CurveAbscissa::Time, dimension, points });
    }
    Ok((curves, None))
}

fn expression(shell: &mut Shell, text: &str) -> PlotData {
    let subject = match subject(shell, text) {
        Ok(subject) => subject,
        Err(refusal) => return Err(shell.report_error(&refusal)),
    };
    let before = shell.session().simulation_positions();
    // The expression is evaluated on a copy of the simulation, because it might change the simulation.
    let present = subject.as_ref().map(Revisit::at_present).transpose();
    let present = present.map_err(|error| shell.report_native_error(error))?;
    let place = present.as_ref().map(Revisit::place);
    let reply = shell.session_mut().evaluate_preview(text);
    let has_moved = present.as_ref().map(Revisit::place) != place;
    drop(present);
    if shell.session_mut().record_movement(&before) || has_moved {
        return Err(shell.report_error(&moves(text)));
    }
    let value = match reply {
        Reply::Value(value) => value,
        Reply::Done => {
            let message = format!("'{text}' has no value");
            let hint = "write it without a semicolon, and as an expression";
            return Err(shell.report_error(&Diagnostic::general(message).with_hint(hint)));
        }
        failed => return Err(shell.print_reply(failed)),
    };
    let of = with_article(shell.session().engine().map_type_name(value.type_name()));
    let is_point = match shape(&value, &of) {
        PlotShape::Whole(over, points) => {
            let name = text.to_owned();
            return Ok((vec![PlotCurve { name, over, dimension: None, points }], None));
        }
        PlotShape::None(why) => {
            let message = format!("'{text}' cannot be plotted: {why}");
            let hint = match value.is_bool() {
                true => "write if … { 1 } else { 0 }",
                false => {
                    "plot a number or a vector over time, an array of numbers, a pair of arrays [x, y], or columns: :plot energy"
                }
            };
            return Err(shell.report_error(&Diagnostic::general(message).with_hint(hint)));
        }
        point => point,
    };
    let alone = |shell: &Shell| {
        let message = format!("'{text}' is a single number, not a curve");
        shell.report_error(&Diagnostic::general(message).with_hint(
                "give an array of numbers, or an expression with a simulation, which is plotted over time",
            ))
    };
    let Some(subject) = subject else { return Err(alone(shell)) };
    let Followed { points, text: words } = evaluate_history(shell, &subject, text)?;
    let names_simulation = mentions(shell, text).next().is_some();
    let is_flat = points.windows(2).all(|pair| pair[0].1 == pair[1].1);
    if is_flat && !names_simulation && points.len() > 1 {
        return Err(alone(shell));
    }
    let curve = |name: String, read: fn(&PlotShape) -> f64| PlotCurve {
        name,
        over: CurveAbscissa::Time,
        dimension: None,
        points: points.iter().map(|(time, point)| (*time, read(point))).collect(),
    };
    let x = |point: &PlotShape| match point {
        PlotShape::Number(value) => *value,
        PlotShape::Vector(vector) => vector.x,
        _ => f64::NAN,
    };
    let y = |point: &PlotShape| match point {
        PlotShape::Vector(vector) => vector.y,
        _ => f64::NAN,
    };
    let curves = match is_point {
        PlotShape::Vector(_) => vec![curve(format!("{text}.x"), x), curve(format!("{text}.y"), y)],
        _ => vec![curve(text.to_owned(), x)],
    };
    Ok((curves, Some(words)))
}

fn mentions<'s>(shell: &'s Shell, text: &str) -> impl Iterator<Item = SimulationHandle> + 's {
    let tokens: Vec<_> = scan(text).into_iter().filter(|token| token.is_significant()).collect();
    let mut named: Vec<SimulationHandle> = Vec::new();
    for (index, token) in
        tokens.iter().enumerate().filter(|(_, token)| token.kind == TokenKind::Word)
    {
        let is_member = index > 0 && matches!(tokens[index - 1].of(text), "." | "?." | "::");
        let name = token.of(text);
        let held = match name {
            "latest_simulation" => shell.latest(),
            _ => shell
                .session()
                .variables()
                .get(name)
                .and_then(|value| Some(value.read_lock::<SimulationHandle>()?.clone())),
        };
        if let Some(handle) = held.filter(|_| !is_member)
            && !named.iter().any(|other| other.is_same(&handle))
        {
            named.push(handle);
        }
    }
    named.into_iter()
}

fn subject(shell: &Shell, text: &str) -> Result<Option<SimulationHandle>, Diagnostic> {
    let mut named = mentions(shell, text);
    match (named.next(), named.next()) {
        (Some(one), Some(other)) => {
            let message = format!(
                "'{text}' uses two simulations, '{}' and '{}', whose states may have different times",
                one.name(),
                other.name()
            );
            Err(Diagnostic::general(message).with_hint(
                "separate them by a comma, :plot a.energy, b.energy, or subtract columns of their histories, which are arrays",
            ))
        }
        (Some(one), None) => Ok(Some(one)),
        _ => Ok(shell.latest()),
    }
}
