//! Sobol' indices: fractions of the variance of a result that are due to each parameter.

/// Minimum number `n` of Saltelli blocks or of independent points. The uncertainty of an index is about `1/√n`.
const FEWEST: usize = 30;

#[derive(Clone, Copy, Debug, PartialEq)]
pub struct VarianceShare {
    /// First-order index: the result is averaged over all other parameters, and the variance of this average over this parameter is computed.
    /// The index is this variance as a fraction of the total variance.
    pub first: f64,
    /// Total index: mean variance of the result if only this parameter is unknown, as a fraction of the total variance.
    pub total: Option<f64>,
}

fn mean(values: impl Iterator<Item = f64>) -> f64 {
    let (sum, count) = values.fold((0.0, 0_usize), |(sum, count), x| (sum + x, count + 1));
    sum / count.max(1) as f64
}

fn variance(values: &[f64]) -> f64 {
    let middle = mean(values.iter().copied());
    mean(values.iter().map(|x| (x - middle) * (x - middle)))
}

/// Exact indices of all parameters from results on a full grid with equally probable values; `None` if the result is constant.
/// `lengths` is the number of values of each parameter. The last parameter varies fastest.
pub fn grid_indices(lengths: &[usize], results: &[f64]) -> Option<Vec<VarianceShare>> {
    let whole = variance(results);
    (whole > 0.0).then(|| {
        let of = |own: usize| {
            let inner: usize = lengths[own + 1..].iter().product();
            let (length, outer) = (lengths[own], lengths[..own].iter().product::<usize>());
            let at = |a: usize, value: usize, b: usize| results[(a * length + value) * inner + b];
            let others = || (0..outer).flat_map(|a| (0..inner).map(move |b| (a, b)));
            let means: Vec<f64> =
                (0..length).map(|value| mean(others().map(|(a, b)| at(a, value, b)))).collect();
            let left = others().map(|(a, b)| {
                let line: Vec<f64> = (0..length).map(|value| at(a, value, b)).collect();
                variance(&line)
            });
            VarianceShare { first: variance(&means) / whole, total: Some(mean(left) / whole) }
        };
        (0..lengths.len()).map(of).collect()
    })
}

/// Indices of all parameters from results at the points of [`saltelli`](super::saltelli).
/// Estimators: M. J. W. Jansen, Computer Physics Communications 117 (1999) 35-43.
///
/// Blocks with a result that is not finite are omitted. The indices are `None` if fewer than 30 blocks remain or the result is constant.
pub fn saltelli_indices(parameters: usize, results: &[f64]) -> Option<Vec<VarianceShare>> {
    let is_whole = |block: &&[f64]| block.iter().all(|result| result.is_finite());
    let blocks: Vec<&[f64]> = results.chunks_exact(parameters + 2).filter(is_whole).collect();
    let both: Vec<f64> = blocks.iter().flat_map(|block| [block[0], block[1]]).collect();
    let whole = variance(&both);
    let half_square = |x: f64, y: f64| (x - y) * (x - y) / 2.0;
    let of = |own: usize| {
        let with_own = mean(blocks.iter().map(|block| half_square(block[1], block[2 + own])));
        let without = mean(blocks.iter().map(|block| half_square(block[0], block[2 + own])));
        VarianceShare { first: 1.0 - with_own / whole, total: Some(without / whole) }
    };
    (whole > 0.0 && blocks.len() >= FEWEST).then(|| (0..parameters).map(of).collect())
}

/// First-order index of one parameter with `values` at independent points; `None` for fewer than 30 finite results or a constant result.
///
/// The points are sorted by the parameter and divided into groups, of which there are at least three.
/// The numerator of the index is the variance of the group means, minus the contribution of the scatter within groups.
/// The number of groups is the cube root of the number of points, rounded down.
pub fn rank_indices(values: &[f64], results: &[f64]) -> Option<VarianceShare> {
    let pairs = values.iter().copied().zip(results.iter().copied());
    let mut pairs: Vec<(f64, f64)> = pairs.filter(|(_, result)| result.is_finite()).collect();
    pairs.sort_by(|a, b| a.0.total_cmp(&b.0));
    let results: Vec<f64> = pairs.into_iter().map(|(_, result)| result).collect();
    let whole = variance(&results);
    if results.len() < FEWEST || whole <= 0.0 {
        return None;
    }
    let groups = (1..).take_while(|n: &usize| n.pow(3) <= results.len()).last().unwrap_or(1).max(3);
    let ends =
        |group: usize| (group * results.len() / groups)..((group + 1) * results.len() / groups);
    let all = mean(results.iter().copied());
    let (mut between, mut within) = (0.0, 0.0);
    for group in (0..groups).map(|group| &results[ends(group)]) {
        let (count, middle) = (group.len() as f64, mean(group.iter().copied()));
        between += count * (middle - all) * (middle - all);
        within += variance(group) * count / (count - 1.0).max(1.0);
    }
    let count = results.len() as f64;
    Some(VarianceShare {
        first: ((between / count - within / count) / whole).max(0.0),
        total: None,
    })
}

