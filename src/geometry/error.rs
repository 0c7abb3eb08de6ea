//! What can be wrong with the description of a curve, a basis or a rule.

use super::Vec2;

/// An impossible request to the geometry layer. Every message names the object, the value, what is
/// allowed and, where it is not plain, what to do.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum GeometryError {
    /// A number is NaN or infinite.
    #[error("{object}: {value} is not a finite number; give a finite one")]
    NotFinite {
        /// What the number was to be, e.g. "knot 3".
        object: String,
        /// The number.
        value: f64,
    },

    /// A polynomial degree that the basis does not offer.
    #[error("degree {degree} is not available; allowed are 1 to {largest}")]
    Degree {
        /// The degree asked for.
        degree: usize,
        /// The largest degree on offer.
        largest: usize,
    },

    /// No span at all, or too many of them.
    #[error("spans: {spans} asked for; at least 1 and at most {largest} are allowed")]
    Spans {
        /// The number asked for.
        spans: usize,
        /// The largest number allowed.
        largest: usize,
    },

    /// More continuity at the interior knots than the degree leaves.
    #[error(
        "continuity {continuity} is not possible with degree {degree}; allowed are 0 to {}",
        .degree - 1
    )]
    Continuity {
        /// The number of continuous derivatives asked for.
        continuity: usize,
        /// The polynomial degree.
        degree: usize,
    },

    /// Fewer knots than two ends need.
    #[error(
        "knots: {count} are too few for degree {degree}; an open knot vector has at least {} ({} at each end)",
        2 * (.degree + 1), .degree + 1
    )]
    TooFewKnots {
        /// The number of knots given.
        count: usize,
        /// The polynomial degree.
        degree: usize,
    },

    /// A knot smaller than the one before it.
    #[error(
        "knots: entry {index} ({value}) is smaller than entry {} ({previous}); knots must not decrease",
        .index - 1
    )]
    DecreasingKnots {
        /// Position of the offending knot, counted from 0.
        index: usize,
        /// The offending knot.
        value: f64,
        /// The knot before it.
        previous: f64,
    },

    /// The curve could not begin or end in its end control point.
    #[error(
        "knots: the {end} knot {knot} has multiplicity {multiplicity}; an open knot vector of degree {degree} \
         repeats it {} times: write {}",
        .degree + 1, open_end(end, *knot, *degree)
    )]
    EndMultiplicity {
        /// "first" or "last".
        end: &'static str,
        /// The knot at that end.
        knot: f64,
        /// How often it occurs.
        multiplicity: usize,
        /// The polynomial degree.
        degree: usize,
    },

    /// The basis would be torn at an interior knot.
    #[error(
        "knots: the interior knot {knot} would have multiplicity {multiplicity}; \
         at most {degree}, the degree, is allowed, else the curve is torn there"
    )]
    InteriorMultiplicity {
        /// The knot.
        knot: f64,
        /// How often it would occur.
        multiplicity: usize,
        /// The polynomial degree, which is the largest multiplicity allowed.
        degree: usize,
    },

    /// Two knots or breaks that are meant to be equal but are not, quite.
    #[error(
        "{object}: the span from {start} to {end} is shorter than 1e-12 of the whole; \
         make the two equal or move them apart"
    )]
    ShortSpan {
        /// "knots" or "breaks".
        object: &'static str,
        /// Start of the span.
        start: f64,
        /// End of the span.
        end: f64,
    },

    /// First and last knot coincide.
    #[error("knots: all of them are {knot}; the last knot must be larger than the first")]
    EmptyDomain {
        /// The only knot.
        knot: f64,
    },

    /// Element ends that do not increase.
    #[error(
        "breaks: entry {index} ({value}) is not larger than entry {} ({previous}); breaks must increase",
        .index - 1
    )]
    BreakOrder {
        /// Position of the offending break, counted from 0.
        index: usize,
        /// The offending break.
        value: f64,
        /// The break before it.
        previous: f64,
    },

    /// A parameter outside the curve or basis.
    #[error("parameter {xi} is outside [{start}, {end}]")]
    OutsideDomain {
        /// The parameter.
        xi: f64,
        /// Start of the domain.
        start: f64,
        /// End of the domain.
        end: f64,
    },

    /// A knot to insert that is not strictly inside the domain.
    #[error("knot {xi} cannot be inserted; it must lie strictly between {start} and {end}")]
    InsertOutside {
        /// The knot.
        xi: f64,
        /// Start of the domain.
        start: f64,
        /// End of the domain.
        end: f64,
    },

    /// Control points and basis functions do not match.
    #[error(
        "control points: {points} given; the knot vector has {functions} basis functions and needs one each"
    )]
    ControlPointCount {
        /// The number of control points given.
        points: usize,
        /// The number of basis functions.
        functions: usize,
    },

    /// Too few points for a curve.
    #[error("points: {count} given; a curve needs at least {needed}")]
    TooFewPoints {
        /// The number of points given.
        count: usize,
        /// The number of points needed.
        needed: usize,
    },

    /// Two consecutive points in the same place.
    #[error(
        "points: entries {} and {index} are both ({}, {}); consecutive points must differ: leave one out",
        .index - 1, .point.x, .point.y
    )]
    CoincidentPoints {
        /// Position of the second of the two, counted from 0.
        index: usize,
        /// Where they are [length].
        point: Vec2,
    },

    /// A line that is a point.
    #[error("line: start and end are both ({}, {}); give two different points", .point.x, .point.y)]
    ZeroLengthLine {
        /// Where it starts and ends [length].
        point: Vec2,
    },

    /// A spline that is a point.
    #[error("spline: all control points are ({}, {}); at least one must differ", .point.x, .point.y)]
    ZeroLengthSpline {
        /// Where they all are [length].
        point: Vec2,
    },

    /// An arc without a proper radius.
    #[error("arc: radius {radius} is not allowed; it must be positive")]
    ArcRadius {
        /// The radius [length].
        radius: f64,
    },

    /// An arc that goes nowhere.
    #[error(
        "arc: it starts and ends at angle {angle}; the two must differ (add 2π for a full circle)"
    )]
    ZeroArc {
        /// The angle [rad].
        angle: f64,
    },

    /// An arc that overlaps itself.
    #[error(
        "arc: it turns by {sweep} rad; at most a full turn, 2π, is allowed in either direction"
    )]
    ArcTurn {
        /// Angle from start to end [rad].
        sweep: f64,
    },

    /// The curve stands still: it has neither tangent nor curvature there.
    #[error(
        "curve: no tangent at parameter {xi}, where its derivative is zero; \
         move control points that coincide, or ask beside it"
    )]
    NoTangent {
        /// The parameter.
        xi: f64,
    },

    /// An arc length that the curve does not have.
    #[error("arc length {arc_length} is outside [0, {length}], the curve's length")]
    OutsideLength {
        /// The arc length asked for [length].
        arc_length: f64,
        /// The length of the curve [length].
        length: f64,
    },

    /// A Gauss rule that is not on offer.
    #[error("quadrature: {points} points asked for; allowed are 1 to {largest}")]
    QuadraturePoints {
        /// The number asked for.
        points: usize,
        /// The largest number on offer.
        largest: usize,
    },
}

/// The end of an open knot vector as one would write it.
fn open_end(end: &str, knot: f64, degree: usize) -> String {
    let repeated = vec![knot.to_string(); degree + 1].join(", ");
    if end == "first" { format!("[{repeated}, …]") } else { format!("[…, {repeated}]") }
}

/// `value`, if it is a finite number.
pub(super) fn finite(object: impl Into<String>, value: f64) -> Result<f64, GeometryError> {
    if value.is_finite() {
        Ok(value)
    } else {
        Err(GeometryError::NotFinite { object: object.into(), value })
    }
}

/// `point`, if both its coordinates are finite numbers.
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
    fn messages_name_object_value_and_what_is_allowed() {
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
