//! Concurrent tasks.

use std::hint::spin_loop;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::sync::{Mutex, PoisonError};

use super::pool::{keep_polling, notify_workers, pool};

/// Number of times that a thread polls for the end of a task before it sleeps. The polls take about 50 µs, as long as sleeping and waking.
const MOST_POLLS: usize = 2000;

/// Runs all tasks concurrently: the first task on this thread, and the other tasks on threads of the pool.
/// Tasks that have not been started by the pool also run on this thread.
pub fn run_concurrently<T: Send>(tasks: impl IntoIterator<Item = T>, work: impl Fn(T) + Sync) {
    let mut tasks = tasks.into_iter();
    let first = tasks.next();
    let others: Vec<Mutex<Option<T>>> = tasks.map(|task| Mutex::new(Some(task))).collect();
    let take = |task: &Mutex<Option<T>>| {
        let taken = task.lock().unwrap_or_else(PoisonError::into_inner).take();
        taken.into_iter().for_each(&work);
    };
    let Some(pool) = pool().filter(|_| !others.is_empty()) else {
        first.into_iter().for_each(&work);
        return others.iter().for_each(take);
    };
    let left = AtomicUsize::new(others.len());
    pool.in_place_scope(|scope| {
        let (take, left) = (&take, &left);
        notify_workers();
        for task in &others {
            scope.spawn(move |_| {
                keep_polling();
                take(task);
                left.fetch_sub(1, Ordering::Release);
            });
        }
        first.into_iter().for_each(&work);
        others.iter().for_each(take);
        for _ in 0..MOST_POLLS {
            if left.load(Ordering::Acquire) == 0 {
                break;
            }
            spin_loop();
        }
    });
}

/// Runs two operations, concurrently if `threads` is at least two.
pub fn both(threads: usize, one: impl FnOnce() + Send, other: impl FnOnce() + Send) {
    if threads < 2 {
        one();
        return other();
    }
    run_concurrently([Either::One(one), Either::Other(other)], |either| match either {
        Either::One(one) => one(),
        Either::Other(other) => other(),
    });
}

enum Either<A, B> {
    One(A),
    Other(B),
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_task_runs_once_on_any_number_of_threads() {
        let mut counts = [0; 9];
        run_concurrently(counts.iter_mut().enumerate(), |(index, count)| *count += index);
        assert_eq!(counts, [0, 1, 2, 3, 4, 5, 6, 7, 8]);
        run_concurrently(std::iter::empty::<usize>(), |_| unreachable!());
        for threads in [1, 2] {
            let (mut one, mut other) = (0, String::new());
            both(threads, || one += 1, || other.push('x'));
            assert_eq!((one, other.as_str()), (1, "x"), "{threads}");
        }
    }
}
