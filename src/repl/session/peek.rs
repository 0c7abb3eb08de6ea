//! Evaluations that leave nothing behind, once or in rounds.

use rhai::{AST, Dynamic};

use super::{Reply, Session};

/// Somebody who has an input evaluated again and again, each time from the same variables.
pub trait Rounds {
    /// Makes ready for the next round; `false` when there were enough.
    fn begin(&mut self) -> bool;
    /// Takes what came of a round.
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
    /// Evaluates an expression that leaves nothing behind but what it does to scenes and simulations.
    pub fn peek(&mut self, text: &str) -> Reply {
        let mut once = Once::default();
        match self.peek_in_rounds(text, &mut once) {
            Ok(()) if once.value.is_unit() => Reply::Done,
            Ok(()) => Reply::Value(once.value),
            Err(failed) => failed,
        }
    }

    /// The same in rounds: the text is read once, and variables are before each round what they were before the first.
    ///
    /// # Errors
    /// What came of the round that did not work: the last one.
    pub fn peek_in_rounds(&mut self, text: &str, rounds: &mut dyn Rounds) -> Result<(), Reply> {
        let program = self.transcript.typed(text);
        let text = program.text.clone();
        let before = self.transcript.add(program);
        let (checkpoint, library) = (self.checkpoint(), self.library.clone());
        let outcome =
            self.begin(&text, before).and_then(|(ast, _watchdog)| self.go_round(&ast, rounds));
        self.restore(checkpoint);
        self.library = library;
        self.transcript.forget_last();
        outcome
    }

    fn go_round(&mut self, ast: &AST, rounds: &mut dyn Rounds) -> Result<(), Reply> {
        // With the functions of the input, which its closures are.
        let start = self.checkpoint();
        while rounds.begin() {
            let value = self.run(ast.statements())?;
            rounds.end(value);
            self.restore(start.clone());
        }
        Ok(())
    }
}
