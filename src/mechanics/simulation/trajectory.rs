//! Control points over time.

/// Room for configurations; beyond it every second one is forgotten.
const MOST_NUMBERS: usize = 32 << 20;

/// The trajectory of a run: the control points of all bodies, one after another [length], at some of its times.
#[derive(Debug, Clone)]
pub struct Trajectory {
    stride: usize,
    times: Vec<f64>,
    numbers: Vec<f64>,
    /// Only every so many-th configuration that is offered is kept.
    every: usize,
    offered: usize,
}

impl Trajectory {
    /// An empty trajectory of configurations of `stride` numbers.
    pub fn new(stride: usize) -> Self {
        Self { stride, times: Vec::new(), numbers: Vec::new(), every: 1, offered: 0 }
    }

    /// Makes room in the trajectory for configurations to come, as many as may be kept.
    pub fn reserve(&mut self, configurations: usize) {
        let room = configurations.min(MOST_NUMBERS / self.stride + 1);
        self.times.reserve(room);
        self.numbers.reserve(room * self.stride);
    }

    /// Offers a configuration at a time to the trajectory, which keeps it unless it is thinned out.
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

    /// Takes the trajectory back to where `offered` configurations had been offered. What was thinned out since stays forgotten;
    /// going on from here ends with the same configurations as going on without going back.
    pub fn go_back(&mut self, offered: usize) {
        self.offered = offered;
        let kept = offered.div_ceil(self.every);
        self.times.truncate(kept);
        self.numbers.truncate(kept * self.stride);
    }

    /// How many numbers a configuration of the trajectory has.
    pub(super) fn stride(&self) -> usize {
        self.stride
    }

    /// How many configurations were offered for each that the trajectory keeps.
    pub(super) fn every(&self) -> usize {
        self.every
    }

    /// All numbers of all configurations of the trajectory, one configuration after another.
    pub(super) fn numbers(&self) -> &[f64] {
        &self.numbers
    }

    /// A trajectory of the same bodies with other configurations, of so many that were offered; none when these do not fit each other.
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

    /// The times of the configurations of the trajectory.
    pub fn times(&self) -> &[f64] {
        &self.times
    }

    /// The numbers of a configuration of the trajectory, by its index.
    pub fn configuration(&self, index: usize) -> &[f64] {
        &self.numbers[index * self.stride..(index + 1) * self.stride]
    }

    /// The index of the configuration of the trajectory nearest to a time; none where there is none.
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
    fn old_configurations_thin_out_evenly() {
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
    fn going_back_behind_a_thinning_and_on_again_changes_nothing() {
        let offer = |trajectory: &mut Trajectory, from: i32| {
            for index in from..21 {
                trajectory.push(f64::from(index), std::iter::repeat_n(f64::from(index), 1 << 22));
            }
        };
        let mut trajectory = Trajectory::new(1 << 22);
        offer(&mut trajectory, 0);
        let straight = trajectory.times().to_vec();
        trajectory.go_back(6);
        assert!(trajectory.times().iter().all(|time| *time < 6.0));
        assert_eq!(trajectory.numbers().len(), trajectory.times().len() << 22);
        offer(&mut trajectory, 6);
        assert_eq!(trajectory.times(), straight);
    }
}
