//! Kink of a beam axis under a point force. The smooth basis functions of a mesh cannot represent the displacement due to the kink.
//!
//! A point force on a shear-flexible beam causes a jump of the tangent of its axis. A smooth mesh lacks a part of the displacement under the force.
//! The missing displacement is the same as in a string with the same basis functions, quadrature points and weights.
//! Derivation: docs/theory.md, section 10.1.

mod running;

use super::{BeamError, Mesh};
use crate::geometry::{
    PiecewisePolynomial, PositiveBand, PositiveFactors, Span, Vec2, lower_splines,
};

/// Largest length that is attributed to rounding, as a fraction of a span.
const ROUNDING: f64 = 1e-11;

/// Kink of the axis under a point force, as far as the mesh does not represent it.
#[derive(Debug, Clone)]
pub struct MissedKink {
    /// Kink length `g(ξ)` as a function of the position `ξ` of the kink [length].
    pub length: PiecewisePolynomial,
    /// Correction factor `μ` of the inertia of a moving kink [-].
    /// The mesh misses the kinetic energy `½ μ ρA g |a|² v²` of a kink `a` with the speed `v`, averaged over the positions of the kink.
    /// For exactly integrated strains, the correction factor is `μ = 1`.
    pub inertia: f64,
}

/// Computes the part of a kink that the mesh does not represent.
/// A force `λ` across the beam at `ξ` displaces the axis at `ξ` by `g(ξ) λ/GA` more than the mesh represents.
///
/// ```text
/// kink length:                g(ξ) = l(ξ)ᵀ M⁻¹ r(ξ)
/// matrix:                     M = Σ w t tᵀ/|x_ξ|
/// integrals before the kink:  l = ∫ t dξ from the start to ξ
/// integrals after the kink:   r = ∫ t dξ from ξ to the end
/// ```
///
/// The matrix `M` contains products of the splines `t` of one degree less, summed over the points and weights of the shear strain.
/// The length `g` is the compliance of the exact string under a point load minus the compliance of the string on the mesh.
/// The kink length does not depend on the supports of the string.
/// The kink length `g` is a polynomial of twice the degree on each span, and zero where the basis is C⁰.
/// Returns `None` if `g` is not positive at a point where the basis is smoother. This occurs with fewer quadrature points than the patch rule has.
///
/// # Errors
/// Fails if the mesh has no quadrature, or the axis has a point without a tangent.
pub fn unresolved_kink(
    mesh: &Mesh,
    control_points: &[Vec2],
) -> Result<Option<MissedKink>, BeamError> {
    let (basis, degree) = (mesh.basis(), mesh.basis().degree());
    let spans = basis.spans();
    let mut products = PositiveBand::zeros(basis.functions() - 1, degree - 1);
    for quadrature in mesh.quadrature_spans()? {
        for (xi, weight) in quadrature.force_rule {
            let values = basis.evaluate_in(&quadrature.span, xi);
            let speed = values.combine(1, control_points).norm();
            if speed.is_nan() || speed <= 0.0 {
                return Err(BeamError::NoTangent { parameter: xi });
            }
            let lower: Vec<f64> = lower_splines(&values).collect();
            products.add_square(quadrature.span.first, weight / speed, &lower);
        }
    }
    let Some(string) = SplineString::new(products, degree) else { return Ok(None) };
    let rows: Vec<Vec<f64>> =
        spans.iter().map(|span| string.polynomial(span, &fractions(mesh, span))).collect();
    let length = PiecewisePolynomial::new(&spans, &rows);
    let is_positive = spans.iter().enumerate().all(|(at, span)| {
        let width = span.end - span.start;
        let least = -ROUNDING * control_polygon_length(control_points, span, degree);
        (0..=8 * degree).all(|k| {
            let xi = span.start + width * k as f64 / (8 * degree) as f64;
            length.in_span(at, xi)[0] >= least
        })
    });
    if !is_positive {
        return Ok(None);
    }
    let inertia = string.inertia(mesh, control_points, &length);
    Ok(Some(MissedKink { length, inertia }))
}

/// Length of the control polygon of a span [length].
fn control_polygon_length(control_points: &[Vec2], span: &Span, degree: usize) -> f64 {
    let own = &control_points[span.first..=span.first + degree];
    own.windows(2).map(|pair| (pair[1] - pair[0]).norm()).sum()
}

