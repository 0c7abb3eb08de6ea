//! Watched expressions. Their values are shown after every step.

use super::{CommandOutcome, Shell};
use crate::output::significant;
use crate::repl::session::Reply;
use crate::script::diagnose::Diagnostic;
use crate::script::presentation::present::present;

impl Shell {
    pub(crate) fn is_watching(&self) -> bool {
        !self.watched.is_empty()
    }

    /// Adds an expression to the watched expressions, and shows its value.
    pub fn watch(&mut self, expression: &str) -> CommandOutcome {
        let expression = expression.trim_end_matches(';').to_owned();
        if !self.watched.contains(&expression) {
            self.watched.push(expression);
        }
        self.show_watched()
    }

    pub(crate) fn clear_watched(&mut self) {
        self.watched.clear();
    }

    pub(crate) fn show_watched(&mut self) -> CommandOutcome {
        let mut parts = Vec::new();
        if let Some(latest) = self.latest() {
            parts.push(format!("t = {}", significant(latest.time(), 10)));
        }
        for expression in self.watched.clone() {
            let before = self.session.simulation_positions();
            let reply = self.session.evaluate_preview(&expression);
            let has_moved = self.session.record_movement(&before);
            let message = match reply {
                Reply::Value(_) | Reply::Done if has_moved => {
                    let message =
                        format!("the watched expression '{expression}' advances a simulation");
                    Diagnostic::general(message).with_hint(
                        "it is no longer watched; watch an expression that changes nothing",
                    )
                }
                Reply::Value(value) => {
                    let shown = present(self.session.catalog(), &value, self.width());
                    parts.push(format!("{expression} = {}", shown.lines().next().unwrap_or("")));
                    continue;
                }
                Reply::Done => {
                    parts.push(format!("{expression} = nothing"));
                    continue;
                }
                Reply::Failed(diagnostic) => diagnostic,
                other => return self.print_reply(other),
            };
            self.watched.retain(|other| *other != expression);
            return self.report_error(&message);
        }
        if !self.watched.is_empty() {
            self.print(&parts.join("   "));
        }
        CommandOutcome::Success
    }
}
