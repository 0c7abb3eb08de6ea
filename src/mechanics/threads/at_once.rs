//! Tasks that are worked on at the same time.

use std::hint::spin_loop;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::sync::{Mutex, PoisonError};

use super::pool::{announce_parts, pool, stay_awake};

/// How often a thread asks whether the others are done before it sleeps: for about 50 µs, the time that falling asleep and waking takes.
const PATIENCE: usize = 2000;

/// Works on all tasks at once: on the first one here, on each other one in a thread that stands ready, or here where none has taken it before.
///
/// It returns when every thread that was asked has seen that its task is done, so that it waits where all of them are busy with something else. Tasks and their
/// list are allocated, a few hundred bytes for each call: threads are asked only where a task takes far longer than that.
pub fn at_once<T: Send>(tasks: impl IntoIterator<Item = T>, work: impl Fn(T) + Sync) {
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
        announce_parts();
        for task in &others {
            scope.spawn(move |_| {
                stay_awake();
                take(task);
                left.fetch_sub(1, Ordering::Release);
            });
        }
        first.into_iter().for_each(&work);
        // What no thread has taken.
        others.iter().for_each(take);
        for _ in 0..PATIENCE {
            if left.load(Ordering::Acquire) == 0 {
                break;
            }
            spin_loop();
        }
    });
}

/// Does two different things: at once where there are two threads, else one after the other.
pub fn both(threads: usize, one: impl FnOnce() + Send, other: impl FnOnce() + Send) {
    if threads < 2 {
        one();
        return other();
    }
    at_once([Either::One(one), Either::Other(other)], |either| match either {
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
    fn every_task_is_worked_on_once_whatever_the_threads() {
        let mut counts = [0; 9];
        at_once(counts.iter_mut().enumerate(), |(index, count)| *count += index);
        assert_eq!(counts, [0, 1, 2, 3, 4, 5, 6, 7, 8]);
        at_once(std::iter::empty::<usize>(), |_| unreachable!());
        for threads in [1, 2] {
            let (mut one, mut other) = (0, String::new());
            both(threads, || one += 1, || other.push('x'));
            assert_eq!((one, other.as_str()), (1, "x"), "{threads}");
        }
    }
}
