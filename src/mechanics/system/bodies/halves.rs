//! Many bodies in two halves, on which two threads work at once, with the very bits that one thread gives.
//!
//! Sums are made in the order of the bodies: each adds up its forces for itself, and one thread hands them on. Of the tangent the second half has the
//! rows for itself that no body of the first one has; what its bodies give to rows before these they give again afterwards.

use super::Body;

/// Fewest control points of a half: smaller ones gain little, and lose where the other core has other work (docs/studies.md).
const SMALLEST_HALF: usize = 1500;

/// The largest part of all control points that bodies astride may have: so much is done twice.
const LARGEST_ASTRIDE: f64 = 0.1;

/// Where bodies are cut in two halves.
#[derive(Debug, Clone)]
pub(super) struct BodyHalves {
    /// The first body of the second half.
    pub(super) body: usize,
    /// The first row of the tangent that no body of the first half has.
    pub(super) row: usize,
    /// The bodies of the second half that have rows before that one.
    pub(super) astride: Vec<usize>,
}

impl BodyHalves {
    /// The cut of bodies into two halves, where two threads pay.
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
