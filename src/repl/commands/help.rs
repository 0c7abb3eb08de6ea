//! Commands `:help` and `?`.

use super::names::{NameInfo, in_language, known};
use super::{COMMANDS, Command, find};
use crate::output::Colours;
use crate::repl::shell::{CommandOutcome, Shell};
use crate::script::diagnose::Diagnostic;
use crate::script::help::lookup::{self, HelpPage, StyledText};

pub fn help(shell: &mut Shell, operand: &str) -> CommandOutcome {
    let name = operand.trim_matches('"').trim_end_matches('?').trim_end_matches("()").trim();
    match name {
        "" => return commands(shell),
        "topics" | "all" => return topics(shell),
        _ => (),
    }
    if name.starts_with(':') {
        return match find(name) {
            Ok(command) => {
                let page = command_page(command);
                show(shell, &[drawn(shell, &page)])
            }
            Err(refusal) => shell.report_error(&refusal),
        };
    }
    match help_on(shell, name) {
        Ok(found) => {
            let text = |found: NameInfo| {
                format!("{}{}", drawn(shell, &found.page), found.shown.unwrap_or_default())
            };
            let texts: Vec<String> = found.into_iter().map(text).collect();
            show(shell, &texts)
        }
        Err(unknown) => shell.report_error(&unknown),
    }
}

pub fn help_on(shell: &mut Shell, name: &str) -> Result<Vec<NameInfo>, Diagnostic> {
    let mut found = Vec::new();
    let mut name_of_page = in_language(shell, name);
    if let Some(of_session) = known(shell, name) {
        found.push(of_session);
        let is_plain = lookup::find(shell.session().catalog(), &name_of_page).is_empty();
        let value = shell.session().variables().get(name).filter(|_| is_plain);
        if let Some(value) = value {
            name_of_page = shell.session().engine().map_type_name(value.type_name()).to_owned();
        }
    }
    let command = COMMANDS.iter().find(|command| command.name[1..] == *name);
    let of_command = command.map(|command| NameInfo::of_language(command_page(command)));
    match lookup::page(shell.session().catalog(), &name_of_page) {
        Ok(page) => {
            found.push(NameInfo::of_language(page));
            found.extend(of_command);
        }
        Err(unknown) => {
            found.extend(of_command);
            if found.is_empty() {
                let message = Diagnostic::general(unknown.to_string());
                return Err(match unknown.is_strange() {
                    true => message.with_hint(":help topics lists all topics"),
                    false => message.with_hint(unknown.hint()),
                });
            }
            if command.is_some() && !unknown.is_strange() {
                let mut page = HelpPage::default();
                page.paragraph(&format!("In a script: {}", unknown.hint()));
                found.push(NameInfo::of_language(page));
            }
        }
    }
    Ok(found)
}

fn command_page(command: &Command) -> HelpPage {
    let mut page = HelpPage::default();
    page.heading(command.usage());
    page.paragraph(&format!("At the prompt, it {}.", command.summary));
    if !command.doc.is_empty() {
        page.paragraph(command.doc);
    }
    page
}

fn commands(shell: &mut Shell) -> CommandOutcome {
    let mut page = HelpPage::default();
    page.heading("Commands of the prompt");
    for command in COMMANDS {
        let summary = StyledText::plain(format!(": {}", command.summary));
        page.words(2, vec![StyledText::name(command.usage()), summary]);
    }
    page.gap();
    page.paragraph(
        "NAME? or ?NAME explains a variable, a function, a type, an option or a topic: sim?, beam?, EA?, loops?. :help topics lists \
         them all. All other input is evaluated.",
    );
    show(shell, &[drawn(shell, &page)])
}

fn topics(shell: &mut Shell) -> CommandOutcome {
    match lookup::page(shell.session().catalog(), "") {
        Ok(page) => show(shell, &[drawn(shell, &page)]),
        Err(unknown) => shell.report_error(&Diagnostic::internal_error(unknown)),
    }
}

fn drawn(shell: &Shell, page: &HelpPage) -> String {
    match shell.colours() {
        Colours::Ansi => page.ansi(shell.width()),
        Colours::None => page.plain(shell.width()),
    }
}

fn show(shell: &mut Shell, texts: &[String]) -> CommandOutcome {
    let texts: Vec<&str> = texts.iter().map(|text| text.trim_end()).collect();
    shell.print_in_pages(&texts.join("\n\n"))
}
