//! Sampling of force functions into piecewise linear tables, whose stored energy can be integrated exactly.

use super::spring_law::SpringLaw;
use crate::geometry::larger;

/// Largest allowed difference between the table and the sampled function in the middle of a segment, as a fraction of the largest force.
const TOLERANCE: f64 = 1e-7;

const SEGMENTS: usize = 32;

const MOST_POINTS: usize = 20_000;

/// Position of the second test point in a segment, as a fraction of the length of the segment [-].
/// One test point is not sufficient, because an oscillating function may agree with the polygon in the middle of a segment by chance.
const SECOND_TEST_POINT: f64 = 0.381_966;

/// Ratio of the allowed difference at the second test point to the allowed difference in the middle of a segment [-].
const OFF_MIDDLE_MARGIN: f64 = 4.0;

type Polygon = Vec<(f64, f64)>;

impl SpringLaw {
    /// Samples a force over a range of elongations.
    /// Points are added until the polygon deviates from the function by at most 1e-7 of its largest value in the middle of each segment
    /// and by at most 4e-7 at a second test point, up to 20 000 points.
    ///
    /// # Errors
    /// Fails if the sampled function fails.
    pub fn sampled<E>(
        (from, to): (f64, f64),
        mut force: impl FnMut(f64) -> Result<f64, E>,
    ) -> Result<Self, E> {
        let place = |part: usize| from + (to - from) * part as f64 / SEGMENTS as f64;
        let mut points = Vec::with_capacity(SEGMENTS + 1);
        for part in 0..=SEGMENTS {
            points.push((place(part), force(place(part))?));
        }
        loop {
            let allowed = TOLERANCE * largest_force(&points);
            let (finer, error) = refined(&points, &mut force, (0.5, allowed))?;
            let is_fine = finer.len() == points.len();
            let (finer, error) = match is_fine {
                true => {
                    let beside = (SECOND_TEST_POINT, OFF_MIDDLE_MARGIN * allowed);
                    let (finer, second_error) = refined(&points, &mut force, beside)?;
                    (finer, larger(error, second_error))
                }
                false => (finer, error),
            };
            if finer.len() == points.len() || finer.len() > MOST_POINTS {
                return Ok(Self::Sampled { points, error });
            }
            points = finer;
        }
    }

    /// Deviation of the polygon from the sampled function and largest force [force]; `None` if the deviation is within the tolerance.
    pub fn sampling_error(&self) -> Option<(f64, f64)> {
        let Self::Sampled { points, error } = self else { return None };
        let largest = largest_force(points);
        (*error > OFF_MIDDLE_MARGIN * TOLERANCE * largest).then_some((*error, largest))
    }
}

fn largest_force(points: &[(f64, f64)]) -> f64 {
    points.iter().map(|(_, force)| force.abs()).fold(0.0, larger)
}

fn refined<E>(
    points: &[(f64, f64)],
    force: &mut impl FnMut(f64) -> Result<f64, E>,
    (part, allowed): (f64, f64),
) -> Result<(Polygon, f64), E> {
    let (mut finer, mut off) = (vec![points[0]], 0.0);
    for pair in points.windows(2) {
        let [(before, one), (after, other)] = [pair[0], pair[1]];
        let within = (1.0 - part) * before + part * after;
        let there = force(within)?;
        let missed = (there - ((1.0 - part) * one + part * other)).abs();
        off = larger(off, missed);
        if missed > allowed && before < within && within < after {
            finer.push((within, there));
        }
        finer.push(pair[1]);
    }
    Ok((finer, off))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn sampled(range: (f64, f64), force: fn(f64) -> f64) -> (SpringLaw, f64, usize) {
        let law = SpringLaw::sampled(range, |q| Ok::<f64, ()>(force(q))).unwrap();
        let SpringLaw::Sampled { points, error } = law.clone() else { panic!("{law:?}") };
        (law, error, points.len())
    }

    #[test]
    fn sampled_smooth_law_keeps_its_stated_error() {
        let (law, error, points) = sampled((-0.5, 0.8), |q| 100.0 * q + 50.0 * q * q * q);
        assert!(error < 1.1e-5 && points < 2000, "{error:e} {points}");
        for step in 0..1000 {
            let q = -0.5 + 1.3 * f64::from(step) / 999.0;
            let missed = (law.force(q) - 100.0 * q - 50.0 * q * q * q).abs();
            assert!(missed < 1.2e-5, "{q}: {missed:e}");
        }
        let (low, high) = (law.energy(-0.2), law.energy(0.7));
        let exact = |q: f64| 50.0 * q * q + 12.5 * q * q * q * q;
        assert!((high - low - exact(0.7) + exact(-0.2)).abs() < 1e-5);
        let mean = law.mean(-0.2, 0.9);
        assert!((mean.force * 0.9 - (high - low)).abs() < 1e-13 * high);
    }

    #[test]
    fn linear_function_needs_no_refinement_and_is_extrapolated() {
        let (law, error, points) = sampled((-1.0, 1.0), |q| 3.0 * q);
        assert!(points == SEGMENTS + 1 && error < 1e-15);
        assert!((law.force(4.0) - 12.0).abs() < 1e-12);
    }

    #[test]
    fn corners_are_refined_and_refinement_stops_at_jumps() {
        let (_, error, points) = sampled((-1.0, 1.0), |q| if q > 0.123 { q - 0.123 } else { 0.0 });
        assert!(error < 4e-7 && points < 100, "{error:e} {points}");
        let (law, error, points) = sampled((-1.0, 1.0), |q| if q > 0.1 { 1.0 } else { 0.0 });
        assert!(error >= 0.4 && points < 200, "{error:e} {points}");
        assert_eq!(law.sampling_error(), Some((error, 1.0)));
    }

    #[test]
    fn oscillation_aliased_with_the_first_segments_is_detected() {
        let swinging = |q: f64| crate::elementary::sin(32.0 * std::f64::consts::PI * q);
        let (law, error, points) = sampled((-1.0, 1.0), swinging);
        assert!(points > 10_000 && error > 1e-7, "{error:e} {points}");
        assert!((law.force(1.0 / 64.0) - 1.0).abs() < 1e-4);
        let smooth = sampled((-1.0, 1.0), |q| q + q * q * q).0;
        assert_eq!(smooth.sampling_error(), None);
    }
}
