//! Recorded control points at many times.

/// Largest number of stored values of a trajectory. For more values, every second configuration is discarded.
const MOST_NUMBERS: usize = 32 << 20;

/// Trajectory of a run: control points of all bodies [length] at some times of the run.
#[derive(Debug, Clone)]
pub struct Trajectory {
    stride: usize,
    times: Vec<f64>,
    numbers: Vec<f64>,
    every: usize,
    offered: usize,
}

impl Trajectory {
    /// Creates an empty trajectory for configurations with `stride` values each.
    pub fn new(stride: usize) -> Self {
        Self { stride, times: Vec::new(), numbers: Vec::new(), every: 1, offered: 0 }
    }

    pub(crate) fn reserve(&mut self, configurations: usize) {
        let room = configurations.min(MOST_NUMBERS / self.stride + 1);
        self.times.reserve(room);
        self.numbers.reserve(room * self.stride);
    }

    /// Stores every n-th configuration passed to the trajectory. The number n is doubled at the limit of stored values.
    pub fn push(&mut self, time: f64, numbers: impl Iterator<Item = f64>) {
        if self.offered.is_multiple_of(self.every) {
            self.times.push(time);
            self.numbers.extend(numbers);
        }
        self.offered += 1;
        if self.numbers.len() > MOST_NUMBERS {
            self.thin_out();
        }
    }

    fn thin_out(&mut self) {
        let kept = self.times.len().div_ceil(2);
        for new in 1..kept {
            self.times[new] = self.times[2 * new];
            self.numbers
                .copy_within(2 * new * self.stride..(2 * new + 1) * self.stride, new * self.stride);
        }
        self.times.truncate(kept);
        self.numbers.truncate(kept * self.stride);
        self.every *= 2;
    }

    /// Restores the trajectory to the time when `offered` configurations had been passed to it.
    /// Configurations that were discarded because of the limit of stored values are not restored.
    pub fn truncate(&mut self, offered: usize) {
        self.offered = offered;
        let kept = offered.div_ceil(self.every);
        self.times.truncate(kept);
        self.numbers.truncate(kept * self.stride);
    }

    pub(super) fn stride(&self) -> usize {
        self.stride
    }

    pub(super) fn every(&self) -> usize {
        self.every
    }

    pub(super) fn numbers(&self) -> &[f64] {
        &self.numbers
    }

    pub(super) fn with_configurations(
        &self,
        offered: usize,
        every: usize,
        times: Vec<f64>,
        numbers: Vec<f64>,
    ) -> Option<Self> {
        let fits = every.is_power_of_two()
            && times.len() == offered.div_ceil(every)
            && times.len().checked_mul(self.stride) == Some(numbers.len())
            && times.is_sorted()
            && times.iter().chain(&numbers).all(|number| number.is_finite());
        fits.then_some(Self { stride: self.stride, times, numbers, every, offered })
    }

    /// Times of the stored configurations.
    pub fn times(&self) -> &[f64] {
        &self.times
    }

    /// Coordinates of all control points in the stored configuration with the given index [length].
    pub fn configuration(&self, index: usize) -> &[f64] {
        &self.numbers[index * self.stride..(index + 1) * self.stride]
    }

    /// Index of the stored configuration nearest to a time; `None` if nothing is stored.
    pub fn nearest(&self, time: f64) -> Option<usize> {
        let after = self.times.partition_point(|t| *t < time);
        let candidates = [after.checked_sub(1), (after < self.times.len()).then_some(after)];
        let distance = |index: &usize| (self.times[*index] - time).abs();
        candidates.into_iter().flatten().min_by(|a, b| distance(a).total_cmp(&distance(b)))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn stored_configurations_are_thinned_evenly() {
        let mut trajectory = Trajectory::new(1 << 22);
        for index in 0..40 {
            trajectory.push(f64::from(index), std::iter::repeat_n(f64::from(index), 1 << 22));
        }
        let times = trajectory.times().to_vec();
        assert!(times.len() <= 9 && times[0] == 0.0);
        assert!(times.windows(2).all(|pair| pair[1] - pair[0] == times[1] - times[0]), "{times:?}");
        let nearest = trajectory.nearest(17.0).unwrap();
        assert_eq!(trajectory.configuration(nearest)[0], times[nearest]);
    }

    #[test]
    fn truncated_and_continued_trajectory_is_unchanged() {
        let offer = |trajectory: &mut Trajectory, from: i32| {
            for index in from..21 {
                trajectory.push(f64::from(index), std::iter::repeat_n(f64::from(index), 1 << 22));
            }
        };
        let mut trajectory = Trajectory::new(1 << 22);
        offer(&mut trajectory, 0);
        let straight = trajectory.times().to_vec();
        trajectory.truncate(6);
        assert!(trajectory.times().iter().all(|time| *time < 6.0));
        assert_eq!(trajectory.numbers().len(), trajectory.times().len() << 22);
        offer(&mut trajectory, 6);
        assert_eq!(trajectory.times(), straight);
    }
}
