//! Mesh of a beam: basis and strain quadrature.

use serde::{Deserialize, Serialize};

use super::BeamError;
use crate::geometry::{
    Basis, GaussRule, GeometryError, KnotVector, LagrangeBasis, RunRule, Span, patch_rule,
};

/// Quadrature of the axial and shear strain of a beam.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
pub enum Quadrature {
    /// Patch rule ([`patch_rule`]), which avoids locking and zero-energy modes, and passes the patch test.
    #[default]
    Patch,
    /// Fixed number of Gauss points per span. Too many points cause locking. Too few points leave zero-energy modes.
    Points(usize),
}

/// Mesh of a beam: basis functions for its displacements and rotations, and quadrature of its strains.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(try_from = "(Basis, Quadrature)")]
pub struct Mesh {
    basis: Basis,
    quadrature: Quadrature,
    #[serde(skip)]
    is_automatic: bool,
}

/// Numbers of quadrature points of a beam.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct PointCounts {
    /// Number of quadrature points for the axial and shear strain `Γ`. The section force at each point is an unknown that is eliminated.
    pub force: usize,
    /// Number of quadrature points for the bending strain `κ`.
    pub moment: usize,
    /// Number of quadrature points for the mass matrix, which is integrated once.
    pub inertia: usize,
}

#[derive(Debug, Clone, PartialEq)]
pub(super) struct QuadratureSpan {
    pub(super) span: Span,
    pub(super) force_rule: Vec<(f64, f64)>,
    pub(super) moment_points: usize,
}

impl QuadratureSpan {
    pub(super) fn moment_rule(&self) -> Result<GaussRule, GeometryError> {
        GaussRule::new(self.moment_points)
    }
}

impl TryFrom<(Basis, Quadrature)> for Mesh {
    type Error = BeamError;

    fn try_from((basis, quadrature): (Basis, Quadrature)) -> Result<Self, BeamError> {
        Self::new(basis).with_quadrature(quadrature)
    }
}

impl Mesh {
    /// Creates a B-spline mesh with the quadrature [`Quadrature::Patch`], `spans` equal spans and continuity C^`continuity` at interior knots.
    ///
    /// # Errors
    /// Fails if no knot vector exists for the given number of spans, degree and continuity.
    pub fn bspline(spans: usize, degree: usize, continuity: usize) -> Result<Self, GeometryError> {
        Ok(Self::new(Basis::BSpline(KnotVector::uniform(spans, degree, continuity)?)))
    }

    /// Creates a mesh of cubic C² splines with `spans` spans. The scene may change this number according to its forces and sliders.
    ///
    /// # Errors
    /// Fails if the number of spans is out of range.
    pub fn automatic(spans: usize) -> Result<Self, GeometryError> {
        Ok(Self { is_automatic: true, ..Self::bspline(spans, 3, 2)? })
    }

    /// Creates a mesh of equal Lagrange elements of degree 1 to 3 with the quadrature [`Quadrature::Patch`].
    ///
    /// # Errors
    /// Fails if the degree or the number of elements is out of range.
    pub fn lagrange(elements: usize, degree: usize) -> Result<Self, GeometryError> {
        Ok(Self::new(Basis::Lagrange(LagrangeBasis::uniform(elements, degree)?)))
    }

    /// Creates a mesh on any basis. The quadrature of the axial and shear strain is [`Quadrature::Patch`].
    pub fn new(basis: Basis) -> Self {
        Self { basis, quadrature: Quadrature::Patch, is_automatic: false }
    }

    /// Returns the mesh with another quadrature of the axial and shear strain.
    ///
    /// # Errors
    /// Fails if the number of points is zero, or exceeds the degree by more than three.
    pub fn with_quadrature(self, quadrature: Quadrature) -> Result<Self, BeamError> {
        let (degree, most) = (self.basis.degree(), self.basis.degree() + 3);
        match quadrature {
            Quadrature::Points(points) if points == 0 || points > most => {
                Err(BeamError::Quadrature { points, most, degree })
            }
            _ => Ok(Self { quadrature, ..self }),
        }
    }

    /// Returns the mesh with the continuity reduced to C⁰ at the given parameters [-].
    ///
    /// # Errors
    /// Fails if a parameter lies outside the domain of the basis.
    pub fn with_breaks(&self, places: &[f64]) -> Result<Self, GeometryError> {
        let broken =
            places.iter().try_fold(self.basis.clone(), |basis, &xi| basis.with_break(xi))?;
        Ok(Self { basis: broken, quadrature: self.quadrature, is_automatic: false })
    }

