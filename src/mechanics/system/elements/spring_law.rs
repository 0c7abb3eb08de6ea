//! Force laws as functions of an elongation, with their stored energy.

use serde::{Deserialize, Serialize};

use super::coordinate::Coordinate;
use crate::geometry::larger;

/// Largest force that counts as zero, as a fraction of the largest force of the law.
const ROUNDING: f64 = 1e-12;

/// Smallest change of the stiffness at a corner that counts as sharp, as a fraction of the largest stiffness of the law.
const SHARP_CORNER: f64 = 0.5;

/// Restoring force as a function of an elongation `q`, which is a length or an angle.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub enum SpringLaw {
    /// Linear law `k (q - q₀)`.
    Linear {
        /// Stiffness `k` [force/length, or force·length/rad].
        stiffness: f64,
        /// Natural length or angle `q₀` [length, rad].
        natural: f64,
    },
    /// Polygon through points, extrapolated by the lines of its first and last segments.
    Table {
        /// Increasing elongations `q` [length, rad] with forces [force, force·length]; at least two points.
        points: Vec<(f64, f64)>,
    },
    /// Function that was sampled when the scene was built.
    Sampled {
        /// Increasing elongations with forces, as in a table.
        points: Vec<(f64, f64)>,
        /// Largest difference between the function and the polygon at the test points within the segments [force, force·length].
        error: f64,
    },
}

/// Mean force of a step, defined as the discrete gradient of the stored energy (Gonzalez 1996), with its derivative.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct MeanForce {
    /// Change of the stored energy divided by the elongation change, or the force of the law for zero change [force, force·length].
    pub force: f64,
    /// Derivative of the mean force with respect to the elongation at the end of the step [force/length, force·length/rad].
    pub slope: f64,
}

impl SpringLaw {
    /// Force at an elongation [force, force·length].
    pub fn force(&self, q: impl Into<Coordinate>) -> f64 {
        let q = q.into();
        match self {
            Self::Linear { stiffness, natural } => stiffness * (q.value - natural),
            Self::Table { points } | Self::Sampled { points, .. } => {
                // The interpolation starts at the end of the segment with the smaller force, which has the smaller rounding error.
                let [first, second] = segment(points, q);
                let (at, force) = if first.1.abs() <= second.1.abs() { first } else { second };
                force + self.slope(q) * q.difference(at)
            }
        }
    }

    /// Stiffness at an elongation [force/length, force·length/rad].
    /// At a corner of the law, the stiffness of the segment above the corner is returned.
    pub fn slope(&self, q: impl Into<Coordinate>) -> f64 {
        match self {
            Self::Linear { stiffness, .. } => *stiffness,
            Self::Table { points } | Self::Sampled { points, .. } => {
                let [(q0, f0), (q1, f1)] = segment(points, q.into());
                (f1 - f0) / (q1 - q0)
            }
        }
    }

    /// Largest absolute stiffness [force/length, force·length/rad].
    pub(crate) fn largest_slope(&self) -> f64 {
        match self {
            Self::Linear { stiffness, .. } => stiffness.abs(),
            Self::Table { points } | Self::Sampled { points, .. } => {
                points.windows(2).map(|pair| slope([pair[0], pair[1]]).abs()).fold(0.0, larger)
            }
        }
    }

    /// Returns true for a table or a sampled function whose force never decreases.
    pub(crate) fn rises_with_corners(&self) -> bool {
        match self {
            Self::Linear { .. } => false,
            Self::Table { points } | Self::Sampled { points, .. } => {
                points.windows(2).all(|pair| pair[0].1 <= pair[1].1)
            }
        }
    }

    /// Range of elongations in which the law is given. Outside the range, the law is extrapolated linearly.
    /// If the force is constant at an end of the table, the limit at this end is infinite.
    /// The range is `None` for laws that hold everywhere: linear laws, linear laws with zero force on one side, and tables that are constant at both ends.
    pub fn range(&self) -> Option<[f64; 2]> {
        match self {
            Self::Linear { .. } => None,
            Self::Sampled { points, .. } => Some([points[0].0, points[points.len() - 1].0]),
            Self::Table { points } => {
                let last = points.len() - 1;
                let levels = [points[0].1 == points[1].1, points[last - 1].1 == points[last].1];
                if points.len() == 2 || (points.len() == 3 && self.may_be_slack()) {
                    return None;
                }
                let [from, to] = [points[0].0, points[last].0];
                match levels {
                    [true, true] => None,
                    [true, false] => Some([f64::NEG_INFINITY, to]),
                    [false, true] => Some([from, f64::INFINITY]),
                    [false, false] => Some([from, to]),
                }
            }
        }
    }

