//! Linear buckling: load factors at which the stiffness is singular to first order in the loads (docs/theory.md, section 14.3).

use nalgebra::{DMatrix, SymmetricEigen};

use super::VibrationError;
use super::elastic::{FourVectors, Shapes};
use super::lanczos::{Pairs, SymmetricOperator};
use super::pencil::Pencil;
use super::refinement::refine;
use super::search::{LARGEST_RESIDUAL, ModeSearch, counted_pairs};
use crate::beams::{SpanStiffness, StrainKind};
use crate::elementary::hypot;
use crate::integrators::Mechanism;
use crate::linalg::{STRIP_WIDTH, SymmetricFactors, SymmetricSparse, VectorStrip};
use crate::system::System;

/// Smallest eigenvalue `1/λ` that is not attributed to rounding, as a fraction of the largest absolute eigenvalue.
const SMALLEST: f64 = 1e-10;

/// Largest strain at which a critical load is reported [-].
/// Under a tension of the size of the shear stiffness, the equations of the beam have a critical load that no real beam has.
const LARGEST_STRAIN: f64 = 0.5;

/// Largest ratio of the energy of a correction to the energy of the linear displacement that ends the refinement of the section forces.
const REFINED: f64 = 1e-30;

const MOST_CORRECTIONS: usize = 10;

/// Critical load of linear buckling, with its shape.
#[derive(Debug, Clone, PartialEq)]
pub struct CriticalLoad {
    /// Load factor [-]: multiple of the loads at which the stiffness is singular.
    pub factor: f64,
    /// Residual of factor and shape [-]: square root of the energy of a correction of the shape, divided by the energy of the shape.
    /// The relative error of the factor is about the square of the residual.
    pub residual: f64,
    /// Buckling shape: values of the unknowns, in any scale [length, rad].
    pub shape: Vec<f64>,
}

pub(crate) struct CriticalLoads {
    pub(crate) critical: Vec<CriticalLoad>,
    /// Displacement under the loads to first order [length, rad].
    pub(crate) displacement: Vec<f64>,
}

/// Smallest positive critical loads of a model at rest without loads, in increasing order.
/// The argument `loads` contains the forces on the unknowns at load factor 1.
/// The result is `None` if the stiffness without loads is not positive definite.
pub(crate) fn critical_loads(
    model: &System,
    loads: &[f64],
    count: usize,
    goes_on: &mut dyn FnMut() -> bool,
) -> Result<Option<CriticalLoads>, VibrationError> {
    let pencil = Pencil::of_stiffness(model)?;
    let Some(factors) = pencil.factors(0.0) else { return Ok(None) };
    let linear = linear_displacement(&pencil, &factors, loads);
    let displacement = linear.movements[..pencil.size()].iter().map(|row| row[0]).collect();
    let displacement = pencil.order.to_step_order(displacement, model.unknowns());
    let LoadEffect { decrease, strain } = load_effect(model, &pencil, &linear.first_forces());
    let pencil = pencil.with_right_hand_matrix(decrease);
    let operator = BucklingOperator { pencil: &pencil, factors: &factors, strain };
    let sought = count.min(pencil.size());
    let pairs = match ModeSearch::of(pencil.size(), sought) {
        ModeSearch::All => operator.all_pairs(),
        ModeSearch::Lowest => counted_pairs(&pencil, 0.0, &operator, sought, goes_on)?,
    };
    let least = strain / LARGEST_STRAIN;
    let available = pairs.values.iter().filter(|value| **value > least).count();
    if available < count {
        return Err(VibrationError::FewEigenvalues { requested: count, available });
    }
    let pairs = operator.to_shapes(pairs);
    let mut found = Vec::with_capacity(count);
    for pair in refine(&pencil, &factors, 0.0, &pairs, count, goes_on)? {
        let residual = pair.residual;
        if !(residual <= LARGEST_RESIDUAL && pair.square.is_finite()) {
            return Err(VibrationError::BelowRounding { modes: found.len(), residual });
        }
        let shape = pencil.order.to_step_order(pair.shape, model.unknowns());
        found.push(CriticalLoad { factor: pair.square, residual, shape });
    }
    found.sort_by(|a, b| a.factor.total_cmp(&b.factor));
    Ok(Some(CriticalLoads { critical: found, displacement }))
}

/// Displacement under the loads to first order, with its section forces and constraint forces.
/// Section forces are unknowns in addition to the displacements, so that their rounding errors do not depend on the stiffnesses.
fn linear_displacement(pencil: &Pencil, factors: &SymmetricFactors, loads: &[f64]) -> Shapes {
    let mut external = pencil.zeros();
    for (unknown, load) in loads.iter().enumerate() {
        external[pencil.order.place(unknown)][0] = *load;
    }
    let mut shapes = pencil.elastic.room(pencil.length());
    for _ in 0..MOST_CORRECTIONS {
        let mut correction = external.clone();
        for (left, internal) in correction.iter_mut().zip(&shapes.internal_forces) {
            left.iter_mut().zip(internal).for_each(|(left, internal)| *left -= internal);
        }
        correction[pencil.size()..].fill([0.0; STRIP_WIDTH]);
        factors.solve(&mut correction);
        let energies = pencil.elastic.correct(&mut shapes, &correction);
        if energies.correction[0] <= REFINED * energies.double_energy[0] {
            break;
        }
    }
    shapes
}

