//! Local interpolation of points by a cubic spline.

use super::error::finite_point;
use super::{GeometryError, KnotVector, SplineCurve, Vec2, cross};

/// Largest angle [rad] between two chords that count as parallel, and largest relative length of a sum of chords that counts as zero.
const PARALLEL: f64 = 1e-12;

/// Local cubic interpolation (The NURBS Book, section 9.3.4) through `n + 1` points. One cubic piece joins each pair of consecutive points.
/// The end tangents of a cubic piece are those of [`tangents`]. The speed `|dx/dξ|` has the same value at the ends and middles of all pieces.
///
/// # Errors
/// Fails if there are fewer than two points, coordinates are not finite, or consecutive points are closer than about 1e-12 of the curve length.
pub(super) fn through(points: &[Vec2]) -> Result<SplineCurve, GeometryError> {
    if points.len() < 2 {
        return Err(GeometryError::TooFewPoints { count: points.len(), needed: 2 });
    }
    for (index, &point) in points.iter().enumerate() {
        finite_point(format!("point {index}"), point)?;
    }
    let chords: Vec<Vec2> = points.windows(2).map(|ends| ends[1] - ends[0]).collect();
    if let Some(before) = chords.iter().position(|chord| chord.norm() == 0.0) {
        return Err(GeometryError::CoincidentPoints { index: before + 1, point: points[before] });
    }
    let tangents = tangents(&chords);

    let mut control_points = vec![points[0]];
    let mut ends = vec![0.0];
    let mut end = 0.0;
    for ((corners, tangents), chord) in points.windows(2).zip(tangents.windows(2)).zip(&chords) {
        let speed = common_speed(*chord, tangents[0] + tangents[1]);
        control_points.push(corners[0] + speed / 3.0 * tangents[0]);
        control_points.push(corners[1] - speed / 3.0 * tangents[1]);
        end += speed;
        ends.push(end);
    }
    control_points.push(points[points.len() - 1]);

    let interior = ends[1..ends.len() - 1].iter().flat_map(|knot| [knot / end; 2]);
    let knots = [0.0; 4].into_iter().chain(interior).chain([1.0; 4]).collect();
    SplineCurve::new(KnotVector::new(3, knots)?, control_points)
}

/// Speed at the start, the middle and the end of a cubic piece (The NURBS Book, equation 9.50).
fn common_speed(chord: Vec2, tangent_sum: Vec2) -> f64 {
    let a = 16.0 - tangent_sum.norm_squared();
    let half_b = 6.0 * chord.dot(&tangent_sum);
    let c = -36.0 * chord.norm_squared();
    let root = (half_b * half_b - a * c).sqrt();
    // The form of the root depends on the sign of `half_b`, so that no cancellation occurs.
    if half_b > 0.0 { -c / (half_b + root) } else { (root - half_b) / a }
}

/// Unit tangents at the points between consecutive `chords` and at both ends.
/// Akima's rule computes a tangent from two chords on either side (The NURBS Book, equations 9.29 and 9.31).
fn tangents(chords: &[Vec2]) -> Vec<Vec2> {
    let count = chords.len();
    let before = continued(chords[0], chords[1.min(count - 1)]);
    let after = continued(chords[count - 1], chords[count.saturating_sub(2)]);
    let all: Vec<Vec2> = before.iter().rev().chain(chords).chain(&after).copied().collect();
    all.windows(4).map(|chords| akima_tangent(chords[0], chords[1], chords[2], chords[3])).collect()
}

/// Two additional chords beyond an end of the curve, extrapolated from the last two chords (The NURBS Book, equation 9.33).
/// The chord `far` is scaled to the length of `near`. Without scaling, a curve through unequally spaced points could start backwards.
fn continued(near: Vec2, far: Vec2) -> [Vec2; 2] {
    let next = |near: Vec2, far: Vec2| 2.0 * near - near.norm() / far.norm() * far;
    let first = next(near, far);
    [first, next(first, near)]
}

