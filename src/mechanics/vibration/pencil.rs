//! Eigenvalue problem of undamped vibrations: stiffness and inertia of a configuration.

use super::VibrationError;
use super::elastic::{Elastic, FourVectors};
use crate::beams::SpanStiffness;
use crate::elementary::square;
use crate::linalg::{LinearError, PreciseBand, STRIP_WIDTH, SymmetricFactors, SymmetricSparse};
use crate::system::{StaticOrder, System, add_resistance};

/// Largest accepted growth factor of an elimination. With a larger growth factor, more than 12 of the 32 digits are lost.
const MOST_GROWTH: f64 = 1e12;

/// Eigenvalue problem `K φ = ω² M φ` with the stiffness `K` and the inertia `M` of a model, for modes `φ` of angular frequency `ω`.
pub(super) struct Pencil {
    stiffness: PreciseBand,
    pub(super) inertia: SymmetricSparse,
    pub(super) elastic: Elastic,
    pub(super) order: StaticOrder,
    /// Estimate of the squared frequency of the lowest bending mode, for scenes with beams [1/time²].
    /// For scenes without beams, the estimate is the squared frequency of the lowest vibration of a chain of the softest springs.
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

impl Pencil {
    pub(super) fn of(model: &System) -> Result<Self, VibrationError> {
        let order = model.static_order();
        let size = order.count();
        let mut stiffness = PreciseBand::zeros(size, order.half_bandwidth());
        let mut elastic = Elastic::default();
        let inertia = model.sparse_inertia(&order);
        let bending = model.slowest_bending();
        let masses: Vec<f64> = (0..size).map(|at| inertia.diagonal(at)).collect();
        let mut slowest = f64::INFINITY;
        model.for_each_static_span(&order, &mut |degrees, span| {
            add_resistance(&mut stiffness, degrees, span);
            elastic.add(size, degrees, span);
            if bending.is_none() {
                slowest = squared_frequencies(&masses, degrees, span).fold(slowest, f64::min);
            }
        });
        // Without stiffness, all frequencies are zero and any scale may be used.
        let of_springs = || Some(slowest / size as f64).filter(|scale| scale.is_finite());
        let scale = bending.or_else(of_springs).unwrap_or(1.0);
        let own: Vec<f64> = (0..size)
            .map(|at| stiffness.diagonal(at).abs() + scale * inertia.diagonal(at))
            .collect();
        model.for_each_static_constraint(&order, |at| own[at], &mut |degrees, span| {
            add_resistance(&mut stiffness, degrees, span);
            elastic.add(size, degrees, span);
        });
        let is_finite = (0..size)
            .all(|at| stiffness.diagonal(at).is_finite() && inertia.diagonal(at).is_finite());
        let finite = (0..size).filter(|at| inertia.diagonal(*at) > 0.0).count();
        let finite = finite.saturating_sub(model.constrained_movements(&order, &inertia));
        if !is_finite || !scale.is_normal() {
            return Err(VibrationError::NotFinite);
        }
        Ok(Self { stiffness, inertia, elastic, order, scale, finite })
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

    /// Factors of the stiffness plus `shift` times the inertia; `None` if the sum is not positive definite.
    pub(super) fn factors(&self, shift: f64) -> Option<SymmetricFactors> {
        let factors = self.stiffness.factorise(shift, &self.inertia).ok()?;
        (factors.pivots().negative == 0).then_some(factors)
    }

    /// Number of modes whose squared frequency is below `square`; `None` if the elimination is not reliable.
    /// The number of modes follows from the signs of pivots (Sylvester's law of inertia).
    pub(super) fn modes_below(&self, square: f64) -> Option<usize> {
        match self.stiffness.pivots(-square, &self.inertia) {
            Ok(pivots) if pivots.growth <= MOST_GROWTH => Some(pivots.negative),
            Ok(_) | Err(LinearError::Singular { .. } | LinearError::NotFinite { .. }) => None,
        }
    }

    pub(super) fn inertia_times(&self, x: &[FourVectors]) -> Vec<FourVectors> {
        let mut product = self.zeros();
        self.inertia.times(x, &mut product);
        product
    }
}
