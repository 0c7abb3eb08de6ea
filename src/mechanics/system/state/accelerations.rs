//! Accelerations of a mechanism, for integrators whose state contains accelerations.

/// Accelerations of the unknowns at the start of a step; empty if the integrator does not need them.
#[derive(Debug, Clone, Default)]
pub struct Accelerations {
    values: Vec<f64>,
    are_known: bool,
}

impl Accelerations {
    /// Allocates entries for the accelerations of `unknowns` unknowns. The values are not valid until they are set.
    pub fn allocate(&mut self, unknowns: usize) {
        *self = Self { values: vec![0.0; unknowns], are_known: false };
    }

    pub fn resize(&mut self, unknowns: usize) {
        if !self.values.is_empty() {
            self.allocate(unknowns);
        }
    }

    pub fn known(&self) -> Option<&[f64]> {
        self.are_known.then_some(&self.values)
    }

    pub fn set(&mut self, values: &[f64]) {
        if !self.values.is_empty() {
            self.values.copy_from_slice(values);
            self.are_known = true;
        }
    }

    pub fn mark_unknown(&mut self) {
        self.values.fill(0.0);
        self.are_known = false;
    }

    pub fn are_known(&self) -> bool {
        self.are_known
    }

    pub fn save(&self, numbers: &mut Vec<f64>) {
        numbers.extend(&self.values);
    }

    pub fn restore(&mut self, are_known: bool, next: &mut dyn FnMut() -> f64) {
        self.are_known = are_known && !self.values.is_empty();
        self.values.iter_mut().for_each(|value| *value = next());
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn unallocated_accelerations_are_not_saved() {
        let mut accelerations = Accelerations::default();
        accelerations.set(&[1.0]);
        let mut state = Vec::new();
        accelerations.save(&mut state);
        assert_eq!((accelerations.known(), state.len()), (None, 0));
    }

    #[test]
    fn accelerations_are_known_after_set_or_restore() {
        let mut accelerations = Accelerations::default();
        accelerations.allocate(2);
        assert_eq!(accelerations.known(), None);
        accelerations.set(&[1.0, -2.0]);
        let mut state = Vec::new();
        accelerations.save(&mut state);
        accelerations.mark_unknown();
        assert_eq!(accelerations.known(), None);
        let mut numbers = state.into_iter();
        accelerations.restore(true, &mut || numbers.next().unwrap());
        assert_eq!(accelerations.known(), Some(&[1.0, -2.0][..]));
    }
}
