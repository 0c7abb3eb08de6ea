//! Crossings of sharp corners of spring laws, which contribute to the error estimate by step doubling.

use crate::geometry::larger;
use crate::system::{Along, Branch, System};

/// Linear segments of the laws of springs with sharp corners, at the start, in the middle and at the end of a step.
///
/// A whole step and its two halves may give nearly equal positions but different impact times with a stiff bumper.
/// If a spring changes its segment in a step, the error estimate is at least the step length times the difference
/// of the rates of the elongation after the whole step and after the two half steps.
#[derive(Default)]
pub(super) struct CornerCrossings {
    start: Vec<Branch>,
    middle: Vec<Branch>,
    whole: Vec<Branch>,
    halves: Vec<Branch>,
}

impl CornerCrossings {
    pub(super) fn record_start(&mut self, model: &System) {
        model.write_branches(&mut self.start);
    }

    pub(super) fn record_whole_step(&mut self, model: &System) {
        model.write_branches(&mut self.whole);
    }

    pub(super) fn record_middle(&mut self, model: &System) {
        model.write_branches(&mut self.middle);
    }

    pub(super) fn record_half_steps(&mut self, model: &System) {
        model.write_branches(&mut self.halves);
    }

    pub(super) fn difference(&self, duration: f64, length: f64) -> f64 {
        let ends = self.whole.iter().zip(&self.halves);
        let all = self.start.iter().zip(&self.middle).zip(ends);
        let apart =
            |((start, middle), (whole, halves)): ((&Branch, &Branch), (&Branch, &Branch))| {
                let is_struck = [middle, whole, halves].iter().any(|at| at.index != start.index);
                let displacement = duration * (whole.rate - halves.rate).abs();
                match whole.along {
                    _ if !is_struck => 0.0,
                    Along::Length => displacement / length,
                    Along::Angle => displacement,
                }
            };
        all.map(apart).fold(0.0, larger)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn branch(index: usize, rate: f64) -> Vec<Branch> {
        vec![Branch { index, rate, along: Along::Length }]
    }

    #[test]
    fn crossing_difference_is_nonzero_only_if_a_branch_changes() {
        let (start, middle) = (branch(1, -2.0), branch(1, -2.0));
        let mut crossings =
            CornerCrossings { start, middle, whole: branch(1, -2.0), halves: branch(1, -2.5) };
        assert_eq!(crossings.difference(0.5, 4.0), 0.0);
        crossings.whole = branch(0, 1.5);
        assert_eq!(crossings.difference(0.5, 4.0), 0.5);
        crossings.whole[0].along = Along::Angle;
        assert_eq!(crossings.difference(0.5, 4.0), 2.0);
    }
}
