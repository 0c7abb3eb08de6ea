//! Splits curves at gaps, clips them to the plot, and thins them to the resolution of the picture.

use super::canvas::{Area, Point};
use crate::elementary::hypot;

/// Width of the vertical strips in which a long curve is thinned [pixels].
const STRIP: f64 = 0.5;

/// Smallest number of points of a curve that is thinned.
const LONG: usize = 2000;

/// Splits a curve [pixels] at its gaps and at the sides of `window`, and thins it if it is long.
pub fn pieces(points: impl IntoIterator<Item = Point>, window: &Area) -> Vec<Vec<Point>> {
    let runs = runs(points);
    let length: usize = runs.iter().map(Vec::len).sum();
    let runs = if length < LONG { runs } else { runs.iter().map(|run| thinned(run)).collect() };
    runs.iter().flat_map(|run| inside(run, window)).collect()
}

fn runs(points: impl IntoIterator<Item = Point>) -> Vec<Vec<Point>> {
    let mut runs = Vec::new();
    let mut run = Vec::new();
    for point in points {
        if point.0.is_finite() && point.1.is_finite() {
            run.push(point);
        } else if !run.is_empty() {
            runs.push(std::mem::take(&mut run));
        }
    }
    runs.extend((!run.is_empty()).then_some(run));
    runs
}

fn thinned(run: &[Point]) -> Vec<Point> {
    let strip = |point: &Point| (point.0 / STRIP).floor();
    let mut kept = Vec::new();
    for part in run.chunk_by(|a, b| strip(a) == strip(b)) {
        let least = (0..part.len()).min_by(|&a, &b| part[a].1.total_cmp(&part[b].1));
        let most = (0..part.len()).max_by(|&a, &b| part[a].1.total_cmp(&part[b].1));
        let mut indices: Vec<usize> =
            [Some(0), least, most, part.len().checked_sub(1)].into_iter().flatten().collect();
        indices.sort_unstable();
        indices.dedup();
        kept.extend(indices.into_iter().map(|index| part[index]));
    }
    kept
}

fn inside(run: &[Point], window: &Area) -> Vec<Vec<Point>> {
    if let [dot] = run {
        return clipped(*dot, *dot, window).map(|_| vec![*dot]).into_iter().collect();
    }
    let mut parts: Vec<Vec<Point>> = Vec::new();
    for pair in run.windows(2) {
        let Some((from, to)) = clipped(pair[0], pair[1], window) else { continue };
        match parts.last_mut() {
            Some(part) if part.last() == Some(&from) => part.push(to),
            _ => parts.push(vec![from, to]),
        }
    }
    parts
}

/// Part of the straight line from `a` to `b` that is within `window` (Liang and Barsky, ACM Trans. Graphics 3, 1984).
fn clipped(a: Point, b: Point, window: &Area) -> Option<(Point, Point)> {
    let (dx, dy) = (b.0 - a.0, b.1 - a.1);
    let (mut enter, mut leave) = (0.0f64, 1.0f64);
    let sides = [
        (-dx, a.0 - window.left),
        (dx, window.right - a.0),
        (-dy, a.1 - window.top),
        (dy, window.bottom - a.1),
    ];
    for (outwards, room) in sides {
        if outwards == 0.0 && room < 0.0 {
            return None;
        } else if outwards < 0.0 {
            enter = enter.max(room / outwards);
        } else if outwards > 0.0 {
            leave = leave.min(room / outwards);
        }
    }
    let at = |t: f64| (a.0 + t * dx, a.1 + t * dy);
    (enter <= leave)
        .then(|| (if enter > 0.0 { at(enter) } else { a }, if leave < 1.0 { at(leave) } else { b }))
}

pub fn dashes(run: &[Point], pattern: &[f64]) -> Vec<Vec<Point>> {
    let whole =
        run.windows(2).map(|pair| hypot(pair[1].0 - pair[0].0, pair[1].1 - pair[0].1)).sum::<f64>();
    if pattern.iter().any(|&length| length < 0.5) || pattern.is_empty() || whole > 1e5 {
        return vec![run.to_vec()];
    }
    let mut strokes = Vec::new();
    let mut stroke: Vec<Point> = run.first().copied().into_iter().collect();
    let (mut index, mut left) = (0, pattern[0]);
    for pair in run.windows(2) {
        let (a, b) = (pair[0], pair[1]);
        let length = hypot(b.0 - a.0, b.1 - a.1);
        let mut gone = 0.0;
        while length - gone > left {
            gone += left;
            let corner = (a.0 + (b.0 - a.0) * gone / length, a.1 + (b.1 - a.1) * gone / length);
            stroke.push(corner);
            if index % 2 == 0 {
                strokes.push(std::mem::take(&mut stroke));
            }
            stroke = vec![corner];
            index += 1;
            left = pattern[index % pattern.len()];
        }
        left -= length - gone;
        stroke.push(b);
    }
    if index % 2 == 0 {
        strokes.push(stroke);
    }
    strokes
}

#[cfg(test)]
mod tests {
    use super::*;

    const WINDOW: Area = Area { left: 0.0, top: 0.0, right: 10.0, bottom: 10.0 };

    #[test]
    fn curves_are_split_at_gaps_and_clipped_at_the_window() {
        let nan = (f64::NAN, 1.0);
        assert_eq!(pieces([(1.0, 1.0), nan, nan, (2.0, 2.0), (3.0, 3.0)], &WINDOW).len(), 2);
        assert_eq!(pieces([(-5.0, 5.0), (15.0, 5.0)], &WINDOW), [[(0.0, 5.0), (10.0, 5.0)]]);
        let excursion = pieces([(1.0, 5.0), (2.0, 15.0), (3.0, 5.0)], &WINDOW);
        assert_eq!(excursion, [[(1.0, 5.0), (1.5, 10.0)], [(2.5, 10.0), (3.0, 5.0)]]);
        assert!(pieces([(20.0, 20.0), (30.0, 20.0)], &WINDOW).is_empty());
        assert_eq!(pieces([(5.0, 5.0)], &WINDOW), [[(5.0, 5.0)]]);
    }

    #[test]
    fn million_points_of_a_curve_are_reduced() {
        let noise = (0..1_000_000u32)
            .map(|i| (f64::from(i) * 1e-5, f64::from((i % 1000 * 919) % 1000) * 0.01));
        let pieces = pieces(noise, &WINDOW);
        assert_eq!(pieces.len(), 1);
        assert!(pieces[0].len() <= 4 * 21, "{}", pieces[0].len());
        let top = pieces[0].iter().map(|p| p.1).fold(0.0, f64::max);
        assert_eq!(top, 9.99);
    }

    #[test]
    fn dashes_continue_across_corners() {
        let strokes = dashes(&[(0.0, 0.0), (3.0, 0.0), (3.0, 4.0)], &[2.0, 2.0]);
        assert_eq!(strokes, [vec![(0.0, 0.0), (2.0, 0.0)], vec![(3.0, 1.0), (3.0, 3.0)]]);
        assert_eq!(dashes(&[(0.0, 0.0), (1.0, 0.0)], &[0.0]).len(), 1);
    }
}
