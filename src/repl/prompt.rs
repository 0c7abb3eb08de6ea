//! The loop of a person at a terminal: read an input, do what it says, until the person leaves.

use std::io;

use super::editor::typed_ahead::TypedAhead;
use super::editor::{Editor, EditorInput};
use super::shell::{CommandOutcome, Shell};

/// Lets a person type inputs at the prompt until he leaves.
///
/// # Errors
/// When the terminal fails.
pub fn run(shell: &mut Shell, editor: &mut Editor) -> io::Result<()> {
    let _held = TypedAhead::keep();
    loop {
        if let Some((columns, lines)) = editor.size() {
            shell.resize(columns, lines);
        }
        if let Some(note) = editor.take_note() {
            shell.note(&note);
        }
        let prompt = format!("withy:{}> ", shell.session().next_line());
        match editor.read(&prompt, shell.surroundings())? {
            EditorInput::Line(input) => match shell.submit(&input) {
                CommandOutcome::Quit | CommandOutcome::PipeClosed => return Ok(()),
                CommandOutcome::Good | CommandOutcome::Failed | CommandOutcome::Interrupted => (),
            },
            EditorInput::Interrupted => (),
            EditorInput::End => return Ok(()),
        }
    }
}
