//! Estimate of the discretisation error of a run from coarser runs of the same scene (Richardson 1911; order from three levels, Roache 1998).
//!
//! Each refinement level is a run with the mesh or step size `h`. Its error is a function of time.
//! The root mean square of this error over the run is `C h^p`, with a constant `C` and the observed order `p`.
//! The errors of two levels with `h < H` have the correlation coefficient `(h/H)^k`. In the asymptotic range, the errors are proportional, and `k = 0`.
//! Three levels `h₁ < h₂ < h₃` have two differences. Their root mean squares `d₁₂`, `d₂₃` and their correlation determine `C`, `p` and `k`.
//! The run is converged if the order is high enough and the differences are correlated. The error is proportional to the difference of the two finest levels.

use super::trace::Trace;
use crate::elementary::{power, square};
use crate::geometry::Vec2;

/// Largest distance of two runs that is attributed to rounding, as a fraction of the scale of the compared quantity.
const ROUNDING: f64 = 1e-10;

const ORDERS: (f64, f64) = (0.05, 12.0);

/// Smallest observed order of a converging run, as a fraction of the order of the integrator or mesh.
const SHARE_OF_ORDER: f64 = 0.7;

/// Smallest observed order of a converging single value, a result at one time only.
const LEAST_ORDER: f64 = 0.7;

/// Largest amount by which the observed order of a converging single value may exceed its largest expected order.
const EXCESS: f64 = 1.0;

/// Smallest correlation coefficient of the differences of successive refinement levels for which the runs count as converging [-].
const LEAST_CORRELATION: f64 = 0.2;

/// Largest exponent `k` of the correlation `(h/H)^k` of the errors of two levels.
const LARGEST_DECORRELATION: f64 = 8.0;

/// Absolute tolerance of the order `p` and of the exponent `k`.
const ACCURACY: f64 = 1e-3;

/// Order and correlation exponent for the smallest error estimate of runs that have not converged.
const FIRST_ORDER: Convergence = Convergence { order: 1.0, decorrelation: 0.0 };

/// Largest error at which a run may count as converged, as a fraction of the scale of the compared quantity.
const TOO_LARGE: f64 = 0.3;

/// Smallest fraction of the duration of a chaotic run in which the refinement levels must converge. Otherwise, the run counts as too coarse.
const LEAST_CONVERGED_PART: f64 = 1.0 / 3.0;

/// Growth factor of the distance of two runs, after the last time at which they converge under refinement.
/// The motion counts as chaotic if the growth factor exceeds this value.
const GROWTH_OF_CHAOS: f64 = 10.0;

#[derive(Debug, Clone, Copy, PartialEq)]
pub enum ErrorVerdict {
    Exact,
    /// The error is small, the differences of neighbouring levels are correlated, and the observed order is high enough.
    /// For functions of time, the order must be at least 0.7 times the expected order.
    /// For a single value, the order must be at least 0.7, and exceed the largest expected order by at most 1.
    Converged,
    /// The runs do not converge as expected. The error may differ from the estimate by more than a factor of 3.
    PreAsymptotic,
    /// The motion is chaotic: initially close runs separate. Results are meaningful only until the time `until`.
    Chaotic {
        /// Time until which the runs converge [time].
        until: f64,
    },
}

impl ErrorVerdict {
    pub fn describe(self) -> &'static str {
        match self {
            Self::Exact => "exact",
            Self::Converged => "converged",
            Self::PreAsymptotic => "pre-asymptotic",
            Self::Chaotic { .. } => "chaotic",
        }
    }
}

#[derive(Debug, Clone, PartialEq)]
pub struct DiscretisationError {
    /// Times of the run [time] with the error at each time [dimension of the quantity].
    pub over_time: Vec<(f64, f64)>,
    /// Observed order; `None` if it would be at most 0.05, the runs agree to rounding, or the coarsest level is missing.
    pub order: Option<f64>,
    pub verdict: ErrorVerdict,
}

