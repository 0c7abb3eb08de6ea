//! Small linear complementarity problems, which occur in simultaneous impacts of several contacts.

use super::{BandedMatrix, LinearError};

/// Condition that an unknown and its response `w = A z + q` must satisfy together.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Pairing {
    /// Equality: the response is zero, and the unknown may have any value.
    Equality,
    /// Complementarity: unknown and response are not negative, and at least one of them is zero.
    Complementary,
}

/// Number of block exchanges without progress after which pairs are exchanged one by one.
const MOST_BLOCK_EXCHANGES: usize = 3;

/// Largest magnitude of a negative unknown or response that counts as zero [-].
/// Unknowns are compared with the largest unknown, and responses with the largest entry of `q`.
const NOTHING: f64 = 1e-13;

/// Solves a linear complementarity problem for the unknowns `z` with the responses `w = A z + q`.
/// Equality pairs satisfy `w = 0`, complementary pairs `0 ≤ z ⟂ w ≥ 0`.
///
/// The matrix `A` is given by its rows and need not be symmetric.
/// The solution is unique if `A` is positive definite, at least after the elimination of the equality pairs.
/// The method is block principal pivoting, which exchanges all violating pairs simultaneously (Júdice & Pires 1994).
/// If block pivoting does not make progress, pairs are exchanged one by one (Murty 1974).
///
/// # Errors
/// Fails if, during the exchanges, the submatrix of the unknowns that may be nonzero is singular or not finite.
pub fn complementary(
    matrix: &[Vec<f64>],
    q: &[f64],
    pairings: &[Pairing],
) -> Result<Vec<f64>, LinearError> {
    let count = q.len();
    let pushes = |at: usize| pairings[at] == Pairing::Complementary;
    let mut acts: Vec<bool> = (0..count).map(|at| !pushes(at) || q[at] < 0.0).collect();
    let (mut fewest, mut exchanges_left) = (usize::MAX, MOST_BLOCK_EXCHANGES);
    loop {
        let acting: Vec<usize> = (0..count).filter(|at| acts[*at]).collect();
        let mut active = BandedMatrix::zeros(acting.len(), acting.len().saturating_sub(1));
        for (row, &i) in acting.iter().enumerate() {
            acting
                .iter()
                .enumerate()
                .for_each(|(column, &j)| active.add(row, column, matrix[i][j]));
        }
        let mut own: Vec<f64> = acting.iter().map(|at| -q[*at]).collect();
        active.factorise()?.solve(&mut own);
        let mut z = vec![0.0; count];
        acting.iter().zip(own).for_each(|(at, value)| z[*at] = value);

        let answer = |at: usize| q[at] + matrix[at].iter().zip(&z).map(|(a, z)| a * z).sum::<f64>();
        let largest = |values: &[f64]| values.iter().fold(0.0, |most: f64, x| most.max(x.abs()));
        let (least_z, least_w) = (-NOTHING * largest(&z), -NOTHING * largest(q));
        let is_wrong = |at: &usize| match acts[*at] {
            true => z[*at] < least_z,
            false => answer(*at) < least_w,
        };
        let wrong: Vec<usize> = (0..count).filter(|at| pushes(*at)).filter(is_wrong).collect();
        let Some(&last) = wrong.last() else { return Ok(z) };
        if wrong.len() < fewest {
            (fewest, exchanges_left) = (wrong.len(), MOST_BLOCK_EXCHANGES);
        } else if exchanges_left > 0 {
            exchanges_left -= 1;
        } else {
            acts[last] = !acts[last];
            continue;
        }
        wrong.iter().for_each(|at| acts[*at] = !acts[*at]);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn definite(size: usize, entries: &[f64]) -> Vec<Vec<f64>> {
        let rows: Vec<&[f64]> = entries.chunks(size).collect();
        let product =
            |i: usize, j: usize| rows[i].iter().zip(rows[j]).map(|(a, b)| a * b).sum::<f64>();
        let entry = |i: usize, j: usize| product(i, j) + if i == j { 0.01 } else { 0.0 };
        (0..size).map(|i| (0..size).map(|j| entry(i, j)).collect()).collect()
    }

    #[test]
    fn complementary_unknown_already_satisfied_by_coupling_is_zero() {
        let matrix = [vec![2.0, 1.9], vec![1.9, 2.0]];
        let pairings = [Pairing::Complementary; 2];
        assert_eq!(complementary(&matrix, &[-2.0, -0.1], &pairings).unwrap(), [1.0, 0.0]);
        let tied = [Pairing::Complementary, Pairing::Equality];
        let both = complementary(&matrix, &[-2.0, -0.1], &tied).unwrap();
        assert!(both[0] > 1.0 && both[1] < 0.0, "{both:?}");
    }

    proptest! {
        #[test]
        fn complementarity_solution_satisfies_all_conditions(
            entries in prop::collection::vec(-1.0..1.0_f64, 49),
            q in prop::collection::vec(-1.0..1.0_f64, 7),
            tied in prop::collection::vec(any::<bool>(), 7),
        ) {
            let matrix = definite(7, &entries);
            let pairing = |tied: &bool| if *tied { Pairing::Equality } else { Pairing::Complementary };
            let pairings: Vec<Pairing> = tied.iter().map(pairing).collect();
            let z = complementary(&matrix, &q, &pairings).unwrap();
            let size = z.iter().fold(1.0_f64, |most, z| most.max(z.abs()));
            for (at, row) in matrix.iter().enumerate() {
                let answer = q[at] + row.iter().zip(&z).map(|(a, z)| a * z).sum::<f64>();
                let nothing = 1e-12 * size;
                match pairings[at] {
                    Pairing::Equality => prop_assert!(answer.abs() < nothing),
                    Pairing::Complementary => {
                        prop_assert!(z[at] > -nothing && answer > -nothing);
                        prop_assert!(z[at].abs() < nothing || answer.abs() < nothing);
                    }
                }
            }
            let turned: Vec<Vec<f64>> = matrix.iter().rev().map(|row| row.iter().rev().copied().collect()).collect();
            let q: Vec<f64> = q.into_iter().rev().collect();
            let pairings: Vec<Pairing> = pairings.into_iter().rev().collect();
            let other = complementary(&turned, &q, &pairings).unwrap();
            for (one, other) in z.iter().zip(other.iter().rev()) {
                prop_assert!((one - other).abs() < 1e-10 * size);
            }
        }
    }
}
