//! Functions that are not differentiable at or near their arguments: kinks, jumps and infinite slopes.

use std::rc::Rc;

use rhai::{Array, Dynamic};

use super::parameter_set::ParameterSet;
use super::variant_value::project;
use crate::elementary::cos;
use crate::geometry::Vec2;
use crate::script::bindings::accept::as_point;
use crate::script::messages::numbers::as_number;

/// Minimum distance of an argument from a point of infinite slope, as a multiple of the perturbation of the argument.
/// At the distance `NEAR`, the relative error of the difference quotient is about 1e-5.
const NEAR: f64 = 300.0;

/// Arguments of a call at the parameter values, and with a positive and a negative perturbation of one parameter.
pub struct Sides<'s> {
    pub at: &'s [Dynamic],
    pub plus: &'s [Dynamic],
    pub minus: &'s [Dynamic],
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum NoDerivative {
    Discontinuous,
    /// A point of infinite slope is too close to the arguments.
    InfiniteSlope,
}

/// Check of a function for kinks, jumps and infinite slopes between the perturbed arguments.
pub type NonsmoothCheck = fn(&Sides) -> Option<NoDerivative>;

/// Error message if the function has no derivative at the given arguments; `None` if the derivative exists.
pub fn corner_of(
    (name, corner): (&str, NonsmoothCheck),
    family: &ParameterSet,
    given: &[Dynamic],
) -> Option<Rc<str>> {
    let in_variant =
        |variant| given.iter().map(|of| project(of, variant)).collect::<Vec<Dynamic>>();
    let at = in_variant(0);
    let parameters = family.parameters();
    let mut found = parameters.iter().enumerate().filter_map(|(number, (parameter, _))| {
        let [plus, minus] = [1, 2].map(|beside| in_variant(beside + 2 * number));
        let rough = corner(&Sides { at: &at, plus: &plus, minus: &minus })?;
        Some(match rough {
            NoDerivative::Discontinuous => format!(
                "'{name}' has a kink or a jump at this value, and no derivative by \
                '{parameter}'"
            ),
            NoDerivative::InfiniteSlope => format!(
                "'{name}' is too close to a point where its slope is infinite or undefined, and \
                has no derivative by '{parameter}'"
            ),
        })
    });
    Some(found.next()?.into())
}

impl Sides<'_> {
    fn each(&self, what: impl Fn(&[Dynamic]) -> f64) -> [f64; 3] {
        [self.at, self.plus, self.minus].map(what)
    }

    fn passes_zero(&self, what: impl Fn(&[Dynamic]) -> f64) -> Option<NoDerivative> {
        let [_, plus, minus] = self.each(what);
        (plus * minus < 0.0).then_some(NoDerivative::Discontinuous)
    }

    fn nears_zero(&self, what: impl Fn(&[Dynamic]) -> f64) -> Option<NoDerivative> {
        let [at, plus, minus] = self.each(what);
        let change = (plus - at).abs().max((minus - at).abs());
        (change > 0.0 && at.abs() <= NEAR * change).then_some(NoDerivative::InfiniteSlope)
    }

    fn nears_origin(&self, what: impl Fn(&[Dynamic]) -> Option<Vec2>) -> Option<NoDerivative> {
        let (at, plus, minus) = (what(self.at)?, what(self.plus)?, what(self.minus)?);
        let change = (plus - at).norm().max((minus - at).norm());
        (change > 0.0 && at.norm() <= NEAR * change).then_some(NoDerivative::InfiniteSlope)
    }
}

/// Check for a kink or jump at the argument zero, as for `abs`.
pub fn at_zero(sides: &Sides) -> Option<NoDerivative> {
    sides.passes_zero(|given| number(given, 0))
}

/// Check for an infinite slope at the argument zero, as for `sqrt` and `ln`.
pub fn near_zero(sides: &Sides) -> Option<NoDerivative> {
    sides.nears_zero(|given| number(given, 0))
}

/// Check for an infinite slope at the arguments one and minus one, as for `acos`.
pub fn near_one(sides: &Sides) -> Option<NoDerivative> {
    sides.nears_zero(|given| number(given, 0).abs() - 1.0)
}

/// Check for an infinite slope at the poles of `tan`.
pub fn near_quarters(sides: &Sides) -> Option<NoDerivative> {
    sides.nears_zero(|given| cos(number(given, 0)))
}

