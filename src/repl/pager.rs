//! Display of long replies in pages.

/// Result of showing a text in pages.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum PagerOutcome {
    /// The text was shown.
    Shown,
    /// Ctrl-C was pressed.
    Interrupted,
    /// The text must be printed without pages, because it is short or pages are disabled.
    NotPaged,
}

/// Pager for long texts.
pub trait Pager {
    /// Sets the size of the terminal.
    fn resize(&mut self, columns: usize, lines: usize);

    /// Shows a text in pages. `was_interrupted` returns true once after each Ctrl-C.
    fn show(&mut self, text: &str, was_interrupted: &dyn Fn() -> bool) -> PagerOutcome;
}
