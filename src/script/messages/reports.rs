//! Report entries of simulations, and rescue files with their results if a run is stopped.

use std::cell::RefCell;
use std::collections::HashSet;

use rhai::Dynamic;

/// Object that contributes to the report of a run, such as a simulation.
pub trait Reporter {
    /// Entry of the object in the report. Called when the run ends, for any reason, or when the object is released.
    fn report(&self) -> serde_json::Value;

    /// Script value of the object.
    fn object(&self) -> Dynamic;

    /// True if the script can still reach the object.
    fn is_in_use(&self) -> bool;

    /// Name and content of a rescue file with about `numbers` values; `None` if there is nothing to save.
    fn remains(&self, numbers: usize) -> Option<(String, String)>;
}

const MOST_REMAINS: usize = 20;

const MOST_NUMBERS: usize = 1_000_000;
/// Largest length of a number and its separator in a rescue file [bytes].
const LONGEST_NUMBER: u64 = 26;

/// Smallest number of objects at which objects out of use are released.
const MANY: usize = 100;

/// All objects that contribute to the report of a run, in the order of their start.
///
/// Scripts may run thousands of simulations. Of a simulation that the script can no longer reach, only the report entry is kept.
/// The first [`MOST_REMAINS`] objects are always kept, because they are saved if the script fails.
#[derive(Default)]
pub struct Reports(RefCell<Entries>);

#[derive(Default)]
struct Entries {
    all: Vec<Entry>,
    /// Number of entries at which objects out of use are released next.
    full: usize,
}

enum Entry {
    Object(Box<dyn Reporter>),
    Released(serde_json::Value),
}

impl Entries {
    fn objects(&self) -> impl Iterator<Item = &dyn Reporter> {
        self.all.iter().filter_map(|entry| match entry {
            Entry::Object(object) => Some(object.as_ref()),
            Entry::Released(_) => None,
        })
    }

    fn release(&mut self) {
        for entry in self.all.iter_mut().skip(MOST_REMAINS) {
            if let Entry::Object(object) = entry
                && !object.is_in_use()
            {
                *entry = Entry::Released(object.report());
            }
        }
        self.full = self.all.len() + MANY.max(self.objects().count());
    }
}

impl Reports {
    /// Adds an object that contributes to the report.
    pub fn add(&self, reporter: Box<dyn Reporter>) {
        let mut entries = self.0.borrow_mut();
        entries.all.push(Entry::Object(reporter));
        if entries.all.len() >= entries.full.max(MANY) {
            entries.release();
        }
    }

    /// Unique names and contents of the rescue files for the first simulations of a run, about `bytes` in total.
    /// The second value is a note if there are more simulations.
    pub fn remains(&self, bytes: u64) -> (Vec<(String, String)>, Option<String>) {
        let entries = self.0.borrow();
        let all = entries.all.len();
        let numbers = usize::try_from(bytes / LONGEST_NUMBER).unwrap_or(MOST_NUMBERS);
        let numbers = numbers.min(MOST_NUMBERS) / all.clamp(1, MOST_REMAINS);
        let mut names = HashSet::new();
        let mut remains = entries.objects().filter_map(|reporter| reporter.remains(numbers));
        let named = |(number, (name, content)): (usize, (String, String))| {
            let taken = names.contains(&name);
            let name = if taken { format!("{}-{name}", number + 1) } else { name };
            names.insert(name.clone());
            (name, content)
        };
        let files = remains.by_ref().take(MOST_REMAINS).enumerate().map(named).collect();
        let note = format!("note: the first {MOST_REMAINS} of {all} simulations are kept");
        (files, remains.next().map(|_| note))
    }

    /// Script values of all objects that are not released.
    pub fn objects(&self) -> Vec<Dynamic> {
        self.0.borrow().objects().map(|reporter| reporter.object()).collect()
    }

    /// Number of released objects.
    pub fn released(&self) -> usize {
        let entries = self.0.borrow();
        entries.all.len() - entries.objects().count()
    }

    /// Removes all objects.
    pub fn clear(&self) {
        self.0.take();
    }

    /// Report entries of all objects. The objects are removed.
    pub fn take(&self) -> Vec<serde_json::Value> {
        let entries = self.0.take().all.into_iter();
        let reports = entries.map(|entry| match entry {
            Entry::Object(object) => object.report(),
            Entry::Released(report) => report,
        });
        reports.collect()
    }
}

#[cfg(test)]
mod tests {
    use std::rc::Rc;

    use super::*;

    struct Numbered(usize, Rc<()>);

    impl Reporter for Numbered {
        fn report(&self) -> serde_json::Value {
            self.0.into()
        }

        fn object(&self) -> Dynamic {
            Dynamic::UNIT
        }

        fn is_in_use(&self) -> bool {
            Rc::strong_count(&self.1) > 1
        }

        fn remains(&self, _: usize) -> Option<(String, String)> {
            Some(("name".to_owned(), self.0.to_string()))
        }
    }

    #[test]
    fn unused_objects_are_released_but_reported() {
        let reports = Reports::default();
        let used = Rc::new(());
        for number in 0..1000 {
            let handle = if number == 500 { Rc::clone(&used) } else { Rc::default() };
            reports.add(Box::new(Numbered(number, handle)));
        }
        let objects = reports.objects().len();
        assert!((MOST_REMAINS + 1..MOST_REMAINS + 1 + MANY).contains(&objects), "{objects}");
        assert_eq!(objects + reports.released(), 1000);
        let (files, note) = reports.remains(1_000_000);
        assert_eq!((files.len(), files[19].1.as_str()), (MOST_REMAINS, "19"));
        assert_eq!(note.unwrap(), "note: the first 20 of 1000 simulations are kept");
        let numbers = reports.take();
        assert!(numbers.into_iter().eq((0..1000).map(serde_json::Value::from)));
    }
}
