//! The mesh of a beam: a basis, and where strains are sampled.

use serde::{Deserialize, Serialize};

use super::BeamError;
use crate::geometry::{
    Basis, GaussRule, GeometryError, KnotVector, LagrangeBasis, Span, derivative_weights,
};

/// Where axial and shear strain are sampled.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
pub enum Quadrature {
    /// In a run of spans of full continuity: one point in each span, a few more in its first and last one; that neither
    /// locks nor leaves zero-energy modes. A span on its own (every span of a Lagrange or C¹ cubic mesh) has `degree`
    /// points, which is right for Lagrange elements and locks for C¹ cubics.
    ///
    /// After Adam, Bouabdallah, Zarroug & Maitournam, Comput. Methods Appl. Mech. Eng. 279 (2014) 1–28.
    #[default]
    Patch,
    /// The same number of Gauss points in every span.
    Points(usize),
}

/// A basis with its quadrature.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(try_from = "(Basis, Quadrature)")]
pub struct Mesh {
    basis: Basis,
    quadrature: Quadrature,
}

/// The numbers of quadrature points of a beam.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct PointCounts {
    /// For axial and shear strain `Γ`, each with a section force as an unknown that is condensed there.
    pub force: usize,
    /// For the bending strain `κ`.
    pub moment: usize,
    /// For the mass matrix, which is integrated once.
    pub inertia: usize,
}

/// A span with the numbers of its quadrature points.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct QuadratureSpan {
    pub(super) span: Span,
    pub(super) force_points: usize,
    pub(super) moment_points: usize,
}

/// From basis and quadrature, as stored.
impl TryFrom<(Basis, Quadrature)> for Mesh {
    type Error = BeamError;

    fn try_from((basis, quadrature): (Basis, Quadrature)) -> Result<Self, BeamError> {
        Self::new(basis).with_quadrature(quadrature)
    }
}

impl Mesh {
    /// B-splines: `spans` equal spans, C^`continuity` where they meet.
    ///
    /// # Errors
    /// When the numbers make no knot vector.
    pub fn bspline(spans: usize, degree: usize, continuity: usize) -> Result<Self, GeometryError> {
        Ok(Self::new(Basis::BSpline(KnotVector::uniform(spans, degree, continuity)?)))
    }

    /// Lagrange elements of degree 1 to 3.
    ///
    /// # Errors
    /// When degree or number of elements is out of range.
    pub fn lagrange(elements: usize, degree: usize) -> Result<Self, GeometryError> {
        Ok(Self::new(Basis::Lagrange(LagrangeBasis::uniform(elements, degree)?)))
    }

    /// Any basis, with the patch rule.
    pub fn new(basis: Basis) -> Self {
        Self { basis, quadrature: Quadrature::Patch }
    }

    /// The same basis with another quadrature for axial and shear strain.
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

    /// The same mesh, only C⁰ at the given places of the domain.
    ///
    /// # Errors
    /// When a place lies outside the domain.
    pub fn with_breaks(&self, places: &[f64]) -> Result<Self, GeometryError> {
        let broken =
            places.iter().try_fold(self.basis.clone(), |basis, &xi| basis.with_break(xi))?;
        Ok(Self { basis: broken, quadrature: self.quadrature })
    }

    /// The basis.
    pub fn basis(&self) -> &Basis {
        &self.basis
    }

    /// The rule for axial and shear strain.
    pub fn quadrature(&self) -> Quadrature {
        self.quadrature
    }

    /// The number of spans or elements.
    pub fn spans(&self) -> usize {
        self.basis.spans().len()
    }

    /// In words: `cubic B-splines C², 14 spans`.
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
            Quadrature::Points(points) => format!(", {points} points for the strain"),
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

    /// How many quadrature points all spans have together.
    pub fn point_counts(&self) -> PointCounts {
        let spans = self.quadrature_spans();
        PointCounts {
            force: spans.iter().map(|span| span.force_points).sum(),
            moment: spans.iter().map(|span| span.moment_points).sum(),
            inertia: spans.len() * self.points_of_inertia(),
        }
    }

    /// The spans with the numbers of their quadrature points for `Γ` and `κ`.
    pub(super) fn quadrature_spans(&self) -> Vec<QuadratureSpan> {
        let degree = self.basis.degree();
        self.runs()
            .into_iter()
            .flat_map(|run| {
                let last = run.len() - 1;
                run.into_iter().enumerate().map(move |(at, span)| {
                    let patch = match last {
                        0 => degree,
                        _ if at == 0 || at == last => 1 + degree / 2,
                        _ => 1,
                    };
                    let force_points = match self.quadrature {
                        Quadrature::Patch => patch,
                        Quadrature::Points(points) => points,
                    };
                    let moment_points = if last > 0 { (degree - 1).max(2) } else { degree };
                    QuadratureSpan { span, force_points, moment_points }
                })
            })
            .collect()
    }

