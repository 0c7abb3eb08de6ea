//! Kink of a beam axis under a point force. The basis functions of a mesh are too smooth to represent the additional deflection at the kink.
//!
//! A point force on a shear-flexible beam causes a jump of the tangent of its axis.
//! Derivation: docs/theory.md, section 10.1.

mod running;
mod straight;

pub use straight::StraightBeam;

use super::{BeamError, Mesh};
use crate::geometry::{
    PiecewisePolynomial, PositiveBand, PositiveFactors, Span, Vec2, lower_splines,
};

/// Largest magnitude of a negative kink length (see [`MissedKink`]) that is attributed to rounding, as a fraction of the length of the span.
const ROUNDING: f64 = 1e-11;

/// Part of the kink under a point force that the mesh does not represent. A kink is a jump of the tangent of the axis.
#[derive(Debug, Clone)]
pub struct MissedKink {
    /// Kink length as a function of the position of the kink [length].
    /// The kink length is the shear stiffness times the additional deflection per unit force that the mesh does not represent.
    pub length: PiecewisePolynomial,
    /// Factor of the kinetic energy of a moving kink [-]. It accounts for kinetic energy that the mesh does not represent.
    pub inertia: f64,
}

/// Arc length of the axis that the control points describe, as a function of the parameter [length].
pub fn arc_lengths(mesh: &Mesh, control_points: &[Vec2]) -> PiecewisePolynomial {
    let basis = mesh.basis();
    let speed = |span: &Span, xi| basis.evaluate_in(span, xi).combine(1, control_points).norm();
    PiecewisePolynomial::integral(&basis.spans(), basis.degree(), speed)
}

/// Computes the kink length, as a function of the position on the mesh, and the factor of the kinetic energy (docs/theory.md, section 10.1).
///
/// The result is `None` if the mesh is more compliant than the exact beam, so that the kink length is negative.
/// This may occur on meshes with fewer quadrature points than the patch rule.
///
/// # Errors
/// Fails if the mesh has no quadrature, or if the axis has a point without a tangent.
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

fn control_polygon_length(control_points: &[Vec2], span: &Span, degree: usize) -> f64 {
    let own = &control_points[span.first..=span.first + degree];
    own.windows(2).map(|pair| (pair[1] - pair[0]).norm()).sum()
}

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

struct SplineString {
    degree: usize,
    products: PositiveBand,
    factors: PositiveFactors,
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

    fn response(&self, row: usize, (first, load): &(usize, Vec<f64>)) -> f64 {
        (*first..).zip(load).map(|(at, r)| self.inverse.get(row, at) * r).sum()
    }

    fn polynomial(&self, span: &Span, fractions: &[Vec<f64>]) -> Vec<f64> {
        let own = span.first..span.first + self.degree;
        let (before, behind) = (self.load_residual(own.start), self.load_residual(own.end));
        let mut sum = vec![0.0; 2 * self.degree + 1];
        sum[0] -=
            (before.0..).zip(&before.1).map(|(at, r)| r * self.response(at, &behind)).sum::<f64>();
        for (i, part) in own.clone().zip(fractions) {
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