    /// Returns a mesh with about `ratio` times as many spans: see [`Basis::with_span_ratio`].
    ///
    /// # Errors
    /// Fails if the resulting mesh has too many or too short spans.
    pub fn with_span_ratio(&self, ratio: f64) -> Result<Self, GeometryError> {
        let basis = self.basis.with_span_ratio(ratio)?;
        Ok(Self { basis, quadrature: self.quadrature, is_automatic: false })
    }

    /// Returns true if the scene chooses the number of spans according to its forces and sliders.
    pub fn is_automatic(&self) -> bool {
        self.is_automatic
    }

    /// Basis of the mesh.
    pub fn basis(&self) -> &Basis {
        &self.basis
    }

    /// Quadrature of axial and shear strain.
    pub fn quadrature(&self) -> Quadrature {
        self.quadrature
    }

    /// Number of spans or elements.
    pub fn spans(&self) -> usize {
        self.basis.spans().len()
    }

    /// Text that describes the basis and the number of spans, such as `cubic B-splines C², 14 spans`.
    pub fn describe(&self) -> String {
        let degree = match self.basis.degree() {
            1 => "linear".to_owned(),
            2 => "quadratic".to_owned(),
            3 => "cubic".to_owned(),
            degree => format!("degree {degree}"),
        };
        let spans = self.spans();
        let rule = match self.quadrature {
            Quadrature::Patch => String::new(),
            Quadrature::Points(points) => {
                let flaw = match self.excess_points() {
                    0 => String::new(),
                    more if more > 0 => format!(": {more} too many, stiff beams lock"),
                    fewer => format!(": {} zero-energy modes", -2 * fewer),
                };
                format!(", {points} strain points per span{flaw}")
            }
        };
        let plural = if spans == 1 { "" } else { "s" };
        match &self.basis {
            Basis::BSpline(_) => {
                format!(
                    "{degree} B-splines C{}, {spans} span{plural}{rule}",
                    self.basis.continuity()
                )
            }
            Basis::Lagrange(_) => format!("{degree} Lagrange, {spans} element{plural}{rule}"),
        }
    }

    /// Total numbers of quadrature points.
    pub fn point_counts(&self) -> PointCounts {
        let runs = self.runs();
        let force = |run: &Vec<Span>| match self.quadrature {
            Quadrature::Patch => self.derivatives(run),
            Quadrature::Points(points) => points * run.len(),
        };
        PointCounts {
            force: runs.iter().map(force).sum(),
            moment: runs.iter().map(|run| run.len() * self.moment_points(run)).sum(),
            inertia: self.spans() * self.points_of_inertia(),
        }
    }

    fn derivatives(&self, run: &[Span]) -> usize {
        run[run.len() - 1].first - run[0].first + self.basis.degree()
    }

    /// Number of quadrature points for the strain `Γ`, minus the number of linearly independent derivatives of the basis functions.
    /// The mesh locks if the difference is positive, and has two zero-energy modes for each missing point if it is negative.
    fn excess_points(&self) -> isize {
        let wanted: usize = self.runs().iter().map(|run| self.derivatives(run)).sum();
        self.point_counts().force as isize - wanted as isize
    }

    /// Spans of the mesh with their quadrature points for the strains `Γ` and `κ`.
    ///
    /// # Errors
    /// Fails if the lengths of smoothly joined spans differ so much that no patch rule exists.
    pub(super) fn quadrature_spans(&self) -> Result<Vec<QuadratureSpan>, BeamError> {
        let mut spans = Vec::with_capacity(self.spans());
        for run in self.runs() {
            let moment_points = self.moment_points(&run);
            let rules = self.force_rules(&run)?;
            let with_rule = |(span, force_rule)| QuadratureSpan { span, force_rule, moment_points };
            spans.extend(run.into_iter().zip(rules).map(with_rule));
        }
        Ok(spans)
    }

    fn runs(&self) -> Vec<Vec<Span>> {
        let spans = self.basis.spans();
        spans.chunk_by(|a, b| self.is_smooth(a, b)).map(<[Span]>::to_vec).collect()
    }

    pub(super) fn is_smooth(&self, a: &Span, b: &Span) -> bool {
        b.first < a.first + self.basis.degree()
    }

