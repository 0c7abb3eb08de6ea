//! Finds a root of a function of one variable.

const MOST_CALLS: usize = 200;

#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Root {
    /// Argument at which the function is zero or changes its sign.
    pub at: f64,
    pub value: f64,
    pub calls: usize,
}

#[derive(Clone, Debug, PartialEq)]
pub enum RootError<E> {
    /// The function has the same sign at both ends of the interval. The fields are the values at the ends.
    SameSign(f64, f64),
    /// A function value is not finite. The fields are the argument and this value.
    NotFinite(f64, f64),
    /// The sign changes at a pole, near which the values are larger in magnitude than at both ends of the interval.
    /// The fields are an argument near the pole and the function value there.
    Pole(f64, f64),
    /// The search did not converge within the maximum number of calls. The fields are the best argument and its function value.
    Unfinished(f64, f64),
    Function(E),
}

/// Root of `function` between `from` and `to`, accurate to `tolerance` in the argument. The signs of `function` at `from` and `to` must differ.
///
/// Method of R. P. Brent, Algorithms for Minimization without Derivatives, 1973, chapter 4.
pub fn root<E>(
    (from, to): (f64, f64),
    tolerance: f64,
    mut function: impl FnMut(f64) -> Result<f64, E>,
) -> Result<Root, RootError<E>> {
    let mut calls = 0;
    let mut value = |x: f64| {
        calls += 1;
        match function(x) {
            Ok(value) if value.is_finite() => Ok(value),
            Ok(value) => Err(RootError::NotFinite(x, value)),
            Err(error) => Err(RootError::Function(error)),
        }
    };
    let (mut a, mut b) = (from, to);
    let (mut fa, mut fb) = (value(a)?, value(b)?);
    if fa != 0.0 && fb != 0.0 && fa.signum() == fb.signum() {
        return Err(RootError::SameSign(fa, fb));
    }
    let largest = fa.abs().max(fb.abs());
    let (mut c, mut fc) = (a, fa);
    let (mut last, mut step) = (b - a, b - a);
    for _ in 0..MOST_CALLS {
        // Restores the invariant: `b` is the best estimate of the root, and the function has opposite signs at `b` and `c`.
        if fb.signum() == fc.signum() {
            (c, fc) = (a, fa);
            step = b - a;
            last = step;
        }
        if fc.abs() < fb.abs() {
            (a, b, c) = (b, c, b);
            (fa, fb, fc) = (fb, fc, fb);
        }
        let near = 2.0 * f64::EPSILON * b.abs() + 0.5 * tolerance;
        let half = 0.5 * c - 0.5 * b;
        if half.abs() <= near || fb == 0.0 {
            return match fb.abs() > largest {
                true => Err(RootError::Pole(b, fb)),
                false => Ok(Root { at: b, value: fb, calls }),
            };
        }
        let bisected = (half, half);
        (last, step) = match last.abs() >= near && fa.abs() > fb.abs() {
            false => bisected,
            true => {
                let s = fb / fa;
                let (p, q) = if a == c {
                    (2.0 * half * s, 1.0 - s)
                } else {
                    let (q, r) = (fa / fc, fb / fc);
                    let p = s * (2.0 * half * q * (q - r) - (b - a) * (r - 1.0));
                    (p, (q - 1.0) * (r - 1.0) * (s - 1.0))
                };
                let (p, q) = if p > 0.0 { (p, -q) } else { (-p, q) };
                let is_good = 2.0 * p < (3.0 * half * q - (near * q).abs()).min((last * q).abs());
                if is_good { (step, p / q) } else { bisected }
            }
        };
        (a, fa) = (b, fb);
        b += if step.abs() > near { step } else { near.copysign(half) };
        fb = value(b)?;
    }
    Err(RootError::Unfinished(b, fb))
}

#[cfg(test)]
mod tests {
    use std::convert::Infallible;

    use super::*;
    use crate::elementary::{cos, cosh};

    fn good(x: f64) -> Result<f64, Infallible> {
        Ok(x)
    }

    #[test]
    fn roots_are_found_to_the_tolerance_in_few_calls() {
        let found = root((1.0, 3.0), 1e-12, |x| good(cos(x) * cosh(x) + 1.0)).unwrap();
        assert!((found.at - 1.875_104_068_711_961).abs() < 1e-12 && found.calls < 12, "{found:?}");
        let found = root((3.0, 1.0), 1e-10, |x| good(x * x * x - 8.0)).unwrap();
        assert!((found.at - 2.0).abs() < 1e-10, "{found:?}");
        let step = root((0.0, 1.0), 1e-9, |x| good(if x < 0.3 { -1.0 } else { 1.0 })).unwrap();
        assert!((step.at - 0.3).abs() < 1e-9, "{step:?}");
        assert_eq!(root((0.0, 1.0), 1e-9, good).unwrap().at, 0.0);
        let far = root((-1e308, 1e308), 1e-9, good).unwrap();
        assert!(far.at.abs() < 1e-9, "{far:?}");
        let small = root((0.0, 1.0), 1e-9, |x| good(1e-200 * (x - 0.4))).unwrap();
        assert!((small.at - 0.4).abs() < 1e-9, "{small:?}");
    }

    #[test]
    fn functions_without_a_root_are_rejected() {
        let found = root((0.0, 1.0), 1e-9, |x| good(x + 1.0));
        assert_eq!(found, Err(RootError::SameSign(1.0, 2.0)));
        assert!(matches!(root((0.0, 1.0), 1e-9, |x| good(1.0 / x)), Err(RootError::NotFinite(..))));
        let pole = root((0.0, 1.0), 1e-9, |x| good(1.0 / (x - 0.3)));
        let is_there = |at: f64| (at - 0.3).abs() < 1e-9;
        assert!(matches!(pole, Err(RootError::Pole(at, _)) if is_there(at)), "{pole:?}");
        let rough = root((-1e308, 1e308), 1e-9, |x| good(if x < 3.0 { -1.0 } else { 1.0 }));
        assert!(matches!(rough, Err(RootError::Unfinished(..))), "{rough:?}");
        let failing = root((0.0, 1.0), 1e-9, |_| Err::<f64, _>("lost"));
        assert_eq!(failing, Err(RootError::Function("lost")));
    }
}
