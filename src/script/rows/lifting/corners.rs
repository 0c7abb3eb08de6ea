//! Functions with corners and jumps: where these lie between the variants of a parameter there is no derivative. Each test is given the arguments of a call
//! at the parameter plus its distance, and minus it.

use rhai::{Array, Dynamic};

use crate::geometry::Vec2;
use crate::script::rows::accept::as_point;
use crate::script::words::numbers::as_number;

/// Whether there is a corner or a jump between the arguments of two calls.
pub type Corner = fn(plus: &[Dynamic], minus: &[Dynamic]) -> bool;

/// At zero of the one argument, as that of `abs` and `sqrt`.
pub fn at_zero(plus: &[Dynamic], minus: &[Dynamic]) -> bool {
    number(plus, 0) * number(minus, 0) < 0.0
}

/// Where both arguments are equal, as that of `max`.
pub fn where_equal(plus: &[Dynamic], minus: &[Dynamic]) -> bool {
    let [plus, minus] = [plus, minus].map(|given| number(given, 0) - number(given, 1));
    plus * minus < 0.0
}

/// At the origin of the vector of both arguments, as that of `hypot`.
pub fn at_origin(plus: &[Dynamic], minus: &[Dynamic]) -> bool {
    let [plus, minus] = [plus, minus].map(|given| Vec2::new(number(given, 0), number(given, 1)));
    plus.dot(&minus) < 0.0
}

/// At the origin of the argument, as that of `norm`.
pub fn at_zero_vector(plus: &[Dynamic], minus: &[Dynamic]) -> bool {
    let [plus, minus] = [plus, minus].map(|given| point(given, 0));
    plus.zip(minus).is_some_and(|(plus, minus)| plus.dot(&minus) < 0.0)
}

/// Where both points are one, as that of `distance`.
pub fn where_points_meet(plus: &[Dynamic], minus: &[Dynamic]) -> bool {
    let [plus, minus] =
        [plus, minus].map(|given| point(given, 1).zip(point(given, 0)).map(|(b, a)| b - a));
    plus.zip(minus).is_some_and(|(plus, minus)| plus.dot(&minus) < 0.0)
}

/// At whole numbers, as that of `fraction`.
pub fn at_whole_numbers(plus: &[Dynamic], minus: &[Dynamic]) -> bool {
    number(plus, 0).trunc() != number(minus, 0).trunc()
}

/// Where another number of the array becomes the largest.
pub fn where_largest_changes(plus: &[Dynamic], minus: &[Dynamic]) -> bool {
    chosen_changes(plus, minus, |x, y| x > y)
}

/// Where another number of the array becomes the smallest.
pub fn where_smallest_changes(plus: &[Dynamic], minus: &[Dynamic]) -> bool {
    chosen_changes(plus, minus, |x, y| x < y)
}

fn chosen_changes(plus: &[Dynamic], minus: &[Dynamic], wins: fn(f64, f64) -> bool) -> bool {
    let chosen = |values: &[f64]| {
        let better =
            |best: usize, at: usize| if wins(values[at], values[best]) { at } else { best };
        (0..values.len()).reduce(better)
    };
    let [plus, minus] = [plus, minus].map(numbers);
    let (Some(one), Some(other)) = (chosen(&plus), chosen(&minus)) else { return false };
    plus.len() == minus.len() && wins(plus[one], plus[other]) && wins(minus[other], minus[one])
}

fn number(given: &[Dynamic], at: usize) -> f64 {
    given.get(at).and_then(as_number).unwrap_or(f64::NAN)
}

fn point(given: &[Dynamic], at: usize) -> Option<Vec2> {
    given.get(at).and_then(as_point)
}

fn numbers(given: &[Dynamic]) -> Vec<f64> {
    let array = given.first().and_then(|first| first.read_lock::<Array>());
    array.iter().flat_map(|array| array.iter()).filter_map(as_number).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn of(numbers: &[f64]) -> Vec<Dynamic> {
        numbers.iter().map(|x| Dynamic::from(*x)).collect()
    }

    #[test]
    fn corners_lie_where_a_sign_changes() {
        assert!(at_zero(&of(&[1e-5]), &of(&[-1e-5])));
        assert!(!at_zero(&of(&[3e-5]), &of(&[1e-5])));
        assert!(where_equal(&of(&[2.1, 2.0]), &of(&[1.9, 2.0])));
        assert!(!where_equal(&of(&[2.2, 2.0]), &of(&[2.1, 2.0])));
        assert!(at_origin(&of(&[0.1, 0.0]), &of(&[-0.1, 0.0])));
        assert!(!at_origin(&of(&[0.1, 1.0]), &of(&[-0.1, 1.0])));
        assert!(at_whole_numbers(&of(&[2.1]), &of(&[1.9])));
    }

    #[test]
    fn the_largest_of_an_array_changes_where_another_overtakes() {
        let array = |numbers: &[f64]| vec![Dynamic::from(of(numbers))];
        assert!(where_largest_changes(&array(&[1.0, 2.1, 2.0]), &array(&[1.0, 1.9, 2.0])));
        assert!(!where_largest_changes(&array(&[1.0, 2.1, 2.1]), &array(&[1.0, 1.9, 1.9])));
        assert!(where_smallest_changes(&array(&[1.1, 1.0]), &array(&[0.9, 1.0])));
        assert!(!where_smallest_changes(&array(&[]), &array(&[])));
    }
}
