//! What can be wrong with a beam.

use crate::geometry::GeometryError;

/// A section, mesh or beam that cannot be built.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum BeamError {
    /// A property of a section that is not positive and finite.
    #[error(
        "section: {name} is {value}, but must be a positive finite number [{dimension}]{advice}"
    )]
    SectionValue {
        /// The name of the refused property of a section.
        name: &'static str,
        /// The value of the refused property, in its dimension.
        value: f64,
        /// The dimension of the refused property, in words such as `force`.
        dimension: &'static str,
        /// What to do about the refused property, when there is more to say.
        advice: &'static str,
    },
    /// Poisson's ratio of a material is out of range.
    #[error("section: nu is {value}, but Poisson's ratio must lie in (-1, 0.5]")]
    PoissonRatio {
        /// The value given for Poisson's ratio [-].
        value: f64,
    },
    /// A tube whose hole is not smaller than itself.
    #[error(
        "section: the inner radius {inner} of a tube must be smaller than the outer radius {outer}"
    )]
    Tube {
        /// The inner radius given for a tube [length].
        inner: f64,
        /// The outer radius given for a tube [length].
        outer: f64,
    },
    /// A taper with too few or too many places.
    #[error("taper: a section varies between 2 places or more, at most {most}, and {} given", places(.count))]
    TaperPlaces {
        /// The number of places that were given.
        count: usize,
        /// The most places of a taper.
        most: usize,
    },
    /// A taper whose places do not rise from its start to its end.
    #[error(
        "taper: a place is {value}, but places must rise from 0, the start of the beam, to 1, its end"
    )]
    TaperPlace {
        /// The place that is in the wrong order [-].
        value: f64,
    },
    /// A taper between shapes between which there is none.
    #[error(
        "taper: there is no shape between a rectangle, a circle and a tube; give shapes of one kind, or stiffness and inertia"
    )]
    TaperShapes,
    /// A quadrature with too few or too many points.
    #[error("quadrature: {points} points a span, but allowed are 1 to {most} for degree {degree}")]
    Quadrature {
        /// The number of quadrature points asked for.
        points: usize,
        /// The largest number of quadrature points that makes sense.
        most: usize,
        /// The polynomial degree of the basis whose quadrature was asked for.
        degree: usize,
    },
    /// Spans of a mesh that differ so much in length that there is no patch rule.
    #[error(
        "the longest span of a smooth piece of the mesh is {ratio:.1e} times as long as the shortest: strain points that neither lock nor leave modes \
         without energy cannot be found in rounded numbers; grade the spans more gently, or make the basis C0 between long and short ones \
         (repeat the knot as often as the degree says)"
    )]
    UnevenSpans {
        /// The length of the longest span over that of the shortest [-].
        ratio: f64,
    },
    /// The axis or the mesh of a beam cannot be represented.
    #[error(transparent)]
    Geometry(#[from] GeometryError),
    /// The axis of a beam has a point without a tangent.
    #[error(
        "the axis has no tangent at parameter {parameter}: its derivative vanishes there; use more spans or elements, or move the control points apart"
    )]
    NoTangent {
        /// The parameter of the axis at which there is no tangent [-].
        parameter: f64,
    },
}

/// How many places are given, in words.
fn places(count: &usize) -> String {
    if *count == 1 { "1 place is".to_owned() } else { format!("{count} places are") }
}
