//! `:help` and `?`: what a name means.

use super::{COMMANDS, Command, find};
use crate::output::{Cell, Colours, Table};
use crate::repl::shell::{Outcome, Shell};
use crate::script::diagnose::Diagnostic;
use crate::script::help::{self, Page};

/// `:help [name]`
pub fn help(shell: &mut Shell, operand: &str) -> Outcome {
    let name = operand.trim_end_matches("()").trim();
    if name.is_empty() {
        return overview(shell);
    }
    if name.starts_with(':') {
        return match find(name) {
            Ok(command) => explain(shell, command),
            Err(refusal) => shell.refuse(&refusal),
        };
    }
    let named = COMMANDS.iter().find(|command| command.name[1..] == *name);
    match (help::page(shell.session().catalog(), name), named) {
        (Ok(page), command) => {
            show(shell, &page);
            if let Some(command) = command {
                shell.print("");
                return explain(shell, command);
            }
            Outcome::Good
        }
        (Err(_), Some(command)) => explain(shell, command),
        (Err(unknown), None) => {
            let told = Diagnostic::general(unknown.to_string());
            shell.refuse(&match unknown.meant.is_none() && unknown.mentions.is_empty() {
                true => told.with_hint(":help lists what there is"),
                false => told.with_hint(unknown.hint()),
            })
        }
    }
}

fn explain(shell: &Shell, command: &Command) -> Outcome {
    let mut page = Page::default();
    page.heading(command.usage());
    page.paragraph(&format!("At the prompt, it {}.", command.summary));
    if !command.doc.is_empty() {
        page.paragraph(command.doc);
    }
    show(shell, &page);
    Outcome::Good
}

fn overview(shell: &mut Shell) -> Outcome {
    let mut table = Table::new(&["command", "what it does"]);
    for command in COMMANDS {
        table.row([command.usage(), command.summary.to_owned()].map(Cell::Text));
    }
    shell.print(&format!("{}\n", table.to_string().trim_end()));
    match help::page(shell.session().catalog(), "") {
        Ok(page) => show(shell, &page),
        Err(unknown) => return shell.refuse(&Diagnostic::bug(unknown)),
    }
    Outcome::Good
}

fn show(shell: &Shell, page: &Page) {
    let text = match shell.colours() {
        Colours::Ansi => page.ansi(shell.width()),
        Colours::None => page.plain(shell.width()),
    };
    shell.print(text.trim_end());
}
