//! Script functions that are called at given times of a simulation.

#[derive(Clone)]
pub struct Events<F> {
    functions: Vec<(f64, F)>,
    called: usize,
}

impl<F> Default for Events<F> {
    fn default() -> Self {
        Self { functions: Vec::new(), called: 0 }
    }
}

impl<F: Clone> Events<F> {
    pub fn insert(&mut self, time: f64, function: F) {
        let place = self.functions.partition_point(|(other, _)| *other <= time);
        self.functions.insert(place.max(self.called), (time, function));
    }

    pub fn next_time(&self) -> Option<f64> {
        self.functions.get(self.called).map(|(time, _)| *time)
    }

    pub fn take_due(&mut self, now: f64) -> Option<F> {
        let (_, due) = self.functions.get(self.called).filter(|(time, _)| *time <= now)?;
        self.called += 1;
        Some(due.clone())
    }

    pub fn all(&self) -> &[(f64, F)] {
        &self.functions
    }

    /// Marks the functions with times after `now` as not yet called, after the simulation was rewound to `now`.
    pub fn reschedule_after(&mut self, now: f64) {
        let passed = self.functions.partition_point(|(time, _)| *time <= now);
        self.called = self.called.min(passed);
    }

    pub fn waiting(&self) -> usize {
        self.functions.len() - self.called
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn names(events: &mut Events<&'static str>, now: f64) -> Vec<&'static str> {
        std::iter::from_fn(|| events.take_due(now)).collect()
    }

    #[test]
    fn rescheduled_events_are_called_again() {
        let mut events = Events::default();
        for (time, name) in [(2.0, "second"), (1.0, "first"), (2.0, "third")] {
            events.insert(time, name);
        }
        assert_eq!(names(&mut events, 2.5), ["first", "second", "third"]);
        assert_eq!((events.next_time(), events.waiting()), (None, 0));
        events.reschedule_after(1.0);
        assert_eq!((events.next_time(), events.waiting()), (Some(2.0), 2));
        assert_eq!(names(&mut events, 1.5), Vec::<&str>::new());
        assert_eq!(names(&mut events, 2.0), ["second", "third"]);
    }
}