    /// The spans, those that are joined smoothly together: all but one of the functions of two neighbours are common to both.
    fn runs(&self) -> Vec<Vec<Span>> {
        let is_joined = |a: &Span, b: &Span| b.first == a.first + 1 && self.basis.degree() > 1;
        let spans = self.basis.spans();
        spans.chunk_by(is_joined).map(<[Span]>::to_vec).collect()
    }

    /// Points and weights for `Γ` on each span: `∫ f dξ ≈ Σ weight · f(point)`.
    ///
    /// The points are those of Gauss. Where the patch rule has as many as a run of spans has derivatives of functions, its weights are chosen to
    /// integrate these exactly, so that a constant section force is in balance: Gauss's single points do that only far from
    /// the ends of the run.
    pub(super) fn force_rules(&self) -> Result<Vec<Vec<(f64, f64)>>, GeometryError> {
        let gauss = |of: &QuadratureSpan| {
            let rule = GaussRule::new(of.force_points)?;
            Ok(rule.iter_on(of.span.start, of.span.end).collect())
        };
        let spans = self.quadrature_spans();
        let mut rules: Vec<Vec<(f64, f64)>> =
            spans.iter().map(gauss).collect::<Result<_, GeometryError>>()?;
        if self.quadrature == Quadrature::Patch {
            let mut rest = rules.as_mut_slice();
            for run in self.runs() {
                let (rules, others) = rest.split_at_mut(run.len());
                rest = others;
                if run.len() > 1 {
                    balance(&self.basis, &run, rules);
                }
            }
        }
        Ok(rules)
    }

    /// The Gauss rule that integrates the inertia of a span exactly when it is straight.
    pub(super) fn inertia_rule(&self) -> Result<GaussRule, GeometryError> {
        GaussRule::new(self.points_of_inertia())
    }

    fn points_of_inertia(&self) -> usize {
        self.basis.degree() + 1
    }
}

/// A weight may become so many times smaller than that of Gauss.
const SMALLEST_WEIGHT: f64 = 0.1;

/// Gives a run the weights that integrate derivatives exactly, if there are such and all are clearly positive: spans of very different
/// lengths keep those of Gauss, for a negative weight would be a negative stiffness.
fn balance(basis: &Basis, run: &[Span], rules: &mut [Vec<(f64, f64)>]) {
    let points = |rule: &Vec<(f64, f64)>| rule.iter().map(|(xi, _)| *xi).collect();
    let points: Vec<Vec<f64>> = rules.iter().map(points).collect();
    let Some(weights) = derivative_weights(basis, run, &points) else { return };
    let gauss = rules.iter_mut().flatten().map(|(_, weight)| weight);
    if gauss.zip(&weights).all(|(gauss, weight)| *weight >= SMALLEST_WEIGHT * *gauss) {
        let gauss = rules.iter_mut().flatten().map(|(_, weight)| weight);
        gauss.zip(weights).for_each(|(gauss, weight)| *gauss = weight);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn force_points(mesh: &Mesh) -> Vec<usize> {
        mesh.quadrature_spans().iter().map(|span| span.force_points).collect()
    }

    #[test]
    fn the_patch_rule_is_the_one_of_the_design() {
        let cubic = Mesh::bspline(6, 3, 2).unwrap();
        assert_eq!(force_points(&cubic), [2, 1, 1, 1, 1, 2]);
        assert!(cubic.quadrature_spans().iter().all(|span| span.moment_points == 2));
        assert_eq!(force_points(&Mesh::bspline(4, 3, 1).unwrap()), [3, 3, 3, 3]);
        assert_eq!(force_points(&Mesh::lagrange(3, 1).unwrap()), [1, 1, 1]);
        assert_eq!(force_points(&Mesh::lagrange(2, 3).unwrap()), [3, 3]);
        assert_eq!(force_points(&Mesh::bspline(1, 3, 2).unwrap()), [3]);
    }

    #[test]
    fn points_are_counted_over_all_spans() {
        let counts = |mesh: Mesh| {
            let PointCounts { force, moment, inertia } = mesh.point_counts();
            [force, moment, inertia]
        };
        assert_eq!(counts(Mesh::bspline(6, 3, 2).unwrap()), [8, 12, 24]);
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
    }
}
