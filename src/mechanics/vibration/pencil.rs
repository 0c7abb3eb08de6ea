//! Eigenvalue problems of a configuration: undamped vibrations and linear buckling.

use super::VibrationError;
use super::elastic::{Elastic, FourVectors};
use crate::beams::SpanStiffness;
use crate::elementary::square;
use crate::linalg::{LinearError, PreciseBand, STRIP_WIDTH, SymmetricFactors, SymmetricSparse};
use crate::system::{StaticOrder, System, add_resistance};

/// Largest accepted growth factor of an elimination. With a larger growth factor, more than 12 of the 32 digits are lost.
const MOST_GROWTH: f64 = 1e12;

/// Generalised eigenvalue problem `K φ = μ B φ` with the stiffness `K` of a model.
/// For modes, `μ = ω²` and `B` is the inertia. For buckling, `μ = λ` and `B = -K_g`.
pub(super) struct Pencil {
    stiffness: PreciseBand,
    pub(super) right_hand_matrix: SymmetricSparse,
    pub(super) elastic: Elastic,
    pub(super) order: StaticOrder,
    /// Estimate of the squared frequency of the lowest bending mode, for scenes with beams [1/time²].
    /// For scenes without beams, the estimate is the squared frequency of the lowest vibration of a chain of the softest springs.
    /// The scale is zero for buckling, which needs no shift.
    pub(super) scale: f64,
    /// Number of modes with a finite frequency: degrees of freedom with inertia, minus constraints.
    pub(super) finite: usize,
}

fn squared_frequencies(
    inertia: &[f64],
    degrees: &[usize],
    span: &SpanStiffness,
) -> impl Iterator<Item = f64> {
    span.stiffness.iter().zip(span.strains.chunks_exact(degrees.len())).filter_map(
        |(factor, row)| {
            let masses = degrees.iter().map(|at| inertia.get(*at).copied().unwrap_or(0.0));
            let shares = row.iter().zip(masses).filter(|(_, mass)| *mass > 0.0);
            let rate = factor * shares.map(|(strain, mass)| square(*strain) / mass).sum::<f64>();
            (rate > 0.0).then_some(rate)
        },
    )
}

/// Stiffness of a model as a matrix and in factored form.
struct StaticStiffness {
    matrix: PreciseBand,
    elastic: Elastic,
}

impl StaticStiffness {
    fn of_spans(
        model: &System,
        order: &StaticOrder,
        look: &mut dyn FnMut(&[usize], &SpanStiffness),
    ) -> Self {
        let mut matrix = PreciseBand::zeros(order.count(), order.half_bandwidth());
        let mut elastic = Elastic::default();
        model.for_each_static_span(order, &mut |degrees, span| {
            add_resistance(&mut matrix, degrees, span);
            elastic.add(order.count(), degrees, span);
            look(degrees, span);
        });
        Self { matrix, elastic }
    }

    /// Adds the constraints, whose penalty stiffness is a multiple of the largest of the stiffnesses `own`.
    fn add_constraints(&mut self, model: &System, order: &StaticOrder, own: &[f64]) {
        model.for_each_static_constraint(order, |at| own[at], &mut |degrees, span| {
            add_resistance(&mut self.matrix, degrees, span);
            self.elastic.add(order.count(), degrees, span);
        });
    }

    fn is_finite(&self) -> bool {
        (0..self.matrix.size()).all(|at| self.matrix.diagonal(at).is_finite())
    }
}

