//! Commands that only look.

use crate::output::{Cell, Table};
use crate::repl::shell::{Outcome, Screen, Shell, no_simulation};
use crate::script::diagnose::Diagnostic;
use crate::script::looks::present::present_in_a_line;
use crate::script::looks::sight;
use crate::script::words::error::ScriptError;
use crate::script::words::numbers::format_number;
use crate::simulation::Simulation;

/// Characters of a value in the list of variables.
const VALUE_WIDTH: usize = 70;

/// The command `:vars`: lists the variables, functions and modules of the session.
pub fn variables(shell: &mut Shell, _: &str) -> Outcome {
    let session = shell.session();
    let mut table = Table::new(&["name", "type", "value"]);
    let mut is_empty = true;
    let mut row = |name: &str, of: &str, value: String| {
        table.row([name.to_owned(), of.to_owned(), value].map(Cell::Text));
        is_empty = false;
    };
    let variables: Vec<_> = session.variables().iter_raw().collect();
    for (name, is_constant, value) in variables.into_iter().rev() {
        let of = session.engine().map_type_name(value.type_name());
        let of = if is_constant { format!("constant {of}") } else { of.to_owned() };
        row(name, &of, present_in_a_line(session.catalog(), value, VALUE_WIDTH));
    }
    for function in session.functions() {
        row(
            function.name,
            "function",
            format!("{}({})", function.name, function.params.join(", ")),
        );
    }
    for (name, module) in session.modules() {
        // What a module keeps to itself and its closures have no place here.
        let public = |of: &str| !of.starts_with("private ") && !of.starts_with("anon$");
        let functions = module
            .gen_fn_signatures_with_mapper(|name| name.into())
            .filter(|signature| public(signature));
        row(name, "import", functions.collect::<Vec<_>>().join(", "));
    }
    match is_empty {
        true => shell.print("there are no variables yet"),
        false => shell.print(table.to_string().trim_end()),
    }
    Outcome::Good
}

/// The command `:invariants`: shows how far energy and momenta of the last simulation drift.
pub fn invariants(shell: &mut Shell, _: &str) -> Outcome {
    shell.show_of_latest("invariants()")
}

/// The command `:view [FILE]`: writes a page on which the last simulation moves.
pub fn view(shell: &mut Shell, operand: &str) -> Outcome {
    let file = if operand.is_empty() { "view.html" } else { operand.trim_matches('"') };
    // What no name of a file can contain would end the text in which it stands.
    let name: String = file.chars().filter(|letter| !matches!(letter, '"' | '\\')).collect();
    let outcome = shell.call_latest(&format!("write_viewer(\"{name}\")"));
    if outcome == Outcome::Good {
        let page = shell.session().context().output().folder().join(&name);
        shell.print(&format!("wrote {}; open it in a browser", page.display()));
    }
    outcome
}

/// The command `:explain`: tells what the last simulation uses and leaves out.
pub fn explain(shell: &mut Shell, _: &str) -> Outcome {
    shell.show_of_latest("explain()")
}

/// The command `:show [time]`: draws the configuration of the last simulation.
pub fn show(shell: &mut Shell, operand: &str) -> Outcome {
    let time = match (operand, operand.parse::<f64>()) {
        ("", _) => None,
        (_, Ok(time)) => Some(time),
        _ => {
            let told = Diagnostic::general(format!("'{operand}' is not a time"));
            return shell
                .refuse(&told.with_hint("write :show, or :show T with a time that has passed"));
        }
    };
    draw(shell, |simulation, screen| match screen {
        _ if time.is_some_and(|time| !(0.0..=simulation.time()).contains(&time)) => {
            let now = format_number(simulation.time());
            Err(ScriptError::new("there is no configuration at this time")
                .hint(format!("the simulation has run from t = 0 to {now}")))
        }
        Screen::Terminal(style) => sight::configuration_picture(simulation, time, &style),
        Screen::Pipe => sight::configuration_summary(simulation, time),
    })
}

/// Shows what is made of the last simulation for the screen: a picture, or words.
pub(super) fn draw(
    shell: &mut Shell,
    picture: impl FnOnce(&Simulation, Screen) -> Result<String, ScriptError>,
) -> Outcome {
    let latest = match shell.latest() {
        Some(latest) => latest,
        None => return shell.refuse(&no_simulation()),
    };
    let drawn = picture(&latest.simulation(), shell.screen());
    match drawn {
        Ok(text) => {
            shell.print(text.trim_end());
            Outcome::Good
        }
        Err(ScriptError::Failure(failure)) => {
            let hint = failure.hint.clone();
            shell.refuse(&Diagnostic { hint, ..Diagnostic::general(failure.message) })
        }
        Err(other) => shell.refuse(&Diagnostic::bug(format!("{other:?}"))),
    }
}