impl DiscretisationError {
    pub fn present(&self) -> f64 {
        self.over_time.last().map_or(0.0, |(_, error)| *error)
    }

    pub fn largest(&self) -> f64 {
        largest(&self.over_time)
    }

    /// Error at a time, interpolated linearly; outside the known times, the nearest known error.
    pub fn at(&self, time: f64) -> f64 {
        let after = self.over_time.partition_point(|(other, _)| *other < time);
        match (after.checked_sub(1).map(|before| self.over_time[before]), self.over_time.get(after))
        {
            (Some((start, before)), Some((end, error))) => {
                before + (error - before) * (time - start) / (end - start)
            }
            (Some((_, error)), None) | (None, Some(&(_, error))) => error,
            (None, None) => 0.0,
        }
    }
}

#[derive(Debug, Clone, Copy)]
pub struct RefinementLevels<'a> {
    pub sizes: [f64; 3],
    pub traces: [Option<&'a Trace>; 3],
    pub level: usize,
    pub order: ExpectedOrder,
    pub scale: f64,
}

/// Order of convergence in the asymptotic range.
#[derive(Debug, Clone, Copy)]
pub enum ExpectedOrder {
    /// Smallest and largest order of the integrator.
    Between(f64, f64),
    /// Order of a mesh for functions of time. It may be exceeded.
    AtLeast(f64),
    /// Largest order of a single value, a result at one time only.
    ///
    /// The difference of two levels can be small by chance. The observed order of a single value is then too high.
    AtMost(f64),
}

/// Order `p` and correlation exponent `k` of the errors of refinement levels.
/// A level with the mesh or step size `h` has the error `C h^p`. The errors of two levels `h < H` have the correlation coefficient `(h/H)^k`.
#[derive(Debug, Clone, Copy)]
struct Convergence {
    /// Observed order `p`.
    order: f64,
    /// Exponent `k`.
    decorrelation: f64,
}

/// Root mean squares and correlation coefficient of the differences of successive refinement levels.
/// The field `near` belongs to the two finest levels, and `far` belongs to the two coarsest levels.
#[derive(Debug, Clone, Copy)]
struct Differences {
    near: f64,
    far: f64,
    correlation: f64,
}

impl Convergence {
    /// Computes the differences of successive levels if the error of the finest level is 1.
    fn differences(self, sizes: [f64; 3]) -> Differences {
        let errors = sizes.map(|size| power(size / sizes[0], self.order));
        let covariance = |a: usize, b: usize| {
            errors[a] * errors[b] * power(sizes[a] / sizes[b], self.decorrelation)
        };
        let square_distance = |a: usize, b: usize| {
            square(errors[a] - errors[b]) + 2.0 * (errors[a] * errors[b] - covariance(a, b))
        };
        let [near, far] = [square_distance(0, 1).sqrt(), square_distance(1, 2).sqrt()];
        let product = covariance(0, 1) - covariance(0, 2) - square(errors[1]) + covariance(1, 2);
        Differences { near, far, correlation: product / (near * far) }
    }
}

