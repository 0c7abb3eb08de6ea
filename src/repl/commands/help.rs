//! `:help` and `?`: what a name means.

use super::{COMMANDS, Command, find};
use crate::output::Colours;
use crate::repl::session::ANSWER;
use crate::repl::shell::{Outcome, Shell};
use crate::script::diagnose::Diagnostic;
use crate::script::help::{self, Page, Span};
use crate::script::kind::with_article;

/// `:help [name]`
pub fn help(shell: &mut Shell, operand: &str) -> Outcome {
    let name = operand.trim_matches('"').trim_end_matches("()").trim();
    match name {
        "" => return commands(shell),
        "topics" | "all" => return topics(shell),
        ANSWER => {
            let mut page = Page::default();
            page.heading(ANSWER);
            page.paragraph("At the prompt, the value of the last input that had one.");
            show(shell, &page);
            return Outcome::Good;
        }
        _ => (),
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
        (Err(unknown), Some(command)) => {
            let outcome = explain(shell, command);
            if !unknown.is_strange() {
                let mut page = Page::default();
                page.gap();
                page.paragraph(&format!("In a script: {}", unknown.hint()));
                show(shell, &page);
            }
            outcome
        }
        (Err(_), None) if shell.session().variables().contains(name) => {
            let of = shell.session().variables().get(name).map(rhai::Dynamic::type_name);
            let of = of.map(|of| shell.session().engine().map_type_name(of).to_owned());
            let of = of.unwrap_or_default();
            shell.print(&format!("{name} is a variable: {}", with_article(&of)));
            help(shell, &of)
        }
        (Err(unknown), None) => {
            let told = Diagnostic::general(unknown.to_string());
            shell.refuse(&match unknown.is_strange() {
                true => told.with_hint(":help topics lists what there is"),
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

/// The commands, and how to come to the rest: what is asked for must not scroll away.
fn commands(shell: &mut Shell) -> Outcome {
    let mut page = Page::default();
    page.heading("Commands of the prompt");
    for command in COMMANDS {
        let summary = Span::plain(format!(": {}", command.summary));
        page.words(2, vec![Span::name(command.usage()), summary]);
    }
    page.gap();
    page.paragraph(
        "?NAME explains a function, a type, an option or a topic: ?beam, ?simulation, ?EA, ?loops. :help topics lists them all. \
         Anything else that is typed is evaluated.",
    );
    show(shell, &page);
    Outcome::Good
}

/// All that has a page.
fn topics(shell: &mut Shell) -> Outcome {
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
