//! Representation of a curve in a given basis.

use super::collocation::{CollocationRow, solve};
use super::{Basis, Curve, GeometryError, Vec2};

/// Returns the control points (splines) or nodes (Lagrange elements) that represent `curve` in `basis`, one per function [length].
///
/// The interpolation is exact for lines, and for splines with the same knots.
/// Other curves are interpolated at the [abscissae](Basis::abscissae) of the basis, which include the ends of the curve.
/// For smooth curves, the interpolation error is of order `degree + 1` in the span length.
/// Corners of the curve, where its tangent jumps, are represented only at C⁰ breaks of the basis.
///
/// # Errors
/// Fails if the curve cannot be evaluated.
pub fn interpolate(curve: &Curve, basis: &Basis) -> Result<Vec<Vec2>, GeometryError> {
    if let (Curve::Spline(spline), Basis::BSpline(knots)) = (curve, basis)
        && spline.knots().is_affine_to(knots)
    {
        return Ok(spline.control_points().to_vec());
    }
    let abscissae = basis.abscissae();
    let points =
        abscissae.iter().map(|&xi| curve.point(corresponding(xi, basis.domain(), curve.domain())));
    match (curve, basis) {
        (Curve::Line(_), _) | (_, Basis::Lagrange(_)) => points.collect(),
        _ => {
            let rows = abscissae.iter().zip(points).map(|(&xi, point)| {
                let values = basis.evaluate(xi)?;
                Ok(CollocationRow {
                    first: values.first,
                    entries: values.values().to_vec(),
                    right_side: point?,
                })
            });
            Ok(solve(rows.collect::<Result<_, GeometryError>>()?))
        }
    }
}

/// Affine map of `xi` from the interval `[a, b]` to `[start, end]`. The map is exact at the ends.
pub fn corresponding(xi: f64, (a, b): (f64, f64), (start, end): (f64, f64)) -> f64 {
    let t = (xi - a) / (b - a);
    ((1.0 - t) * start + t * end).clamp(start, end)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::samples::{bases, spline_curves};
    use crate::geometry::{KnotVector, LagrangeBasis};
    use proptest::prelude::*;

    fn quarter_circle() -> Curve {
        Curve::arc(Vec2::new(1.0, 2.0), 3.0, 0.2, 0.2 + std::f64::consts::FRAC_PI_2).unwrap()
    }

    fn spline(spans: usize, degree: usize, continuity: usize) -> Basis {
        Basis::BSpline(KnotVector::uniform(spans, degree, continuity).unwrap())
    }

    fn error(curve: &Curve, basis: &Basis) -> f64 {
        let points = interpolate(curve, basis).unwrap();
        (0..=200)
            .map(|i| f64::from(i) / 200.0)
            .map(|xi| {
                (basis.evaluate(xi).unwrap().combine(0, &points) - curve.point(xi).unwrap()).norm()
            })
            .fold(0.0, f64::max)
    }

    #[test]
    fn interpolated_arcs_converge_at_one_order_above_the_degree() {
        for continuity in [0, 1, 2] {
            let errors =
                [8, 16, 32].map(|spans| error(&quarter_circle(), &spline(spans, 3, continuity)));
            for pair in errors.windows(2) {
                assert!((pair[0] / pair[1]).log2() > 3.7, "C{continuity}: {errors:?}");
            }
        }
        let lagrange = |elements| Basis::Lagrange(LagrangeBasis::uniform(elements, 2).unwrap());
        assert!(
            (error(&quarter_circle(), &lagrange(8)) / error(&quarter_circle(), &lagrange(16)))
                .log2()
                > 2.8
        );
    }

    #[test]
    fn length_and_curvature_of_the_interpolated_arc_converge() {
        let curve = quarter_circle();
        let errors = [8, 16, 32].map(|spans| {
            let knots = KnotVector::uniform(spans, 3, 2).unwrap();
            let points = interpolate(&curve, &Basis::BSpline(knots.clone())).unwrap();
            let fitted = Curve::spline(knots, points).unwrap();
            let bend = (fitted.curvature(0.5).unwrap() - curve.curvature(0.5).unwrap()).abs();
            ((fitted.length() - curve.length()).abs(), bend)
        });
        for pair in errors.windows(2) {
            assert!((pair[0].0 / pair[1].0).log2() > 3.7, "length: {errors:?}");
            assert!((pair[0].1 / pair[1].1).log2() > 1.7, "curvature: {errors:?}");
        }
    }

    #[test]
    fn interpolation_on_the_same_knots_keeps_control_points() {
        let knots = KnotVector::new(2, [0.0, 0.0, 0.0, 1.0, 3.0, 3.0, 3.0].to_vec()).unwrap();
        let mapped =
            KnotVector::new(2, [0.0, 0.0, 0.0, 1.0 / 3.0, 1.0, 1.0, 1.0].to_vec()).unwrap();
        let points = [[0.0, 0.0], [1.0, 0.3], [0.2, 2.0], [3.0, 1.0]].map(Vec2::from).to_vec();
        let curve = Curve::spline(knots, points.clone()).unwrap();
        assert_eq!(interpolate(&curve, &Basis::BSpline(mapped)).unwrap(), points);
    }

    proptest! {
        #[test]
        fn lines_are_interpolated_exactly_in_every_basis(basis in bases(), t in 0.0..=1.0f64) {
            let line = Curve::line(Vec2::new(0.0, 8.0), Vec2::new(6.0, 0.0)).unwrap();
            let points = interpolate(&line, &basis).unwrap();
            let (start, end) = basis.domain();
            let xi = ((1.0 - t) * start + t * end).clamp(start, end);
            let fitted = basis.evaluate(xi).unwrap().combine(0, &points);
            let exact = line.point(corresponding(xi, (start, end), (0.0, 1.0))).unwrap();
            prop_assert!((fitted - exact).norm() < 1e-13);
        }

        #[test]
        fn interpolants_equal_the_curve_at_the_abscissae(basis in bases()) {
            let curve = quarter_circle();
            let points = interpolate(&curve, &basis).unwrap();
            for xi in basis.abscissae() {
                let fitted = basis.evaluate(xi).unwrap().combine(0, &points);
                let exact = curve.point(corresponding(xi, basis.domain(), (0.0, 1.0))).unwrap();
                prop_assert!((fitted - exact).norm() < 1e-12);
            }
            prop_assert_eq!(points[0], curve.point(0.0).unwrap());
            prop_assert_eq!(points[points.len() - 1], curve.point(1.0).unwrap());
        }

        #[test]
        fn interpolation_in_a_finer_basis_reproduces_a_spline(spline in spline_curves(), t in 0.05..0.95f64) {
            let (start, end) = spline.knots().domain();
            let xi = (1.0 - t) * start + t * end;
            let Ok(finer) = spline.insert(xi, 1) else { return Ok(()) };
            let basis = Basis::BSpline(finer.knots().clone());
            let fitted = interpolate(&Curve::Spline(spline), &basis).unwrap();
            for (fitted, exact) in fitted.iter().zip(finer.control_points()) {
                prop_assert!((fitted - exact).norm() < 1e-7, "{fitted} {exact}");
            }
        }
    }
}
