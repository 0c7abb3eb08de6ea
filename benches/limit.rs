//! Peak rates of the machine: multiplications and subtractions by vector instructions (not fused, as in elimination), and bytes read and written.
//!
//! `cargo bench --bench limit` prints the rates. docs/studies.md compares the steps with them.

use std::hint::black_box;
use std::time::{Duration, Instant};

use pulp::{Arch, Simd, WithSimd};

const TIME_LIMIT: Duration = Duration::from_millis(300);
/// Number of independent operations. It is large enough to hide the latency of an operation.
const CHAINS: usize = 12;
const ROUNDS: usize = 100_000;

/// Independent chains of multiplications and subtractions.
struct Arithmetic;

impl WithSimd for Arithmetic {
    type Output = usize;

    /// Number of executed operations.
    #[inline(always)]
    fn with_simd<S: Simd>(self, simd: S) -> usize {
        let (factor, less) = (simd.splat_f64s(black_box(0.999)), simd.splat_f64s(black_box(1e-3)));
        let mut values = [simd.splat_f64s(black_box(1.0)); CHAINS];
        for _ in 0..ROUNDS {
            for value in &mut values {
                *value = simd.sub_f64s(simd.mul_f64s(*value, factor), less);
            }
        }
        black_box(values);
        2 * S::F64_LANES * CHAINS * ROUNDS
    }
}

/// Sum of numbers, computed with vector instructions.
struct Sum<'a>(&'a [f64]);

impl WithSimd for Sum<'_> {
    type Output = f64;

    #[inline(always)]
    fn with_simd<S: Simd>(self, simd: S) -> f64 {
        let (vectors, _) = S::as_simd_f64s(self.0);
        let mut sums = [simd.splat_f64s(0.0); CHAINS];
        for vectors in vectors.chunks_exact(CHAINS) {
            for (sum, vector) in sums.iter_mut().zip(vectors) {
                *sum = simd.add_f64s(*sum, *vector);
            }
        }
        sums.iter().map(|sum| simd.reduce_sum_f64s(*sum)).sum()
    }
}

/// Smallest duration of an action [s].
fn least(mut action: impl FnMut()) -> f64 {
    let (begun, mut least) = (Instant::now(), f64::INFINITY);
    while begun.elapsed() < TIME_LIMIT {
        let started = Instant::now();
        action();
        least = least.min(started.elapsed().as_secs_f64());
    }
    least
}

fn main() {
    let mut operations = 0;
    let time = least(|| operations = black_box(Arch::new().dispatch(Arithmetic)));
    println!("arithmetic, not fused: {:.1} GFlop/s", operations as f64 / time * 1e-9);
    for kilobytes in [16, 256, 1024, 8 << 10, 64 << 10, 256 << 10] {
        let bytes = kilobytes << 10;
        let mut numbers = vec![1.0; bytes / size_of::<f64>()];
        let read = least(|| _ = black_box(Arch::new().dispatch(Sum(black_box(&numbers)))));
        let written = least(|| black_box(&mut numbers).fill(0.0));
        let speed = |time: f64| bytes as f64 / time * 1e-9;
        println!(
            "{kilobytes:>7} KiB: {:>6.1} GB/s read, {:>6.1} GB/s written",
            speed(read),
            speed(written)
        );
    }
}
