//! Completion of commands such as `:step 10`, and of help requests such as `?slider`.

use super::candidates::{Candidate, fitting};
use super::completion::complete;
use super::paths::{FileFilter, complete_path};
use super::surroundings::{CommandOperand, CommandWord, CompletionContext};

/// Completion candidates for a command or a help request, and the index of the first byte that a candidate replaces.
pub fn complete_command(text: &str, surroundings: &CompletionContext) -> (usize, Vec<Candidate>) {
    let begin = text.len() - text.trim_start().len();
    let command = &text[begin..];
    if let Some(asked) = command.strip_prefix('?') {
        let asked = asked.trim_start();
        return (text.len() - asked.len(), fitting(asked, topics(surroundings)));
    }
    let Some(end) = command.find(char::is_whitespace) else {
        let commands = surroundings.commands.iter();
        return (
            begin,
            fitting(command, commands.map(|word| Candidate::word(word.name, word.summary))),
        );
    };
    let operand = command[end..].trim_start();
    let start = text.len() - operand.len();
    match command_named(&command[..end], surroundings).map(|word| word.operand) {
        Some(CommandOperand::Name) => (start, fitting(operand, topics(surroundings))),
        Some(CommandOperand::File) => {
            let (offset, found) = complete_path(operand, &surroundings.folder, FileFilter::Any);
            (start + offset, found)
        }
        Some(CommandOperand::Curves) if options_at(operand).is_some() => {
            in_call("plot([], [], \"\", ", operand, start, surroundings)
        }
        Some(CommandOperand::Curves) => {
            let last = operand.rfind([' ', ',']).map_or(0, |gap| gap + 1);
            let columns = surroundings.columns.iter().map(|column| Candidate::word(column, ""));
            let columns = fitting(&operand[last..], columns);
            let (offset, found) = complete(operand, operand.len(), surroundings);
            match columns.is_empty() {
                // Only columns and variables are suggested as curves, because the functions would be too many.
                false => {
                    let variables = surroundings.variables.iter();
                    let variables = variables.map(|known| Candidate::word(&known.name, ""));
                    (start + last, fitting(&operand[last..], columns.into_iter().chain(variables)))
                }
                true => (start + offset, found),
            }
        }
        Some(CommandOperand::Expression) => {
            let (offset, found) = complete(operand, operand.len(), surroundings);
            (start + offset, found)
        }
        Some(CommandOperand::OneOf(words)) => {
            (start, fitting(operand, words.iter().map(|word| Candidate::word(word, ""))))
        }
        Some(CommandOperand::OptionsOf(call)) => in_call(call, operand, start, surroundings),
        Some(CommandOperand::Nothing | CommandOperand::Number) | None => (text.len(), Vec::new()),
    }
}

fn options_at(operand: &str) -> Option<usize> {
    let at = operand.find("#{")?;
    (at == 0 || operand[..at].ends_with([' ', ','])).then_some(at)
}

fn in_call(
    call: &str,
    operand: &str,
    start: usize,
    surroundings: &CompletionContext,
) -> (usize, Vec<Candidate>) {
    let Some(map) = options_at(operand) else {
        let (offset, found) = complete(operand, operand.len(), surroundings);
        return (start + offset, found);
    };
    let typed = format!("{call}{}", &operand[map..]);
    let (offset, found) = complete(&typed, typed.len(), surroundings);
    (start + map + offset.saturating_sub(call.len()), found)
}

pub fn command_named<'s>(
    name: &str,
    surroundings: &'s CompletionContext,
) -> Option<&'s CommandWord> {
    let mut beginning = surroundings.commands.iter().filter(|word| word.name.starts_with(name));
    let exact = surroundings.commands.iter().find(|word| word.name == name);
    exact.or_else(|| beginning.next().filter(|_| beginning.next().is_none()))
}

fn topics(surroundings: &CompletionContext) -> Vec<Candidate> {
    let catalog = &surroundings.catalog;
    let is_name = |name: &str| name.starts_with(|letter: char| letter.is_alphabetic());
    let rows = catalog.rows().filter(|row| is_name(row.name));
    let constants = catalog.tables().flat_map(|table| table.constants);
    rows.map(|row| Candidate::word(row.name, row.summary))
        .chain(constants.map(|constant| Candidate::word(constant.name, constant.summary)))
        .chain(
            surroundings
                .functions
                .iter()
                .map(|function| Candidate::word(&function.name, "a function of this session")),
        )
        .chain(surroundings.variables.iter().map(|known| Candidate::word(&known.name, &known.of)))
        .chain(
            surroundings.modules.iter().map(|module| Candidate::word(&module.alias, "an import")),
        )
        .chain(surroundings.commands.iter().map(|word| Candidate::word(word.name, word.summary)))
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::repl::editor::samples::surroundings;

    #[test]
    fn operands_and_options_of_commands_are_completed() {
        let mut known = surroundings();
        let command = |name, operand| CommandWord { name, summary: "", operand };
        known.commands.push(command(":along", CommandOperand::OneOf(&["M", "N", "speed"])));
        known.commands.push(command(":look", CommandOperand::OptionsOf("plot_motion(0, \"\", ")));
        let found = |text: &str| {
            let (start, found) = complete_command(text, &known);
            let names: Vec<String> = found.iter().map(|one| one.replacement.clone()).collect();
            (start, names)
        };
        assert_eq!(found(":along sp"), (7, vec!["speed".to_owned()]));
        assert_eq!(found(":along ").1.len(), 3);
        let (start, names) = found(":look 2, #{ mag");
        assert_eq!(start, 12);
        assert!(names.len() == 1 && names[0].starts_with("magnify"), "{names:?}");
        let (start, names) = found(":plot kinetic, #{ y_lo");
        assert_eq!((start, names[0].starts_with("y_log")), (18, true), "{names:?}");
        let (_, names) = found(":look #{ trace: [rod.e");
        assert!(names.iter().any(|name| name.starts_with("end")), "{names:?}");
    }
}
