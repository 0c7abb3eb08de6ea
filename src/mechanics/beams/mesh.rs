//! The mesh of a beam: a basis, and where strains are sampled.

use serde::{Deserialize, Serialize};

use super::BeamError;
use crate::geometry::{
    Basis, GaussRule, GeometryError, KnotVector, LagrangeBasis, RunRule, Span, patch_rule,
};

/// A rule for where axial and shear strain of a beam are sampled.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
pub enum Quadrature {
    /// The patch rule: on each piece of the mesh that is smooth, one point for each derivative of a function, at the Gauss points of these
    /// splines ([`patch_rule`]). That neither locks nor leaves zero-energy modes, and passes the patch test.
    #[default]
    Patch,
    /// Every span has the same number of Gauss points: too many lock, too few leave modes without energy.
    Points(usize),
}

/// How a beam is discretised: a basis with its quadrature.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(try_from = "(Basis, Quadrature)")]
pub struct Mesh {
    basis: Basis,
    quadrature: Quadrature,
}

/// The numbers of quadrature points of a whole beam.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct PointCounts {
    /// The number of points for axial and shear strain `Γ`, each with a section force as an unknown that is condensed there.
    pub force: usize,
    /// The number of points for the bending strain `κ`.
    pub moment: usize,
    /// The number of points for the mass matrix, which is integrated once.
    pub inertia: usize,
}

/// A span with its points for the strain `Γ`, `∫ f dξ ≈ Σ weight · f(point)`, and the number of those for the curvature `κ`.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct QuadratureSpan {
    pub(super) span: Span,
    pub(super) force_rule: Vec<(f64, f64)>,
    pub(super) moment_points: usize,
}

impl QuadratureSpan {
    /// The quadrature rule of the span for the curvature `κ`.
    pub(super) fn moment_rule(&self) -> Result<GaussRule, GeometryError> {
        GaussRule::new(self.moment_points)
    }
}

/// From basis and quadrature, as stored.
impl TryFrom<(Basis, Quadrature)> for Mesh {
    type Error = BeamError;

    fn try_from((basis, quadrature): (Basis, Quadrature)) -> Result<Self, BeamError> {
        Self::new(basis).with_quadrature(quadrature)
    }
}

impl Mesh {
    /// A mesh of B-splines with the patch rule: `spans` equal spans, C^`continuity` where they meet.
    ///
    /// # Errors
    /// When the numbers make no knot vector.
    pub fn bspline(spans: usize, degree: usize, continuity: usize) -> Result<Self, GeometryError> {
        Ok(Self::new(Basis::BSpline(KnotVector::uniform(spans, degree, continuity)?)))
    }

    /// A mesh of equal Lagrange elements of degree 1 to 3, with the patch rule.
    ///
    /// # Errors
    /// When degree or number of elements is out of range.
    pub fn lagrange(elements: usize, degree: usize) -> Result<Self, GeometryError> {
        Ok(Self::new(Basis::Lagrange(LagrangeBasis::uniform(elements, degree)?)))
    }

    /// A mesh of any basis, with the patch rule.
    pub fn new(basis: Basis) -> Self {
        Self { basis, quadrature: Quadrature::Patch }
    }

    /// The mesh of the same basis with another quadrature for axial and shear strain.
    ///
    /// # Errors
    /// When the number of points is zero or far above what the degree can use.
    pub fn with_quadrature(self, quadrature: Quadrature) -> Result<Self, BeamError> {
        let (degree, most) = (self.basis.degree(), self.basis.degree() + 3);
        match quadrature {
            Quadrature::Points(points) if points == 0 || points > most => {
                Err(BeamError::Quadrature { points, most, degree })
            }
            _ => Ok(Self { quadrature, ..self }),
        }
    }

    /// The same mesh, only C⁰ at the given parameters [-] of the domain.
    ///
    /// # Errors
    /// When a place lies outside the domain.
    pub fn with_breaks(&self, places: &[f64]) -> Result<Self, GeometryError> {
        let broken =
            places.iter().try_fold(self.basis.clone(), |basis, &xi| basis.with_break(xi))?;
        Ok(Self { basis: broken, quadrature: self.quadrature })
    }

