use super::*;
use crate::geometry::samples::bases;
use crate::geometry::{KnotVector, LagrangeBasis};
use proptest::prelude::*;

fn spline(spans: usize, degree: usize, continuity: usize) -> Basis {
    Basis::BSpline(KnotVector::uniform(spans, degree, continuity).unwrap())
}

fn lagrange(elements: usize, degree: usize) -> Basis {
    Basis::Lagrange(LagrangeBasis::uniform(elements, degree).unwrap())
}

fn passage(basis: &Basis, from: f64, to: f64) -> ContactPath {
    let mut passage = ContactPath::new(basis.clone());
    passage.set_interval(from, to);
    passage
}

fn rows(passage: &ContactPath) -> [&[f64]; 6] {
    [
        passage.start(),
        passage.end(),
        passage.mean(),
        passage.difference(),
        passage.slope(),
        passage.change(),
    ]
}

fn spread(functions: usize, first: usize, window: &[f64]) -> Vec<f64> {
    let mut all = vec![0.0; functions];
    add(&mut all, first, 1.0, window);
    all
}

fn combine(passage: &ContactPath, window: &[f64], coefficients: &[f64]) -> f64 {
    window.iter().zip(&coefficients[passage.first()..]).map(|(n, c)| n * c).sum()
}

fn largest(values: &[f64]) -> f64 {
    values.iter().fold(0.0, |most, value| most.max(value.abs()))
}

fn distance(one: &[f64], other: &[f64]) -> f64 {
    assert_eq!(one.len(), other.len());
    one.iter().zip(other).fold(0.0, |most, (a, b)| most.max((a - b).abs()))
}

fn place(basis: &Basis, t: f64) -> f64 {
    let (start, end) = basis.domain();
    ((1.0 - t) * start + t * end).clamp(start, end)
}

fn inside(basis: &Basis, t: f64) -> (Span, f64) {
    let spans = basis.spans();
    let place = t * spans.len() as f64;
    let span = spans[place as usize];
    (span, span.start + (0.1 + 0.8 * place.fract()) * (span.end - span.start))
}

fn cube(basis: &Basis) -> Vec<f64> {
    match basis {
        Basis::BSpline(knots) => {
            let inner = &knots.knots()[1..knots.knots().len() - 1];
            inner.windows(3).map(|knots| knots.iter().product()).collect()
        }
        Basis::Lagrange(lagrange) => lagrange.nodes().iter().map(|node| node.powi(3)).collect(),
    }
}

#[test]
fn difference_quotient_of_a_cube_is_exact_for_all_increments() {
    for basis in [spline(5, 3, 2), spline(5, 3, 1), spline(4, 3, 0), lagrange(4, 3)] {
        let coefficients = cube(&basis);
        for from in [0.0, 0.1, 0.2, 0.25, 0.5, 0.77, 1.0] {
            for increment in
                [0.0, 1e-300, 1e-17, 1e-13, -1e-9, 1e-5, -0.01, 0.02, 0.3, -0.55, 1.3, -1.2]
            {
                let to = from + increment;
                let on = passage(&basis, from, to);
                let context = format!("{basis:?} from {from} to {to}");
                let value = combine(&on, on.difference(), &coefficients);
                let exact = from * from + from * to + to * to;
                assert!((value - exact).abs() < 1e-13 * largest(on.slope()).max(10.0), "{context}");
                let slope = combine(&on, on.slope(), &coefficients);
                assert!((slope - 3.0 * to * to).abs() < 1e-13 * largest(on.slope()), "{context}");
                let kinks = basis.continuity() == 0;
                if !kinks || increment == 0.0 || increment.abs() >= 0.01 {
                    let change = combine(&on, on.change(), &coefficients);
                    let error = (change - (from + 2.0 * to)).abs();
                    assert!(error < if kinks { 1e-11 } else { 2e-12 }, "{context}: {error}");
                }
            }
        }
    }
}

#[test]
fn quotient_derivative_is_exact_across_smooth_breaks_near_a_kink() {
    let basis = spline(4, 3, 2).with_break(0.9).unwrap();
    let coefficients = cube(&basis);
    let from = 0.5 - 1e-15;
    for to in [0.5 + 1e-15, 0.5 + 1e-12, 0.5 + 1e-6] {
        for (from, to) in [(from, to), (to, from)] {
            let on = passage(&basis, from, to);
            assert_eq!(on.change().len(), 5);
            let change = combine(&on, on.change(), &coefficients);
            assert!((change - (from + 2.0 * to)).abs() < 1e-12, "{from} {to} {change}");
        }
    }
}

