//! Snapshots of a simulation, stored within a memory limit.

use std::collections::VecDeque;
use std::rc::Rc;

use super::controller::StepSizeState;
use super::progress::StepTaken;
use super::step_retry::StepRetry;
use super::{ReleaseEvent, WorkCounts};
use crate::system::SystemState;

#[derive(Debug, Clone)]
pub(super) struct Snapshot {
    pub(super) state: SystemState,
    pub(super) time: f64,
    pub(super) rows: usize,
    pub(super) last_step: StepTaken,
    pub(super) arrivals: usize,
    pub(super) releases: Rc<[ReleaseEvent]>,
    pub(super) counts: WorkCounts,
    pub(super) passed: u64,
    pub(super) retry: Option<StepRetry>,
    pub(super) step_size: Option<StepSizeState>,
}

impl Snapshot {
    pub(super) fn steps(&self) -> usize {
        self.counts.steps
    }

    fn bytes(&self) -> usize {
        size_of::<Self>() + self.state.bytes()
    }
}

#[derive(Debug, Clone, Default)]
pub(super) struct Snapshots {
    /// Memory limit [bytes].
    limit: usize,
    first: Option<Snapshot>,
    recent: VecDeque<Snapshot>,
    most: usize,
}

impl Snapshots {
    /// Changes the memory limit of the snapshots [bytes]. If no snapshot is stored, the callback `present` creates the first snapshot.
    pub(super) fn set_limit(&mut self, limit: usize, present: impl FnOnce() -> Snapshot) {
        let kept = std::mem::take(self);
        let first = if limit == 0 { None } else { Some(kept.first.unwrap_or_else(present)) };
        self.limit = limit;
        let Some(first) = first.filter(|first| first.bytes() <= limit) else { return };
        let most = limit / first.bytes() - 1;
        let mut recent = kept.recent;
        recent.drain(..recent.len().saturating_sub(most));
        recent.shrink_to(most);
        *self = Self { limit, first: Some(first), recent, most };
    }

    pub(super) fn limit(&self) -> usize {
        self.limit
    }

    /// Memory that the snapshots use [bytes].
    pub(super) fn bytes(&self) -> usize {
        let states: usize = self.all().map(|snapshot| snapshot.state.bytes()).sum();
        states
            + size_of::<Snapshot>() * (usize::from(self.first.is_some()) + self.recent.capacity())
    }

    pub(super) fn first(&self) -> Option<&Snapshot> {
        self.first.as_ref()
    }

    pub(super) fn places(&self) -> impl Iterator<Item = (usize, f64)> {
        self.all().map(|snapshot| (snapshot.steps(), snapshot.time))
    }

    fn all(&self) -> impl Iterator<Item = &Snapshot> {
        self.first.iter().chain(&self.recent)
    }

    pub(super) fn count(&self) -> usize {
        self.all().count()
    }

    /// Smallest step number from which the snapshots of all steps up to `now` are stored.
    pub(super) fn unbroken_from(&self, now: usize) -> Option<usize> {
        let first = self.first.as_ref()?.steps();
        let oldest = self.recent.front().map_or(now, Snapshot::steps);
        Some(if oldest == first + 1 { first } else { oldest })
    }

    pub(super) fn find(&self, steps: usize) -> Option<&Snapshot> {
        if let Some(first) = self.first.as_ref().filter(|first| first.steps() == steps) {
            return Some(first);
        }
        let at = self.recent.binary_search_by_key(&steps, Snapshot::steps).ok()?;
        self.recent.get(at)
    }

    pub(super) fn last_until(&self, time: f64, now: usize) -> Option<&Snapshot> {
        let unbroken = self.unbroken_from(now)?;
        let last = self.all().take_while(|snapshot| snapshot.time <= time).last()?;
        (last.steps() >= unbroken).then_some(last)
    }

    pub(super) fn truncate(&mut self, steps: usize) {
        self.recent.truncate(self.recent.partition_point(|snapshot| snapshot.steps() <= steps));
    }

    pub(super) fn blank(&mut self) -> Option<SystemState> {
        let first = self.first.as_ref().filter(|_| self.most > 0)?;
        let is_full = self.recent.len() >= self.most;
        let oldest = if is_full { self.recent.pop_front() } else { None };
        Some(oldest.map_or_else(|| first.state.blank(), |oldest| oldest.state))
    }

    /// Stores a snapshot whose state was written into a buffer from [`blank`](Self::blank).
    pub(super) fn push(&mut self, snapshot: Snapshot) {
        let count = self.recent.len();
        if count == self.recent.capacity() {
            self.recent.reserve_exact(count.max(4).min(self.most.saturating_sub(count)));
        }
        self.recent.push_back(snapshot);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn snapshot(steps: usize) -> Snapshot {
        Snapshot {
            state: SystemState::default(),
            time: steps as f64,
            rows: 1,
            last_step: StepTaken::default(),
            arrivals: 0,
            releases: Rc::default(),
            counts: WorkCounts { steps, ..WorkCounts::default() },
            passed: 0,
            retry: None,
            step_size: None,
        }
    }

    fn filled(limit: usize, last: usize) -> Snapshots {
        let mut snapshots = Snapshots::default();
        snapshots.set_limit(limit, || snapshot(1));
        for steps in 2..=last {
            if let Some(state) = snapshots.blank() {
                snapshots.push(Snapshot { state, ..snapshot(steps) });
            }
        }
        snapshots
    }

    #[test]
    fn first_and_latest_snapshots_are_kept_within_the_limit() {
        let snapshots = filled(10 * size_of::<Snapshot>(), 100);
        assert_eq!((snapshots.count(), snapshots.unbroken_from(100)), (10, Some(92)));
        assert!(snapshots.bytes() <= snapshots.limit());
        let kept = |steps| snapshots.find(steps).is_some();
        assert!(kept(1) && !kept(2) && !kept(91) && kept(92) && kept(100) && !kept(101));
        let last = |time| snapshots.last_until(time, 100).map(Snapshot::steps);
        assert_eq!(
            (last(99.5), last(92.0), last(91.5), last(1.0)),
            (Some(99), Some(92), None, None)
        );
    }

    #[test]
    fn smaller_memory_limit_drops_the_oldest_snapshots() {
        let mut snapshots = filled(10 * size_of::<Snapshot>(), 9);
        assert_eq!(snapshots.unbroken_from(9), Some(1));
        snapshots.set_limit(4 * size_of::<Snapshot>(), || snapshot(9));
        assert_eq!((snapshots.count(), snapshots.unbroken_from(9)), (4, Some(7)));
        assert!(snapshots.bytes() <= snapshots.limit());
        for limit in [size_of::<Snapshot>() - 1, 0] {
            snapshots.set_limit(limit, || snapshot(9));
            assert_eq!((snapshots.count(), snapshots.blank()), (0, None));
        }
    }

    #[test]
    fn memory_for_one_snapshot_keeps_only_the_first() {
        let snapshots = filled(size_of::<Snapshot>(), 9);
        assert_eq!((snapshots.count(), snapshots.unbroken_from(9)), (1, Some(9)));
    }

    #[test]
    fn truncation_removes_later_snapshots() {
        let mut snapshots = filled(10 * size_of::<Snapshot>(), 9);
        snapshots.truncate(5);
        assert!(snapshots.find(5).is_some() && snapshots.find(6).is_none());
        snapshots.truncate(1);
        assert_eq!((snapshots.count(), snapshots.unbroken_from(1)), (1, Some(1)));
    }
}
