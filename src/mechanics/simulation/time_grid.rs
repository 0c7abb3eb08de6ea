//! Times at which steps end.

use crate::loads::{SampleClock, multiple};

/// Largest difference of two times that count as equal, as a fraction of the step size.
const SAME: f64 = 1e-9;

/// Largest difference of two times that count as equal, as a multiple of their rounding error.
const ROUNDINGS: f64 = 4.0;

const MOST_POINTS: u64 = 1 << 60;

/// Times at which steps end: `t_n = t_0 + n dt`, and additional times called cuts.
/// Cuts are the jumps of schedules and of their derivatives, release times, and times that the caller requests.
/// Steps also end at the times at which digital controllers sample and act.
/// With variable steps, the grid consists of cuts only.
#[derive(Debug, Clone, Default)]
pub struct TimeGrid {
    start: f64,
    dt: f64,
    slack: f64,
    cuts: Vec<f64>,
    clocks: Vec<SampleClock>,
    passed: u64,
}

impl TimeGrid {
    /// Creates a grid that starts at `start` with steps of `dt` [time]. The list `cuts` of additional times may be unsorted.
    pub fn new(start: f64, dt: f64, cuts: Vec<f64>) -> Self {
        let slack = SAME * dt;
        Self { start, dt, slack, cuts: Vec::new(), clocks: Vec::new(), passed: 0 }.with_cuts(cuts)
    }

    /// Creates a grid without regular times, for variable steps: steps must end only at the `cuts`.
    /// `first` is the size of the first step [time].
    pub(crate) fn of_cuts(start: f64, first: f64, cuts: Vec<f64>) -> Self {
        Self { dt: f64::INFINITY, ..Self::new(start, first, cuts) }
    }

    pub(crate) fn with_beats(self, beats: impl Iterator<Item = SampleClock>) -> Self {
        Self { clocks: beats.collect(), ..self }
    }

    fn with_cuts(self, mut cuts: Vec<f64>) -> Self {
        cuts.retain(|cut| cut.is_finite() && *cut > self.start);
        cuts.sort_by(f64::total_cmp);
        cuts.dedup_by(|later, earlier| self.has_reached(*earlier, *later));
        Self { cuts, passed: 0, ..self }
    }

    /// Additional end times of steps, in increasing order [time].
    pub fn cuts(&self) -> &[f64] {
        &self.cuts
    }

    /// Spacing of the regular grid times [time]; infinite if the grid has only cuts.
    pub fn dt(&self) -> f64 {
        self.dt
    }

    /// Largest difference between two times that count as equal near the given time [time].
    pub fn slack(&self, time: f64) -> f64 {
        self.slack.max(ROUNDINGS * f64::EPSILON * time.abs())
    }

    /// Returns true if a time is before or equal to `now`, within the tolerance of the grid.
    pub fn has_reached(&self, now: f64, time: f64) -> bool {
        now >= time - self.slack(now)
    }

    fn point(&self, n: u64) -> f64 {
        if self.dt == f64::INFINITY || n > MOST_POINTS {
            return f64::INFINITY;
        }
        self.start + multiple(self.dt, n)
    }

    /// Adds a cut, unless the grid already has a cut at this time.
    pub fn cut_at(&mut self, time: f64) {
        let same = self.slack(time);
        if self.cuts.iter().all(|cut| (cut - time).abs() > same) {
            self.cuts.insert(self.cuts.partition_point(|cut| *cut < time), time);
        }
    }

    /// End of the step that starts at `now` [time]: the next grid time or cut, at most `limit`.
    pub fn next(&self, now: f64, limit: f64) -> f64 {
        self.next_after(self.points_up_to(now, self.passed), now, limit)
    }

    /// End of the step that started at the time `start`, without a limit [time].
    pub(crate) fn end_of_step(&self, start: f64) -> f64 {
        self.next_after(self.points_up_to(start, 0), start, f64::INFINITY)
    }

    fn next_after(&self, passed: u64, now: f64, limit: f64) -> f64 {
        let grid = self.point(passed + 1);
        let cut = self.cuts[self.cuts.partition_point(|cut| self.has_reached(now, *cut))..].first();
        let slack = self.slack(now);
        let beat = self.clocks.iter().map(|beat| beat.next(now, slack)).min_by(f64::total_cmp);
        // If a cut and a grid time are equal within `slack`, the step ends exactly at the cut.
        // The cut may be the jump of a schedule, and the schedule must be evaluated exactly at the time of its jump.
        [Some(limit), beat, cut.copied()].into_iter().flatten().fold(grid, |end, candidate| {
            if candidate > now && self.has_reached(end, candidate) { candidate } else { end }
        })
    }

    /// Number of grid times that have passed.
    pub fn passed(&self) -> u64 {
        self.passed
    }

