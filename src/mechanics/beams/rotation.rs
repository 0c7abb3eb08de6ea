//! Section rotations as cosine and sine, advanced by tangent-scaled increments without trigonometric functions.

use super::pair::Planar;
use super::simd::Number;
use crate::elementary::{atan, sin_cos, tan};

/// What an interpolated rotation increment `Δω` stands for: which angle `Δθ` a section turns by.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum RotationIncrement {
    /// The increment is the scaled tangent of the angle, `Δθ = 2 atan(Δω/2)`: then `Λ1 - Λ0 = Δω J (Λ0 + Λ1)/2`, on which conservation rests.
    TangentScaled,
    /// The increment is the angle itself: `Δθ = Δω`.
    Angle,
}

/// The rotation by the angle `Δθ(Δω)` of an increment, with its derivative.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Turn<T> {
    cos: T,
    sin: T,
    /// The derivative `dΔθ/dΔω` of the angle by the increment [-].
    pub(super) rate: T,
}

impl RotationIncrement {
    /// The rotation that an increment `Δω` stands for.
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

    /// The first two derivatives of the angle by the increment, `dΔθ/dΔω` and `d²Δθ/dΔω²`, for which no angle needs its sine.
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

    /// The angle `Δθ` that an increment `Δω` stands for [rad].
    pub fn angle(self, increment: f64) -> f64 {
        match self {
            Self::TangentScaled => 2.0 * atan(0.5 * increment),
            Self::Angle => increment,
        }
    }

    /// The increment that stands for an angle `Δθ` [rad].
    pub fn of_angle(self, angle: f64) -> f64 {
        match self {
            Self::TangentScaled => 2.0 * tan(0.5 * angle),
            Self::Angle => angle,
        }
    }

    /// The tangent-scaled increment `2 tan(Δθ/2)` of the angle that an increment stands for, with which `Λ1 - Λ0 = 2 tan(Δθ/2) J (Λ0 + Λ1)/2` [-].
    pub fn tangent_scaled(self, increment: f64) -> f64 {
        match self {
            Self::TangentScaled => increment,
            Self::Angle => 2.0 * tan(0.5 * increment),
        }
    }

    /// The derivative `dΔθ/dΔω` of the angle by the increment [-].
    #[inline(always)]
    pub fn rate<T: Number>(self, increment: T) -> T {
        self.rates(increment).0
    }
}

/// The rotation `Λ = [[c, -s], [s, c]]` from the section frame to space; a mean of two rotations is not itself one.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Rotation<T = f64> {
    /// The cosine `c` of the angle of the rotation, or a mean of such.
    pub cos: T,
    /// The sine `s` of the angle of the rotation, or a mean of such.
    pub sin: T,
}

impl Rotation {
    /// The rotation by an angle [rad].
    pub fn by(angle: f64) -> Self {
        let (sin, cos) = sin_cos(angle);
        Self { cos, sin }
    }
}

impl<T: Number> Rotation<T> {
    /// This rotation followed by the one that an increment stands for.
    #[inline(always)]
    pub fn turned(self, kind: RotationIncrement, increment: T) -> Self {
        self.times(&kind.turn(increment))
    }

    /// The product of this rotation with a turn.
    #[inline(always)]
    pub(super) fn times(self, turn: &Turn<T>) -> Self {
        Self {
            cos: self.cos * turn.cos - self.sin * turn.sin,
            sin: self.sin * turn.cos + self.cos * turn.sin,
        }
    }

    /// Pulls a rotation that rounding has moved off the unit circle back onto it.
    #[inline(always)]
    pub fn normalised(self) -> Self {
        let square = self.cos * self.cos + self.sin * self.sin;
        let correction = square.same(1.5) - square.same(0.5) * square;
        Self { cos: self.cos * correction, sin: self.sin * correction }
    }

    /// The mixture `(1 - t) Λ + t Λ'` of this rotation and another.
    #[inline(always)]
    pub fn mixed(self, other: Self, t: T) -> Self {
        Self {
            cos: self.cos + t * (other.cos - self.cos),
            sin: self.sin + t * (other.sin - self.sin),
        }
    }

    /// The vector `Λ a`: `a` of the section frame, in space.
    #[inline(always)]
    pub fn to_space<P: Planar<T>>(self, a: P) -> P {
        let (x, y) = a.components();
        P::of(self.cos * x - self.sin * y, self.sin * x + self.cos * y)
    }

    /// The vector `Λᵀ a`: `a` of space, in the section frame.
    #[inline(always)]
    pub fn to_section<P: Planar<T>>(self, a: P) -> P {
        let (x, y) = a.components();
        P::of(self.cos * x + self.sin * y, self.cos * y - self.sin * x)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_increment_turns_by_twice_the_arctangent_of_its_half() {
        let turned = Rotation::by(0.3).turned(RotationIncrement::TangentScaled, 1.1);
        let expected = Rotation::by(0.3 + 2.0 * (0.55_f64).atan());
        assert!(
            (turned.cos - expected.cos).abs() < 1e-15 && (turned.sin - expected.sin).abs() < 1e-15
        );
    }

    #[test]
    fn the_difference_of_rotations_is_the_increment_times_their_mean() {
        // Λ1 - Λ0 = Δω J Λ̄: the property that makes the midpoint rule conserve.
        let (start, increment) = (Rotation::by(-0.7), 0.9);
        let end = start.turned(RotationIncrement::TangentScaled, increment);
        let mean = start.mixed(end, 0.5);
        assert!((end.cos - start.cos + increment * mean.sin).abs() < 1e-15);
        assert!((end.sin - start.sin - increment * mean.cos).abs() < 1e-15);
    }
}