/// Check for an infinite slope of a logarithm, where the argument is zero, or the base is zero or one.
pub fn near_ends_of_logarithm(sides: &Sides) -> Option<NoDerivative> {
    let base = || sides.nears_zero(|given| number(given, 1) - 1.0);
    near_zero(sides).or_else(base).or_else(|| sides.nears_zero(|given| number(given, 1)))
}

/// Check for a kink where the arguments are equal, as for `max`.
pub fn at_equality(sides: &Sides) -> Option<NoDerivative> {
    sides.passes_zero(|given| number(given, 0) - number(given, 1))
}

/// Check for an infinite slope where both arguments are zero, as for `hypot`.
pub fn at_origin(sides: &Sides) -> Option<NoDerivative> {
    sides.nears_origin(|given| Some(Vec2::new(number(given, 0), number(given, 1))))
}

/// Check for a jump or infinite slope of the angle of the vector `(second, first)`, as for `atan2`: at its branch cut or the origin.
pub fn at_branch_cut(sides: &Sides) -> Option<NoDerivative> {
    cut(sides, |given| Some(Vec2::new(number(given, 1), number(given, 0))))
}

/// Check for a jump or infinite slope of the angle of a vector argument, at its branch cut or the origin.
pub fn at_branch_cut_of_vector(sides: &Sides) -> Option<NoDerivative> {
    cut(sides, |given| point(given, 0))
}

fn cut(sides: &Sides, what: fn(&[Dynamic]) -> Option<Vec2>) -> Option<NoDerivative> {
    let passes = || match what(sides.at)?.x < 0.0 {
        true => sides.passes_zero(|given| what(given).map_or(f64::NAN, |of| of.y)),
        false => None,
    };
    sides.nears_origin(what).or_else(passes)
}

/// Check for an infinite slope where a vector is zero, as for `norm`.
pub fn at_zero_vector(sides: &Sides) -> Option<NoDerivative> {
    sides.nears_origin(|given| point(given, 0))
}

/// Detects arguments at which two points coincide, where a function such as `distance` has no derivative.
pub fn at_coinciding_points(sides: &Sides) -> Option<NoDerivative> {
    sides.nears_origin(|given| point(given, 1).zip(point(given, 0)).map(|(b, a)| b - a))
}

/// Detects an integer argument, at which a function such as `fraction` jumps.
pub fn at_integers(sides: &Sides) -> Option<NoDerivative> {
    let [_, plus, minus] = sides.each(|given| number(given, 0).trunc());
    (plus != minus).then_some(NoDerivative::Discontinuous)
}

/// Check for a jump where a digit changes, as for `round_to`.
pub fn at_digit_changes(sides: &Sides) -> Option<NoDerivative> {
    let [_, plus, minus] = sides.each(|given| {
        let digits = number(given, 1);
        (number(given, 0) * crate::elementary::power(10.0, digits)).round()
    });
    (plus != minus).then_some(NoDerivative::Discontinuous)
}

/// Check for a jump of a remainder where the argument is a multiple of the divisor.
pub fn at_multiples(sides: &Sides) -> Option<NoDerivative> {
    let [at, plus, minus] = sides.each(|given| (number(given, 0) / number(given, 1)).trunc());
    (plus != at || minus != at).then_some(NoDerivative::Discontinuous)
}

pub fn near_zero_divisor(sides: &Sides) -> Option<NoDerivative> {
    sides.nears_zero(|given| number(given, 1))
}

/// Check for an infinite slope of a power where the base is zero, unless the exponent is a constant non-negative integer.
pub fn near_zero_base(sides: &Sides) -> Option<NoDerivative> {
    let exponents = sides.each(|given| number(given, 1));
    let is_smooth = exponents[0] >= 0.0
        && exponents[0].fract() == 0.0
        && exponents.iter().all(|exponent| *exponent == exponents[0]);
    if is_smooth { None } else { sides.nears_zero(|given| number(given, 0)) }
}

/// Check for a kink where another element of an array becomes the largest.
pub fn at_largest_change(sides: &Sides) -> Option<NoDerivative> {
    selection_changes(sides, |x, y| x > y)
}

/// Check for a kink where another element of an array becomes the smallest.
pub fn at_smallest_change(sides: &Sides) -> Option<NoDerivative> {
    selection_changes(sides, |x, y| x < y)
}

