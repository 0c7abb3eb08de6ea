//! Commands that inspect the session without changing it.

use rhai::{Dynamic, Map};

use crate::output::{Cell, Colours, Glyphs, TerminalStyle, TextTable, columns, cut, scientific};
use crate::repl::session::Reply;
use crate::repl::shell::{CommandOutcome, ReplyTarget, Shell, no_simulation};
use crate::script::diagnose::Diagnostic;
use crate::script::handles::simulation::SimulationHandle;
use crate::script::messages::error::ScriptError;
use crate::script::messages::numbers::format_number;
use crate::script::messages::suggest::nearest;
use crate::script::packages::pictures::motion::motion_text;
use crate::script::presentation::along::SectionForceProfile;
use crate::script::presentation::plots;
use crate::script::presentation::present::present_in_a_line;
use crate::script::presentation::quantities::{BeamQuantity, NAMES};
use crate::script::studies::error_estimate::{ErrorEstimate, QuantityError};
use crate::simulation::Simulation;

/// Maximum and minimum width of a value in the list of variables [columns].
const VALUE_WIDTH: usize = 70;
const LEAST_VALUE_WIDTH: usize = 12;

pub fn variables(shell: &mut Shell, _: &str) -> CommandOutcome {
    let session = shell.session();
    let variables: Vec<_> = session.variables().iter_raw().collect();
    let of_variables = variables.into_iter().rev().map(|(name, is_constant, value)| {
        let of = session.engine().map_type_name(value.type_name());
        let of = if is_constant { format!("constant {of}") } else { of.to_owned() };
        (name.to_owned(), of, ShownVariable::Value(value))
    });
    let of_functions = session.functions().map(|function| {
        let signature = format!("{}({})", function.name, function.params.join(", "));
        (function.name.to_owned(), "function".to_owned(), ShownVariable::Words(signature))
    });
    let of_modules = session.modules().map(|(name, module)| {
        let public = |of: &str| !of.starts_with("private ") && !of.starts_with("anon$");
        let functions = module.gen_fn_signatures_with_mapper(|name| name.into());
        let functions: Vec<_> = functions.filter(|signature| public(signature)).collect();
        (name.to_owned(), "import".to_owned(), ShownVariable::Words(functions.join(", ")))
    });
    let rows: Vec<_> = of_variables.chain(of_functions).chain(of_modules).collect();
    if rows.is_empty() {
        shell.print("there are no variables yet");
        return CommandOutcome::Success;
    }
    let room = match shell.screen() {
        ReplyTarget::Terminal(style) => {
            let longest = |texts: &mut dyn Iterator<Item = &String>| {
                texts.map(|text| columns(text)).max().unwrap_or_default()
            };
            let names = longest(&mut rows.iter().map(|(name, ..)| name)).max(4);
            let types = longest(&mut rows.iter().map(|(_, of, _)| of)).max(4);
            Some(style.width.saturating_sub(names + types + 4).max(LEAST_VALUE_WIDTH))
        }
        ReplyTarget::Pipe => None,
    };
    let mut table = TextTable::new(&["name", "type", "value"]);
    for (name, of, shown) in rows {
        let value = match shown {
            ShownVariable::Value(value) => {
                let width = room.unwrap_or(VALUE_WIDTH).min(VALUE_WIDTH);
                present_in_a_line(session.catalog(), value, width)
            }
            ShownVariable::Words(words) => words,
        };
        let value = room.map_or_else(|| value.clone(), |room| cut(&value, room, '…'));
        table.row([name, of, value].map(Cell::Text));
    }
    shell.print(table.to_string().trim_end());
    CommandOutcome::Success
}

enum ShownVariable<'a> {
    Value(&'a Dynamic),
    Words(String),
}

pub fn invariants(shell: &mut Shell, _: &str) -> CommandOutcome {
    shell.show_latest_result("invariants()")
}

pub fn error_estimate(shell: &mut Shell, operand: &str) -> CommandOutcome {
    let words = operand.split([',', ' ']).map(|name| name.trim_matches('"').to_owned());
    let columns: Vec<String> = words.filter(|name| !name.is_empty()).collect();
    if columns.is_empty() {
        return shell.show_latest_result("error_estimate()");
    }
    let Some(latest) = shell.latest() else { return shell.report_error(&no_simulation()) };
    if let Err(error) = plots::expect_columns(latest.simulation().history(), &columns) {
        return shell.report_native_error(error);
    }
    let estimate = match shell.preview_latest("error_estimate()") {
        Ok(Reply::Value(value)) if value.is::<ErrorEstimate>() => value.cast::<ErrorEstimate>(),
        Ok(reply) => return shell.print_reply(reply),
        Err(refusal) => return shell.report_error(&refusal),
    };
    draw(shell, |simulation, screen| {
        let history = simulation.history();
        match screen {
            ReplyTarget::Pipe => {
                let line = |name: &String| {
                    let of_rows = estimate.of_rows(name, history)?;
                    let [present, largest] = [
                        of_rows.last().copied().unwrap_or_default(),
                        of_rows.iter().copied().fold(0.0, f64::max),
                    ]
                    .map(|error| scientific(error, 2));
                    let summary = plots::column_summary(history, name)?;
                    let verdict = estimate.of(name).map(QuantityError::verdict).unwrap_or_default();
                    Ok(format!(
                        "{summary}; estimated error {present}, largest {largest}, {verdict}"
                    ))
                };
                Ok(columns.iter().map(line).collect::<Result<Vec<_>, ScriptError>>()?.join("\n"))
            }
            ReplyTarget::Terminal(style) => {
                plots::history_charts(history, &columns, &style, |chart, columns| {
                    for (index, name) in columns.iter().enumerate() {
                        chart.add_band(index, &estimate.of_rows(name, history)?);
                    }
                    Ok(())
                })
            }
        }
    })
}