#[test]
fn quotient_over_a_tiny_path_across_a_kink_weights_both_slopes() {
    let basis = lagrange(2, 1);
    let on = passage(&basis, 0.5 - f64::EPSILON, 0.5 + 3.0 * f64::EPSILON);
    assert_eq!((on.first(), on.difference()), (0, &[-0.5, -1.0, 1.5][..]));
    assert_eq!(on.slope(), [0.0, -2.0, 2.0]);
}

#[test]
fn path_starting_at_a_break_uses_its_own_span() {
    for basis in [lagrange(2, 2), spline(2, 2, 0), spline(2, 2, 1), spline(2, 3, 1)] {
        let spans = basis.spans();
        for (span, to) in [(spans[0], 0.3), (spans[1], 0.8), (spans[1], 0.5)] {
            let (behind, at) = (basis.evaluate_in(&span, 0.5), basis.evaluate_in(&span, to));
            let there = passage(&basis, 0.5, to);
            assert_eq!((there.first(), there.start()), (span.first, behind.values()));
            assert_eq!((there.end(), there.slope()), (at.values(), at.slopes()));
            let back = passage(&basis, to, 0.5);
            assert_eq!((back.first(), back.start()), (span.first, at.values()));
            assert_eq!((back.end(), back.slope()), (behind.values(), behind.slopes()));
            assert!(distance(there.difference(), back.difference()) < 1e-14);
        }
    }
}

#[test]
fn path_of_zero_length_has_the_derivatives_of_the_basis() {
    for basis in [lagrange(3, 2), spline(3, 4, 2)] {
        for xi in basis.breaks().into_iter().chain([0.1, 0.7]) {
            let on = passage(&basis, xi, xi);
            let at = basis.evaluate(xi).unwrap();
            assert_eq!((on.first(), on.start(), on.end()), (at.first, at.values(), at.values()));
            assert!(distance(on.difference(), at.slopes()) < 1e-13);
            let half: Vec<f64> = at.derivatives(2).iter().map(|n| 0.5 * n).collect();
            assert!(distance(on.change(), &half) < 1e-12);
        }
    }
}

#[test]
fn end_polynomials_are_extrapolated_beyond_the_domain() {
    for basis in [lagrange(3, 2), spline(3, 3, 2)] {
        let spans = basis.spans();
        for (span, to) in [(spans[0], -0.4), (spans[2], 1.4)] {
            let beyond = basis.evaluate_in(&span, to);
            for from in [span.start, 0.5 * (span.start + span.end), span.end] {
                let on = passage(&basis, from, to);
                let skip = span.first - on.first();
                let functions = on.length;
                assert_eq!(on.end(), spread(functions, skip, beyond.values()));
                assert_eq!(on.slope(), spread(functions, skip, beyond.slopes()));
                let quotients = on.difference().iter().zip(on.start().iter().zip(on.end()));
                for (quotient, (start, end)) in quotients {
                    assert!((quotient * (to - from) - (end - start)).abs() < 1e-12);
                }
            }
        }
    }
}

#[test]
fn nonfinite_path_gives_nan_without_affecting_later_paths() {
    let basis = spline(4, 3, 2);
    let mut on = ContactPath::new(basis.clone());
    let bad = [f64::NAN, f64::INFINITY, f64::NEG_INFINITY];
    for (from, to, first) in
        bad.into_iter().flat_map(|bad| [(0.6, bad, Some(2)), (1.0, bad, Some(3)), (bad, 0.6, None)])
    {
        on.set_interval(from, to);
        assert!(rows(&on).iter().all(|row| row.len() == 4 && row.iter().all(|n| n.is_nan())));
        assert!(first.is_none_or(|first| first == on.first()));
    }
    for to in [1e300, -1e300, f64::MAX, f64::MIN] {
        on.set_interval(0.6, to);
        assert_eq!(rows(&on).map(<[f64]>::len), [if to > 0.0 { 5 } else { 6 }; 6]);
    }
    on.set_interval(0.3, 0.4);
    assert_eq!(rows(&on), rows(&passage(&basis, 0.3, 0.4)));
}

#[test]
fn new_contact_path_has_zero_length_at_the_start() {
    let basis = spline(2, 2, 1);
    let on = ContactPath::new(basis.clone());
    assert_eq!((on.basis(), on.first(), on.mean()), (&basis, 0, &[1.0, 0.0, 0.0][..]));
    assert_eq!(on.difference(), [-4.0, 4.0, 0.0]);
}