    fn force_rules(&self, run: &[Span]) -> Result<RunRule, BeamError> {
        match self.quadrature {
            Quadrature::Patch => {
                let uneven = || {
                    let lengths = run.iter().map(|span| span.end - span.start);
                    let (shortest, longest) = lengths
                        .fold((f64::INFINITY, 0.0_f64), |(low, high), length| {
                            (low.min(length), high.max(length))
                        });
                    BeamError::UnevenSpans { ratio: longest / shortest }
                };
                patch_rule(&self.basis, run).ok_or_else(uneven)
            }
            Quadrature::Points(points) => {
                let gauss = GaussRule::new(points)?;
                Ok(run.iter().map(|span| gauss.iter_on(span.start, span.end).collect()).collect())
            }
        }
    }

    /// Number of quadrature points per span for the curvature `κ` in `run`, a sequence of smoothly joined spans.
    /// If all its spans are joined with the highest continuity, each span needs one point fewer, but at least two points.
    fn moment_points(&self, run: &[Span]) -> usize {
        let degree = self.basis.degree();
        let is_fully_smooth = run.windows(2).all(|pair| pair[1].first == pair[0].first + 1);
        if run.len() > 1 && is_fully_smooth { (degree - 1).max(2) } else { degree }
    }

    pub(super) fn inertia_rule(&self) -> Result<GaussRule, GeometryError> {
        GaussRule::new(self.points_of_inertia())
    }

    fn points_of_inertia(&self) -> usize {
        self.basis.degree() + 1
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn force_points(mesh: &Mesh) -> Vec<usize> {
        let spans = mesh.quadrature_spans().unwrap();
        spans.iter().map(|span| span.force_rule.len()).collect()
    }

    #[test]
    fn each_smooth_patch_has_as_many_force_points_as_derivatives() {
        let cubic = Mesh::bspline(6, 3, 2).unwrap();
        assert_eq!(force_points(&cubic), [2, 1, 1, 1, 1, 2]);
        assert!(cubic.quadrature_spans().unwrap().iter().all(|span| span.moment_points == 2));
        assert_eq!(force_points(&Mesh::bspline(4, 3, 1).unwrap()).iter().sum::<usize>(), 9);
        assert_eq!(force_points(&Mesh::bspline(4, 4, 3).unwrap()).iter().sum::<usize>(), 7);
        assert_eq!(force_points(&Mesh::lagrange(3, 1).unwrap()), [1, 1, 1]);
        assert_eq!(force_points(&Mesh::lagrange(2, 3).unwrap()), [3, 3]);
        assert_eq!(force_points(&Mesh::bspline(1, 3, 2).unwrap()), [3]);
    }

    #[test]
    fn quadrature_points_are_counted_over_all_spans() {
        let counts = |mesh: Mesh| {
            let PointCounts { force, moment, inertia } = mesh.point_counts();
            assert_eq!(force, force_points(&mesh).iter().sum::<usize>());
            [force, moment, inertia]
        };
        assert_eq!(counts(Mesh::bspline(6, 3, 2).unwrap()), [8, 12, 24]);
        assert_eq!(counts(Mesh::bspline(6, 3, 1).unwrap()), [13, 18, 24]);
        assert_eq!(counts(Mesh::lagrange(3, 1).unwrap()), [3, 3, 6]);
    }

    #[test]
    fn breaks_separate_quadrature_patches() {
        let broken = Mesh::bspline(6, 3, 2).unwrap().with_breaks(&[0.5]).unwrap();
        assert_eq!(force_points(&broken), [2, 1, 2, 2, 1, 2]);
    }

    #[test]
    fn mesh_description_states_basis_size_and_quadrature_faults() {
        assert_eq!(Mesh::bspline(14, 3, 2).unwrap().describe(), "cubic B-splines C2, 14 spans");
        assert_eq!(Mesh::lagrange(10, 1).unwrap().describe(), "linear Lagrange, 10 elements");
        let points = |mesh: Mesh, points| {
            mesh.with_quadrature(Quadrature::Points(points)).unwrap().describe()
        };
        let c1 = Mesh::bspline(7, 3, 1).unwrap();
        assert_eq!(
            points(c1.clone(), 3),
            "cubic B-splines C1, 7 spans, 3 strain points per span: 6 too many, stiff beams lock"
        );
        assert_eq!(
            points(c1, 2),
            "cubic B-splines C1, 7 spans, 2 strain points per span: 2 zero-energy modes"
        );
        assert_eq!(
            points(Mesh::lagrange(2, 3).unwrap(), 3),
            "cubic Lagrange, 2 elements, 3 strain points per span"
        );
    }
}
