//! Strips of four vectors that vector instructions process together.

use pulp::{Arch, Simd, WithSimd};

pub const STRIP_WIDTH: usize = 4;

/// Four interleaved vectors: the entries `i` of all four vectors are followed by the entries `i + 1`.
pub type VectorStrip = [[f64; STRIP_WIDTH]];

/// Matrix of four by four numbers, stored row by row, for products of two strips.
pub type Square4 = [[f64; STRIP_WIDTH]; STRIP_WIDTH];

/// Products `Xᵀ Y` of two strips. Entry `(i, j)` is the scalar product of vector `i` of `x` and vector `j` of `y`.
pub fn products(x: &VectorStrip, y: &VectorStrip) -> Square4 {
    Arch::new().dispatch(Products { x, y })
}

/// Subtracts linear combinations of the vectors of `x` from the vectors of `from`: `Y ← Y - X G`.
pub fn subtract_combination(x: &VectorStrip, by: &Square4, from: &mut VectorStrip) {
    Arch::new().dispatch(LinearCombination { x, by, from });
}

/// Replaces the vectors of a strip by linear combinations of these vectors: `X ← X G`.
pub fn combine(x: &mut VectorStrip, by: &Square4) {
    Arch::new().dispatch(Replacement { x, by });
}

struct Replacement<'a> {
    x: &'a mut VectorStrip,
    by: &'a Square4,
}

impl WithSimd for Replacement<'_> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(self, _: S) {
        let by = *self.by;
        for row in self.x {
            let mut value = [0.0; STRIP_WIDTH];
            for (entry, by) in row.iter().zip(&by) {
                for (sum, by) in value.iter_mut().zip(by) {
                    *sum += entry * by;
                }
            }
            *row = value;
        }
    }
}

struct Products<'a> {
    x: &'a VectorStrip,
    y: &'a VectorStrip,
}

impl WithSimd for Products<'_> {
    type Output = Square4;

    #[inline(always)]
    fn with_simd<S: Simd>(self, _: S) -> Square4 {
        let mut sums = [[0.0; STRIP_WIDTH]; STRIP_WIDTH];
        for (x, y) in self.x.iter().zip(self.y) {
            for (sums, x) in sums.iter_mut().zip(x) {
                for (sum, y) in sums.iter_mut().zip(y) {
                    *sum += x * y;
                }
            }
        }
        sums
    }
}

struct LinearCombination<'a> {
    x: &'a VectorStrip,
    by: &'a Square4,
    from: &'a mut VectorStrip,
}

impl WithSimd for LinearCombination<'_> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(self, _: S) {
        let by = *self.by;
        for (x, from) in self.x.iter().zip(self.from) {
            let mut value = *from;
            for (x, by) in x.iter().zip(&by) {
                for (value, by) in value.iter_mut().zip(by) {
                    *value -= x * by;
                }
            }
            *from = value;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn strips_are_projected_out_and_recombined() {
        let x: Vec<[f64; 4]> =
            (0..4).map(|i| std::array::from_fn(|k| f64::from(u8::from(i == k)))).collect();
        let mut y = vec![[1.0, 2.0, 3.0, 4.0]; 4];
        let products = products(&x, &y);
        assert_eq!(products[2], [1.0, 2.0, 3.0, 4.0]);
        subtract_combination(&x, &products, &mut y);
        assert_eq!(y, vec![[0.0; 4]; 4]);
        let mut z = x.clone();
        combine(&mut z, &products);
        assert_eq!(z, vec![[1.0, 2.0, 3.0, 4.0]; 4]);
    }
}
