//! Stiffness and inertia of a configuration, and their combination with a shift.

use nalgebra::DMatrix;

use super::VibrationError;
use crate::integrators::Mechanism;
use crate::linalg::{BandedMatrix, negative_eigenvalues};
use crate::model::Model;

/// `K φ = ω² M φ`
pub(super) struct Pencil {
    stiffness: BandedMatrix,
    inertia: BandedMatrix,
    /// The most that rounding may add to any `ω²`: `ε max K_ii/M_ii` [1/time²].
    pub(super) rounding: f64,
    /// Movements with inertia: so many modes have a finite frequency.
    pub(super) finite: usize,
}

impl Pencil {
    /// That of the present configuration of a model.
    pub(super) fn of(model: &mut Model) -> Result<Self, VibrationError> {
        let zeros = || BandedMatrix::zeros(model.unknowns(), model.half_bandwidth());
        let (mut stiffness, mut inertia) = (zeros(), zeros());
        model.add_stiffness(&mut stiffness);
        model.add_inertia_tangent(1.0, &mut inertia);
        let ratios = (0..model.unknowns()).filter_map(|at| {
            let mass = inertia.get(at, at);
            (mass > 0.0).then(|| stiffness.get(at, at).abs() / mass)
        });
        let (finite, largest) = ratios.fold((0, 0.0_f64), |(count, largest), ratio| {
            (count + 1, if ratio > largest || ratio.is_nan() { ratio } else { largest })
        });
        if !largest.is_finite() {
            return Err(VibrationError::NotFinite);
        }
        Ok(Self { stiffness, inertia, rounding: f64::EPSILON * largest, finite })
    }

    /// The number of unknowns.
    pub(super) fn size(&self) -> usize {
        self.stiffness.size()
    }

    /// The entries of `K` and `M` in the band: row, column and both values.
    pub(super) fn entries(&self) -> impl Iterator<Item = (usize, usize, f64, f64)> {
        let (size, reach) = (self.size(), self.stiffness.half_bandwidth());
        (0..size).flat_map(move |row| {
            (row.saturating_sub(reach)..(row + reach + 1).min(size)).map(move |column| {
                // Rounding differs on both sides of the diagonal.
                let mean = |of: &BandedMatrix| 0.5 * (of.get(row, column) + of.get(column, row));
                (row, column, mean(&self.stiffness), mean(&self.inertia))
            })
        })
    }

    /// `K + σ M`, to be factorised.
    pub(super) fn shifted_band(&self, shift: f64) -> BandedMatrix {
        let mut band = BandedMatrix::zeros(self.size(), self.stiffness.half_bandwidth());
        for (row, column, stiffness, inertia) in self.entries() {
            band.add(row, column, stiffness + shift * inertia);
        }
        band
    }

    /// What rounding may add to the `ω²` of a shape with `φᵀ M φ = 1`: `ε Σ |φ_i K_ij φ_j|` [1/time²].
    pub(super) fn rounding_of(&self, shape: &[f64]) -> f64 {
        let products =
            self.entries().map(|(row, column, k, _)| (shape[row] * k * shape[column]).abs());
        f64::EPSILON * products.sum::<f64>()
    }

    /// `K - σ M` has so many negative eigenvalues: as many modes have squares below `σ` (Sylvester's law of inertia).
    pub(super) fn modes_below(&self, square: f64) -> usize {
        negative_eigenvalues(&self.shifted_band(-square))
    }

    /// `M X`
    pub(super) fn inertia_times(&self, vectors: &DMatrix<f64>) -> DMatrix<f64> {
        self.times(vectors, |_, inertia| inertia)
    }

    /// `(K + σ M) X`
    pub(super) fn shifted_times(&self, shift: f64, vectors: &DMatrix<f64>) -> DMatrix<f64> {
        self.times(vectors, |stiffness, inertia| stiffness + shift * inertia)
    }

    fn times(&self, vectors: &DMatrix<f64>, entry: impl Fn(f64, f64) -> f64) -> DMatrix<f64> {
        let mut product = DMatrix::zeros(vectors.nrows(), vectors.ncols());
        for (row, column, stiffness, inertia) in self.entries() {
            let value = entry(stiffness, inertia);
            if value != 0.0 {
                for (of, mut out) in vectors.column_iter().zip(product.column_iter_mut()) {
                    out[row] += value * of[column];
                }
            }
        }
        product
    }
}