/// Effect of the loads on the stiffness, to first order.
struct LoadEffect {
    /// Decrease of the stiffness per load factor: minus the second derivatives of all strains, times their forces.
    decrease: SymmetricSparse,
    /// Largest section force per load factor, divided by the smaller of axial and shear stiffness [-].
    strain: f64,
}

fn load_effect(model: &System, pencil: &Pencil, forces: &[f64]) -> LoadEffect {
    let (order, size) = (&pencil.order, pencil.size());
    let mut entries: Vec<(usize, usize, f64)> = Vec::new();
    let (mut first, mut strain) = (0, 0.0_f64);
    let mut add = |degrees: &[usize], span: &SpanStiffness| {
        let (own, width) = (&forces[first..][..span.stiffness.len()], degrees.len());
        first += own.len();
        strain = strain.max(largest_strain(span, own));
        let mut sum = vec![0.0; width * width];
        let pairs = span.second_derivatives.chunks_exact(2 * width);
        for (pair, strain) in pairs.zip(&span.second_derivative_strains) {
            let (p, q) = pair.split_at(width);
            for (at, entry) in sum.iter_mut().enumerate() {
                let (row, column) = (at / width, at % width);
                *entry -= own[*strain] * (p[row] * q[column] + q[row] * p[column]);
            }
        }
        for (at, value) in sum.into_iter().enumerate().filter(|(_, value)| *value != 0.0) {
            let (row, column) = (degrees[at / width], degrees[at % width]);
            if row < size && column < size {
                entries.push((row, column, value));
            }
        }
    };
    model.for_each_static_span(order, &mut add);
    // Second derivatives do not depend on the penalty stiffness.
    model.for_each_static_constraint(order, |_| 1.0, &mut add);
    let decrease = SymmetricSparse::new(size, |give| {
        entries.iter().for_each(|(row, column, value)| give(*row, *column, *value));
    });
    LoadEffect { decrease, strain }
}

fn largest_strain(span: &SpanStiffness, forces: &[f64]) -> f64 {
    let of_point = |at: usize| {
        let [axial, shear] = [at, at + 1].map(|at| (forces[at], span.stiffness[at]));
        hypot(axial.0, shear.0) / axial.1.min(shear.1)
    };
    let axial = span.kinds.iter().enumerate().filter(|(_, kind)| **kind == StrainKind::Axial);
    axial.map(|(at, _)| of_point(at)).fold(0.0, f64::max)
}

/// Operator `R⁻ᵀ G R⁻¹` with the stiffness `K = Rᵀ R` and its decrease `G` per load factor. The eigenvalues are `1/λ`, of both signs.
struct BucklingOperator<'a> {
    pencil: &'a Pencil,
    factors: &'a SymmetricFactors,
    strain: f64,
}

impl SymmetricOperator for BucklingOperator<'_> {
    fn size(&self) -> usize {
        self.pencil.size()
    }

    fn zeros(&self) -> Vec<FourVectors> {
        self.pencil.zeros()
    }

    fn metric_times(&self, x: &VectorStrip, product: &mut VectorStrip) {
        product.copy_from_slice(x);
    }

    fn threshold(&self, largest: f64) -> f64 {
        (SMALLEST * largest).max(self.strain / LARGEST_STRAIN)
    }

    fn images(&self, momenta: &mut VectorStrip) {
        self.factors.solve_root(momenta);
        let mut product = self.pencil.right_hand_times(momenta);
        self.factors.solve_root_transposed(&mut product);
        momenta.copy_from_slice(&product);
    }
}

impl BucklingOperator<'_> {
    /// All pairs with positive eigenvalues above the threshold, in decreasing order.
    fn all_pairs(&self) -> Pairs {
        let size = self.size();
        let mut matrix = DMatrix::zeros(size, size);
        for first in (0..size).step_by(STRIP_WIDTH) {
            let lanes = 0..STRIP_WIDTH.min(size - first);
            let mut columns = self.zeros();
            lanes.clone().for_each(|lane| columns[first + lane][lane] = 1.0);
            self.images(&mut columns);
            for lane in lanes {
                for (to, from) in matrix.column_mut(first + lane).iter_mut().zip(&columns) {
                    *to = from[lane];
                }
            }
        }
        let SymmetricEigen { eigenvalues, eigenvectors } =
            ((&matrix + matrix.transpose()) * 0.5).symmetric_eigen();
        let least = self.threshold(eigenvalues.amax());
        let mut order: Vec<usize> = (0..size).filter(|at| eigenvalues[*at] > least).collect();
        order.sort_by(|a, b| eigenvalues[*b].total_cmp(&eigenvalues[*a]));
        let strip = |columns: &[usize]| {
            let mut strip = self.zeros();
            for (lane, column) in columns.iter().enumerate() {
                for (to, from) in strip.iter_mut().zip(eigenvectors.column(*column).iter()) {
                    to[lane] = *from;
                }
            }
            strip
        };
        let strips = order.chunks(STRIP_WIDTH).map(strip).collect();
        Pairs { values: order.iter().map(|at| eigenvalues[*at]).collect(), strips }
    }

    /// Transforms eigenvectors to shapes that are normalised with respect to the decrease of the stiffness.
    fn to_shapes(&self, mut pairs: Pairs) -> Pairs {
        for (strip, values) in pairs.strips.iter_mut().zip(pairs.values.chunks(STRIP_WIDTH)) {
            self.factors.solve_root(strip);
            for row in strip {
                row.iter_mut().zip(values).for_each(|(entry, value)| *entry /= value.sqrt());
            }
        }
        pairs
    }
}
