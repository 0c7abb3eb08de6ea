//! Record of the checks made by a script.

#[derive(Clone, Debug, PartialEq, Eq)]
pub struct FailedCheck {
    pub message: String,
    /// Line of the check in the script, counted from 1.
    pub line: usize,
}

#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Checks {
    made: usize,
    failed: Vec<FailedCheck>,
}

impl Checks {
    pub fn pass(&mut self) {
        self.made += 1;
    }

    pub fn fail(&mut self, check: FailedCheck) {
        self.made += 1;
        self.failed.push(check);
    }

    pub fn made(&self) -> usize {
        self.made
    }

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
