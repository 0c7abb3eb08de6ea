//! Main loop of the interactive prompt.

use std::io;

use super::line_editor::{Editor, EditorInput};
use super::typed_ahead::TypedAhead;
use crate::repl::shell::{CommandOutcome, Shell};

pub fn run(shell: &mut Shell, editor: &mut Editor) -> io::Result<()> {
    let _held = TypedAhead::set_mode();
    loop {
        if let Some((columns, lines)) = editor.size() {
            shell.resize(columns, lines);
        }
        if let Some(note) = editor.take_history_problem() {
            shell.print_note(&note);
        }
        let prompt = format!("withy:{}> ", shell.session().next_line());
        match editor.read(&prompt, shell.surroundings())? {
            EditorInput::Line(input) => match shell.submit(&input) {
                CommandOutcome::Quit | CommandOutcome::PipeClosed => return Ok(()),
                CommandOutcome::Success | CommandOutcome::Failed | CommandOutcome::Interrupted => {}
            },
            EditorInput::Interrupted => (),
            EditorInput::End => return Ok(()),
        }
    }
}
