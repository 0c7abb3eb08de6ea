//! Section rotations, stored as cosine and sine, and updated without trigonometric functions.

use super::pair::Planar;
use super::simd::Number;
use crate::elementary::{atan, sin_cos, tan};

/// Relation between a rotation increment `Δω` and the rotation angle `Δθ`.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum RotationIncrement {
    /// Tangent-scaled increment `Δω` of the angle `Δθ = 2 atan(Δω/2)`, which conserving methods require.
    TangentScaled,
    /// Increment `Δω` of the angle: `Δθ = Δω`.
    Angle,
}

#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Turn<T> {
    cos: T,
    sin: T,
    /// Derivative `dΔθ/dΔω` [-].
    pub(super) rate: T,
}

impl RotationIncrement {
    #[inline(always)]
    pub(super) fn turn<T: Number>(self, increment: T) -> Turn<T> {
        let one = increment.same(1.0);
        match self {
            Self::TangentScaled => {
                let half = increment.same(0.5) * increment;
                let (rate, _) = self.rates(increment);
                Turn { cos: (one - half * half) * rate, sin: increment * rate, rate }
            }
            Self::Angle => {
                let (sin, cos) = increment.sin_cos();
                Turn { cos, sin, rate: one }
            }
        }
    }

    /// Derivatives `dΔθ/dΔω` and `d²Δθ/dΔω²` of the angle `Δθ` with respect to the increment `Δω`.
    #[inline(always)]
    pub fn rates<T: Number>(self, increment: T) -> (T, T) {
        let one = increment.same(1.0);
        match self {
            Self::TangentScaled => {
                let half = increment.same(0.5) * increment;
                let rate = one / (one + half * half);
                (rate, -half * rate * rate)
            }
            Self::Angle => (one, increment.same(0.0)),
        }
    }

    /// Rotation angle `Δθ` of an increment `Δω` [rad].
    pub fn angle(self, increment: f64) -> f64 {
        match self {
            Self::TangentScaled => 2.0 * atan(0.5 * increment),
            Self::Angle => increment,
        }
    }

    /// Rotation increment `Δω` of an angle `Δθ` [rad].
    pub(crate) fn of_angle(self, angle: f64) -> f64 {
        match self {
            Self::TangentScaled => 2.0 * tan(0.5 * angle),
            Self::Angle => angle,
        }
    }

    /// Factor `σ` in the relation `Δω = tan(σ Δθ)/σ` between increment and angle; zero if they are equal.
    pub(crate) fn tangent_factor(self) -> f64 {
        match self {
            Self::TangentScaled => 0.5,
            Self::Angle => 0.0,
        }
    }

    pub(crate) fn tangent_scaled(self, increment: f64) -> f64 {
        match self {
            Self::TangentScaled => increment,
            Self::Angle => 2.0 * tan(0.5 * increment),
        }
    }

    /// Derivative `dΔθ/dΔω` of the angle `Δθ` with respect to the increment `Δω` [-].
    #[inline(always)]
    pub fn rate<T: Number>(self, increment: T) -> T {
        self.rates(increment).0
    }
}

/// Rotation `Λ = [[c, -s], [s, c]]` from the section frame to space.
/// A `Rotation` may also be the mean of two rotations, for which `c² + s²` is less than 1.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Rotation<T = f64> {
    /// Cosine `c` of the angle, or a mean of two cosines.
    pub cos: T,
    /// Sine `s` of the angle, or a mean of two sines.
    pub sin: T,
}

impl Rotation {
    /// Rotation by an angle [rad].
    pub fn by(angle: f64) -> Self {
        let (sin, cos) = sin_cos(angle);
        Self { cos, sin }
    }
}

impl<T: Number> Rotation<T> {
    /// Product of this rotation and the rotation by an increment.
    #[inline(always)]
    pub fn turned(self, kind: RotationIncrement, increment: T) -> Self {
        self.times(&kind.turn(increment))
    }

    #[inline(always)]
    pub(super) fn times(self, turn: &Turn<T>) -> Self {
        Self {
            cos: self.cos * turn.cos - self.sin * turn.sin,
            sin: self.sin * turn.cos + self.cos * turn.sin,
        }
    }

    /// Normalises a rotation whose determinant is not exactly one because of rounding.
    #[inline(always)]
    pub(crate) fn normalised(self) -> Self {
        let square = self.cos * self.cos + self.sin * self.sin;
        let correction = square.same(1.5) - square.same(0.5) * square;
        Self { cos: self.cos * correction, sin: self.sin * correction }
    }

    /// Weighted mean `(1 - t) Λ + t Λ'` of this rotation `Λ` and another rotation `Λ'`.
    #[inline(always)]
    pub fn mixed(self, other: Self, t: T) -> Self {
        Self {
            cos: self.cos + t * (other.cos - self.cos),
            sin: self.sin + t * (other.sin - self.sin),
        }
    }

    #[inline(always)]
    pub(crate) fn to_space<P: Planar<T>>(self, a: P) -> P {
        let (x, y) = a.components();
        P::of(self.cos * x - self.sin * y, self.sin * x + self.cos * y)
    }

    /// Vector `Λᵀ a`: transforms `a` from space to the section frame.
    #[inline(always)]
    pub(crate) fn to_section<P: Planar<T>>(self, a: P) -> P {
        let (x, y) = a.components();
        P::of(self.cos * x + self.sin * y, self.cos * y - self.sin * x)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn tangent_scaled_increment_rotates_by_twice_the_arctangent_of_its_half() {
        let turned = Rotation::by(0.3).turned(RotationIncrement::TangentScaled, 1.1);
        let expected = Rotation::by(0.3 + 2.0 * (0.55_f64).atan());
        assert!(
            (turned.cos - expected.cos).abs() < 1e-15 && (turned.sin - expected.sin).abs() < 1e-15
        );
    }

    #[test]
    fn the_difference_of_rotations_is_the_increment_times_their_mean() {
        let (start, increment) = (Rotation::by(-0.7), 0.9);
        let end = start.turned(RotationIncrement::TangentScaled, increment);
        let mean = start.mixed(end, 0.5);
        assert!((end.cos - start.cos + increment * mean.sin).abs() < 1e-15);
        assert!((end.sin - start.sin - increment * mean.cos).abs() < 1e-15);
    }
}
