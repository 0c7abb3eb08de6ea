//! Division of many bodies into two halves for two threads, without an effect on the results.
//!
//! Sums are computed in the order of the bodies: each body accumulates its forces separately, and one thread adds these forces to the sum.
//! In the tangent, the thread of the second half writes only the rows in which no body of the first half has entries.

use super::Body;

/// Smallest number of control points of a half. Smaller halves gain little time, and lose time if the other core is busy (docs/studies.md).
const SMALLEST_HALF: usize = 1500;

/// Largest allowed fraction of control points in bodies that have rows in both halves of the tangent and are therefore evaluated twice.
const LARGEST_ASTRIDE: f64 = 0.1;

#[derive(Debug, Clone)]
pub(super) struct BodyHalves {
    pub(super) body: usize,
    /// First row of the tangent in which no body of the first half has entries.
    pub(super) row: usize,
    /// Bodies of the second half that have entries in rows of the first half.
    pub(super) astride: Vec<usize>,
}

impl BodyHalves {
    pub(super) fn worthwhile(bodies: &[Body], threads: usize) -> Option<Self> {
        let points = |bodies: &[Body]| bodies.iter().map(Body::points).sum::<usize>();
        let all = points(bodies);
        if threads < 2 || all < 2 * SMALLEST_HALF || bodies.iter().any(Body::is_divided) {
            return None;
        }
        let mut before = 0;
        let body = bodies.iter().take_while(|body| {
            before += body.points();
            2 * before <= all
        });
        let body = body.count();
        let (first, second) = bodies.split_at(body);
        if points(first).min(points(second)) < SMALLEST_HALF {
            return None;
        }
        let row = first.iter().filter_map(Body::last_row).max().map_or(0, |row| row + 1);
        let reaches = |at: &usize| bodies[*at].first_row().is_some_and(|first| first < row);
        let astride: Vec<usize> = (body..bodies.len()).filter(reaches).collect();
        let twice: usize = astride.iter().map(|at| bodies[*at].points()).sum();
        (twice as f64 <= LARGEST_ASTRIDE * all as f64).then_some(Self { body, row, astride })
    }
}
