//! Tests of knot vectors.

use super::*;
use crate::geometry::samples::knot_vectors;
use proptest::prelude::*;

fn refusal(degree: usize, knots: &[f64]) -> String {
    KnotVector::new(degree, knots.to_vec()).unwrap_err().to_string()
}

#[test]
fn uniform_knots_have_the_multiplicity_for_their_continuity() {
    let knots = KnotVector::uniform(3, 3, 1).unwrap();
    let (third, two_thirds) = (1.0 / 3.0, 2.0 / 3.0);
    assert_eq!(
        knots.knots(),
        [0.0, 0.0, 0.0, 0.0, third, third, two_thirds, two_thirds, 1.0, 1.0, 1.0, 1.0]
    );
    assert_eq!(knots.functions(), 8);
    assert_eq!(knots.breaks(), [0.0, third, two_thirds, 1.0]);
    let second = Span { first: 2, start: third, end: two_thirds };
    assert_eq!(knots.spans()[1], second);
    assert_eq!(KnotVector::uniform(MAX_SPANS, 1, 0).unwrap().functions(), MAX_SPANS + 1);
}

#[test]
fn spans_are_found_at_ends_and_at_repeated_knots() {
    let knots = KnotVector::new(2, vec![0.0, 0.0, 0.0, 1.0, 1.0, 2.0, 3.0, 3.0, 3.0]).unwrap();
    let found: Vec<_> = [0.0, 0.5, 1.0, 1.5, 2.0, 3.0].map(|xi| knots.span_at(xi).unwrap()).into();
    assert_eq!(found, [2, 2, 4, 4, 5, 5]);
    assert_eq!([0.0, 1.0, 1.5, 2.0].map(|xi| knots.multiplicity(xi)), [3, 2, 0, 1]);
    for outside in [-1e-12, 3.1, f64::NAN, f64::INFINITY] {
        assert!(matches!(knots.span_at(outside), Err(GeometryError::OutsideDomain { .. })));
    }
}

#[test]
fn first_and_last_greville_abscissae_are_exactly_the_ends() {
    let knots = KnotVector::new(3, vec![0.1, 0.1, 0.1, 0.1, 0.4, 0.7, 0.7, 0.7, 0.7]).unwrap();
    let abscissae = knots.greville();
    assert_eq!((abscissae[0], abscissae[4]), (0.1, 0.7));
    assert!((abscissae[2] - 0.4).abs() < 1e-16);
}

#[test]
fn insertion_repeats_a_knot_up_to_the_degree() {
    let knots = KnotVector::uniform(2, 3, 2).unwrap();
    assert_eq!(knots.insert(0.5, 2).unwrap().multiplicity(0.5), 3);
    assert_eq!(knots.insert(0.25, 1).unwrap().breaks(), [0.0, 0.25, 0.5, 1.0]);
    assert_eq!(
        knots.insert(0.5, 3).unwrap_err().to_string(),
        "knots: the interior knot 0.5 has multiplicity 4, but at most 3 (the degree) is allowed for a \
         continuous curve"
    );
    for end in [0.0, 1.0, 2.0, f64::NAN] {
        assert!(matches!(knots.insert(end, 1), Err(GeometryError::InsertOutside { .. })));
    }
    assert!(knots.insert(0.25, usize::MAX).is_err());
    assert!(matches!(knots.insert(0.5 + 1e-15, 1), Err(GeometryError::ShortSpan { .. })));
}

#[test]
fn invalid_knots_are_rejected_with_a_reason() {
    assert_eq!(refusal(0, &[0.0, 1.0]), "degree 0 is not available; allowed are 1 to 10");
    assert_eq!(refusal(11, &[0.0, 1.0]), "degree 11 is not available; allowed are 1 to 10");
    assert_eq!(
        refusal(2, &[0.0, 0.0, 1.0]),
        "knots: 3 are too few for degree 2; an open knot vector has at least 6 (3 at each end)"
    );
    assert_eq!(
        refusal(1, &[0.0, 0.0, f64::NAN, 1.0]),
        "knot 2 is NaN, but must be a finite number"
    );
    assert_eq!(
        refusal(1, &[0.0, 0.0, 1.0, f64::INFINITY]),
        "knot 3 is inf, but must be a finite number"
    );
    assert_eq!(
        refusal(1, &[0.0, 0.0, 0.5, 0.3, 1.0, 1.0]),
        "knots: entry 3 (0.3) is smaller than entry 2 (0.5); knots must not decrease"
    );
    assert_eq!(
        refusal(1, &[2.0, 2.0, 2.0, 2.0]),
        "knots: all are 2, but the last knot must be larger than the first"
    );
    assert_eq!(
        refusal(2, &[0.0, 0.0, 0.5, 1.0, 1.0, 1.0]),
        "knots: the first knot 0 has multiplicity 2; an open knot vector of degree 2 repeats it 3 times: \
         write [0, 0, 0, …]"
    );
    assert_eq!(
        refusal(1, &[0.0, 0.0, 1.0, 1.0, 1.0]),
        "knots: the last knot 1 has multiplicity 3; an open knot vector of degree 1 repeats it 2 times: \
         write […, 1, 1]"
    );
    assert_eq!(
        refusal(1, &[0.0, 0.0, 0.5, 0.5, 1.0, 1.0]),
        "knots: the interior knot 0.5 has multiplicity 2, but at most 1 (the degree) is allowed for a \
         continuous curve"
    );
    assert!(
        refusal(1, &[0.0, 0.0, 0.3, 0.1 + 0.2, 1.0, 1.0]).contains("make the two values equal")
    );
    assert!(refusal(1, &[-1e308, -1e308, 1e308, 1e308]).contains("length of the domain"));
}

#[test]
fn invalid_uniform_knots_are_rejected_before_allocation() {
    let refusal = |spans, degree, continuity| {
        KnotVector::uniform(spans, degree, continuity).unwrap_err().to_string()
    };
    let allowed = "but 1 to 400000 are allowed";
    assert_eq!(refusal(0, 3, 2), format!("spans: 0 requested, {allowed}"));
    assert_eq!(refusal(1_000_000_000, 3, 2), format!("spans: 1000000000 requested, {allowed}"));
    assert!(refusal(usize::MAX, 3, 2).contains(allowed));
    assert_eq!(refusal(4, 3, 3), "continuity 3 is not possible with degree 3; allowed are 0 to 2");
    assert_eq!(refusal(4, 0, 0), "degree 0 is not available; allowed are 1 to 10");
    assert_eq!(refusal(4, 11, 0), "degree 11 is not available; allowed are 1 to 10");
}

proptest! {
    #[test]
    fn the_span_found_contains_the_parameter(knots in knot_vectors(), t in 0.0..=1.0f64) {
        let (start, end) = knots.domain();
        let xi = (start + t * (end - start)).clamp(start, end);
        let i = knots.span_at(xi).unwrap();
        prop_assert!(knots.knots()[i] <= xi && xi <= knots.knots()[i + 1]);
        prop_assert!(knots.knots()[i] < knots.knots()[i + 1]);
        prop_assert!(knots.spans().iter().any(|span| span.first + knots.degree() == i));
    }

    #[test]
    fn greville_abscissae_increase(knots in knot_vectors()) {
        let abscissae = knots.greville();
        prop_assert_eq!(abscissae.len(), knots.functions());
        prop_assert!(abscissae.windows(2).all(|pair| pair[0] < pair[1]));
        prop_assert_eq!((abscissae[0], abscissae[abscissae.len() - 1]), knots.domain());
    }
}