fn selection_changes(sides: &Sides, wins: fn(f64, f64) -> bool) -> Option<NoDerivative> {
    let chosen = |values: &[f64]| {
        let better =
            |best: usize, at: usize| if wins(values[at], values[best]) { at } else { best };
        (0..values.len()).reduce(better)
    };
    let [plus, minus] = [sides.plus, sides.minus].map(numbers);
    let (one, other) = (chosen(&plus)?, chosen(&minus)?);
    let changes =
        plus.len() == minus.len() && wins(plus[one], plus[other]) && wins(minus[other], minus[one]);
    changes.then_some(NoDerivative::Discontinuous)
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

    fn array(numbers: &[f64]) -> Vec<Dynamic> {
        vec![Dynamic::from(of(numbers))]
    }

    fn asked(corner: NonsmoothCheck, [at, plus, minus]: [Vec<Dynamic>; 3]) -> Option<NoDerivative> {
        corner(&Sides { at: &at, plus: &plus, minus: &minus })
    }

    fn about(corner: NonsmoothCheck, at: &[f64], h: f64) -> Option<NoDerivative> {
        let moved = |by: f64| of(&[&[at[0] + by], &at[1..]].concat());
        asked(corner, [moved(0.0), moved(h), moved(-h)])
    }

    #[test]
    fn discontinuities_are_detected_at_sign_changes() {
        assert_eq!(about(at_zero, &[0.0], 1e-5), Some(NoDerivative::Discontinuous));
        assert_eq!(about(at_zero, &[2e-5], 1e-5), None);
        assert_eq!(about(at_equality, &[2.0, 2.0], 0.1), Some(NoDerivative::Discontinuous));
        assert_eq!(about(at_equality, &[2.15, 2.0], 0.1), None);
        assert_eq!(about(at_integers, &[2.0], 0.1), Some(NoDerivative::Discontinuous));
        assert_eq!(about(at_multiples, &[4.0, 2.0], 0.1), Some(NoDerivative::Discontinuous));
        assert_eq!(about(at_digit_changes, &[0.125, 2.0], 1e-6), Some(NoDerivative::Discontinuous));
        assert_eq!(about(at_branch_cut, &[0.0, -1.0], 1e-5), Some(NoDerivative::Discontinuous));
        assert_eq!(about(at_branch_cut, &[0.0, 1.0], 1e-5), None);
    }

    #[test]
    fn infinite_slopes_are_detected_near_singular_points() {
        for (corner, at) in [
            (near_zero as NonsmoothCheck, vec![0.0]),
            (near_one, vec![-1.0]),
            (near_quarters, vec![0.5 * std::f64::consts::PI]),
            (near_zero_base, vec![0.0, 0.5]),
            (near_zero_base, vec![0.0, -1.0]),
            (at_origin, vec![0.0, 0.0]),
            (at_branch_cut, vec![0.0, 0.0]),
            (near_ends_of_logarithm, vec![0.0, 10.0]),
        ] {
            let beside = |by: f64| [&[at[0] + by], &at[1..]].concat();
            assert_eq!(about(corner, &at, 1e-5), Some(NoDerivative::InfiniteSlope));
            assert_eq!(about(corner, &beside(2e-3), 1e-5), Some(NoDerivative::InfiniteSlope));
            assert_eq!(about(corner, &beside(0.1), 1e-5), None, "{at:?}");
            assert_eq!(about(corner, &at, 0.0), None, "what does not change has a derivative");
        }
        assert_eq!(about(near_zero_base, &[0.0, 2.0], 1e-5), None);
        let sides = [of(&[1.0, 0.0]), of(&[1.0, 1e-5]), of(&[1.0, -1e-5])];
        assert_eq!(asked(near_zero_divisor, sides), Some(NoDerivative::InfiniteSlope));
    }

    #[test]
    fn change_of_the_largest_element_is_discontinuous() {
        let sides = |one: &[f64], other: &[f64]| [array(one), array(one), array(other)];
        let overtaken = sides(&[1.0, 2.1, 2.0], &[1.0, 1.9, 2.0]);
        assert_eq!(asked(at_largest_change, overtaken), Some(NoDerivative::Discontinuous));
        let together = sides(&[1.0, 2.1, 2.1], &[1.0, 1.9, 1.9]);
        assert_eq!(asked(at_largest_change, together), None);
        let fallen = sides(&[1.1, 1.0], &[0.9, 1.0]);
        assert_eq!(asked(at_smallest_change, fallen), Some(NoDerivative::Discontinuous));
        assert_eq!(asked(at_smallest_change, sides(&[], &[])), None);
    }
}
