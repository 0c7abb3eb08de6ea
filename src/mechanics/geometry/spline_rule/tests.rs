use super::*;
use crate::geometry::KnotVector;
use nalgebra::{DMatrix, SymmetricEigen};

fn basis(sizes: &[f64], degree: usize, continuity: usize) -> Basis {
    let mut breaks = vec![0.0];
    for size in sizes {
        breaks.push(breaks[breaks.len() - 1] + size);
    }
    let end = breaks[sizes.len()];
    let inner = breaks[1..sizes.len()].iter();
    let inner = inner.flat_map(|knot| vec![*knot; degree - continuity]).collect();
    let knots = [vec![0.0; degree + 1], inner, vec![end; degree + 1]].concat();
    Basis::BSpline(KnotVector::new(degree, knots).unwrap())
}

fn sizes(spans: usize) -> [Vec<f64>; 3] {
    let graded = |at: usize| 10_f64.powf(at as f64 / (spans - 1).max(1) as f64);
    let scattered = |at: usize| 10_f64.powf((at as f64 * 0.618_033_988_75).fract());
    [vec![1.0; spans], (0..spans).map(graded).collect(), (0..spans).map(scattered).collect()]
}

fn least_share(basis: &Basis, run: &[Span], rule: &RunRule) -> f64 {
    let count = lower_count(basis, run).unwrap();
    let exact = GaussRule::new(basis.degree()).unwrap();
    let gram = |rule: &RunRule| {
        let mut gram = DMatrix::zeros(count, count);
        for (span, points) in run.iter().zip(rule) {
            for (xi, weight) in points {
                let values = basis.evaluate_in(span, *xi);
                let lower: Vec<f64> = lower_splines(&values).collect();
                for (a, left) in lower.iter().enumerate() {
                    for (b, right) in lower.iter().enumerate() {
                        gram[(span.first + a, span.first + b)] += *weight * left * right;
                    }
                }
            }
        }
        gram
    };
    let sampled = gram(rule);
    let lower =
        gram(&run.iter().map(|span| exact.iter_on(span.start, span.end).collect()).collect());
    let lower = lower.cholesky().unwrap().unpack();
    let half = lower.solve_lower_triangular(&sampled).unwrap();
    let share = lower.solve_lower_triangular(&half.transpose()).unwrap();
    let share = (&share + share.transpose()) * 0.5;
    SymmetricEigen::new(share).eigenvalues.min()
}

#[test]
fn every_spline_has_a_rule_that_detects_all_derivatives() {
    let mut least = f64::INFINITY;
    for degree in 1..=10 {
        for continuity in 1..degree.max(2) {
            let continuity = continuity.min(degree - 1);
            for spans in [2, 3, 4, 7, 16, 33] {
                for sizes in sizes(spans) {
                    let basis = basis(&sizes, degree, continuity);
                    let run = if degree == 1 { basis.spans()[..1].to_vec() } else { basis.spans() };
                    let what = format!("degree {degree}, C{continuity}, {sizes:?}");
                    let rule = patch_rule(&basis, &run).expect(&what);
                    let count: usize = rule.iter().map(Vec::len).sum();
                    assert_eq!(Some(count), lower_count(&basis, &run), "{what}");
                    let points: Vec<f64> = rule.iter().flatten().map(|(xi, _)| *xi).collect();
                    assert!(points.is_sorted_by(|a, b| a < b), "{what}");
                    if degree > 1 && spans <= 16 {
                        least = least.min(least_share(&basis, &run, &rule));
                    }
                }
            }
        }
    }
    assert!(least > 0.79, "{least}");
}

#[test]
fn derivatives_of_all_functions_are_integrated_exactly() {
    for (degree, continuity) in [(2, 1), (3, 2), (3, 1), (4, 2), (5, 4), (8, 7), (9, 8), (10, 3)] {
        for sizes in sizes(9) {
            let basis = basis(&sizes, degree, continuity);
            let rule = patch_rule(&basis, &basis.spans()).unwrap();
            let mut integrals = vec![0.0; basis.functions()];
            for (span, points) in basis.spans().iter().zip(&rule) {
                for (xi, weight) in points {
                    let values = basis.evaluate_in(span, *xi);
                    for (at, slope) in values.slopes().iter().enumerate() {
                        integrals[span.first + at] += weight * slope;
                    }
                }
            }
            let (start, end) = (integrals.remove(0), integrals.pop().unwrap());
            assert!((start + 1.0).abs() < 1e-12 && (end - 1.0).abs() < 1e-12, "{start} {end}");
            assert!(integrals.iter().all(|integral| integral.abs() < 1e-12), "{integrals:?}");
        }
    }
}

#[test]
fn interior_points_are_midpoints_or_knots_by_degree_parity() {
    for degree in [2, 3, 4, 5] {
        let basis = basis(&[1.0; 60], degree, degree - 1);
        let rule = patch_rule(&basis, &basis.spans()).unwrap();
        let (xi, weight) = *rule[29..31].iter().flatten().next().unwrap();
        let part = (2.0 * xi).round() / 2.0;
        assert!((xi - part).abs() < 1e-9 && (weight - 1.0).abs() < 1e-9, "{degree}: {xi} {weight}");
        assert_eq!(part.fract() == 0.5, degree % 2 == 1, "{degree}: {xi}");
    }
}

#[test]
fn patch_rule_of_a_single_span_is_the_gauss_rule() {
    let basis = basis(&[2.0], 4, 3);
    let rule = patch_rule(&basis, &basis.spans()).unwrap();
    let gauss: Vec<(f64, f64)> = GaussRule::new(4).unwrap().iter_on(0.0, 2.0).collect();
    assert_eq!(rule, [gauss]);
}

#[test]
fn long_and_nonuniform_meshes_have_patch_rules() {
    let ten_thousand = Basis::BSpline(KnotVector::uniform(10_000, 3, 2).unwrap());
    let rule = patch_rule(&ten_thousand, &ten_thousand.spans()).unwrap();
    assert!((rule[5000][0].1 * 1e4 - 1.0).abs() < 1e-8 && rule[5000].len() == 1);
    for degree in [2, 3, 5, 8] {
        let [_, _, scattered] = sizes(1500);
        let uneven = basis(&scattered, degree, degree - 1);
        assert!(patch_rule(&uneven, &uneven.spans()).is_some(), "{degree}");
        let sizes: Vec<f64> = (0..12).map(|at| [1.0, 1e3][at % 2]).collect();
        let uneven = basis(&sizes, degree, degree - 1);
        assert!(patch_rule(&uneven, &uneven.spans()).is_some(), "{degree}");
    }
}

#[test]
fn spans_of_any_order_of_magnitude_have_patch_rules() {
    let mut random = 1_u64;
    let mut next = || {
        random =
            random.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (random >> 11) as f64 / (1_u64 << 53) as f64
    };
    for degree in 2..=10 {
        for continuity in 1..degree {
            for spans in [2, 3, 5, 8, 12, 20] {
                let sizes: Vec<f64> = (0..spans).map(|_| 10_f64.powf(-11.0 * next())).collect();
                let basis = basis(&sizes, degree, continuity);
                let rule = patch_rule(&basis, &basis.spans());
                assert!(rule.is_some(), "degree {degree}, C{continuity}, {sizes:?}");
            }
        }
    }
}