/// Unit tangent at the point between the chords `b` and `c` of four consecutive chords.
/// At a corner between two straight parts, both chords have equal weight, which rounds the corner.
/// If the direction of the curve reverses, the tangent is the direction of the following chord.
fn akima_tangent(a: Vec2, b: Vec2, c: Vec2, d: Vec2) -> Vec2 {
    let (bend_before, bend_after) = (cross(a, b).abs(), cross(c, d).abs());
    let straight = bend_before <= PARALLEL * a.norm() * b.norm()
        && bend_after <= PARALLEL * c.norm() * d.norm();
    let alpha = if straight { 0.5 } else { bend_before / (bend_before + bend_after) };
    let direction = (1.0 - alpha) * b + alpha * c;
    if direction.norm() > PARALLEL * (b.norm() + c.norm()) {
        direction.normalize()
    } else {
        c.normalize()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::unit;
    use proptest::prelude::*;

    fn near(a: Vec2, b: Vec2) -> bool {
        (a - b).norm() < 1e-12 * (1.0 + a.norm())
    }

    #[test]
    fn equidistant_points_on_a_line_give_the_uniform_line() {
        let (from, to) = (Vec2::new(0.0, 8.0), Vec2::new(6.0, 0.0));
        let at = |t: f64| (1.0 - t) * from + t * to;
        for n in [1, 2, 3, 7, 20] {
            let points: Vec<_> = (0..=n).map(|i| at(f64::from(i) / f64::from(n))).collect();
            let curve = through(&points).unwrap();
            let uniform = KnotVector::uniform(n as usize, 3, 1).unwrap();
            assert!(
                curve
                    .knots()
                    .knots()
                    .iter()
                    .zip(uniform.knots())
                    .all(|(a, b)| (a - b).abs() < 2e-15)
            );
            for (point, xi) in curve.control_points().iter().zip(uniform.greville()) {
                assert!((point - at(xi)).norm() < 2e-14);
            }
        }
    }

    #[test]
    fn curve_through_graded_collinear_points_is_monotonic() {
        let points = [0.0, 1.0, 5.0, 30.0, 31.0].map(|x| Vec2::new(x, 0.0));
        let curve = through(&points).unwrap();
        assert!(curve.control_points().windows(2).all(|ends| ends[0].x < ends[1].x));
        assert!((curve.length() - 31.0).abs() < 1e-12);
    }

    #[test]
    fn curve_through_points_of_a_circle_has_its_tangents() {
        let points: Vec<_> = (0..9).map(|i| unit(0.3 * f64::from(i))).collect();
        let curve = through(&points).unwrap();
        let knots = curve.knots().breaks();
        for (i, &xi) in knots.iter().enumerate().skip(2).take(5) {
            let velocity = curve.derivative(xi, 1).unwrap();
            assert!(velocity.normalize().dot(&unit(0.3 * i as f64)).abs() < 1e-14);
        }
        assert!((curve.length() - 2.4).abs() < 1e-3);
    }

    #[test]
    fn corners_are_rounded_and_reversals_are_interpolated() {
        let corner = [[0.0, 0.0], [1.0, 0.0], [2.0, 0.0], [2.0, 1.0], [2.0, 2.0]].map(Vec2::from);
        let curve = through(&corner).unwrap();
        let velocity = curve.derivative(curve.knots().breaks()[2], 1).unwrap();
        assert!((velocity.x - velocity.y).abs() < 1e-12 && velocity.x > 0.0);
        let back = [[0.0, 0.0], [1.0, 0.0], [0.0, 0.0]].map(Vec2::from);
        assert!(through(&back).unwrap().length() > 2.0 - 1e-12);
    }

    #[test]
    fn invalid_points_are_rejected_with_a_reason() {
        let refusal = |points: &[[f64; 2]]| {
            through(&points.iter().copied().map(Vec2::from).collect::<Vec<_>>())
                .unwrap_err()
                .to_string()
        };
        assert_eq!(refusal(&[]), "points: 0 given; a curve needs at least 2");
        assert_eq!(refusal(&[[1.0, 1.0]]), "points: 1 given; a curve needs at least 2");
        assert_eq!(
            refusal(&[[0.0, 0.0], [1.0, 2.0], [1.0, 2.0]]),
            "points: entries 1 and 2 are both (1, 2); consecutive points must differ: leave one out"
        );
        assert_eq!(
            refusal(&[[0.0, 0.0], [1.0, f64::INFINITY]]),
            "point 1 is inf, but must be a finite number"
        );
    }

    proptest! {
        #[test]
        fn any_points_are_interpolated_smoothly(
            coordinates in prop::collection::vec((-1.0..1.0f64, -1.0..1.0f64), 2..12)
        ) {
            let points: Vec<_> = coordinates.into_iter().map(|(x, y)| Vec2::new(x, y)).collect();
            let curve = through(&points).unwrap();
            let (knots, spans) = (curve.knots(), points.len() - 1);
            prop_assert_eq!(curve.control_points().len(), 2 * spans + 2);
            let breaks = knots.breaks();
            for (&xi, &point) in breaks.iter().zip(&points) {
                prop_assert!(near(curve.derivative(xi, 0).unwrap(), point));
            }
            let speed = curve.derivative(0.0, 1).unwrap().norm();
            for (span, next) in knots.spans().iter().zip(breaks.iter().skip(1)) {
                let middle = curve.derivative(0.5 * (span.start + span.end), 1).unwrap().norm();
                prop_assert!((middle - speed).abs() < 1e-9 * speed);
                prop_assert!((curve.derivative(*next, 1).unwrap().norm() - speed).abs() < 1e-9 * speed);
            }
            for &xi in &breaks[1..spans] {
                prop_assert_eq!(knots.multiplicity(xi), 2);
                let jump = curve.derivative(xi, 1).unwrap() - curve.derivative(xi - 1e-10, 1).unwrap();
                let bend = curve.derivative(xi - 1e-10, 2).unwrap().norm();
                prop_assert!(jump.norm() < 1e-9 * speed + 2e-10 * bend);
            }
        }
    }
}
