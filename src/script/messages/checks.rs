//! The record of what a script checked about its own results.

/// A check of a script that did not hold.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct FailedCheck {
    /// What the script says about the failed check.
    pub message: String,
    /// The line of the failed check in the script, from 1.
    pub line: usize,
}

/// How many checks a script made, and which failed.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Checks {
    made: usize,
    failed: Vec<FailedCheck>,
}

impl Checks {
    /// Counts a check that held.
    pub fn pass(&mut self) {
        self.made += 1;
    }

    /// Counts a check that did not hold.
    pub fn fail(&mut self, check: FailedCheck) {
        self.made += 1;
        self.failed.push(check);
    }

    /// The number of checks that were made.
    pub fn made(&self) -> usize {
        self.made
    }

    /// The checks that failed, in the order of the run.
    pub fn failed(&self) -> &[FailedCheck] {
        &self.failed
    }

    /// One line on the outcome of the checks; nothing if nothing was checked.
    pub fn summary(&self) -> Option<String> {
        match (self.made, self.failed.len()) {
            (0, _) => None,
            (1, 0) => Some("the check passed".into()),
            (made, 0) => Some(format!("all {made} checks passed")),
            (made, failed) => Some(format!("{failed} of {made} checks failed")),
        }
    }
}
