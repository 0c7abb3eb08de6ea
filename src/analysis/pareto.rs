//! Pareto fronts of cost and error.

/// Returns for each pair of cost and error true if no other pair is smaller in one value and not larger in the other.
/// Of several equal pairs, only the first is on the front. Pairs with an infinite or NaN value are not on the front.
pub fn pareto_front(points: &[(f64, f64)]) -> Vec<bool> {
    let mut order: Vec<usize> = (0..points.len())
        .filter(|index| points[*index].0.is_finite() && points[*index].1.is_finite())
        .collect();
    order.sort_by(|a, b| {
        let ((price, error), (other_price, other_error)) = (points[*a], points[*b]);
        price.total_cmp(&other_price).then(error.total_cmp(&other_error))
    });
    let mut is_on_front = vec![false; points.len()];
    let mut least = f64::INFINITY;
    for index in order {
        if points[index].1 < least {
            least = points[index].1;
            is_on_front[index] = true;
        }
    }
    is_on_front
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    #[test]
    fn pareto_front_contains_only_nondominated_points() {
        let points = [(1.0, 9.0), (2.0, 9.5), (3.0, 4.0), (3.0, 4.0), (3.0, 5.0), (8.0, 1.0)];
        assert_eq!(pareto_front(&points), [true, false, true, false, false, true]);
        assert_eq!(pareto_front(&[(1.0, f64::NAN), (f64::INFINITY, 1.0)]), [false, false]);
    }

    proptest! {
        #[test]
        fn points_off_the_pareto_front_are_dominated_by_front_points(
            points in prop::collection::vec((0..9_u8, 0..9_u8), 0..30),
        ) {
            let points: Vec<(f64, f64)> = points.into_iter().map(|(a, b)| (a.into(), b.into())).collect();
            let front = pareto_front(&points);
            let winners: Vec<(f64, f64)> =
                points.iter().zip(&front).filter(|(_, is_on)| **is_on).map(|(point, _)| *point).collect();
            for (point, is_on) in points.iter().zip(&front) {
                let beats = |other: &&(f64, f64)| other.0 <= point.0 && other.1 <= point.1;
                let strictly = winners.iter().filter(beats).any(|other| other != point);
                prop_assert_eq!(*is_on && strictly, false);
                prop_assert!(winners.iter().any(|other| beats(&other)));
            }
        }
    }
}
