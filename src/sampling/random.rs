//! Random number generator.

use rand_chacha::ChaCha12Rng;
use rand_chacha::rand_core::{Rng, SeedableRng};

/// Generator of the random numbers of studies: ChaCha with twelve rounds (D. J. Bernstein, 2008), with equal numbers for equal seeds.
pub struct Random(ChaCha12Rng);

const BITS: u32 = 53;

impl Random {
    pub fn seeded(seed: u64) -> Self {
        let mut key = [0; 32];
        key[..8].copy_from_slice(&seed.to_le_bytes());
        Self(ChaCha12Rng::from_seed(key))
    }

    pub fn unit(&mut self) -> f64 {
        let part = self.0.next_u64() >> (u64::BITS - BITS);
        ((part as f64 + 0.5) / (1_u64 << BITS) as f64).min(1.0 - f64::EPSILON / 2.0)
    }

    pub fn word(&mut self) -> u32 {
        self.0.next_u32()
    }

    /// Uniform random integer below `count`.
    /// The largest values of the generator are rejected, because they would make some integers more probable than others.
    pub fn below(&mut self, count: u64) -> u64 {
        let whole = u64::MAX - u64::MAX % count.max(1);
        loop {
            let word = self.0.next_u64();
            if word < whole {
                return word % count.max(1);
            }
        }
    }

    /// Permutes the values at random, with equal probability of all permutations (R. Durstenfeld, 1964).
    pub fn shuffle<T>(&mut self, values: &mut [T]) {
        for last in (1..values.len()).rev() {
            let other = self.below(last as u64 + 1);
            values.swap(last, usize::try_from(other).unwrap_or(0));
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn equal_seeds_give_equal_numbers_between_zero_and_one() {
        let drawn = |seed| -> Vec<f64> {
            let mut random = Random::seeded(seed);
            (0..10_000).map(|_| random.unit()).collect()
        };
        let first = drawn(1);
        assert_eq!(first, drawn(1));
        assert_ne!(first, drawn(2));
        assert!(first.iter().all(|x| *x > 0.0 && *x < 1.0));
        let mean = first.iter().sum::<f64>() / first.len() as f64;
        // The tolerance is five standard deviations of the mean.
        assert!((mean - 0.5).abs() < 5.0 * (1.0_f64 / 12.0 / 1e4).sqrt(), "{mean}");
    }

    #[test]
    fn shuffle_permutes_values_uniformly() {
        let mut random = Random::seeded(7);
        let mut places = [0_usize; 5];
        for _ in 0..5000 {
            let mut values = [0, 1, 2, 3, 4];
            random.shuffle(&mut values);
            places[values.iter().position(|value| *value == 0).unwrap()] += 1;
            values.sort_unstable();
            assert_eq!(values, [0, 1, 2, 3, 4]);
        }
        assert!(places.iter().all(|count| count.abs_diff(1000) < 150), "{places:?}");
    }
}
