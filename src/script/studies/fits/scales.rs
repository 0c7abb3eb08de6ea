//! Scaling of the results of a design to order one, with an objective to be minimised and nonnegative constraints.

use std::cell::Cell;

use super::design::{Limit, Objective};
use crate::fitting::{Rating, SlopedRating, SlopesOfRating};

pub(super) struct ResultScales<'s> {
    goal: &'s Objective,
    at: usize,
    limits: &'s [(usize, &'s Limit)],
    size: Cell<Option<f64>>,
}

impl<'s> ResultScales<'s> {
    pub(super) fn of(goal: &'s Objective, at: usize, limits: &'s [(usize, &'s Limit)]) -> Self {
        Self { goal, at, limits, size: Cell::new(None) }
    }

    fn divisor(&self, goal: f64) -> f64 {
        let own = Some(goal.abs()).filter(|size| *size > 0.0).unwrap_or(1.0);
        let size = self.size.get().unwrap_or(own);
        self.size.set(Some(size));
        match self.goal {
            Objective::Least(_) => size,
            Objective::Largest(_) => -size,
        }
    }

    pub(super) fn rating(&self, numbers: &[f64]) -> Rating {
        let distances = self.limits.iter().flat_map(|(at, limit)| limit.distances(numbers[*at]));
        let objective = numbers[self.at] / self.divisor(numbers[self.at]);
        Rating { objective, constraints: distances.collect() }
    }

    pub(super) fn with_slopes(&self, rows: Vec<(f64, Vec<f64>)>, results: usize) -> SlopesOfRating {
        if rows.len() != results {
            return Err("it returns different results".into());
        }
        let (numbers, slopes): (Vec<f64>, Vec<Vec<f64>>) = rows.into_iter().unzip();
        let wanted = || self.limits.iter().map(|(at, _)| *at).chain([self.at]);
        let parameters = slopes.first().map_or(0, Vec::len);
        // Zero derivatives are errors in the first run only; later they may indicate the optimum.
        let begins = self.size.get().is_none();
        if begins && (0..parameters).any(|by| wanted().all(|at| slopes[at][by] == 0.0)) {
            return Err("all derivatives by a parameter are zero".into());
        }
        if !wanted().all(|at| slopes[at].iter().all(|slope| slope.is_finite())) {
            return Err("a derivative is not finite".into());
        }
        let divisor = self.divisor(numbers[self.at]);
        let constraints = self.limits.iter().flat_map(|(at, limit)| limit.slopes(&slopes[*at]));
        Ok(SlopedRating {
            rating: self.rating(&numbers),
            objective: slopes[self.at].iter().map(|slope| slope / divisor).collect(),
            constraints: constraints.collect(),
        })
    }
}
