//! When springs are struck, seen by two half steps and by a whole one.

use crate::geometry::larger;
use crate::system::{Along, Branch, System};

/// The branches of laws with sharp corners along a step that is taken as a whole and in halves.
///
/// A step that ends just within a stiff bumper ends at its face, whenever it got there: places tell nothing of how late the blow is. Rates do, as what
/// strikes has been turned round or has not. Where a spring changes its branch in a step, the difference of rates counts as the way that it
/// makes in one more step.
#[derive(Default)]
pub(super) struct CornerCrossings {
    start: Vec<Branch>,
    middle: Vec<Branch>,
    whole: Vec<Branch>,
    halves: Vec<Branch>,
}

impl CornerCrossings {
    /// Looks at a model at the start of a step.
    pub(super) fn look_at_start(&mut self, model: &System) {
        model.write_branches(&mut self.start);
    }

    /// Looks at it at the end of the whole step.
    pub(super) fn look_at_whole(&mut self, model: &System) {
        model.write_branches(&mut self.whole);
    }

    /// Looks at it between the half steps.
    pub(super) fn look_at_middle(&mut self, model: &System) {
        model.write_branches(&mut self.middle);
    }

    /// Looks at it at the end of both half steps.
    pub(super) fn look_at_halves(&mut self, model: &System) {
        model.write_branches(&mut self.halves);
    }

    /// How far whole step and halves of some duration [time] are apart by what has been struck in them, relative to a length, or in rad [-].
    pub(super) fn apart(&self, duration: f64, length: f64) -> f64 {
        let ends = self.whole.iter().zip(&self.halves);
        let all = self.start.iter().zip(&self.middle).zip(ends);
        let apart =
            |((start, middle), (whole, halves)): ((&Branch, &Branch), (&Branch, &Branch))| {
                let is_struck = [middle, whole, halves].iter().any(|at| at.index != start.index);
                let way = duration * (whole.rate - halves.rate).abs();
                match whole.along {
                    _ if !is_struck => 0.0,
                    Along::Length => way / length,
                    Along::Angle => way,
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
    fn rates_count_where_a_branch_changes() {
        let (start, middle) = (branch(1, -2.0), branch(1, -2.0));
        let mut blows =
            CornerCrossings { start, middle, whole: branch(1, -2.0), halves: branch(1, -2.5) };
        assert_eq!(blows.apart(0.5, 4.0), 0.0);
        blows.whole = branch(0, 1.5);
        assert_eq!(blows.apart(0.5, 4.0), 0.5);
        blows.whole[0].along = Along::Angle;
        assert_eq!(blows.apart(0.5, 4.0), 2.0);
    }
}
