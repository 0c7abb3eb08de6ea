//! Errors of native code called by commands.

use rhai::EvalAltResult;

use super::{CommandOutcome, Shell};
use crate::repl::session::Reply;
use crate::script::diagnose::Diagnostic;
use crate::script::messages::error::ScriptError;
use crate::script::messages::stop::Stop;

impl Shell {
    /// Reports an error of native code, which has no position in a script.
    pub fn report_native_error(&mut self, error: ScriptError) -> CommandOutcome {
        match error {
            ScriptError::Failure(failure) => {
                let hint = failure.hint.clone();
                self.report_error(&Diagnostic { hint, ..Diagnostic::general(failure.message) })
            }
            ScriptError::Stopped(Stop::Interrupt) => self.print_reply(Reply::Interrupted),
            ScriptError::Stopped(stop) => {
                self.report_error(&Diagnostic::general(stop.message_and_hint().0))
            }
            ScriptError::Engine(error) => match *error {
                EvalAltResult::ErrorTerminated(token, _) => {
                    self.report_native_error(ScriptError::Stopped(Stop::of_token(&token)))
                }
                other => self.report_error(&Diagnostic::general(other.to_string())),
            },
            ScriptError::Internal(message) => {
                self.report_error(&Diagnostic::internal_error(message))
            }
        }
    }
}
