//! Errors of native code called by commands.

use rhai::EvalAltResult;

use super::{CommandOutcome, Shell};
use crate::repl::session::Reply;
use crate::script::diagnose::Diagnostic;
use crate::script::messages::error::ScriptError;
use crate::script::messages::stop::Stop;

impl Shell {
    /// Reports an error that does not originate in a script.
    pub fn refuse_native(&mut self, error: ScriptError) -> CommandOutcome {
        match error {
            ScriptError::Failure(failure) => {
                let hint = failure.hint.clone();
                self.refuse(&Diagnostic { hint, ..Diagnostic::general(failure.message) })
            }
            ScriptError::Stopped(Stop::Interrupt) => self.tell(Reply::Interrupted),
            ScriptError::Stopped(stop) => self.refuse(&Diagnostic::general(stop.words().0)),
            ScriptError::Engine(error) => match *error {
                EvalAltResult::ErrorTerminated(token, _) => {
                    self.refuse_native(ScriptError::Stopped(Stop::of_token(&token)))
                }
                other => self.refuse(&Diagnostic::general(other.to_string())),
            },
            ScriptError::Bug(message) => self.refuse(&Diagnostic::bug(message)),
        }
    }
}
