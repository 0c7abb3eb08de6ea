//! Tangent matrix of one span.

use pulp::Simd;

pub(super) type BlockRow<const N: usize> = [[f64; 3]; N];

/// Tangent matrix of one span: `rows[a][i][b][j]` for control points `a`, `b` and components `i`, `j` of x, y, ω.
pub(super) struct SpanTangent<S, const N: usize> {
    simd: S,
    pub(super) rows: [[BlockRow<N>; 3]; N],
}

impl<S: Simd, const N: usize> SpanTangent<S, N> {
    #[inline(always)]
    pub(super) fn zeros(simd: S) -> Self {
        Self { simd, rows: [[[[0.0; 3]; N]; 3]; N] }
    }

    #[inline(always)]
    pub(super) fn add_multiple(
        &mut self,
        (function, component): (usize, usize),
        factor: f64,
        row: &BlockRow<N>,
    ) {
        let to = self.rows[function][component].as_flattened_mut();
        let (to, to_rest) = S::as_mut_simd_f64s(to);
        let (from, from_rest) = S::as_simd_f64s(row.as_flattened());
        let factors = self.simd.splat_f64s(factor);
        for (to, from) in to.iter_mut().zip(from) {
            *to = self.simd.add_f64s(*to, self.simd.mul_f64s(factors, *from));
        }
        for (to, from) in to_rest.iter_mut().zip(from_rest) {
            *to += factor * from;
        }
    }

    #[inline(always)]
    pub(super) fn entries(&self) -> &[f64] {
        self.rows.as_flattened().as_flattened().as_flattened()
    }
}
