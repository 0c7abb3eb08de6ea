//! Report entries and rescue files of the simulations of a run.

use std::cell::RefCell;
use std::collections::HashSet;

/// An object that contributes to the report of a run, such as a simulation.
pub trait Reporter {
    /// Returns the entry in the report, called when the run ends for any reason.
    fn report(&self) -> serde_json::Value;

    /// Returns name and content of a file that rescues results if the script fails.
    fn remains(&self) -> Option<(String, String)>;
}

/// Maximum number of rescue files, so that a script with thousands of simulations ends soon after an interrupt.
const MOST_REMAINS: usize = 20;

/// All reporters of a run.
#[derive(Default)]
pub struct Reports(RefCell<Vec<Box<dyn Reporter>>>);

impl Reports {
    /// Adds a reporter.
    pub fn add(&self, reporter: Box<dyn Reporter>) {
        self.0.borrow_mut().push(reporter);
    }

    /// Distinct names and contents of the rescue files of the first simulations of a run, and a note if there are more.
    pub fn remains(&self) -> (Vec<(String, String)>, Option<String>) {
        let reporters = self.0.borrow();
        let mut names = HashSet::new();
        let mut remains = reporters.iter().filter_map(|reporter| reporter.remains());
        let named = |(number, (name, content)): (usize, (String, String))| {
            let taken = names.contains(&name);
            let name = if taken { format!("{}-{name}", number + 1) } else { name };
            names.insert(name.clone());
            (name, content)
        };
        let files = remains.by_ref().take(MOST_REMAINS).enumerate().map(named).collect();
        let (kept, all) = (MOST_REMAINS, reporters.len());
        let note = format!("note: the first {kept} of {all} simulations are kept");
        (files, remains.next().map(|_| note))
    }

    /// Drops all reporters.
    pub fn forget(&self) {
        self.0.borrow_mut().clear();
    }

    /// Returns the report entries and drops the reporters.
    pub fn take(&self) -> Vec<serde_json::Value> {
        self.0.take().into_iter().map(|reporter| reporter.report()).collect()
    }
}
