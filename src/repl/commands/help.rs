//! `:help` and `?`: what a name means.

use super::{COMMANDS, find};
use crate::output::{Cell, Table};
use crate::repl::shell::{Outcome, Shell};

/// `:help [name]`
pub fn help(shell: &mut Shell, operand: &str) -> Outcome {
    let name = operand.trim_end_matches("()").trim();
    if name.is_empty() {
        return overview(shell);
    }
    if let Some(command) = name.strip_prefix(':') {
        return match find(command) {
            Ok(command) => {
                let text = format!("{}\n  {}. {}", command.usage(), command.summary, command.doc);
                shell.print(text.trim_end());
                Outcome::Good
            }
            Err(refusal) => shell.refuse(&refusal),
        };
    }
    Outcome::Good
}

fn overview(shell: &mut Shell) -> Outcome {
    let mut table = Table::new(&["command", "what it does"]);
    for command in COMMANDS {
        table.row([command.usage(), command.summary.to_owned()].map(Cell::Text));
    }
    shell.print(table.to_string().trim_end());
    Outcome::Good
}
