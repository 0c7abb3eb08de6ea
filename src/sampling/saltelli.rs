//! Sampling for Sobol' indices.

use super::sobol;

/// Points in the unit cube for Sobol' indices (A. Saltelli et al., Computer Physics Communications 181 (2010) 259-270).
///
/// The points form blocks of `dimensions + 2` points. The result has one list per coordinate.
/// The first two points of a block are the halves of one point of a Sobol' sequence with `2 · dimensions` coordinates.
/// Each further point of a block is its first point, with one coordinate replaced by that of its second point.
pub fn saltelli(blocks: usize, dimensions: usize, seed: u64) -> Vec<Vec<f64>> {
    let pairs = sobol(blocks, 2 * dimensions, seed);
    (0..dimensions)
        .map(|own| {
            let (first, second) = (&pairs[own], &pairs[dimensions + own]);
            let of_block = |block: usize| {
                let exchanged =
                    move |other| if other == own { second[block] } else { first[block] };
                [first[block], second[block]].into_iter().chain((0..dimensions).map(exchanged))
            };
            (0..blocks).flat_map(of_block).collect()
        })
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn saltelli_block_exchanges_one_coordinate_at_a_time() {
        let columns = saltelli(4, 2, 1);
        for block in 0..4 {
            let point = |at: usize| [columns[0][4 * block + at], columns[1][4 * block + at]];
            let ([a, b], [c, d]) = (point(0), point(1));
            assert_eq!([point(2), point(3)], [[c, b], [a, d]]);
        }
    }
}
