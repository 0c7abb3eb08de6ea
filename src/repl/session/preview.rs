//! Evaluations that leave nothing behind, once or in rounds.

use rhai::{AST, Dynamic};

use super::{Reply, Session};
use crate::script::state::watchdog::Watchdog;

/// Somebody who has an input of a session evaluated again and again, each time from the same variables.
pub trait Rounds {
    /// Makes ready for the next round of evaluation; `false` when there were enough.
    fn begin(&mut self) -> bool;
    /// Takes the value that a round of evaluation has given.
    fn end(&mut self, value: Dynamic);
}

/// One round.
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
    /// Evaluates an expression that leaves nothing behind in the session but what it does to scenes and simulations.
    pub fn peek(&mut self, text: &str) -> Reply {
        let mut once = Once::default();
        match self.peek_in_rounds(text, &mut once) {
            Ok(()) if once.value.is_unit() => Reply::Done,
            Ok(()) => Reply::Value(once.value),
            Err(failed) => failed,
        }
    }

    /// Evaluates an expression in rounds: the text is read once, and variables are before each round what they were before the first.
    ///
    /// # Errors
    /// The reply to the round that did not work: the last one.
    pub fn peek_in_rounds(&mut self, text: &str, rounds: &mut dyn Rounds) -> Result<(), Reply> {
        let program = self.transcript.typed(text);
        let text = program.text.clone();
        let before = self.transcript.add(program);
        let (checkpoint, library) = (self.checkpoint(), self.library.clone());
        let begun = self.begin(&text, before);
        let outcome = begun.and_then(|(ast, guard)| self.go_round(&guard, &ast, rounds));
        self.restore(checkpoint);
        self.library = library;
        self.transcript.forget_last();
        outcome
    }

    fn go_round(
        &mut self,
        guard: &Watchdog,
        ast: &AST,
        rounds: &mut dyn Rounds,
    ) -> Result<(), Reply> {
        // With the functions of the input, which its closures are.
        let start = self.checkpoint();
        while rounds.begin() {
            let value = self.run(guard, ast.statements())?;
            rounds.end(value);
            self.restore(start.clone());
        }
        Ok(())
    }
}
