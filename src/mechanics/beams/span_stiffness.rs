//! Static stiffness of a span in factored form: strains with their stiffnesses, and the geometric stiffness due to section forces.
//!
//! The stiffness matrix is not formed, because rounding errors of its large entries would exceed its small eigenvalues.
//! Equations: docs/theory.md, section 15.

/// Type of a strain of a beam.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum StrainKind {
    /// Axial strain.
    Axial,
    /// Shear strain.
    Shear,
    /// Change of curvature.
    Bending,
}

/// Static stiffness of one span of a beam, of an element or of a constraint.
/// For a span, each row of derivatives has an entry for each component (x, y, rotation) of each control point.
/// For elements and constraints, each row has an entry for each of their degrees of freedom.
#[derive(Debug, Clone, Default)]
pub struct SpanStiffness {
    /// First control point of the span.
    pub first: usize,
    /// Rows of derivatives of strains and curvatures with respect to displacements and rotations, stored one after the other.
    /// The entries of a row have the unit [1/length], except derivatives of axial and shear strain with respect to rotations [-].
    pub strains: Vec<f64>,
    /// Stiffness for each strain or curvature, times the integration length [force·length, force·length³].
    pub stiffness: Vec<f64>,
    /// Type of the strain in each row; empty for elements and constraints.
    pub kinds: Vec<StrainKind>,
    /// Pairs of rows `p` and `q` of the geometric stiffness `p qᵀ + q pᵀ`. The product `p qᵀ` has the unit of a stiffness.
    pub twists: Vec<f64>,
    /// Bound of the relative rounding error of the section force that multiplies each pair of rows in `twists` [-].
    pub rounding_fractions: Vec<f64>,
    /// Pairs of rows `p` and `q` of second derivatives of strains. Each pair adds `p qᵀ + q pᵀ` to the second derivatives of one strain.
    /// The pairs are complete for strains of beams, springs, rigid links and sliders.
    pub second_derivatives: Vec<f64>,
    /// Index of the strain to which each pair of rows in `second_derivatives` belongs.
    pub second_derivative_strains: Vec<usize>,
}

impl SpanStiffness {
    /// Removes all rows and starts another span, whose first control point is `first`.
    pub fn begin(&mut self, first: usize) {
        self.first = first;
        self.strains.clear();
        self.stiffness.clear();
        self.kinds.clear();
        self.twists.clear();
        self.rounding_fractions.clear();
        self.second_derivatives.clear();
        self.second_derivative_strains.clear();
    }

    /// Adds a pair of rows to the second derivatives of a strain.
    pub(crate) fn add_second_derivative(&mut self, strain: usize, p: &[f64], q: &[f64]) {
        self.second_derivative_strains.push(strain);
        self.second_derivatives.extend(p);
        self.second_derivatives.extend(q);
    }

    pub(super) fn add_strain<const N: usize>(
        &mut self,
        kind: StrainKind,
        stiffness: f64,
        row: [[f64; 3]; N],
    ) {
        self.strains.extend(row.as_flattened());
        self.stiffness.push(stiffness);
        self.kinds.push(kind);
    }

    pub(super) fn add_twist<const N: usize>(
        &mut self,
        doubt: f64,
        p: [[f64; 3]; N],
        q: [[f64; 3]; N],
    ) {
        self.twists.extend(p.as_flattened());
        self.twists.extend(q.as_flattened());
        self.rounding_fractions.push(doubt);
    }
}