/// For each B-spline of degree p-1 on a span, returns the integral from the start of the span as coefficients of a polynomial.
/// The polynomial has a coordinate from -1 to 1 over the span. Its values are the sums `Σ_(a > t) N_a` of splines of degree p.
fn fractions(mesh: &Mesh, span: &Span) -> Vec<Vec<f64>> {
    let degree = mesh.basis().degree();
    let half = 0.5 * (span.end - span.start);
    let middle = mesh.basis().evaluate_in(span, 0.5 * (span.start + span.end));
    let mut scales = vec![1.0; degree + 1];
    (1..=degree).for_each(|order| scales[order] = scales[order - 1] * half / order as f64);
    let behind = |lower: usize, order: usize| -> f64 {
        scales[order] * middle.derivatives(order)[lower + 1..].iter().sum::<f64>()
    };
    (0..degree).map(|lower| (0..=degree).map(|order| behind(lower, order)).collect()).collect()
}

/// String on a mesh of splines: its matrix `M`, the solution of `M a = 1`, and the entries of `M⁻¹` near the diagonal.
struct SplineString {
    degree: usize,
    products: PositiveBand,
    factors: PositiveFactors,
    /// Solution `a` of `M a = 1`: the coefficients of the strains of the string under a constant force.
    stretched: Vec<f64>,
    inverse: PositiveBand,
}

impl SplineString {
    fn new(products: PositiveBand, degree: usize) -> Option<Self> {
        let factors = products.factorise()?;
        let mut stretched = vec![1.0; products.size()];
        factors.solve(&mut stretched);
        let inverse = factors.inverse(3 * degree);
        Some(Self { degree, products, factors, stretched, inverse })
    }

    /// Residual for a load on the string that is one for all splines before index `cut`, and zero for the others.
    /// The approximate response to the load has the strains under a constant force for the splines before `cut`, and zero strains for the others.
    /// The residual is nonzero in a few entries around `cut` only. Returns the index of the first of these entries, and the entries.
    fn load_residual(&self, cut: usize) -> (usize, Vec<f64>) {
        let (size, reach) = (self.stretched.len(), self.degree - 1);
        let first = cut.saturating_sub(reach);
        let entry = |row: usize| -> f64 {
            let columns = if row < cut {
                cut..(row + reach + 1).min(size)
            } else {
                row.saturating_sub(reach)..cut
            };
            let sum: f64 = columns.map(|at| self.products.get(row, at) * self.stretched[at]).sum();
            if row < cut { sum } else { -sum }
        };
        (first, (first..(cut + reach).min(size)).map(entry).collect())
    }

    /// Returns the entry `row` of the response `M⁻¹ r` to a load `r`.
    fn response(&self, row: usize, (first, load): &(usize, Vec<f64>)) -> f64 {
        (*first..).zip(load).map(|(at, r)| self.inverse.get(row, at) * r).sum()
    }

    /// Coefficients of `g = lᵀ M⁻¹ r` on a span. The argument `fractions` contains, for each spline of the span, the part in front of the kink.
    /// The splines of earlier spans lie entirely in front of the kink, and the splines of later spans behind it.
    ///
    /// The splines before the kink, and those after the kink, contribute the response to a load. The load is one for all splines up to an index.
    /// The response consists of the strains under a constant force up to the index, and the response to the residual.
    fn polynomial(&self, span: &Span, fractions: &[Vec<f64>]) -> Vec<f64> {
        let own = span.first..span.first + self.degree;
        let (before, behind) = (self.load_residual(own.start), self.load_residual(own.end));
        let mut sum = vec![0.0; 2 * self.degree + 1];
        // Products of splines before the kink with splines after the kink.
        sum[0] -=
            (before.0..).zip(&before.1).map(|(at, r)| r * self.response(at, &behind)).sum::<f64>();
        for (i, part) in own.clone().zip(fractions) {
            // Product of the splines of earlier spans and the part of this spline behind the kink.
            // Product of the part of this spline in front of the kink and the splines of later spans.
            let (earlier, later) = (self.response(i, &before), -self.response(i, &behind));
            sum[0] += earlier;
            sum.iter_mut().zip(part).for_each(|(sum, c)| *sum += (later - earlier) * c);
            for (j, other) in own.clone().zip(fractions) {
                let entry = self.inverse.get(i, j);
                sum.iter_mut().zip(part).for_each(|(sum, c)| *sum += entry * c);
                for (k, c) in part.iter().enumerate() {
                    sum[k..].iter_mut().zip(other).for_each(|(sum, d)| *sum -= entry * c * d);
                }
            }
        }
        sum
    }
}

#[cfg(test)]
mod tests;