    /// Restores the number of passed grid times. Cuts do not change.
    pub fn restore(&mut self, passed: u64) {
        self.passed = passed;
    }

    /// Replaces the cuts. Cuts up to `now` are already passed.
    pub fn lay(&mut self, cuts: &[f64], now: f64) {
        *self = std::mem::take(self).with_cuts(cuts.to_vec());
        self.passed = 0;
        self.mark_reached(now);
    }

    pub(crate) fn mark_reached(&mut self, now: f64) {
        self.passed = self.points_up_to(now, self.passed);
    }

    fn points_up_to(&self, now: f64, least: u64) -> u64 {
        // The search for the number of grid times starts slightly below the result.
        let near = (((now - self.start) / self.dt) as u64).saturating_sub(2).min(MOST_POINTS);
        let mut passed = least.max(near);
        while passed < MOST_POINTS && self.has_reached(now, self.point(passed + 1)) {
            passed += 1;
        }
        passed
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn times(dt: f64, cuts: Vec<f64>, end: f64) -> Vec<f64> {
        let mut grid = TimeGrid::new(0.0, dt, cuts);
        let (mut now, mut times) = (0.0, Vec::new());
        while now < end - 1e-9 * dt {
            now = grid.next(now, end);
            grid.mark_reached(now);
            times.push(now);
        }
        times
    }

    #[test]
    fn distant_grid_time_is_reached_in_one_call() {
        let mut grid = TimeGrid::new(0.0, 0.1, vec![]);
        grid.mark_reached(1e10);
        assert_eq!(grid.passed(), 100_000_000_000);
        assert_eq!(grid.next(1e10, 2e10), 10_000_000_000.1);
        assert_eq!(grid.next(1e300, 2e300), 2e300);
    }

    #[test]
    fn grid_times_do_not_accumulate_rounding() {
        assert_eq!(times(0.05, vec![], 25.0).len(), 500);
        assert_eq!(times(0.1, vec![2.5], 7.5)[24], 2.5);
        assert_eq!(times(0.1, vec![], 1.0)[5], 0.6);
    }

    #[test]
    fn restored_grid_has_the_same_points_and_cuts() {
        let mut grid = TimeGrid::new(0.0, 1.0, vec![]);
        grid.mark_reached(3.0);
        grid.cut_at(2.5);
        grid.restore(1);
        assert_eq!((grid.next(1.0, 9.0), grid.next(2.0, 9.0)), (2.0, 2.5));
        assert_eq!(grid.cuts(), [2.5]);
        let mut again = TimeGrid::new(0.0, 1.0, vec![]);
        again.lay(&[f64::NAN, 2.5, -1.0], 1e6);
        assert_eq!((again.cuts(), again.passed()), (grid.cuts(), 1_000_000));
    }

    #[test]
    fn grid_of_cuts_ends_steps_only_at_cuts_and_limits() {
        let mut grid = TimeGrid::of_cuts(0.0, 1e-6, vec![3.0, 1.0]);
        assert_eq!(
            (grid.next(0.0, 9.0), grid.next(1.0, 2.0), grid.next(3.0, 9.0)),
            (1.0, 2.0, 9.0)
        );
        assert_eq!(grid.next(3.0, f64::INFINITY), f64::INFINITY);
        grid.mark_reached(2.0);
        grid.lay(&[4.0], 3.0);
        assert_eq!((grid.next(3.0, 9.0), grid.passed()), (4.0, 0));
    }

    #[test]
    fn grid_is_cut_at_sample_and_command_times() {
        let beats = [SampleClock::new(0.5, 0.25).unwrap(), SampleClock::new(2.0, 0.0).unwrap()];
        let grid = TimeGrid::new(0.0, 1.0, vec![]).with_beats(beats.into_iter());
        let (mut now, mut times) = (0.0, Vec::new());
        while now < 2.0 {
            now = grid.next(now, 9.0);
            times.push(now);
        }
        assert_eq!(times, [0.25, 0.5, 0.75, 1.0, 1.25, 1.5, 1.75, 2.0]);
        let cuts = TimeGrid::of_cuts(0.0, 1e-6, vec![0.3]).with_beats(beats.into_iter().skip(1));
        assert_eq!((cuts.next(0.0, 9.0), cuts.next(0.3, 9.0)), (0.3, 2.0));
    }

    #[test]
    fn cuts_at_jumps_do_not_shift_the_grid() {
        assert_eq!(times(1.0, vec![2.5], 4.0), [1.0, 2.0, 2.5, 3.0, 4.0]);
        assert_eq!(times(0.3, vec![0.6], 0.9).len(), 3);
        assert_eq!(times(1.0, vec![], 2.5), [1.0, 2.0, 2.5]);
        assert_eq!(times(0.1, vec![0.3], 3.0 * 0.1).last(), Some(&0.3));
    }
}
