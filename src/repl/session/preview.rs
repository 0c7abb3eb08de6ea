//! Evaluation of an expression, once or repeatedly. Its changes of variables are undone afterwards.

use std::mem;

use rhai::{AST, Dynamic, Scope};

use super::{Reply, Session};
use crate::script::state::watchdog::Watchdog;

/// Callbacks of a repeated evaluation.
pub trait Rounds {
    /// Prepares the next evaluation. Returns false if the expression must not be evaluated again.
    fn begin(&mut self) -> bool;
    /// Receives the value of a completed evaluation.
    fn end(&mut self, value: Dynamic);
}

#[derive(Default)]
struct Once {
    has_begun: bool,
    value: Dynamic,
}

impl Rounds for Once {
    fn begin(&mut self) -> bool {
        !std::mem::replace(&mut self.has_begun, true)
    }

    fn end(&mut self, value: Dynamic) {
        self.value = value;
    }
}

impl Session {
    /// Evaluates an expression and restores the variables. Changes of scenes and simulations are not undone.
    pub fn evaluate_preview(&mut self, text: &str) -> Reply {
        let mut once = Once::default();
        match self.evaluate_repeatedly(text, &mut once) {
            Ok(()) if once.value.is_unit() => Reply::Done,
            Ok(()) => Reply::Value(once.value),
            Err(failed) => failed,
        }
    }

    /// Evaluates an expression in which only `values` are variables. Changes of scenes and simulations are not undone.
    pub fn evaluate_with(&mut self, values: Scope<'static>, text: &str) -> Reply {
        let variables = mem::replace(&mut self.scope, values);
        let reply = self.evaluate_preview(text);
        self.scope = variables;
        reply
    }

    /// Evaluates an expression repeatedly. It is parsed once, and variables are restored before each evaluation.
    ///
    /// # Errors
    /// Returns the reply to the first failed evaluation.
    pub fn evaluate_repeatedly(
        &mut self,
        text: &str,
        rounds: &mut dyn Rounds,
    ) -> Result<(), Reply> {
        let program = self.transcript.typed(text);
        let text = program.text.clone();
        let before = self.transcript.add(program);
        let (checkpoint, library) = (self.checkpoint(), self.library.clone());
        let begun = self.begin(&text, before);
        let outcome = begun.and_then(|(ast, guard)| self.evaluate_round(&guard, &ast, rounds));
        self.restore(checkpoint);
        self.library = library;
        self.transcript.remove_last();
        outcome
    }

    fn evaluate_round(
        &mut self,
        guard: &Watchdog,
        ast: &AST,
        rounds: &mut dyn Rounds,
    ) -> Result<(), Reply> {
        let start = self.checkpoint();
        while rounds.begin() {
            let value = self.run(guard, ast.statements())?;
            rounds.end(value);
            self.restore(start.clone());
        }
        Ok(())
    }
}
