//! What can be wrong with the description of a curve, a basis or a rule.

use super::Vec2;

/// An impossible request to the geometry layer. Every message names the object, the value, what is
/// allowed and, where it is not plain, what to do.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum GeometryError {
    /// A number given to the geometry is NaN or infinite.
    #[error("{object}: {value} is not a finite number; give a finite one")]
    NotFinite {
        /// What the number that is not finite was to be, e.g. "knot 3".
        object: String,
        /// The number that is not finite.
        value: f64,
    },

    /// A polynomial degree that the basis does not offer.
    #[error("degree {degree} is not available; allowed are 1 to {largest}")]
    Degree {
        /// The polynomial degree asked for.
        degree: usize,
        /// The largest polynomial degree on offer.
        largest: usize,
    },

    /// A basis with no span at all, or with too many of them.
    #[error("spans: {spans} asked for; at least 1 and at most {largest} are allowed")]
    Spans {
        /// The number of spans asked for.
        spans: usize,
        /// The largest number of spans allowed.
        largest: usize,
    },

    /// More continuous derivatives at the interior knots than the degree of the splines leaves.
    #[error(
        "continuity {continuity} is not possible with degree {degree}; allowed are 0 to {}",
        .degree - 1
    )]
    Continuity {
        /// The number of continuous derivatives asked for at interior knots.
        continuity: usize,
        /// The polynomial degree of splines for which too many continuous derivatives were asked.
        degree: usize,
    },

    /// A knot vector with fewer knots than its two ends need.
    #[error(
        "knots: {count} are too few for degree {degree}; an open knot vector has at least {} ({} at each end)",
        2 * (.degree + 1), .degree + 1
    )]
    TooFewKnots {
        /// The number of knots given where there are too few.
        count: usize,
        /// The polynomial degree of splines with too few knots.
        degree: usize,
    },

    /// A knot smaller than the one before it.
    #[error(
        "knots: entry {index} ({value}) is smaller than entry {} ({previous}); knots must not decrease",
        .index - 1
    )]
    DecreasingKnots {
        /// The position of the knot that is smaller than the one before it, counted from 0.
        index: usize,
        /// The knot that is smaller than the one before it [-].
        value: f64,
        /// The knot before the one that is smaller [-].
        previous: f64,
    },

    /// An end knot that is not repeated often enough: the curve could not begin or end in its end control point.
    #[error(
        "knots: the {end} knot {knot} has multiplicity {multiplicity}; an open knot vector of degree {degree} \
         repeats it {} times: write {}",
        .degree + 1, open_end(end, *knot, *degree)
    )]
    EndMultiplicity {
        /// Which end knot of the vector is meant: "first" or "last".
        end: &'static str,
        /// The end knot that is repeated too seldom or too often [-].
        knot: f64,
        /// How often the end knot occurs in the knot vector.
        multiplicity: usize,
        /// The polynomial degree of the splines whose end knot is not repeated as it should be.
        degree: usize,
    },

    /// An interior knot that is repeated so often that the basis would be torn there.
    #[error(
        "knots: the interior knot {knot} would have multiplicity {multiplicity}; \
         at most {degree}, the degree, is allowed, else the curve is torn there"
    )]
    InteriorMultiplicity {
        /// The interior knot that would be repeated too often [-].
        knot: f64,
        /// How often the interior knot would occur.
        multiplicity: usize,
        /// The polynomial degree of the splines, which is the largest multiplicity of an interior knot.
        degree: usize,
    },

    /// Two knots or breaks that are meant to be equal but are not, quite: the span between them would be nothing but rounding.
    #[error(
        "{object}: the span from {start} to {end} is shorter than 1e-12 of the whole; \
         make the two equal or move them apart"
    )]
    ShortSpan {
        /// What is too close together: "knots" or "breaks".
        object: &'static str,
        /// The start of the span that is too short [-].
        start: f64,
        /// The end of the span that is too short [-].
        end: f64,
    },

    /// A knot vector whose first and last knot coincide.
    #[error("knots: all of them are {knot}; the last knot must be larger than the first")]
    EmptyDomain {
        /// The only value of the knots of an empty domain [-].
        knot: f64,
    },

    /// The ends of Lagrange elements do not increase.
    #[error(
        "breaks: entry {index} ({value}) is not larger than entry {} ({previous}); breaks must increase",
        .index - 1
    )]
    BreakOrder {
        /// The position of the break that is not larger than the one before it, counted from 0.
        index: usize,
        /// The break that is not larger than the one before it [-].
        value: f64,
        /// The break before the one that should be larger [-].
        previous: f64,
    },

    /// A parameter outside the curve or basis.
    #[error("parameter {xi} is outside [{start}, {end}]")]
    OutsideDomain {
        /// The parameter that lies outside the curve or basis [-].
        xi: f64,
        /// The start of the domain of the curve or basis [-].
        start: f64,
        /// The end of the domain of the curve or basis [-].
        end: f64,
    },

    /// A knot to insert that is not strictly inside the domain.
    #[error("knot {xi} cannot be inserted; it must lie strictly between {start} and {end}")]
    InsertOutside {
        /// The knot that was to be inserted [-].
        xi: f64,
        /// The start of the domain inside which a knot can be inserted [-].
        start: f64,
        /// The end of the domain inside which a knot can be inserted [-].
        end: f64,
    },

    /// The numbers of control points and of basis functions differ.
    #[error(
        "control points: {points} given; the knot vector has {functions} basis functions and needs one each"
    )]
    ControlPointCount {
        /// The number of control points given for a curve.
        points: usize,
        /// The number of basis functions, each of which needs a control point.
        functions: usize,
    },

    /// Too few points for a curve.
    #[error("points: {count} given; a curve needs at least {needed}")]
    TooFewPoints {
        /// The number of points given for a curve.
        count: usize,
        /// The number of points that the curve needs at least.
        needed: usize,
    },

    /// Two consecutive points of a curve in the same place.
    #[error(
        "points: entries {} and {index} are both ({}, {}); consecutive points must differ: leave one out",
        .index - 1, .point.x, .point.y
    )]
    CoincidentPoints {
        /// The position of the second of two points in the same place, counted from 0.
        index: usize,
        /// The place where two consecutive points coincide [length].
        point: Vec2,
    },

    /// A straight line that is a point: it ends where it starts.
    #[error("line: start and end are both ({}, {}); give two different points", .point.x, .point.y)]
    ZeroLengthLine {
        /// The point where the line starts and ends [length].
        point: Vec2,
    },

    /// A spline that is a point: all its control points coincide.
    #[error("spline: all control points are ({}, {}); at least one must differ", .point.x, .point.y)]
    ZeroLengthSpline {
        /// The point where all control points of the spline are [length].
        point: Vec2,
    },

    /// An arc whose radius is not positive.
    #[error("arc: radius {radius} is not allowed; it must be positive")]
    ArcRadius {
        /// The radius given for the arc [length].
        radius: f64,
    },

    /// An arc that goes nowhere: it ends at the angle where it starts.
    #[error(
        "arc: it starts and ends at angle {angle}; the two must differ (add 2π for a full circle)"
    )]
    ZeroArc {
        /// The angle at which the arc starts and ends [rad].
        angle: f64,
    },

    /// An arc of more than a full turn, which overlaps itself.
    #[error(
        "arc: it turns by {sweep} rad; at most a full turn, 2π, is allowed in either direction"
    )]
    ArcTurn {
        /// The angle from start to end of the arc that overlaps itself [rad].
        sweep: f64,
    },

    /// The curve stands still: it has neither tangent nor curvature there.
    #[error(
        "curve: no tangent at parameter {xi}, where its derivative is zero; \
         move control points that coincide, or ask beside it"
    )]
    NoTangent {
        /// The parameter at which the curve stands still [-].
        xi: f64,
    },

    /// An arc length that the curve does not have.
    #[error("arc length {arc_length} is outside [0, {length}], the curve's length")]
    OutsideLength {
        /// The arc length asked for, which the curve does not have [length].
        arc_length: f64,
        /// The length of the curve of which another arc length was asked [length].
        length: f64,
    },

    /// A Gauss rule that is not on offer.
    #[error("quadrature: {points} points asked for; allowed are 1 to {largest}")]
    QuadraturePoints {
        /// The number of quadrature points asked for.
        points: usize,
        /// The largest number of quadrature points on offer.
        largest: usize,
    },
}

/// The end of an open knot vector as one would write it.
fn open_end(end: &str, knot: f64, degree: usize) -> String {
    let repeated = vec![knot.to_string(); degree + 1].join(", ");
    if end == "first" { format!("[{repeated}, …]") } else { format!("[…, {repeated}]") }
}

/// Gives `value` back, if it is a finite number; otherwise an error that names the `object`, what the number was to be.
pub(super) fn finite(object: impl Into<String>, value: f64) -> Result<f64, GeometryError> {
    if value.is_finite() {
        Ok(value)
    } else {
        Err(GeometryError::NotFinite { object: object.into(), value })
    }
}

/// Gives `point` back, if both its coordinates are finite numbers; otherwise an error that names the `object`, what the point was to be.
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
