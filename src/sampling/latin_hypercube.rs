//! Latin hypercube sampling.

use super::Random;

/// Random points in the unit cube (M. D. McKay, R. J. Beckman, W. J. Conover, Technometrics 21 (1979) 239-245), one list per coordinate.
///
/// If the range of a coordinate is divided into as many equal intervals as there are points, each interval contains one point.
pub fn latin_hypercube(count: usize, dimensions: usize, seed: u64) -> Vec<Vec<f64>> {
    let mut random = Random::seeded(seed);
    let coordinate = |_| {
        let mut values: Vec<f64> = (0..count)
            .map(|part| {
                let place = (part as f64 + random.unit()) / count as f64;
                place.min(1.0 - f64::EPSILON / 2.0)
            })
            .collect();
        random.shuffle(&mut values);
        values
    };
    (0..dimensions).map(coordinate).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn latin_hypercube_has_one_point_in_each_stratum() {
        let columns = latin_hypercube(50, 3, 4);
        assert_eq!(columns.len(), 3);
        for values in &columns {
            let mut parts: Vec<usize> = values.iter().map(|x| (x * 50.0) as usize).collect();
            parts.sort_unstable();
            assert!(parts.into_iter().eq(0..50));
        }
        assert_ne!(columns[0], columns[1]);
        assert_eq!(columns, latin_hypercube(50, 3, 4));
    }
}
