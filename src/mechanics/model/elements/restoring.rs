//! Laws of restoring forces: a force over an elongation, with the energy that it stores.

use serde::{Deserialize, Serialize};

use crate::geometry::larger;

/// A restoring force over an elongation `q`, a length or an angle.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub enum RestoringLaw {
    /// `k (q - q₀)`
    Linear {
        /// `k` [force/length, or force·length/rad].
        stiffness: f64,
        /// `q₀`, where it is at ease [length, rad].
        natural: f64,
    },
    /// A polygon through points, and beyond the first and the last one as in the segment beside them.
    Table {
        /// Elongations `q` [length, rad], rising, each with the force there [force, force·length]; at least two.
        points: Vec<(f64, f64)>,
    },
    /// A function that was asked when the scene was described, and is a table from then on.
    Sampled {
        /// As those of a table.
        points: Vec<(f64, f64)>,
        /// How far the function is from the polygon in the middle of its segments at most [force, force·length].
        error: f64,
    },
}

/// The mean force of a step: the discrete gradient of the stored energy (Gonzalez 1996), with its derivative.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct MeanForce {
    /// The mean force `G = ΔU/Δq` of a step, or `U'` where nothing changes [force, force·length].
    pub force: f64,
    /// The derivative `∂G/∂q₁` of that force by the coordinate at the end of the step [force/length, force·length/rad].
    pub slope: f64,
}

impl RestoringLaw {
    /// The force `U'(q)` [force, force·length].
    pub fn force(&self, q: f64) -> f64 {
        match self {
            Self::Linear { stiffness, natural } => stiffness * (q - natural),
            Self::Table { points } | Self::Sampled { points, .. } => {
                let [(q0, f0), _] = segment(points, q);
                f0 + self.slope(q) * (q - q0)
            }
        }
    }

    /// The stiffness `U''(q)`; at a corner of a table that of the segment beyond it [force/length, force·length/rad].
    pub fn slope(&self, q: f64) -> f64 {
        match self {
            Self::Linear { stiffness, .. } => *stiffness,
            Self::Table { points } | Self::Sampled { points, .. } => {
                let [(q0, f0), (q1, f1)] = segment(points, q);
                (f1 - f0) / (q1 - q0)
            }
        }
    }

    /// The largest stiffness of the law, whatever its sign [force/length, force·length/rad].
    pub fn largest_slope(&self) -> f64 {
        match self {
            Self::Linear { stiffness, .. } => stiffness.abs(),
            Self::Table { points } | Self::Sampled { points, .. } => points
                .windows(2)
                .map(|pair| ((pair[1].1 - pair[0].1) / (pair[1].0 - pair[0].0)).abs())
                .fold(0.0, larger),
        }
    }

    /// Whether the force is none in a whole segment: slack, or not in touch.
    pub fn may_be_slack(&self) -> bool {
        match self {
            Self::Linear { .. } => false,
            Self::Table { points } | Self::Sampled { points, .. } => {
                points.windows(2).any(|pair| pair[0].1 == 0.0 && pair[1].1 == 0.0)
            }
        }
    }

    /// Whether there is no force at an elongation, as far as what was sampled can tell.
    pub fn is_at_ease(&self, q: f64) -> bool {
        let off = match self {
            Self::Linear { .. } | Self::Table { .. } => 0.0,
            Self::Sampled { error, .. } => *error,
        };
        self.force(q).abs() <= off
    }

    /// The stored energy `U(q)`, zero at ease; where a table has no such place, at its first point [energy].
    pub fn energy(&self, q: f64) -> f64 {
        match self {
            Self::Linear { stiffness, natural } => 0.5 * stiffness * (q - natural) * (q - natural),
            Self::Table { points } | Self::Sampled { points, .. } => {
                self.work(points, ease(points), q)
            }
        }
    }

    /// The work `∫ F dq` from one elongation of a table to another, corner by corner: no difference of large numbers.
    fn work(&self, points: &[(f64, f64)], from: f64, to: f64) -> f64 {
        let (low, high) = (from.min(to), from.max(to));
        let [first, last] = [
            points.partition_point(|(q, _)| *q <= low),
            points.partition_point(|(q, _)| *q < high),
        ];
        let corners = points[first..last.max(first)].iter().map(|(q, _)| *q);
        let (mut at, mut force, mut sum) = (low, self.force(low), 0.0);
        for next in corners.chain([high]) {
            let next_force = self.force(next);
            sum += 0.5 * (force + next_force) * (next - at);
            (at, force) = (next, next_force);
        }
        if from <= to { sum } else { -sum }
    }

