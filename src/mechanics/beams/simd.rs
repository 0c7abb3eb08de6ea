//! Vector lanes: values of consecutive quadrature points that one vector instruction processes together.
//!
//! Each vector lane performs the operations of one quadrature point in a fixed order, so that vectors of any width give identical results.

use std::ops::{Add, AddAssign, Div, Mul, Neg, Sub};

use pulp::{Simd, bytemuck};

use crate::elementary::sin_cos;

pub(super) const LANES: usize = 4;

#[derive(Debug, Clone, Copy, PartialEq, Default)]
#[repr(align(32))]
pub(super) struct Lanes([f64; LANES]);

#[derive(Debug, Clone, Copy)]
pub(super) struct LaneChunk<V> {
    simd: V,
    index: usize,
}

impl<V: Simd> LaneChunk<V> {
    pub(super) const COUNT: usize = {
        assert!(LANES.is_multiple_of(V::F64_LANES), "vectors are no longer than the lanes");
        LANES / V::F64_LANES
    };

    #[inline(always)]
    pub(super) fn new(simd: V, index: usize) -> Self {
        Self { simd, index }
    }

    #[inline(always)]
    pub(super) fn splat(self, number: f64) -> Vector<V> {
        Vector { simd: self.simd, numbers: self.simd.splat_f64s(number) }
    }
}

impl Lanes {
    #[inline(always)]
    pub(super) fn get<V: Simd>(&self, part: LaneChunk<V>) -> Vector<V> {
        let (vectors, _) = V::as_simd_f64s(&self.0);
        Vector { simd: part.simd, numbers: vectors[part.index] }
    }

    #[inline(always)]
    pub(super) fn put<V: Simd>(&mut self, part: LaneChunk<V>, vector: Vector<V>) {
        let (vectors, _) = V::as_mut_simd_f64s(&mut self.0);
        vectors[part.index] = vector.numbers;
    }

    #[inline(always)]
    pub(super) fn lane(&self, lane: usize) -> f64 {
        self.0[lane]
    }

    #[inline(always)]
    pub(super) fn set_lane(&mut self, lane: usize, number: f64) {
        self.0[lane] = number;
    }

    pub(super) fn numbers(&self) -> [f64; LANES] {
        self.0
    }
}

/// Number type of formulas that are evaluated for one quadrature point (scalar) or for several quadrature points at once (vector lanes).
pub trait Number:
    Copy
    + Add<Output = Self>
    + AddAssign
    + Sub<Output = Self>
    + Mul<Output = Self>
    + Div<Output = Self>
    + Neg<Output = Self>
{
    fn same(self, number: f64) -> Self;

    fn abs(self) -> Self;

    /// Larger of two numbers; NaN if either is NaN.
    fn larger(self, other: Self) -> Self;

    fn sin_cos(self) -> (Self, Self);
}

impl Number for f64 {
    #[inline(always)]
    fn same(self, number: f64) -> Self {
        number
    }

    #[inline(always)]
    fn abs(self) -> Self {
        self.abs()
    }

    #[inline(always)]
    fn larger(self, other: Self) -> Self {
        crate::geometry::larger(self, other)
    }

    #[inline(always)]
    fn sin_cos(self) -> (Self, Self) {
        sin_cos(self)
    }
}

#[derive(Debug, Clone, Copy)]
pub(super) struct Vector<V: Simd> {
    simd: V,
    numbers: V::f64s,
}

impl<V: Simd> Number for Vector<V> {
    #[inline(always)]
    fn same(self, number: f64) -> Self {
        Self { numbers: self.simd.splat_f64s(number), ..self }
    }

    #[inline(always)]
    fn abs(self) -> Self {
        Self { numbers: self.simd.abs_f64s(self.numbers), ..self }
    }

    #[inline(always)]
    fn larger(self, other: Self) -> Self {
        let simd = self.simd;
        let (a, b) = (self.numbers, other.numbers);
        let b_or_nan = simd.select_f64s(simd.equal_f64s(a, a), b, a);
        let is_a = simd.greater_than_or_equal_f64s(a, b);
        Self { simd, numbers: simd.select_f64s(is_a, a, b_or_nan) }
    }