impl RefinementLevels<'_> {
    /// Estimated error; `None` if one of the two finest levels is missing or they have no common times.
    pub fn error(&self) -> Option<DiscretisationError> {
        let [fine, middle, coarse] = self.traces;
        let (fine, middle) = (fine?, middle?);
        let near = fine.distances(middle);
        near.last()?;
        let farthest = largest(&near);
        let scaled = |factor: f64, order, verdict| {
            let over_time = near.iter().map(|(time, distance)| (*time, factor * distance));
            Some(DiscretisationError { over_time: over_time.collect(), order, verdict })
        };
        if farthest <= ROUNDING * self.scale {
            return scaled(1.0, None, ErrorVerdict::Exact);
        }
        let far = coarse.map(|coarse| middle.distances(coarse)).unwrap_or_default();
        let differences = coarse.map(|coarse| Differences {
            near: root_mean_square(&near),
            far: root_mean_square(&far),
            correlation: correlation(
                &fine.differences(middle, coarse),
                &middle.differences(coarse, coarse),
            ),
        });
        let found = differences.and_then(|differences| self.convergence(differences));
        let order = found.map(|found| found.order);
        let factor = found.map_or(0.0, |found| self.factor(found));
        let is_small = factor * farthest < TOO_LARGE * self.scale;
        let is_correlated = differences.is_some_and(|of| of.correlation >= LEAST_CORRELATION);
        if order.is_some_and(|order| self.is_converging(order)) && is_small && is_correlated {
            return scaled(factor, order, ErrorVerdict::Converged);
        }
        let verdict = match self.last_convergence(&near, &far) {
            Some(until) => ErrorVerdict::Chaotic { until },
            None => ErrorVerdict::PreAsymptotic,
        };
        scaled(factor.max(self.factor(FIRST_ORDER)), order, verdict)
    }

    /// Ratio of the error of the run to the difference of the two finest levels.
    fn factor(&self, found: Convergence) -> f64 {
        let order = match self.order {
            ExpectedOrder::Between(_, most) | ExpectedOrder::AtMost(most) => found.order.min(most),
            ExpectedOrder::AtLeast(_) => found.order,
        };
        let own = power(self.sizes[self.level] / self.sizes[0], order);
        own / Convergence { order, ..found }.differences(self.sizes).near
    }

    fn is_converging(&self, order: f64) -> bool {
        match self.order {
            ExpectedOrder::Between(least, _) | ExpectedOrder::AtLeast(least) => {
                order >= SHARE_OF_ORDER * least
            }
            ExpectedOrder::AtMost(most) => (LEAST_ORDER..=most + EXCESS).contains(&order),
        }
    }

    /// Order and correlation exponent, computed from the differences of successive levels; `None` if the order would be at most 0.05.
    fn convergence(&self, differences: Differences) -> Option<Convergence> {
        let ratio = differences.far / differences.near;
        let with = |decorrelation: f64| {
            let order = self.observed_order(ratio, decorrelation)?;
            Some(Convergence { order, decorrelation })
        };
        let mut found = with(0.0)?;
        let mut most = LARGEST_DECORRELATION;
        while most - found.decorrelation > ACCURACY {
            let middle = 0.5 * (most + found.decorrelation);
            match with(middle) {
                Some(one) if one.differences(self.sizes).correlation > differences.correlation => {
                    found = one;
                }
                _ => most = middle,
            }
        }
        Some(found)
    }

    /// Order for which the difference of the two coarsest levels is `wanted` times the difference of the two finest levels.
    /// The errors of the levels have the correlation exponent `decorrelation`.
    fn observed_order(&self, wanted: f64, decorrelation: f64) -> Option<f64> {
        let ratio = |order: f64| {
            let of = Convergence { order, decorrelation }.differences(self.sizes);
            of.far / of.near
        };
        if wanted.is_nan() || wanted <= ratio(ORDERS.0) {
            return None;
        }
        let (mut low, mut high) = ORDERS;
        while high - low > ACCURACY {
            let middle = 0.5 * (low + high);
            if ratio(middle) < wanted { low = middle } else { high = middle }
        }
        Some(low)
    }

    /// Last time at which runs with very different final states still converge.
    /// The time is `None` if the runs converge in less than a third of the duration, or if their distance hardly grows afterwards.
    fn last_convergence(&self, near: &[(f64, f64)], far: &[(f64, f64)]) -> Option<f64> {
        let end = near.last()?.0;
        let start = near.first()?.0;
        let window = (end - start) / 20.0;
        let within = |distances: &[(f64, f64)], to: f64| {
            let inside =
                distances.iter().filter(|(time, _)| *time > to - window && *time <= to).copied();
            root_mean_square(&inside.collect::<Vec<_>>())
        };
        let converges = |to: f64| {
            let order = self.observed_order(within(far, to) / within(near, to), 0.0);
            let is_accurate = within(near, to) < TOO_LARGE / GROWTH_OF_CHAOS * self.scale;
            is_accurate && order.is_some_and(|order| self.is_converging(order))
        };
        let times = (1..=20).map(|index| start + index as f64 * window);
        let until = times.take_while(|time| converges(*time)).last()?;
        let is_late = until - start >= LEAST_CONVERGED_PART * (end - start);
        let has_grown = within(near, end) > GROWTH_OF_CHAOS * within(near, until);
        (is_late && has_grown).then_some(until)
    }
}

