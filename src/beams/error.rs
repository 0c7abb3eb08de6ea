//! What can be wrong with a beam.

use crate::geometry::GeometryError;

/// A section, mesh or beam that cannot be built.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum BeamError {
    /// A property of a section is not positive and finite.
    #[error(
        "section: {name} is {value}, but must be a positive finite number [{dimension}]{advice}"
    )]
    SectionValue {
        /// The property.
        name: &'static str,
        /// Its value.
        value: f64,
        /// Its dimension.
        dimension: &'static str,
        /// What to do, when there is more to say.
        advice: &'static str,
    },
    /// Poisson's ratio out of range.
    #[error("section: nu is {value}, but Poisson's ratio must lie in (-1, 0.5]")]
    PoissonRatio {
        /// Its value.
        value: f64,
    },
    /// A tube whose hole is not smaller than itself.
    #[error(
        "section: the inner radius {inner} of a tube must be smaller than the outer radius {outer}"
    )]
    Tube {
        /// Inner radius.
        inner: f64,
        /// Outer radius.
        outer: f64,
    },
    /// A quadrature with too few or too many points.
    #[error("quadrature: {points} points a span, but allowed are 1 to {most} for degree {degree}")]
    Quadrature {
        /// Points asked for.
        points: usize,
        /// Most that make sense.
        most: usize,
        /// Degree of the basis.
        degree: usize,
    },
    /// Spans for whose lengths there is no patch rule.
    #[error(
        "the longest span of a smooth piece of the mesh is {ratio:.1e} times as long as the shortest: strain points that neither lock nor leave modes \
         without energy cannot be found in rounded numbers; grade the spans more gently, or make the basis C0 between long and short ones \
         (repeat the knot as often as the degree says)"
    )]
    UnevenSpans {
        /// Length of the longest over that of the shortest.
        ratio: f64,
    },
    /// The geometry cannot be represented.
    #[error(transparent)]
    Geometry(#[from] GeometryError),
    /// The axis has a point without a direction.
    #[error(
        "the axis has no tangent at parameter {parameter}: its derivative vanishes there; use more spans or elements, or move the control points apart"
    )]
    NoTangent {
        /// Where.
        parameter: f64,
    },
}
