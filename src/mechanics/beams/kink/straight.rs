//! Straight beam with the basis functions and quadrature points of a mesh. Its compliance is compared with the exact compliance.

use super::arc_lengths;
use crate::beams::mesh::QuadratureSpan;
use crate::beams::{BeamError, Mesh, Section};
use crate::elementary::square;
use crate::geometry::{BasisValues, PiecewisePolynomial, Span, Vec2};

/// Straight shear-flexible beam with the basis functions and quadrature points of a mesh, for small displacements.
/// The unknowns alternate: the transverse displacement and the rotation of the first control point, then those of the second, and so on.
#[derive(Debug)]
pub struct StraightBeam<'a> {
    mesh: &'a Mesh,
    control_points: &'a [Vec2],
    section: &'a Section,
    spans: Vec<Span>,
    arc: PiecewisePolynomial,
    length: f64,
}

impl<'a> StraightBeam<'a> {
    /// Creates a straight beam with the same arc lengths as the axis that the control points describe.
    pub fn new(mesh: &'a Mesh, control_points: &'a [Vec2], section: &'a Section) -> Self {
        let (spans, arc) = (mesh.basis().spans(), arc_lengths(mesh, control_points));
        let last = spans.len() - 1;
        let [length, ..] = arc.in_span(last, spans[last].end);
        Self { mesh, control_points, section, spans, arc, length }
    }

    /// Number of control points.
    pub fn control_points(&self) -> usize {
        self.control_points.len()
    }

    /// Degree of the basis functions.
    pub fn degree(&self) -> usize {
        self.mesh.basis().degree()
    }

    /// Spans of the mesh.
    pub fn spans(&self) -> &[Span] {
        &self.spans
    }

    /// Values of the basis functions in a span.
    pub fn values(&self, span: &Span, xi: f64) -> BasisValues {
        self.mesh.basis().evaluate_in(span, xi)
    }

    /// Calls `take` for the shear strain or curvature at each quadrature point.
    /// The arguments are the index of the first unknown, the stiffness, and the derivatives of the strain with respect to consecutive unknowns.
    /// The stiffness is `GA` or `EI` times the length that the quadrature point represents [force·length, force·length³].
    ///
    /// # Errors
    /// Fails if the mesh has no quadrature, or if the axis has a point without a tangent.
    pub fn for_each_strain(
        &self,
        take: &mut dyn FnMut(usize, f64, &[f64]),
    ) -> Result<(), BeamError> {
        let Section { shear_stiffness: shear, bending_stiffness: bending, .. } = *self.section;
        for quadrature in self.mesh.quadrature_spans()? {
            let moment_rule = quadrature.moment_rule()?;
            let QuadratureSpan { span, force_rule, .. } = quadrature;
            for (xi, weight) in force_rule {
                let (first, length, rows) = self.by_arc_length(&span, xi)?;
                let row: Vec<f64> = rows.iter().flat_map(|[n, slope]| [*slope, -n]).collect();
                take(first, shear * weight * length, &row);
            }
            for (xi, weight) in moment_rule.iter_on(span.start, span.end) {
                let (first, length, rows) = self.by_arc_length(&span, xi)?;
                let row: Vec<f64> = rows.iter().flat_map(|[_, slope]| [0.0, *slope]).collect();
                take(first, bending * weight * length, &row);
            }
        }
        Ok(())
    }

    fn by_arc_length(
        &self,
        span: &Span,
        xi: f64,
    ) -> Result<(usize, f64, Vec<[f64; 2]>), BeamError> {
        let values = self.values(span, xi);
        let speed = values.combine(1, self.control_points).norm();
        if speed.is_nan() || speed <= 0.0 {
            return Err(BeamError::NoTangent { parameter: xi });
        }
        let pairs = values.values().iter().zip(values.slopes());
        Ok((2 * values.first, speed, pairs.map(|(n, slope)| [*n, slope / speed]).collect()))
    }

    /// Exact compliances, at one point, of the beam with hinged ends: displacement per force [length/force],
    /// rotation per force [1/force], and rotation per couple [1/(force·length)].
    pub fn hinged(&self, span: usize, xi: f64) -> [f64; 3] {
        let Section { bending_stiffness: bending, shear_stiffness: shear, .. } = *self.section;
        let (whole, [a, ..]) = (self.length, self.arc.in_span(span, xi));
        let b = whole - a;
        let cubes = a * square(a) + b * square(b);
        [
            square(a * b) / (3.0 * whole * bending) + a * b / (whole * shear),
            a * b * (b - a) / (3.0 * whole * bending),
            cubes / (3.0 * square(whole) * bending) + 1.0 / (whole * shear),
        ]
    }
}
