//! Errors of native code that no script has called.

use super::{Outcome, Shell};
use crate::repl::session::Reply;
use crate::script::diagnose::Diagnostic;
use crate::script::words::error::ScriptError;
use crate::script::words::stop::Stop;

impl Shell {
    /// Tells an error that came from no script.
    pub fn refuse_native(&mut self, error: ScriptError) -> Outcome {
        match error {
            ScriptError::Failure(failure) => {
                let hint = failure.hint.clone();
                self.refuse(&Diagnostic { hint, ..Diagnostic::general(failure.message) })
            }
            ScriptError::Stopped(Stop::Interrupt) => self.tell(Reply::Interrupted),
            ScriptError::Stopped(stop) => self.refuse(&Diagnostic::general(stop.words().0)),
            other => self.refuse(&Diagnostic::bug(format!("{other:?}"))),
        }
    }
}
