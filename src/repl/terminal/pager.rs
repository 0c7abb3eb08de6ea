//! Pager at a terminal: an external program or the built-in pager.

mod keyboard;
mod pages;
mod program;

use std::io::stdout;

use crate::repl::pager::{Pager, PagerOutcome};

pub struct TerminalPager {
    program: Option<String>,
    size: (usize, usize),
}

impl TerminalPager {
    /// Creates a pager with the program in the environment variable `PAGER`, or the built-in pager if `PAGER` is not set.
    /// The pager is `None` if `PAGER` is `cat` or empty, or if the terminal cannot move its cursor.
    pub fn of_environment(variable: impl Fn(&str) -> Option<String>) -> Option<Self> {
        let program = variable("PAGER");
        let is_unwanted = program.as_deref().is_some_and(|name| matches!(name.trim(), "" | "cat"));
        let is_dumb = matches!(variable("TERM").as_deref(), None | Some("" | "dumb"));
        (!is_unwanted && !is_dumb).then_some(Self { program, size: (0, 0) })
    }

    fn is_long(&self, text: &str) -> bool {
        let (columns, lines) = self.size;
        columns > 0 && lines > 1 && pages::rows(text, columns) >= lines
    }
}

impl Pager for TerminalPager {
    fn resize(&mut self, columns: usize, lines: usize) {
        self.size = (columns, lines);
    }

    fn show(&mut self, text: &str, was_interrupted: &dyn Fn() -> bool) -> PagerOutcome {
        // With waiting keys, the text is printed without pages: the keys belong to the next prompt, and a pager would read them.
        if !self.is_long(text) || keyboard::has_pending_keys() {
            return PagerOutcome::NotPaged;
        }
        if let Some(name) = &self.program {
            match program::show(name, text, was_interrupted) {
                Ok(()) => return PagerOutcome::Shown,
                Err(error) => eprintln!("note: cannot start the pager '{name}': {error}"),
            }
        }
        let Some(mut keys) = keyboard::KeyboardTerminal::open() else {
            return PagerOutcome::NotPaged;
        };
        let walked =
            pages::show_pages(text, self.size.1, &mut keys, was_interrupted, &mut stdout());
        // An error of the pager means that the terminal has been closed, which the next prompt reports.
        walked.unwrap_or(PagerOutcome::Shown)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn pager(variables: &[(&str, &str)]) -> Option<TerminalPager> {
        let value = |name: &str| variables.iter().find(|(other, _)| *other == name);
        TerminalPager::of_environment(|name| value(name).map(|(_, value)| (*value).to_owned()))
    }

    #[test]
    fn environment_selects_or_disables_the_pager() {
        let xterm = ("TERM", "xterm");
        assert!(pager(&[xterm]).is_some_and(|pager| pager.program.is_none()));
        assert!(pager(&[xterm, ("PAGER", "less -S")]).is_some_and(|pager| pager.program.is_some()));
        for without in
            [&[xterm, ("PAGER", "cat")][..], &[xterm, ("PAGER", "")], &[("TERM", "dumb")], &[]]
        {
            assert!(pager(without).is_none(), "{without:?}");
        }
    }

    #[test]
    fn text_that_fits_the_terminal_is_not_paged() {
        let mut pager = pager(&[("TERM", "xterm")]).expect("a pager");
        assert!(!pager.is_long(&"a\n".repeat(1000)), "of unknown size");
        pager.resize(20, 10);
        assert!(!pager.is_long(&["a"; 9].join("\n")) && pager.is_long(&["a"; 10].join("\n")));
        assert!(!pager.is_long(&"a".repeat(180)) && pager.is_long(&"a".repeat(181)));
    }
}