fn largest(errors: &[(f64, f64)]) -> f64 {
    errors.iter().map(|(_, error)| *error).fold(0.0, f64::max)
}

fn root_mean_square(distances: &[(f64, f64)]) -> f64 {
    let squares = distances.iter().map(|(_, distance)| distance * distance).sum::<f64>();
    (squares / distances.len() as f64).sqrt()
}

fn correlation(near: &[(f64, Vec2)], far: &[(f64, Vec2)]) -> f64 {
    let product = |a: &[(f64, Vec2)], b: &[(f64, Vec2)]| {
        a.iter().zip(b).map(|((_, a), (_, b))| a.dot(b)).sum::<f64>()
    };
    product(near, far) / (product(near, near) * product(far, far)).sqrt()
}

#[cfg(test)]
mod tests {
    use super::*;

    const SIZES: [f64; 3] = [1.0, 2.0, 4.0];

    fn sampled(step: f64, value: impl Fn(f64) -> f64) -> Trace {
        let rows = (256.0 / step) as usize;
        let times: Vec<f64> = (0..=rows).map(|row| 0.25 * row as f64 * step).collect();
        let values: Vec<f64> = times.iter().map(|time| value(*time)).collect();
        Trace::of_values(times, values)
    }

    fn estimate(
        sizes: [f64; 3],
        level: usize,
        value: impl Fn(f64, f64) -> f64,
    ) -> DiscretisationError {
        let traces = sizes.map(|size| sampled(size, |time| value(time, size)));
        let traces = traces.each_ref().map(Some);
        RefinementLevels {
            sizes,
            traces,
            level,
            order: ExpectedOrder::Between(2.0, 2.0),
            scale: 1.0,
        }
        .error()
        .unwrap()
    }

    #[test]
    fn error_of_known_order_is_estimated_on_every_level() {
        for (level, size) in SIZES.into_iter().enumerate() {
            let error = estimate(SIZES, level, |time, h| (0.1 * time).sin() + 1e-6 * time * h * h);
            assert_eq!(error.verdict, ErrorVerdict::Converged);
            assert!((error.order.unwrap() - 2.0).abs() < 0.02, "{error:?}");
            let exact = 64e-6 * size * size;
            assert!((error.largest() / exact - 1.0).abs() < 0.02, "{level} {error:?}");
            assert!((error.present() / exact - 1.0).abs() < 0.02);
        }
        let uneven = estimate([1.0, 2.0, 8.0], 0, |time, h| 1e-6 * time * h * h);
        assert!((uneven.order.unwrap() - 2.0).abs() < 0.02, "{uneven:?}");
    }

    #[test]
    fn equal_runs_are_exact_and_irregular_errors_are_not_converged() {
        let exact = estimate(SIZES, 0, |time, _| time);
        assert_eq!((exact.verdict, exact.order, exact.largest()), (ErrorVerdict::Exact, None, 0.0));
        let lost = estimate(SIZES, 0, |time, h| (0.1 * time * h).sin());
        assert_eq!(lost.verdict, ErrorVerdict::PreAsymptotic);
        let first_order = estimate(SIZES, 0, |time, h| 1e-4 * time * h);
        assert_eq!(first_order.verdict, ErrorVerdict::PreAsymptotic);
    }

