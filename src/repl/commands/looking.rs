//! Commands that only look.

use std::time::{Duration, Instant};

use crate::output::{Cell, Table};
use crate::repl::shell::{Outcome, Shell};
use crate::script::diagnose::Diagnostic;

/// `:help [name]`
pub fn help(shell: &mut Shell, operand: &str) -> Outcome {
    shell.help(operand)
}

/// `:vars`
pub fn variables(shell: &mut Shell, _: &str) -> Outcome {
    let variables = shell.variables();
    if variables.is_empty() {
        shell.print("there are no variables yet");
        return Outcome::Good;
    }
    let mut table = Table::new(&["name", "type", "value"]);
    for variable in variables {
        table.row([variable.name, variable.of, variable.value].map(Cell::Text));
    }
    shell.print(table.to_string().trim_end());
    Outcome::Good
}

/// `:invariants`
pub fn invariants(shell: &mut Shell, _: &str) -> Outcome {
    shell.show_of_latest("invariants()")
}

/// `:explain`
pub fn explain(shell: &mut Shell, _: &str) -> Outcome {
    shell.show_of_latest("explain()")
}

/// `:plot [columns]`
pub fn plot(shell: &mut Shell, operand: &str) -> Outcome {
    let separators = |letter: char| letter.is_whitespace() || letter == ',';
    let named = operand.split(separators).filter(|name| !name.is_empty());
    let mut columns: Vec<String> = named.map(|name| name.trim_matches('"').to_owned()).collect();
    if columns.is_empty() {
        columns = ["kinetic", "strain", "energy"].map(str::to_owned).to_vec();
    }
    shell.plot(&columns)
}

/// `:show [time]`
pub fn show(shell: &mut Shell, operand: &str) -> Outcome {
    match (operand, operand.parse::<f64>()) {
        ("", _) => shell.draw(None),
        (_, Ok(time)) => shell.draw(Some(time)),
        _ => {
            let told = Diagnostic::general(format!("'{operand}' is not a time"));
            shell.refuse(&told.with_hint("write :show, or :show T with a time that has passed"))
        }
    }
}

/// `:time input`
pub fn time(shell: &mut Shell, operand: &str) -> Outcome {
    if operand.is_empty() {
        let told = Diagnostic::general("there is nothing to time");
        return shell.refuse(&told.with_hint("write :time followed by an input"));
    }
    let begun = Instant::now();
    let outcome = shell.submit(operand);
    let took = begun.elapsed();
    if outcome == Outcome::Good {
        shell.print(&format!("took {}", in_words(took)));
    }
    outcome
}

/// Three digits with the unit that suits them.
fn in_words(time: Duration) -> String {
    let seconds = time.as_secs_f64();
    let (value, unit) = match seconds {
        s if s < 1e-3 => (s * 1e6, "µs"),
        s if s < 1.0 => (s * 1e3, "ms"),
        s => (s, "s"),
    };
    let digits = if value < 10.0 { 2 } else if value < 100.0 { 1 } else { 0 };
    format!("{value:.digits$} {unit}")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn times_have_three_digits() {
        assert_eq!(in_words(Duration::from_nanos(1234)), "1.23 µs");
        assert_eq!(in_words(Duration::from_micros(45678)), "45.7 ms");
        assert_eq!(in_words(Duration::from_secs(321)), "321 s");
    }
}
