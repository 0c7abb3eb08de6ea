//! Movements that are prescribed and not solved for.

/// What the prescribed movements of a mechanism do in the present step. They stand behind the unknown movements and the unknowns of constraints; where
/// nothing is prescribed, all are empty.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct PrescribedKinematics {
    /// The increments in the step, behind zeros for the unknowns of constraints [length, rad].
    pub increments: Vec<f64>,
    /// The rates at the end of the step, behind zeros for the unknowns of constraints [length/time, 1/time].
    pub rates: Vec<f64>,
    /// The mean accelerations `(v1 - v0)/Δt`, behind zeros for the unknowns of constraints [length/time², 1/time²].
    pub mean_accelerations: Vec<f64>,
    /// The accelerations just after the start and just before the end of the step, behind zeros for the unknowns of constraints [length/time², 1/time²].
    pub accelerations: [Vec<f64>; 2],
}

/// Which acceleration of prescribed movements a method balances.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum BalancedAt {
    /// The mean acceleration of the step.
    Mean,
    /// The acceleration at a time, as a share of the step from its start on.
    Share(f64),
}

impl PrescribedKinematics {
    /// Nothing that is prescribed, with room for `count` movements behind `constraints` unknowns of constraints.
    pub fn new(constraints: usize, count: usize) -> Self {
        let zeros = vec![0.0; if count > 0 { constraints + count } else { 0 }];
        Self {
            increments: zeros.clone(),
            rates: zeros.clone(),
            mean_accelerations: zeros.clone(),
            accelerations: [zeros.clone(), zeros],
        }
    }

    /// The number of entries that stand behind the unknown movements.
    pub fn width(&self) -> usize {
        self.increments.len()
    }

    /// The accelerations that a method balances, entry by entry.
    pub(super) fn balanced(&self, at: BalancedAt) -> impl Iterator<Item = f64> {
        let [start, end] = &self.accelerations;
        let all = self.mean_accelerations.iter().zip(start.iter().zip(end));
        all.map(move |(mean, (start, end))| match at {
            BalancedAt::Mean => *mean,
            BalancedAt::Share(share) => (1.0 - share) * start + share * end,
        })
    }
}