proptest! {
    #[test]
    fn quotient_times_increment_equals_the_change_of_the_functions(
        basis in bases(), t in 0.0..=1.0f64, u in 0.0..=1.0f64,
    ) {
        let (from, to) = (place(&basis, t), place(&basis, u));
        let on = passage(&basis, from, to);
        let exact = |xi| {
            let at = basis.evaluate(xi).unwrap();
            spread(basis.functions(), at.first, at.values())
        };
        let (start, end) = (exact(from), exact(to));
        let window = on.first()..on.first() + on.length;
        prop_assert!(distance(on.start(), &start[window.clone()]) < 1e-13);
        prop_assert!(distance(on.end(), &end[window.clone()]) < 1e-13);
        for (index, (start, end)) in start.iter().zip(&end).enumerate() {
            prop_assert!(window.contains(&index) || start.abs().max(end.abs()) < 1e-13);
        }
        for (quotient, (start, end)) in on.difference().iter().zip(on.start().iter().zip(on.end())) {
            prop_assert!((quotient * (to - from) - (end - start)).abs() < 1e-12);
        }
        for (mean, (start, end)) in on.mean().iter().zip(on.start().iter().zip(on.end())) {
            prop_assert_eq!(*mean, 0.5 * (start + end));
        }
    }

    #[test]
    fn path_values_sum_to_one_and_quotients_to_zero(
        basis in bases(), t in 0.0..=1.0f64, u in -0.1..=1.1f64, nearness in 0..15i32,
    ) {
        let from = place(&basis, t);
        let (start, end) = basis.domain();
        let to = from + ((1.0 - u) * start + u * end - from) * 10f64.powi(-nearness);
        let on = passage(&basis, from, to);
        for row in [on.start(), on.end(), on.mean()] {
            let size = 1.0 + row.iter().map(|n| n.abs()).sum::<f64>();
            prop_assert!((row.iter().sum::<f64>() - 1.0).abs() < 1e-13 * size);
        }
        for row in [on.difference(), on.slope(), on.change()] {
            let size = row.iter().map(|n| n.abs()).sum::<f64>() + 1.0;
            prop_assert!(row.iter().sum::<f64>().abs() < 1e-12 * size, "{:?}", row);
        }
    }

    #[test]
    fn quotient_over_a_tiny_path_equals_the_slope(basis in bases(), t in 0.0..1.0f64) {
        let (_, xi) = inside(&basis, t);
        let at = basis.evaluate(xi).unwrap();
        let size = largest(at.slopes()) + largest(at.derivatives(2));
        for increment in [1e-13, -1e-13] {
            let on = passage(&basis, xi, xi + increment);
            prop_assert_eq!(on.first(), at.first);
            prop_assert!(distance(on.difference(), at.slopes()) < 1e-12 * size);
            let half: Vec<f64> = at.derivatives(2).iter().map(|n| 0.5 * n).collect();
            let size = largest(at.derivatives(2)) + largest(at.derivatives(3));
            prop_assert!(distance(on.change(), &half) <= 1e-12 * size);
        }
    }

    #[test]
    fn quotient_is_symmetric_in_start_and_end(
        basis in bases(), t in 0.0..=1.0f64, u in 0.0..=1.0f64, nearness in 0..15i32,
    ) {
        let xi = place(&basis, t);
        for from in basis.breaks().into_iter().chain([xi]) {
            let increment = (place(&basis, u) - from) * 10f64.powi(-nearness);
            for (a, b) in [(from, from + increment), (from - 0.3 * increment, from + increment)] {
                if a == b {
                    continue;
                }
                let (there, back) = (passage(&basis, a, b), passage(&basis, b, a));
                prop_assert_eq!((there.first(), there.length), (back.first(), back.length));
                let size = largest(there.difference()) + largest(there.slope()) + largest(back.slope());
                prop_assert!(distance(there.difference(), back.difference()) < 1e-12 * size);
                prop_assert_eq!((there.start(), there.mean()), (back.end(), back.mean()));
            }
        }
    }

    #[test]
    fn change_is_the_derivative_of_the_quotient(basis in bases(), t in 0.0..=1.0f64, u in 0.0..1.0f64) {
        let from = place(&basis, t);
        let (span, to) = inside(&basis, u);
        let size = span.end - span.start;
        prop_assume!((to - from).abs() > 0.01 * size);
        let h = 1e-6 * size;
        let on = passage(&basis, from, to);
        let (before, behind) = (passage(&basis, from, to - h), passage(&basis, from, to + h));
        let scale = largest(on.change()) + largest(on.difference()) / size;
        for (change, (low, high)) in
            on.change().iter().zip(before.difference().iter().zip(behind.difference()))
        {
            prop_assert!(((high - low) / (2.0 * h) - change).abs() < 1e-6 * scale);
        }
    }
}