impl Pencil {
    pub(super) fn of(model: &System) -> Result<Self, VibrationError> {
        let order = model.static_order();
        let size = order.count();
        let inertia = model.sparse_inertia(&order);
        let bending = model.slowest_bending();
        let masses: Vec<f64> = (0..size).map(|at| inertia.diagonal(at)).collect();
        let mut slowest = f64::INFINITY;
        let mut static_stiffness =
            StaticStiffness::of_spans(model, &order, &mut |degrees, span| {
                if bending.is_none() {
                    slowest = squared_frequencies(&masses, degrees, span).fold(slowest, f64::min);
                }
            });
        // Without stiffness, all frequencies are zero and any scale may be used.
        let of_springs = || Some(slowest / size as f64).filter(|scale| scale.is_finite());
        let scale = bending.or_else(of_springs).unwrap_or(1.0);
        let own: Vec<f64> = (0..size)
            .map(|at| static_stiffness.matrix.diagonal(at).abs() + scale * masses[at])
            .collect();
        static_stiffness.add_constraints(model, &order, &own);
        let is_finite = static_stiffness.is_finite() && masses.iter().all(|mass| mass.is_finite());
        let finite = masses.iter().filter(|mass| **mass > 0.0).count();
        let finite = finite.saturating_sub(model.constrained_movements(&order, &inertia));
        if !is_finite || !scale.is_normal() {
            return Err(VibrationError::NotFinite);
        }
        let StaticStiffness { matrix: stiffness, elastic } = static_stiffness;
        Ok(Self { stiffness, right_hand_matrix: inertia, elastic, order, scale, finite })
    }

    /// Eigenvalue problem of buckling. The matrix `B` is zero until it is set by [`with_right_hand_matrix`](Self::with_right_hand_matrix),
    /// because the section forces for `B` are computed with the stiffness.
    pub(super) fn of_stiffness(model: &System) -> Result<Self, VibrationError> {
        let order = model.static_order();
        let mut static_stiffness = StaticStiffness::of_spans(model, &order, &mut |_, _| ());
        let own: Vec<f64> =
            (0..order.count()).map(|at| static_stiffness.matrix.diagonal(at).abs()).collect();
        static_stiffness.add_constraints(model, &order, &own);
        if !static_stiffness.is_finite() {
            return Err(VibrationError::NotFinite);
        }
        let StaticStiffness { matrix: stiffness, elastic } = static_stiffness;
        let right_hand_matrix = SymmetricSparse::new(order.count(), |_| ());
        let finite = order.count();
        Ok(Self { stiffness, right_hand_matrix, elastic, order, scale: 0.0, finite })
    }

    /// Replaces the matrix `B`.
    pub(super) fn with_right_hand_matrix(self, right_hand_matrix: SymmetricSparse) -> Self {
        Self { right_hand_matrix, ..self }
    }

    /// Approximate memory for the eigenvalue problem of a model [bytes].
    pub(super) fn memory(model: &System) -> usize {
        let order = model.static_order();
        let (size, reach) = (order.count(), order.half_bandwidth() + 1);
        size * reach * 8 * size_of::<f64>() + Elastic::memory(2 * size, reach)
    }

    pub(super) fn size(&self) -> usize {
        self.stiffness.size()
    }

    pub(super) fn length(&self) -> usize {
        self.size() + self.stiffness.half_bandwidth().max(1)
    }

    pub(super) fn zeros(&self) -> Vec<FourVectors> {
        vec![[0.0; STRIP_WIDTH]; self.length()]
    }

    /// Factors of `K + shift B`; `None` if the sum is not positive definite.
    pub(super) fn factors(&self, shift: f64) -> Option<SymmetricFactors> {
        let factors = self.stiffness.factorise(shift, &self.right_hand_matrix).ok()?;
        (factors.pivots().negative == 0).then_some(factors)
    }

    /// Number of eigenvalues below `value`, for buckling the number between 0 and `value`; `None` if the elimination is not reliable.
    /// The number follows from the signs of pivots (Sylvester's law of inertia).
    pub(super) fn eigenvalues_below(&self, value: f64) -> Option<usize> {
        match self.stiffness.pivots(-value, &self.right_hand_matrix) {
            Ok(pivots) if pivots.growth <= MOST_GROWTH => Some(pivots.negative),
            Ok(_) | Err(LinearError::Singular { .. } | LinearError::NotFinite { .. }) => None,
        }
    }

    pub(super) fn right_hand_times(&self, x: &[FourVectors]) -> Vec<FourVectors> {
        let mut product = self.zeros();
        self.right_hand_matrix.times(x, &mut product);
        product
    }
}
