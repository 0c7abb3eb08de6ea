//! Random knot vectors, bases and curves for tests.

use super::{Basis, KnotVector, LagrangeBasis, MAX_DEGREE, SplineCurve, Vec2};
use proptest::prelude::*;

pub fn knot_vectors() -> impl Strategy<Value = KnotVector> {
    (1..=MAX_DEGREE)
        .prop_flat_map(|degree| {
            let interior = prop::collection::vec((0.1..1.0f64, 1..=degree), 0..5);
            (Just(degree), -2.0..2.0f64, interior, 0.1..1.0f64)
        })
        .prop_map(|(degree, start, interior, last)| {
            let mut knots = vec![start; degree + 1];
            let mut knot = start;
            for (gap, multiplicity) in interior {
                knot += gap;
                knots.extend(std::iter::repeat_n(knot, multiplicity));
            }
            knots.extend(std::iter::repeat_n(knot + last, degree + 1));
            KnotVector::new(degree, knots).unwrap()
        })
}

pub fn bases() -> impl Strategy<Value = Basis> {
    let lagrange = (1..=3usize, -2.0..2.0f64, prop::collection::vec(0.1..1.0f64, 1..5));
    prop_oneof![
        knot_vectors().prop_map(Basis::BSpline),
        lagrange.prop_map(|(degree, start, gaps)| {
            let mut breaks = vec![start];
            breaks.extend(gaps.iter().scan(start, |end, gap| {
                *end += gap;
                Some(*end)
            }));
            Basis::Lagrange(LagrangeBasis::new(degree, breaks).unwrap())
        }),
    ]
}

pub fn spline_curves() -> impl Strategy<Value = SplineCurve> {
    knot_vectors().prop_flat_map(|knots| {
        let points = prop::collection::vec((-1.0..1.0f64, -1.0..1.0f64), knots.functions());
        points.prop_map(move |points| {
            let points = points.into_iter().map(|(x, y)| Vec2::new(x, y)).collect();
            SplineCurve::new(knots.clone(), points).unwrap()
        })
    })
}