pub fn view(shell: &mut Shell, operand: &str) -> CommandOutcome {
    let file = if operand.is_empty() { "view.html" } else { operand.trim_matches('"') };
    // Quotes and backslashes are removed from the file name, because they would end the string literal in the generated script.
    let name: String = file.chars().filter(|letter| !matches!(letter, '"' | '\\')).collect();
    let outcome = shell.call_latest(&format!("write_viewer(\"{name}\")"));
    if outcome == CommandOutcome::Success {
        let page = shell.session().context().output().folder().join(&name);
        shell.print(&format!("open {} in a browser to see it", page.display()));
    }
    outcome
}

pub fn explain(shell: &mut Shell, _: &str) -> CommandOutcome {
    shell.show_latest_result("explain()")
}

pub fn show(shell: &mut Shell, operand: &str) -> CommandOutcome {
    let (time, options) = operand.find("#{").map_or((operand, ""), |at| operand.split_at(at));
    let time = match (time.trim().trim_end_matches(',').trim_end(), options) {
        ("", _) => None,
        (time, _) => match time.parse::<f64>() {
            Ok(time) => Some(time),
            Err(_) => {
                let message = Diagnostic::general(format!("'{time}' is not a time"));
                let hint = "write :show, :show T with a time up to the present, or :show #{ … } with options of plot_motion";
                return shell.report_error(&message.with_hint(hint));
            }
        },
    };
    let options = match options {
        "" => None,
        text => match options_of(shell, text, ":show #{ trace: [rod.end] }") {
            Ok(mut map) => {
                if let Some(time) = time {
                    map.insert("to".into(), time.into());
                }
                Some(map)
            }
            Err(outcome) => return outcome,
        },
    };
    let latest = shell.latest();
    let engine_picture = |shell: &Shell, of: &SimulationHandle, map: &Map, screen: &ReplyTarget| {
        let style = match screen {
            ReplyTarget::Terminal(style) => *style,
            ReplyTarget::Pipe => TerminalStyle {
                glyphs: Glyphs::Ascii,
                colours: Colours::None,
                width: 80,
                height: 24,
            },
        };
        motion_text(shell.session().engine(), of, map, &style)
    };
    let drawn = match (&latest, &options) {
        (Some(of), Some(map)) => Some(engine_picture(shell, of, map, &shell.screen())),
        _ => None,
    };
    draw(shell, |simulation, screen| match (drawn, screen) {
        _ if time.is_some_and(|time| !(0.0..=simulation.time()).contains(&time)) => {
            let now = format_number(simulation.time());
            Err(ScriptError::new("no configuration is stored for this time")
                .hint(format!("give a time from 0 to {now}")))
        }
        (Some(Err(error)), _) => Err(error),
        (Some(Ok(text)), ReplyTarget::Terminal(_)) => Ok(text),
        (None, ReplyTarget::Terminal(style)) => {
            plots::configuration_picture(simulation, time, &style)
        }
        (_, ReplyTarget::Pipe) => plots::configuration_summary(simulation, time),
    })
}

pub(super) fn options_of(
    shell: &mut Shell,
    text: &str,
    example: &str,
) -> Result<Map, CommandOutcome> {
    match shell.session_mut().evaluate_preview(text) {
        Reply::Value(value) => value.try_cast::<Map>().ok_or_else(|| {
            let message = Diagnostic::general(format!("'{text}' is not a map of options"));
            shell.report_error(&message.with_hint(format!("for example {example}")))
        }),
        failed => Err(shell.print_reply(failed)),
    }
}

pub fn along(shell: &mut Shell, operand: &str) -> CommandOutcome {
    let name = if operand.is_empty() { "M" } else { operand.trim_matches('"') };
    let Some(quantity) = BeamQuantity::named(name) else {
        let message = Diagnostic::general(format!("there is no quantity '{name}' along beams"));
        let meant = nearest(name, NAMES.iter().copied());
        let meant = meant.map(|name| format!("did you mean {name}? ")).unwrap_or_default();
        return shell
            .report_error(&message.with_hint(format!("{meant}quantities: {}", NAMES.join(", "))));
    };
    draw(shell, |simulation, screen| {
        let inside = SectionForceProfile::of_simulation(simulation, &[])?;
        Ok(match screen {
            ReplyTarget::Terminal(style) => inside.text(quantity, &style),
            ReplyTarget::Pipe => inside.summary(quantity),
        })
    })
}

pub(super) fn draw(
    shell: &mut Shell,
    picture: impl FnOnce(&Simulation, ReplyTarget) -> Result<String, ScriptError>,
) -> CommandOutcome {
    let latest = match shell.latest() {
        Some(latest) => latest,
        None => return shell.report_error(&no_simulation()),
    };
    let drawn = picture(&latest.simulation(), shell.screen());
    match drawn {
        Ok(text) => {
            shell.print(text.trim_end());
            CommandOutcome::Success
        }
        Err(error) => shell.report_native_error(error),
    }
}
