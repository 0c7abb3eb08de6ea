//! Tasks that are worked on at the same time, each in a thread of its own.

use std::sync::{Mutex, PoisonError};
use std::thread;

/// Works on all tasks at once: on the first one here, on each other one in a thread of its own, or here where the system gives
/// no thread.
pub fn at_once<T: Send>(tasks: impl IntoIterator<Item = T>, work: impl Fn(T) + Sync) {
    let mut tasks = tasks.into_iter();
    let first = tasks.next();
    let others: Vec<Mutex<Option<T>>> = tasks.map(|task| Mutex::new(Some(task))).collect();
    let take = |task: &Mutex<Option<T>>| {
        let taken = task.lock().unwrap_or_else(PoisonError::into_inner).take();
        taken.into_iter().for_each(&work);
    };
    thread::scope(|scope| {
        let take = &take;
        for task in &others {
            let _ = thread::Builder::new().spawn_scoped(scope, move || take(task));
        }
        first.into_iter().for_each(&work);
        // What no thread has taken.
        others.iter().for_each(take);
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
