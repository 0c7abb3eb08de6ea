//! Errors of curves, bases and quadrature rules.

use super::Vec2;

/// Error of a curve, basis or quadrature rule.
#[expect(missing_docs, reason = "the messages describe the variants and their fields")]
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum GeometryError {
    #[error("{object} is {value}, but must be a finite number")]
    NotFinite { object: String, value: f64 },

    #[error("degree {degree} is not available; allowed are 1 to {largest}")]
    Degree { degree: usize, largest: usize },

    #[error("spans: {spans} requested, but 1 to {largest} are allowed")]
    Spans { spans: usize, largest: usize },

    #[error(
        "continuity {continuity} is not possible with degree {degree}; allowed are 0 to {}",
        .degree - 1
    )]
    Continuity { continuity: usize, degree: usize },

    #[error(
        "knots: {count} are too few for degree {degree}; an open knot vector has at least {} ({} at each end)",
        2 * (.degree + 1), .degree + 1
    )]
    TooFewKnots { count: usize, degree: usize },

    #[error(
        "knots: entry {index} ({value}) is smaller than entry {} ({previous}); knots must not decrease",
        .index - 1
    )]
    DecreasingKnots { index: usize, value: f64, previous: f64 },

    #[error(
        "knots: the {end} knot {knot} has multiplicity {multiplicity}; an open knot vector of degree {degree} \
         repeats it {} times: write {}",
        .degree + 1, open_end(end, *knot, *degree)
    )]
    EndMultiplicity { end: &'static str, knot: f64, multiplicity: usize, degree: usize },

    #[error(
        "knots: the interior knot {knot} has multiplicity {multiplicity}, but at most {degree} (the degree) is allowed for a continuous curve"
    )]
    InteriorMultiplicity { knot: f64, multiplicity: usize, degree: usize },

    #[error(
        "{object}: the span from {start} to {end} is shorter than 1e-12 of the domain; make the two values equal or move them apart"
    )]
    ShortSpan { object: &'static str, start: f64, end: f64 },

    #[error("knots: all are {knot}, but the last knot must be larger than the first")]
    EmptyDomain { knot: f64 },

    #[error(
        "breaks: entry {index} ({value}) is not larger than entry {} ({previous}); breaks must increase",
        .index - 1
    )]
    BreakOrder { index: usize, value: f64, previous: f64 },

    #[error("parameter {xi} is outside [{start}, {end}]")]
    OutsideDomain { xi: f64, start: f64, end: f64 },

    #[error("knot {xi} cannot be inserted; it must lie strictly between {start} and {end}")]
    InsertOutside { xi: f64, start: f64, end: f64 },

    #[error(
        "control points: {points} given; the knot vector has {functions} basis functions and needs one each"
    )]
    ControlPointCount { points: usize, functions: usize },

    #[error("points: {count} given; a curve needs at least {needed}")]
    TooFewPoints { count: usize, needed: usize },

    #[error(
        "points: entries {} and {index} are both ({}, {}); consecutive points must differ: leave one out",
        .index - 1, .point.x, .point.y
    )]
    CoincidentPoints { index: usize, point: Vec2 },

    #[error("line: start and end are both ({}, {}), but must differ", .point.x, .point.y)]
    ZeroLengthLine { point: Vec2 },

    #[error("spline: all control points are ({}, {}); at least one must differ", .point.x, .point.y)]
    ZeroLengthSpline { point: Vec2 },

    #[error("arc: radius is {radius}, but must be positive")]
    ArcRadius { radius: f64 },

    #[error(
        "arc: start and end angle are both {angle}, but must differ (add 2π for a full circle)"
    )]
    ZeroArc { angle: f64 },

    #[error(
        "arc: the angle between start and end is {sweep} rad, but at most 2π is allowed in either direction"
    )]
    ArcTurn { sweep: f64 },

    #[error(
        "curve: no tangent at parameter {xi}, where its derivative is zero; move coincident control points apart, or evaluate at another parameter"
    )]
    NoTangent { xi: f64 },

    #[error("arc length {arc_length} is outside the length of the curve, [0, {length}]")]
    OutsideLength { arc_length: f64, length: f64 },

    #[error("quadrature: {points} points requested, but 1 to {largest} are allowed")]
    QuadraturePoints { points: usize, largest: usize },
}

fn open_end(end: &str, knot: f64, degree: usize) -> String {
    let repeated = vec![knot.to_string(); degree + 1].join(", ");
    if end == "first" { format!("[{repeated}, …]") } else { format!("[…, {repeated}]") }
}

pub(super) fn finite(object: impl Into<String>, value: f64) -> Result<f64, GeometryError> {
    if value.is_finite() {
        Ok(value)
    } else {
        Err(GeometryError::NotFinite { object: object.into(), value })
    }
}

pub(super) fn finite_point(object: impl Into<String>, point: Vec2) -> Result<Vec2, GeometryError> {
    match point.iter().find(|coordinate| !coordinate.is_finite()) {
        None => Ok(point),
        Some(&value) => Err(GeometryError::NotFinite { object: object.into(), value }),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn geometry_errors_state_object_value_and_allowed_values() {
        let too_open =
            GeometryError::EndMultiplicity { end: "first", knot: 0.0, multiplicity: 3, degree: 3 };
        assert_eq!(
            too_open.to_string(),
            "knots: the first knot 0 has multiplicity 3; an open knot vector of degree 3 repeats it 4 times: \
             write [0, 0, 0, 0, …]"
        );
        let decreasing = GeometryError::DecreasingKnots { index: 4, value: 0.3, previous: 0.5 };
        assert_eq!(
            decreasing.to_string(),
            "knots: entry 4 (0.3) is smaller than entry 3 (0.5); knots must not decrease"
        );
        let twice = GeometryError::CoincidentPoints { index: 2, point: Vec2::new(1.0, -0.5) };
        assert_eq!(
            twice.to_string(),
            "points: entries 1 and 2 are both (1, -0.5); consecutive points must differ: leave one out"
        );
    }
}
