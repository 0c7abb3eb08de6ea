//! Errors of beams.

use crate::geometry::GeometryError;

/// Error for a section, mesh or beam that cannot be built.
#[expect(missing_docs, reason = "the messages describe the variants and their fields")]
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum BeamError {
    #[error("section: {name} is {value}, but must be a positive finite number [{dimension}]{hint}")]
    SectionValue { name: &'static str, value: f64, dimension: &'static str, hint: &'static str },
    #[error("section: nu is {value}, but Poisson's ratio must lie in (-1, 0.5]")]
    PoissonRatio {
        /// Rejected value [-].
        value: f64,
    },
    #[error(
        "section: the inner radius {inner} of a tube must be smaller than the outer radius {outer}"
    )]
    Tube {
        /// Inner radius [length].
        inner: f64,
        /// Outer radius [length].
        outer: f64,
    },
    #[error("taper: {} given, but 2 to {most} are needed", places(.count))]
    TaperPlaces { count: usize, most: usize },
    #[error(
        "taper: a place is {value}, but places must increase from 0 (start of the beam) to 1 (its end)"
    )]
    TaperPlace { value: f64 },
    #[error(
        "taper: sections of different shapes (rectangle, circle, tube) cannot be interpolated; give sections of one shape, or stiffnesses and inertias"
    )]
    TaperShapes,
    #[error(
        "quadrature: {points} points per span, but 1 to {most} are allowed for degree {degree}"
    )]
    Quadrature { points: usize, most: usize, degree: usize },
    #[error(
        "the longest span of a smooth part of the mesh is {ratio:.1e} times as long as the shortest, too much for an accurate quadrature of the strains; change the span lengths more gradually, or make the basis C0 between long and short spans (repeat the knot as often as the degree)"
    )]
    UnevenSpans {
        /// Ratio of the longest span to the shortest [-].
        ratio: f64,
    },
    #[error(transparent)]
    Geometry(#[from] GeometryError),
    #[error(
        "the axis has no tangent at parameter {parameter}: its derivative vanishes there; use more spans or elements, or move the control points apart"
    )]
    NoTangent {
        /// Parameter of the mesh at the point without a tangent [-].
        parameter: f64,
    },
}

fn places(count: &usize) -> String {
    if *count == 1 { "1 place is".to_owned() } else { format!("{count} places are") }
}