    #[inline(always)]
    fn sin_cos(self) -> (Self, Self) {
        let (mut sines, mut cosines) = (self, self);
        let lanes = as_numbers(&mut sines).iter_mut().zip(as_numbers(&mut cosines));
        for (sin, cos) in lanes {
            (*sin, *cos) = sin_cos(*sin);
        }
        (sines, cosines)
    }
}

#[inline(always)]
fn as_numbers<V: Simd>(vector: &mut Vector<V>) -> &mut [f64] {
    bytemuck::cast_slice_mut(std::slice::from_mut(&mut vector.numbers))
}

macro_rules! lane_by_lane {
    ($($of:ident, $name:ident, $instruction:ident;)*) => {$(
        impl<V: Simd> $of for Vector<V> {
            type Output = Self;

            #[inline(always)]
            fn $name(self, other: Self) -> Self {
                let numbers = self.simd.$instruction(self.numbers, other.numbers);
                Self { numbers, ..self }
            }
        }
    )*};
}

lane_by_lane! {
    Add, add, add_f64s;
    Sub, sub, sub_f64s;
    Mul, mul, mul_f64s;
    Div, div, div_f64s;
}

impl<V: Simd> AddAssign for Vector<V> {
    #[inline(always)]
    fn add_assign(&mut self, other: Self) {
        *self = *self + other;
    }
}

impl<V: Simd> Neg for Vector<V> {
    type Output = Self;

    #[inline(always)]
    fn neg(self) -> Self {
        Self { numbers: self.simd.neg_f64s(self.numbers), ..self }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;
    use pulp::{Arch, WithSimd};

    struct Formula([Lanes; 2]);

    fn formula<T: Number>(a: T, b: T) -> T {
        let (sin, cos) = (a - b).sin_cos();
        ((a * b + -a.abs()) / (sin + cos.same(2.0))).larger(cos)
    }

    impl WithSimd for Formula {
        type Output = [u64; LANES];

        fn with_simd<V: Simd>(self, simd: V) -> Self::Output {
            let mut lanes = Lanes::default();
            for index in 0..LaneChunk::<V>::COUNT {
                let part = LaneChunk::new(simd, index);
                let [a, b] = [self.0[0].get(part), self.0[1].get(part)];
                lanes.put(part, formula(a, b));
            }
            lanes.numbers().map(f64::to_bits)
        }
    }

    proptest! {
        #[test]
        fn every_lane_is_bit_identical_to_scalar_arithmetic(
            a in prop::array::uniform4(-9.0..9.0_f64), b in prop::array::uniform4(-9.0..9.0_f64),
        ) {
            let expected: [u64; LANES] = std::array::from_fn(|i| formula(a[i], b[i]).to_bits());
            for arch in [Arch::Scalar, Arch::new()] {
                assert_eq!(arch.dispatch(Formula([Lanes(a), Lanes(b)])), expected);
            }
        }
    }

    #[test]
    fn larger_returns_nan_if_either_lane_is_nan() {
        for arch in [Arch::Scalar, Arch::new()] {
            let (a, b) = (Lanes([f64::NAN, 1.0, 2.0, -1.0]), Lanes([1.0, f64::NAN, 3.0, -2.0]));
            let larger = arch.dispatch(Larger([a, b]));
            assert!(larger[0].is_nan() && larger[1].is_nan());
            assert_eq!(larger[2..], [3.0, -1.0]);
        }
    }

    struct Larger([Lanes; 2]);

    impl WithSimd for Larger {
        type Output = [f64; LANES];

        fn with_simd<V: Simd>(self, simd: V) -> Self::Output {
            let mut lanes = Lanes::default();
            for index in 0..LaneChunk::<V>::COUNT {
                let part = LaneChunk::new(simd, index);
                lanes.put(part, self.0[0].get(part).larger(self.0[1].get(part)));
            }
            lanes.numbers()
        }
    }
}
