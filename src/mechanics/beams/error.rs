//! Errors of beams.

use crate::geometry::GeometryError;

/// Section, mesh or beam that cannot be built.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum BeamError {
    /// Section property that is not positive and finite.
    #[error(
        "section: {name} is {value}, but must be a positive finite number [{dimension}]{advice}"
    )]
    SectionValue {
        /// Name of the property.
        name: &'static str,
        /// Rejected value.
        value: f64,
        /// Dimension, such as `force`.
        dimension: &'static str,
        /// Additional advice; may be empty.
        advice: &'static str,
    },
    /// Poisson's ratio outside its range.
    #[error("section: nu is {value}, but Poisson's ratio must lie in (-1, 0.5]")]
    PoissonRatio {
        /// Rejected value [-].
        value: f64,
    },
    /// Tube whose inner radius is not smaller than the outer one.
    #[error(
        "section: the inner radius {inner} of a tube must be smaller than the outer radius {outer}"
    )]
    Tube {
        /// Inner radius [length].
        inner: f64,
        /// Outer radius [length].
        outer: f64,
    },
    /// Taper with too few or too many places.
    #[error("taper: a section varies between 2 places or more, at most {most}, and {} given", places(.count))]
    TaperPlaces {
        /// Number of places.
        count: usize,
        /// Largest allowed number.
        most: usize,
    },
    /// Taper whose places do not increase from 0 to 1.
    #[error(
        "taper: a place is {value}, but places must rise from 0, the start of the beam, to 1, its end"
    )]
    TaperPlace {
        /// First place out of order [-].
        value: f64,
    },
    /// Taper between solids of different shapes.
    #[error(
        "taper: there is no shape between a rectangle, a circle and a tube; give shapes of one kind, or stiffness and inertia"
    )]
    TaperShapes,
    /// Quadrature with too few or too many points.
    #[error("quadrature: {points} points a span, but allowed are 1 to {most} for degree {degree}")]
    Quadrature {
        /// Requested number of points.
        points: usize,
        /// Largest allowed number.
        most: usize,
        /// Degree of the basis.
        degree: usize,
    },
    /// Spans of too different lengths for a patch rule.
    #[error(
        "the longest span of a smooth piece of the mesh is {ratio:.1e} times as long as the shortest: strain points that neither lock nor leave modes \
         without energy cannot be found in rounded numbers; grade the spans more gently, or make the basis C0 between long and short ones \
         (repeat the knot as often as the degree says)"
    )]
    UnevenSpans {
        /// Length of the longest span over that of the shortest [-].
        ratio: f64,
    },
    /// Axis or mesh that cannot be represented.
    #[error(transparent)]
    Geometry(#[from] GeometryError),
    /// Axis with a point without a tangent.
    #[error(
        "the axis has no tangent at parameter {parameter}: its derivative vanishes there; use more spans or elements, or move the control points apart"
    )]
    NoTangent {
        /// Parameter of the point [-].
        parameter: f64,
    },
}

fn places(count: &usize) -> String {
    if *count == 1 { "1 place is".to_owned() } else { format!("{count} places are") }
}