    /// Elongations at which the stiffness jumps by more than half of the largest stiffness [length, rad].
    pub(crate) fn sharp_corners(&self) -> Vec<f64> {
        match self {
            Self::Linear { .. } => Vec::new(),
            Self::Table { points } | Self::Sampled { points, .. } => {
                let sharp = SHARP_CORNER * self.largest_slope();
                let at = |three: &[(f64, f64)]| {
                    let slopes = [[three[0], three[1]], [three[1], three[2]]].map(slope);
                    let jumps = (slopes[1] - slopes[0]).abs() > sharp;
                    jumps.then_some(three[1].0)
                };
                points.windows(3).filter_map(at).collect()
            }
        }
    }

    pub(crate) fn may_be_slack(&self) -> bool {
        match self {
            Self::Linear { .. } => false,
            Self::Table { points } | Self::Sampled { points, .. } => {
                points.windows(2).any(|pair| pair[0].1 == 0.0 && pair[1].1 == 0.0)
            }
        }
    }

    /// Returns true if the force is zero at an elongation, within rounding and sampling errors.
    pub(crate) fn is_unloaded_at(&self, q: f64) -> bool {
        let off = match self {
            Self::Linear { stiffness, natural } => ROUNDING * (stiffness * natural).abs(),
            Self::Table { points } => ROUNDING * largest(points),
            Self::Sampled { points, error } => larger(*error, ROUNDING * largest(points)),
        };
        self.force(q).abs() <= off
    }

    /// Stored energy at an elongation [energy].
    /// It is zero at the elongation where the force changes from negative to positive, or else at the first point of the table.
    pub fn energy(&self, q: impl Into<Coordinate>) -> f64 {
        let q = q.into();
        match self {
            Self::Linear { stiffness, natural } => {
                0.5 * stiffness * (q.value - natural) * (q.value - natural)
            }
            Self::Table { points } | Self::Sampled { points, .. } => {
                self.work(points, natural_elongation(points).into(), q)
            }
        }
    }

    /// Work between two elongations of a table, summed by segments to avoid differences of large numbers.
    fn work(&self, points: &[(f64, f64)], from: Coordinate, to: Coordinate) -> f64 {
        let rises = to.difference_from(from) >= 0.0;
        let (low, high) = if rises { (from, to) } else { (to, from) };
        let [first, last] = [
            points.partition_point(|(q, _)| low.difference(*q) >= 0.0),
            points.partition_point(|(q, _)| high.difference(*q) > 0.0),
        ];
        let corners = points[first..last.max(first)].iter().map(|(q, _)| Coordinate::from(*q));
        let (mut at, mut force, mut sum) = (low, self.force(low), 0.0);
        for next in corners.chain([high]) {
            let next_force = self.force(next);
            sum += 0.5 * (force + next_force) * next.difference_from(at);
            (at, force) = (next, next_force);
        }
        if rises { sum } else { -sum }
    }

    /// Mean force between the elongations `q` and `q + change`.
    pub fn mean(&self, q: impl Into<Coordinate>, change: f64) -> MeanForce {
        let q = q.into();
        let end = q.after(change);
        match self {
            Self::Linear { stiffness, natural } => MeanForce {
                force: stiffness * ((q.value - natural) + 0.5 * change),
                slope: 0.5 * stiffness,
            },
            Self::Table { points } | Self::Sampled { points, .. }
                if segment(points, q) != segment(points, end) && change != 0.0 =>
            {
                let force = self.work(points, q, end) / change;
                MeanForce { force, slope: (self.force(end) - force) / change }
            }
            Self::Table { .. } | Self::Sampled { .. } => {
                let slope = self.slope(end);
                MeanForce { force: self.force(q) + 0.5 * slope * change, slope: 0.5 * slope }
            }
        }
    }

