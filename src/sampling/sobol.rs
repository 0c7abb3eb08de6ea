//! Sobol' sequences, whose points fill the unit cube more evenly than random points.

use super::Random;

const BITS: usize = 32;

/// Inner coefficients of the primitive polynomial, as bits, and initial direction numbers of each coordinate after the first.
/// Source: file new-joe-kuo-6.21201 of S. Joe, F. Y. Kuo, SIAM J. Sci. Comput. 30 (2008) 2635-2654.
const DIRECTIONS: [(u32, &[u32]); 39] = [
    (0, &[1]),
    (1, &[1, 3]),
    (1, &[1, 3, 1]),
    (2, &[1, 1, 1]),
    (1, &[1, 1, 3, 3]),
    (4, &[1, 3, 5, 13]),
    (2, &[1, 1, 5, 5, 17]),
    (4, &[1, 1, 5, 5, 5]),
    (7, &[1, 1, 7, 11, 19]),
    (11, &[1, 1, 5, 1, 1]),
    (13, &[1, 1, 1, 3, 11]),
    (14, &[1, 3, 5, 5, 31]),
    (1, &[1, 3, 3, 9, 7, 49]),
    (13, &[1, 1, 1, 15, 21, 21]),
    (16, &[1, 3, 1, 13, 27, 49]),
    (19, &[1, 1, 1, 15, 7, 5]),
    (22, &[1, 3, 1, 15, 13, 25]),
    (25, &[1, 1, 5, 5, 19, 61]),
    (1, &[1, 3, 7, 11, 23, 15, 103]),
    (4, &[1, 3, 7, 13, 13, 15, 69]),
    (7, &[1, 1, 3, 13, 7, 35, 63]),
    (8, &[1, 3, 5, 9, 1, 25, 53]),
    (14, &[1, 3, 1, 13, 9, 35, 107]),
    (19, &[1, 3, 1, 5, 27, 61, 31]),
    (21, &[1, 1, 5, 11, 19, 41, 61]),
    (28, &[1, 3, 5, 3, 3, 13, 69]),
    (31, &[1, 1, 7, 13, 1, 19, 1]),
    (32, &[1, 3, 7, 5, 13, 19, 59]),
    (37, &[1, 1, 3, 9, 25, 29, 41]),
    (41, &[1, 3, 5, 13, 23, 1, 55]),
    (42, &[1, 3, 7, 3, 13, 59, 17]),
    (50, &[1, 3, 1, 3, 5, 53, 69]),
    (55, &[1, 1, 5, 5, 23, 33, 13]),
    (56, &[1, 1, 7, 7, 1, 61, 123]),
    (59, &[1, 1, 7, 9, 13, 61, 49]),
    (62, &[1, 3, 3, 5, 3, 55, 33]),
    (14, &[1, 3, 1, 15, 31, 13, 49, 245]),
    (21, &[1, 3, 5, 15, 31, 59, 63, 97]),
    (22, &[1, 3, 1, 11, 11, 11, 77, 249]),
];

pub const MOST_DIMENSIONS: usize = DIRECTIONS.len() + 1;

/// Direction numbers of a coordinate, counted from 0, as multiples of 2⁻³².
fn directions(dimension: usize) -> [u32; BITS] {
    let mut numbers = [0; BITS];
    let Some((coefficients, initial)) = dimension.checked_sub(1).map(|at| DIRECTIONS[at]) else {
        // The first coordinate is the van der Corput sequence.
        return std::array::from_fn(|bit| 1 << (BITS - 1 - bit));
    };
    let degree = initial.len();
    for bit in 0..BITS {
        numbers[bit] = match initial.get(bit) {
            Some(number) => number << (BITS - 1 - bit),
            None => {
                let far = numbers[bit - degree];
                let inner = (1..degree).filter(|k| coefficients >> (degree - 1 - k) & 1 == 1);
                inner.fold(far ^ (far >> degree), |sum, k| sum ^ numbers[bit - k])
            }
        };
    }
    numbers
}

/// First `count` points of a Sobol' sequence in Gray code order (I. A. Antonov and V. M. Saleev, 1979), one list per coordinate.
/// The number of dimensions must be at most [`MOST_DIMENSIONS`].
///
/// Each coordinate is combined with random bits by exclusive or, which preserves the uniformity (digital shift).
pub fn sobol(count: usize, dimensions: usize, seed: u64) -> Vec<Vec<f64>> {
    let mut random = Random::seeded(seed);
    (0..dimensions)
        .map(|dimension| {
            let (numbers, shift) = (directions(dimension), random.word());
            let mut bits = 0_u32;
            (0..count)
                .map(|point| {
                    if point > 0 {
                        bits ^= numbers[(point.trailing_zeros() as usize).min(BITS - 1)];
                    }
                    (f64::from(bits ^ shift) + 0.5) / (1_u64 << BITS) as f64
                })
                .collect()
        })
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn plain(count: usize, dimension: usize) -> Vec<f64> {
        let numbers = directions(dimension);
        let mut bits = 0_u32;
        (0..count)
            .map(|point| {
                bits ^= if point > 0 { numbers[point.trailing_zeros() as usize] } else { 0 };
                f64::from(bits) / (1_u64 << BITS) as f64
            })
            .collect()
    }

    #[test]
    fn sobol_points_agree_with_joe_and_kuo() {
        assert_eq!(plain(6, 0), [0.0, 0.5, 0.75, 0.25, 0.375, 0.875]);
        assert_eq!(plain(6, 1), [0.0, 0.5, 0.25, 0.75, 0.375, 0.875]);
        assert_eq!(plain(6, 2), [0.0, 0.5, 0.25, 0.75, 0.625, 0.125]);
    }

    #[test]
    fn sobol_points_are_stratified_for_powers_of_two() {
        for values in sobol(256, MOST_DIMENSIONS, 3) {
            let mut parts: Vec<usize> = values.iter().map(|x| (x * 256.0) as usize).collect();
            parts.sort_unstable();
            assert!(parts.into_iter().eq(0..256));
            assert!(values.iter().all(|x| *x > 0.0 && *x < 1.0));
        }
    }

    #[test]
    fn sobol_integration_error_is_small() {
        let columns = sobol(4096, 4, 1);
        let product = |at: usize| columns.iter().map(|values| 2.0 * values[at]).product::<f64>();
        let mean = (0..4096).map(product).sum::<f64>() / 4096.0;
        assert!((mean - 1.0).abs() < 2e-3, "{mean}");
    }
}
