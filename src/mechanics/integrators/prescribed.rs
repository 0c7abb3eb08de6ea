//! Prescribed motions of degrees of freedom, which are not unknowns.

/// Prescribed motions of a mechanism in the present step, numbered after the unknowns and the constraint multipliers.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct PrescribedKinematics {
    /// Increments in the step [length, rad]. The entries for constraint multipliers come first and are zero.
    pub increments: Vec<f64>,
    /// Rates at the end of the step [length/time, 1/time].
    pub rates: Vec<f64>,
    /// Mean accelerations `(v1 - v0)/Δt` over the step of duration `Δt` [length/time², 1/time²].
    pub mean_accelerations: Vec<f64>,
    /// Accelerations just after the start and just before the end of the step [length/time², 1/time²].
    pub accelerations: [Vec<f64>; 2],
}

#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum BalancedAt {
    Mean,
    Fraction(f64),
}

impl PrescribedKinematics {
    /// Creates vectors of zeros: `constraints` entries for the multipliers, followed by `count` entries for prescribed degrees of freedom.
    pub fn new(constraints: usize, count: usize) -> Self {
        let zeros = vec![0.0; if count > 0 { constraints + count } else { 0 }];
        Self {
            increments: zeros.clone(),
            rates: zeros.clone(),
            mean_accelerations: zeros.clone(),
            accelerations: [zeros.clone(), zeros],
        }
    }

    /// Number of entries for constraint multipliers and prescribed degrees of freedom; zero without prescribed motions.
    pub fn width(&self) -> usize {
        self.increments.len()
    }

    pub(super) fn balanced(&self, at: BalancedAt) -> impl Iterator<Item = f64> {
        let [start, end] = &self.accelerations;
        let all = self.mean_accelerations.iter().zip(start.iter().zip(end));
        all.map(move |(mean, (start, end))| match at {
            BalancedAt::Mean => *mean,
            BalancedAt::Fraction(share) => (1.0 - share) * start + share * end,
        })
    }
}