    /// The mean force between two elongations, the second of which is the first and a change.
    pub fn mean(&self, q: f64, change: f64) -> MeanForce {
        let end = q + change;
        match self {
            Self::Linear { stiffness, natural } => MeanForce {
                force: stiffness * ((q - natural) + 0.5 * change),
                slope: 0.5 * stiffness,
            },
            Self::Table { points } | Self::Sampled { points, .. }
                if segment(points, q) != segment(points, end) && q != end =>
            {
                let force = self.work(points, q, end) / (end - q);
                MeanForce { force, slope: (self.force(end) - force) / (end - q) }
            }
            Self::Table { .. } | Self::Sampled { .. } => {
                let slope = self.slope(end);
                MeanForce { force: self.force(q) + 0.5 * slope * change, slope: 0.5 * slope }
            }
        }
    }

    /// The same law with its elongations counted from another origin, which is this far below.
    pub fn shifted(&self, by: f64) -> Self {
        match self {
            Self::Linear { stiffness, natural } => {
                Self::Linear { stiffness: *stiffness, natural: natural + by }
            }
            Self::Table { points } => Self::Table { points: moved(points, by) },
            Self::Sampled { points, error } => {
                Self::Sampled { points: moved(points, by), error: *error }
            }
        }
    }

    /// The law in words.
    pub fn describe(&self) -> String {
        match self {
            Self::Linear { stiffness, natural } => {
                format!("stiffness {stiffness}, at ease at {natural}")
            }
            Self::Table { points } => format!("a table of {} points", points.len()),
            Self::Sampled { points, error } => {
                let (count, first, last) = (points.len(), points[0].0, points[points.len() - 1].0);
                format!(
                    "a function asked at {count} points from {first} to {last}, off by {error:.1e} between them and straight beyond"
                )
            }
        }
    }
}

fn moved(points: &[(f64, f64)], by: f64) -> Vec<(f64, f64)> {
    points.iter().map(|(q, force)| (q + by, *force)).collect()
}

/// The ends of the segment of a table that an elongation lies on, or is nearest to; at a corner the one beyond it.
fn segment(points: &[(f64, f64)], q: f64) -> [(f64, f64); 2] {
    let beyond = points.partition_point(|(at, _)| *at <= q).clamp(1, points.len() - 1);
    [points[beyond - 1], points[beyond]]
}

/// Where the force of a table passes from below to above zero, or beyond its ends would: the least energy. The first point if it does not.
fn ease(points: &[(f64, f64)]) -> f64 {
    let zero = |(q0, f0): (f64, f64), (q1, f1): (f64, f64)| match f1 == f0 {
        true => q0,
        false => q0 - f0 * (q1 - q0) / (f1 - f0),
    };
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

    fn laws() -> [RestoringLaw; 2] {
        let points = vec![(-1.0, -3.0), (0.0, 0.0), (0.5, 0.0), (2.0, 6.0)];
        [RestoringLaw::Linear { stiffness: 40.0, natural: 0.3 }, RestoringLaw::Table { points }]
    }

    #[test]
    fn the_mean_force_does_the_work_by_which_the_energy_changes() {
        for law in laws() {
            for (q, change) in [(-2.0, 5.0), (0.1, 0.2), (0.4, 0.3), (1.9, -2.5), (0.5, 1e-9)] {
                let mean = law.mean(q, change);
                let (work, gained) = (mean.force * change, law.energy(q + change) - law.energy(q));
                assert!((work - gained).abs() < 1e-13 * (1.0 + law.energy(q).abs()), "{law:?} {q}");
            }
        }
    }

    #[test]
    fn forces_are_slopes_of_the_energy_and_slopes_those_of_the_mean_force() {
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
    fn nothing_is_stored_at_ease_and_never_less() {
        let push = vec![(0.0, -1e5), (1.0, 0.0), (2.0, 0.0)];
        let pull = vec![(0.0, 0.0), (1.0, 0.0), (2.0, 3.0)];
        let tensioned = vec![(1.0, 2.0), (2.0, 4.0)];
        let pressed = vec![(1.0, -4.0), (2.0, -2.0)];
        for (points, ease) in [(push, 1.5), (pull, 0.5), (tensioned, 0.0), (pressed, 3.0)] {
            let law = RestoringLaw::Table { points };
            assert_eq!(law.energy(ease), 0.0, "{law:?}");
            assert!([-1.0, 0.5, 1.5, 4.0].iter().all(|q| law.energy(*q) >= 0.0), "{law:?}");
        }
        let constant = RestoringLaw::Table { points: vec![(1.0, 2.0), (2.0, 2.0)] };
        assert_eq!([constant.energy(1.0), constant.energy(0.0)], [0.0, -2.0]);
    }

    #[test]
    fn a_table_goes_on_beyond_its_ends() {
        let [_, table] = laws();
        assert_eq!([table.force(-2.0), table.force(3.0), table.force(0.25)], [-6.0, 10.0, 0.0]);
        assert_eq!([table.slope(-2.0), table.slope(3.0), table.slope(0.25)], [3.0, 4.0, 0.0]);
    }
}