    /// The basis of the mesh.
    pub fn basis(&self) -> &Basis {
        &self.basis
    }

    /// The quadrature of the mesh for axial and shear strain.
    pub fn quadrature(&self) -> Quadrature {
        self.quadrature
    }

    /// The number of spans or elements of the mesh.
    pub fn spans(&self) -> usize {
        self.basis.spans().len()
    }

    /// The mesh in words, such as `cubic B-splines C², 14 spans`.
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
                let flaw = match self.surplus() {
                    0 => String::new(),
                    more if more > 0 => format!(": {more} too many, locks on stiff beams"),
                    fewer => format!(": {} modes without energy", -2 * fewer),
                };
                format!(", {points} points a span for the strain{flaw}")
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

    /// The numbers of quadrature points that all spans of the mesh have together.
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

    /// The dimension of the derivatives of the functions of a run.
    fn derivatives(&self, run: &[Span]) -> usize {
        run[run.len() - 1].first - run[0].first + self.basis.degree()
    }

    /// How many more points for `Γ` there are than derivatives of functions: too many lock, too few leave twice as many modes without
    /// energy.
    fn surplus(&self) -> isize {
        let wanted: usize = self.runs().iter().map(|run| self.derivatives(run)).sum();
        self.point_counts().force as isize - wanted as isize
    }

    /// The spans of the mesh with their quadrature points for `Γ` and `κ`.
    ///
    /// # Errors
    /// When the spans of a smooth piece differ so much in length that it has no patch rule.
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

    /// The spans, cut where the basis is C⁰ only: pieces whose strains have nothing to do with each other.
    fn runs(&self) -> Vec<Vec<Span>> {
        let spans = self.basis.spans();
        spans.chunk_by(|a, b| self.is_smooth(a, b)).map(<[Span]>::to_vec).collect()
    }

    /// Whether two neighbouring spans of the mesh are joined at least C¹.
    pub(super) fn is_smooth(&self, a: &Span, b: &Span) -> bool {
        // Neighbours that are C⁰ share a single function.
        b.first < a.first + self.basis.degree()
    }

    /// Points and weights for `Γ` on each span of a run.
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

    /// The number of points for `κ` in each span of a run: one fewer than for a single polynomial where the spans have full continuity, which
    /// leaves no curvature unseen.
    fn moment_points(&self, run: &[Span]) -> usize {
        let degree = self.basis.degree();
        let is_fully_smooth = run.windows(2).all(|pair| pair[1].first == pair[0].first + 1);
        if run.len() > 1 && is_fully_smooth { (degree - 1).max(2) } else { degree }
    }

    /// The Gauss rule that integrates the inertia of a span of the mesh exactly when it is straight.
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
    fn each_smooth_piece_has_as_many_points_as_derivatives() {
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
    fn points_are_counted_over_all_spans() {
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
    fn a_break_ends_a_patch() {
        let broken = Mesh::bspline(6, 3, 2).unwrap().with_breaks(&[0.5]).unwrap();
        assert_eq!(force_points(&broken), [2, 1, 2, 2, 1, 2]);
    }

    #[test]
    fn a_mesh_says_what_it_is() {
        assert_eq!(Mesh::bspline(14, 3, 2).unwrap().describe(), "cubic B-splines C2, 14 spans");
        assert_eq!(Mesh::lagrange(10, 1).unwrap().describe(), "linear Lagrange, 10 elements");
        let points = |mesh: Mesh, points| {
            mesh.with_quadrature(Quadrature::Points(points)).unwrap().describe()
        };
        let c1 = Mesh::bspline(7, 3, 1).unwrap();
        assert_eq!(
            points(c1.clone(), 3),
            "cubic B-splines C1, 7 spans, 3 points a span for the strain: 6 too many, locks on stiff beams"
        );
        assert_eq!(
            points(c1, 2),
            "cubic B-splines C1, 7 spans, 2 points a span for the strain: 2 modes without energy"
        );
        assert_eq!(
            points(Mesh::lagrange(2, 3).unwrap(), 3),
            "cubic Lagrange, 2 elements, 3 points a span for the strain"
        );
    }
}
