//! Degrees of freedom of a body.

use std::ops::{Deref, Range};

use crate::beams::Movement;

/// Degrees of freedom of a body: three for each control point. The type dereferences to a slice.
#[derive(Debug, Clone, Default)]
pub struct DegreesOfFreedom {
    numbers: Vec<[usize; 3]>,
    runs: Vec<DofRun>,
}

#[derive(Debug, Clone)]
struct DofRun {
    movements: Range<usize>,
    first: usize,
}

impl From<Vec<[usize; 3]>> for DegreesOfFreedom {
    fn from(numbers: Vec<[usize; 3]>) -> Self {
        let mut begin = 0;
        let run = |run: &[usize]| {
            let movements = begin..begin + run.len();
            begin = movements.end;
            DofRun { movements, first: run[0] }
        };
        let runs = numbers.as_flattened().chunk_by(|a, b| *b == *a + 1).map(run).collect();
        Self { numbers, runs }
    }
}

impl Deref for DegreesOfFreedom {
    type Target = [[usize; 3]];

    fn deref(&self) -> &[[usize; 3]] {
        &self.numbers
    }
}

impl DegreesOfFreedom {
    /// Gathers values by control point. Degrees of freedom without a value receive zero.
    pub fn gather(&self, values: &[f64], moved: &mut [Movement]) {
        let moved = moved.as_flattened_mut();
        for DofRun { movements, first } in &self.runs {
            let moved = &mut moved[movements.clone()];
            let known = values.get(*first..).unwrap_or_default();
            let (there, missing) = moved.split_at_mut(known.len().min(moved.len()));
            there.copy_from_slice(&known[..there.len()]);
            missing.fill(0.0);
        }
    }

    pub fn below(&self, unknowns: usize) -> Vec<usize> {
        self.numbers.as_flattened().iter().copied().filter(|number| *number < unknowns).collect()
    }

    /// Adds nodal forces to `out` and resets the nodal forces to zero.
    pub fn scatter(&self, forces: &mut [Movement], out: &mut [f64]) {
        let forces = forces.as_flattened_mut();
        for DofRun { movements, first } in &self.runs {
            let forces = &mut forces[movements.clone()];
            let out = &mut out[*first..*first + forces.len()];
            for (out, force) in out.iter_mut().zip(forces) {
                *out += std::mem::take(force);
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn gather_and_scatter_follow_the_unknown_numbers() {
        let numbers = vec![[9, 10, 0], [1, 2, 3], [7, 5, 6], [3, 4, 8]];
        let degrees = DegreesOfFreedom::from(numbers.clone());
        assert_eq!(degrees.runs.len(), 6);
        let values: Vec<f64> = (0..10).map(|at| f64::from(at) + 0.5).collect();
        let mut moved = vec![[f64::NAN; 3]; 4];
        degrees.gather(&values, &mut moved);
        let expected =
            numbers.iter().map(|row| row.map(|at| values.get(at).copied().unwrap_or(0.0)));
        assert_eq!(moved, expected.collect::<Vec<_>>());

        let mut out = vec![1.0; 11];
        degrees.scatter(&mut moved, &mut out);
        assert_eq!(out, [1.5, 2.5, 3.5, 8.0, 5.5, 6.5, 7.5, 8.5, 9.5, 10.5, 1.0]);
        assert!(moved.as_flattened().iter().all(|force| *force == 0.0));
    }
}