    /// Returns the law with a corner at each zero of its force, so that small forces near the zeros are accurate.
    pub(crate) fn with_corners_at_zeros(mut self) -> Self {
        if let Self::Table { points } | Self::Sampled { points, .. } = &mut self {
            let crossing = |pair: &[(f64, f64)]| {
                let at = zero(pair[0], pair[1]);
                let is_inside = pair[0].1 * pair[1].1 < 0.0 && pair[0].0 < at && at < pair[1].0;
                is_inside.then_some((at, 0.0))
            };
            let corners: Vec<_> = points.windows(2).filter_map(crossing).collect();
            points.extend(corners);
            points.sort_by(|a, b| a.0.total_cmp(&b.0));
        }
        self
    }

    /// Returns the law with its elongations shifted by `by`.
    pub fn shifted(&self, by: f64) -> Self {
        match self {
            Self::Linear { stiffness, natural } => {
                Self::Linear { stiffness: *stiffness, natural: natural + by }
            }
            Self::Table { points } => Self::Table { points: shifted(points, by) },
            Self::Sampled { points, error } => {
                Self::Sampled { points: shifted(points, by), error: *error }
            }
        }
    }

    /// Description of the law for messages, such as `a table of 5 points`.
    pub fn describe(&self) -> String {
        match self {
            Self::Linear { stiffness, natural } => {
                format!("stiffness {stiffness}, natural length {natural}")
            }
            Self::Table { points } => format!("a table of {} points", points.len()),
            Self::Sampled { points, error } => {
                let (count, first, last) = (points.len(), points[0].0, points[points.len() - 1].0);
                format!(
                    "a function sampled at {count} points from {first} to {last}, interpolation error {error:.1e}, linear beyond"
                )
            }
        }
    }
}

fn largest(points: &[(f64, f64)]) -> f64 {
    points.iter().map(|(_, force)| force.abs()).fold(0.0, larger)
}

/// Slope of a segment of the law [force/length, force·length/rad]; zero for a segment of zero length.
fn slope([a, b]: [(f64, f64); 2]) -> f64 {
    if b.0 > a.0 { (b.1 - a.1) / (b.0 - a.0) } else { 0.0 }
}

fn shifted(points: &[(f64, f64)], by: f64) -> Vec<(f64, f64)> {
    points.iter().map(|(q, force)| (q + by, *force)).collect()
}

fn segment(points: &[(f64, f64)], q: Coordinate) -> [(f64, f64); 2] {
    let beyond = points.partition_point(|(at, _)| q.difference(*at) >= 0.0);
    let beyond = beyond.clamp(1, points.len() - 1);
    [points[beyond - 1], points[beyond]]
}

fn zero((q0, f0): (f64, f64), (q1, f1): (f64, f64)) -> f64 {
    match (f1 == f0, f1 == 0.0) {
        (true, _) => q0,
        (false, true) => q1,
        (false, false) => q0 - f0 * (q1 - q0) / (f1 - f0),
    }
}

