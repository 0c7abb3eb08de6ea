//! Report entries of simulations, and rescue files with their results if a run is stopped.

use std::cell::RefCell;
use std::collections::HashSet;

use rhai::Dynamic;

/// Object that contributes to the report of a run, such as a simulation.
pub trait Reporter {
    /// Entry of the object in the report. Called when the run ends, for any reason.
    fn report(&self) -> serde_json::Value;

    /// Script value of the object.
    fn object(&self) -> Dynamic;

    /// Name and content of a rescue file with about `numbers` values; `None` if there is nothing to save.
    fn remains(&self, numbers: usize) -> Option<(String, String)>;
}

const MOST_REMAINS: usize = 20;

const MOST_NUMBERS: usize = 1_000_000;
/// Largest length of a number and its separator in a rescue file [bytes].
const LONGEST_NUMBER: u64 = 26;

/// All objects that contribute to the report of a run.
#[derive(Default)]
pub struct Reports(RefCell<Vec<Box<dyn Reporter>>>);

impl Reports {
    /// Adds an object that contributes to the report.
    pub fn add(&self, reporter: Box<dyn Reporter>) {
        self.0.borrow_mut().push(reporter);
    }

    /// Unique names and contents of the rescue files for the first simulations of a run, about `bytes` in total.
    pub fn remains(&self, bytes: u64) -> (Vec<(String, String)>, Option<String>) {
        let reporters = self.0.borrow();
        let numbers = usize::try_from(bytes / LONGEST_NUMBER).unwrap_or(MOST_NUMBERS);
        let numbers = numbers.min(MOST_NUMBERS) / reporters.len().clamp(1, MOST_REMAINS);
        let mut names = HashSet::new();
        let mut remains = reporters.iter().filter_map(|reporter| reporter.remains(numbers));
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

    /// Script values of all objects that contribute to the report.
    pub fn objects(&self) -> Vec<Dynamic> {
        self.0.borrow().iter().map(|reporter| reporter.object()).collect()
    }

    /// Removes all objects.
    pub fn clear(&self) {
        self.0.borrow_mut().clear();
    }

    /// Report entries of all objects. The objects are removed.
    pub fn take(&self) -> Vec<serde_json::Value> {
        self.0.take().into_iter().map(|reporter| reporter.report()).collect()
    }
}