#[cfg(test)]
mod tests {
    use super::super::{latin_hypercube, saltelli};
    use super::*;
    use crate::elementary::{power, sin};
    use std::f64::consts::PI;

    /// Function of T. Ishigami and T. Homma (1990) with a = 7 and b = 0.1, on the cube from -π to π.
    fn ishigami(x: &[f64]) -> f64 {
        let [a, b, c] = [0, 1, 2].map(|at: usize| (2.0 * x[at] - 1.0) * PI);
        sin(a) + 7.0 * sin(b) * sin(b) + 0.1 * power(c, 4.0) * sin(a)
    }

    fn known() -> ([f64; 3], [f64; 3]) {
        let fourth = power(PI, 4.0);
        let first = 0.5 * power(1.0 + 0.1 * fourth / 5.0, 2.0);
        let (second, both) = (49.0 / 8.0, 8.0 * 0.01 * fourth * fourth / 225.0);
        let whole = first + second + both;
        ([first, second, 0.0].map(|v| v / whole), [first + both, second, both].map(|v| v / whole))
    }

    #[test]
    fn saltelli_indices_of_the_ishigami_function_are_exact() {
        let columns = saltelli(4096, 3, 1);
        let results: Vec<f64> = (0..columns[0].len())
            .map(|at| ishigami(&[0, 1, 2].map(|c: usize| columns[c][at])))
            .collect();
        let (first, total) = known();
        assert!((first[0] - 0.3139).abs() < 1e-4 && (total[2] - 0.2437).abs() < 1e-4);
        for (own, share) in saltelli_indices(3, &results).unwrap().into_iter().enumerate() {
            assert!((share.first - first[own]).abs() < 0.01, "{own}: {share:?}");
            assert!((share.total.unwrap() - total[own]).abs() < 0.01, "{own}: {share:?}");
        }
    }

    #[test]
    fn grid_indices_of_the_ishigami_function_are_exact() {
        let lengths = [40, 41, 42];
        let middle = |at: usize, of: usize| (at as f64 + 0.5) / of as f64;
        let point = |row: usize| [row / (41 * 42), row / 42 % 41, row % 42];
        let result = |row: usize| {
            let at = point(row);
            ishigami(&[0, 1, 2].map(|c: usize| middle(at[c], lengths[c])))
        };
        let results: Vec<f64> = (0..40 * 41 * 42).map(result).collect();
        let (first, total) = known();
        for (own, share) in grid_indices(&lengths, &results).unwrap().into_iter().enumerate() {
            assert!((share.first - first[own]).abs() < 0.005, "{own}: {share:?}");
            assert!((share.total.unwrap() - total[own]).abs() < 0.005, "{own}: {share:?}");
        }
    }

    #[test]
    fn rank_indices_give_the_first_order_indices() {
        let columns = latin_hypercube(20_000, 3, 1);
        let results: Vec<f64> =
            (0..20_000).map(|at| ishigami(&[0, 1, 2].map(|c: usize| columns[c][at]))).collect();
        for (own, known) in known().0.into_iter().enumerate() {
            let share = rank_indices(&columns[own], &results).unwrap();
            assert!((share.first - known).abs() < 0.02, "{own}: {share:?}, {known}");
        }
        assert!(rank_indices(&columns[0][..20], &results[..20]).is_none());
    }

    #[test]
    fn constant_results_have_no_sensitivity_indices() {
        assert!(grid_indices(&[2, 2], &[1.0; 4]).is_none());
        assert!(saltelli_indices(1, &[1.0; 6]).is_none());
        let blocks = |count| saltelli_indices(1, &[0.0, 1.0, 0.5].repeat(count));
        assert!(blocks(29).is_none() && blocks(30).is_some());
        assert!(saltelli_indices(1, &[f64::NAN; 6]).is_none());
    }
}