/// Elongation of least energy, at which the force of a table or its extrapolation changes from negative to positive.
/// If the force of a law does not change from negative to positive, the function returns the abscissa of the first point.
fn natural_elongation(points: &[(f64, f64)]) -> f64 {
    let passes = |pair: &&[(f64, f64)]| pair[0].1 <= 0.0 && pair[1].1 >= 0.0;
    let last = points.len() - 1;
    match points.windows(2).find(passes) {
        Some(pair) => zero(pair[0], pair[1]),
        None if points[0].1 > 0.0 && points[1].1 > points[0].1 => zero(points[0], points[1]),
        None if points[last].1 < 0.0 && points[last].1 > points[last - 1].1 => {
            zero(points[last - 1], points[last])
        }
        None => points[0].0,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn laws() -> [SpringLaw; 2] {
        let points = vec![(-1.0, -3.0), (0.0, 0.0), (0.5, 0.0), (2.0, 6.0)];
        [SpringLaw::Linear { stiffness: 40.0, natural: 0.3 }, SpringLaw::Table { points }]
    }

    #[test]
    fn work_of_the_mean_spring_force_equals_the_energy_change() {
        for law in laws() {
            for (q, change) in [(-2.0, 5.0), (0.1, 0.2), (0.4, 0.3), (1.9, -2.5), (0.5, 1e-9)] {
                let mean = law.mean(q, change);
                let (work, gained) = (mean.force * change, law.energy(q + change) - law.energy(q));
                assert!((work - gained).abs() < 1e-13 * (1.0 + law.energy(q).abs()), "{law:?} {q}");
            }
        }
    }

    #[test]
    fn spring_forces_and_slopes_are_derivatives() {
        for law in laws() {
            for (q, change) in [(-1.7, 0.4), (0.2, 0.5), (1.0, -0.8), (0.1, 1e-3)] {
                let h = 1e-6;
                let by_energy = (law.energy(q + h) - law.energy(q - h)) / (2.0 * h);
                assert!((by_energy - law.force(q)).abs() < 1e-7);
                let [more, less] = [change + h, change - h].map(|change| law.mean(q, change).force);
                let slope = law.mean(q, change).slope;
                assert!(((more - less) / (2.0 * h) - slope).abs() < 1e-6, "{law:?} {q} {change}");
            }
        }
    }

    #[test]
    fn spring_energy_is_zero_at_its_minimum() {
        let push = vec![(0.0, -1e5), (1.0, 0.0), (2.0, 0.0)];
        let pull = vec![(0.0, 0.0), (1.0, 0.0), (2.0, 3.0)];
        let tensioned = vec![(1.0, 2.0), (2.0, 4.0)];
        let pressed = vec![(1.0, -4.0), (2.0, -2.0)];
        for (points, ease) in [(push, 1.5), (pull, 0.5), (tensioned, 0.0), (pressed, 3.0)] {
            let law = SpringLaw::Table { points };
            assert_eq!(law.energy(ease), 0.0, "{law:?}");
            assert!([-1.0, 0.5, 1.5, 4.0].iter().all(|q| law.energy(*q) >= 0.0), "{law:?}");
        }
        let constant = SpringLaw::Table { points: vec![(1.0, 2.0), (2.0, 2.0)] };
        assert_eq!([constant.energy(1.0), constant.energy(0.0)], [0.0, -2.0]);
    }

    #[test]
    fn spring_is_unloaded_if_its_force_is_rounding() {
        let line = |q: f64| (q, 16.1 * q);
        let points = vec![line(-2.0), line(-0.7), line(1.9)];
        let error = 0.0;
        for law in
            [SpringLaw::Table { points: points.clone() }, SpringLaw::Sampled { points, error }]
        {
            assert!(law.is_unloaded_at(0.0) && !law.is_unloaded_at(1e-9), "{law:?}");
        }
        let linear = SpringLaw::Linear { stiffness: 3.0, natural: 0.1 };
        assert!(linear.is_unloaded_at(0.3 - 0.2) && !linear.is_unloaded_at(0.0));
    }

    #[test]
    fn sharp_corners_are_only_at_stiffness_jumps() {
        let [line, table] = laws();
        assert!(line.sharp_corners().is_empty());
        assert_eq!(table.sharp_corners(), [0.0, 0.5]);
        let hardening = |q: f64| Ok::<f64, ()>(q + q * q * q);
        assert!(SpringLaw::sampled((-1.0, 1.0), hardening).unwrap().sharp_corners().is_empty());
        let cubic = |q: f64| Ok::<f64, ()>(q * q * q);
        let waves = |q: f64| Ok::<f64, ()>((3.0 * q) - q * q * q);
        assert!(SpringLaw::sampled((-1.0, 1.0), cubic).unwrap().sharp_corners().is_empty());
        assert!(SpringLaw::sampled((-2.0, 2.0), waves).unwrap().sharp_corners().is_empty());
    }

    #[test]
    fn spring_table_is_extrapolated_linearly() {
        let [_, table] = laws();
        assert_eq!([table.force(-2.0), table.force(3.0), table.force(0.25)], [-6.0, 10.0, 0.0]);
        assert_eq!([table.slope(-2.0), table.slope(3.0), table.slope(0.25)], [3.0, 4.0, 0.0]);
    }
}