    #[test]
    fn single_values_with_too_high_an_order_are_not_converged() {
        let sizes = [1.0, 4.0 / 3.0, 2.0];
        let error = |order: f64| {
            let traces = sizes
                .map(|size| Trace::at_one_time(Vec2::new(1.0 + 1e-4 * power(size, order), 0.0)));
            let traces = traces.each_ref().map(Some);
            let order = ExpectedOrder::AtMost(4.0);
            RefinementLevels { sizes, traces, level: 0, order, scale: 1.0 }.error().unwrap()
        };
        for order in [2.0, 4.0] {
            assert_eq!(error(order).verdict, ErrorVerdict::Converged);
            assert!((error(order).present() / 1e-4 - 1.0).abs() < 0.02);
        }
        assert_eq!(error(8.0).verdict, ErrorVerdict::PreAsymptotic);
        assert!(error(8.0).present() > 3e-4);
    }

    #[test]
    fn errors_between_known_times_are_interpolated() {
        let error = estimate(SIZES, 0, |time, h| 1e-6 * time * h * h);
        assert!((error.at(20.0) / 20e-6 - 1.0).abs() < 0.02, "{}", error.at(20.0));
        assert!((error.at(20.1) / error.at(20.0) - 1.005).abs() < 1e-9);
        assert_eq!(error.at(1e3), error.present());
        assert_eq!(error.at(-1.0), 0.0);
    }

    #[test]
    fn diverging_runs_are_chaotic_after_a_certain_time() {
        let separate = estimate(SIZES, 0, |time, h| {
            let distance = 1e-6 * h * h * (0.4 * time).exp();
            if distance > 0.3 { (time * h).sin() } else { distance }
        });
        let ErrorVerdict::Chaotic { until } = separate.verdict else { panic!("{separate:?}") };
        assert!(until > 10.0 && until < 40.0, "{until}");
    }

    #[test]
    fn partly_correlated_errors_are_not_overestimated() {
        let sizes = [1.0, 4.0 / 3.0, 2.0];
        // The errors have a part that is equal on all levels and a part whose frequency differs from level to level.
        let with_own_part = |share: f64| {
            let levels: [(usize, f64); 3] = [(2, sizes[0]), (3, sizes[1]), (4, sizes[2])];
            let traces = levels.map(|(harmonic, size)| {
                let own = |time: f64| share * (harmonic as f64 * time).sin();
                sampled(1.0, |time| 1e-4 * size * (time.sin() + own(time)))
            });
            let traces = traces.each_ref().map(Some);
            RefinementLevels {
                sizes,
                traces,
                level: 0,
                order: ExpectedOrder::AtLeast(1.0),
                scale: 1.0,
            }
            .error()
            .unwrap()
        };
        for share in [0.0, 0.1, 0.2] {
            let error = with_own_part(share);
            assert_eq!(error.verdict, ErrorVerdict::Converged, "{share}");
            // If the estimate assumed proportional errors (`k = 0`), it would be 3.1 times the true error for the last `share`.
            let ratio = error.largest() / (1e-4 * (1.0 + share));
            assert!((0.9..1.4).contains(&ratio), "{share}: {ratio}");
        }
        assert_eq!(with_own_part(0.3).verdict, ErrorVerdict::PreAsymptotic);
    }

    #[test]
    fn estimate_from_two_levels_is_their_distance() {
        let traces = [1.0, 2.0].map(|size| sampled(size, |time| 1e-6 * time * size * size));
        let traces = [Some(&traces[0]), Some(&traces[1]), None];
        let levels = RefinementLevels {
            sizes: SIZES,
            traces,
            level: 0,
            order: ExpectedOrder::Between(2.0, 2.0),
            scale: 1.0,
        };
        let error = levels.error().unwrap();
        assert_eq!((error.verdict, error.order), (ErrorVerdict::PreAsymptotic, None));
        assert!((error.largest() / (3.0 * 64e-6) - 1.0).abs() < 1e-12);
    }
}
