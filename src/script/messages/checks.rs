//! Record of the checks made by a script.

/// A failed check.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct FailedCheck {
    /// Message of the script.
    pub message: String,
    /// Line of the check in the script, from 1.
    pub line: usize,
}

/// Number of checks, and the failed ones.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Checks {
    made: usize,
    failed: Vec<FailedCheck>,
}

impl Checks {
    /// Counts a passed check.
    pub fn pass(&mut self) {
        self.made += 1;
    }

    /// Records a failed check.
    pub fn fail(&mut self, check: FailedCheck) {
        self.made += 1;
        self.failed.push(check);
    }

    /// Number of checks made.
    pub fn made(&self) -> usize {
        self.made
    }

    /// Failed checks, in the order of the run.
    pub fn failed(&self) -> &[FailedCheck] {
        &self.failed
    }

    /// One-line summary; `None` if there were no checks.
    pub fn summary(&self) -> Option<String> {
        match (self.made, self.failed.len()) {
            (0, _) => None,
            (1, 0) => Some("the check passed".into()),
            (made, 0) => Some(format!("all {made} checks passed")),
            (made, failed) => Some(format!("{failed} of {made} checks failed")),
        }
    }
}
