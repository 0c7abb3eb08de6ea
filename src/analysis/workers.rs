//! Execution of cases on several processor cores.

use std::ops::ControlFlow;
use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};
use std::sync::mpsc;
use std::thread;
use std::time::Duration;

use super::Case;
use crate::panics::caught;
use crate::simulation::{HAS_THREADS, cores};

const PULSE: Duration = Duration::from_millis(50);

/// Runs cases on all processor cores, and returns the results in the order of the cases.
/// Cases that cannot be serialised ([`Case::to_bytes`]), because they call script functions, run last, on the calling thread.
/// `heed` is called on the calling thread with the index and result of each completed case, and periodically with `None`.
/// If `heed` returns `Break`, `stop` is set, and cases that have not ended get no result.
/// The result of a case that panics is the panic message.
pub fn on_all_cores<R: Send>(
    cases: &[Case],
    stop: &AtomicBool,
    work: impl Fn(&Case) -> R + Sync,
    mut heed: impl FnMut(Option<(usize, &Result<R, String>)>) -> ControlFlow<()>,
) -> Vec<Option<Result<R, String>>> {
    let to_bytes = |case: &Case| if HAS_THREADS { case.to_bytes() } else { None };
    let portable: Vec<Option<Vec<u8>>> = cases.iter().map(to_bytes).collect();
    let queue: Vec<(usize, &[u8])> = portable
        .iter()
        .enumerate()
        .filter_map(|(number, bytes)| Some((number, bytes.as_deref()?)))
        .collect();
    let mut results: Vec<Option<Result<R, String>>> = cases.iter().map(|_| None).collect();
    let next = AtomicUsize::new(0);
    let is_stopped = || stop.load(Ordering::Relaxed);
    let mut pulse = |completed: Option<(usize, &Result<R, String>)>| {
        if heed(completed).is_break() {
            stop.store(true, Ordering::Relaxed);
        }
    };
    thread::scope(|scope| {
        let (done, finished) = mpsc::channel();
        for _ in 0..cores().min(queue.len()) {
            let done = done.clone();
            let (queue, next, work) = (&queue, &next, &work);
            scope.spawn(move || {
                while let Some((number, bytes)) = queue.get(next.fetch_add(1, Ordering::Relaxed)) {
                    if is_stopped() {
                        break;
                    }
                    let case = Case::from_bytes(bytes).ok_or("the stored case cannot be read");
                    let result =
                        case.map_err(str::to_owned).and_then(|case| caught(|| work(&case)));
                    if done.send((*number, result)).is_err() {
                        break;
                    }
                }
            });
        }
        drop(done);
        loop {
            match finished.recv_timeout(PULSE) {
                Ok((number, result)) if !is_stopped() => {
                    pulse(Some((number, &result)));
                    results[number] = Some(result);
                }
                Ok(_) => (),
                Err(mpsc::RecvTimeoutError::Timeout) => pulse(None),
                Err(mpsc::RecvTimeoutError::Disconnected) => break,
            }
        }
    });
    let waiting = portable.iter().enumerate().filter(|(_, bytes)| bytes.is_none());
    for (number, _) in waiting {
        pulse(None);
        let result = caught(|| work(&cases[number]));
        pulse(None);
        if is_stopped() {
            break;
        }
        pulse(Some((number, &result)));
        results[number] = Some(result);
    }
    results
}

#[cfg(test)]
mod tests {
    use super::super::samples::{never, pushed_by_a_function, spinning};
    use super::super::{CaseOutcome, RunLimits};
    use super::*;

    fn steps(case: &Case, stop: &AtomicBool) -> (CaseOutcome, usize) {
        let (outcome, simulation) = case.run(RunLimits::default(), stop, |_| ());
        (outcome, simulation.map_or(0, |simulation| simulation.counts().steps))
    }

    #[test]
    fn results_have_the_order_of_the_cases_on_all_cores() {
        let stop = never();
        let mut cases: Vec<Case> =
            (1..=9).rev().map(|tens| spinning(0.1, &[f64::from(tens)])).collect();
        cases.insert(4, pushed_by_a_function(0.1, &[0.5]));
        let mut received = Vec::new();
        let results = on_all_cores(
            &cases,
            &stop,
            |case| steps(case, &stop),
            |completed| {
                received.extend(completed.map(|(number, _)| number));
                ControlFlow::Continue(())
            },
        );
        let steps: Vec<usize> =
            results.into_iter().map(|result| result.unwrap().unwrap().1).collect();
        assert_eq!(steps, [90, 80, 70, 60, 5, 50, 40, 30, 20, 10]);
        assert_eq!(received.last(), Some(&4));
        received.sort_unstable();
        assert!(received.into_iter().eq(0..10));
    }

    #[test]
    fn panic_of_a_case_does_not_affect_other_cases() {
        let cases = [spinning(0.1, &[0.1]), spinning(0.2, &[0.2])];
        let work = |case: &Case| match case.stops[0] {
            0.1 => panic!("lost in case {}", case.stops[0]),
            end => end,
        };
        let results = on_all_cores(&cases, &never(), work, |_| ControlFlow::Continue(()));
        assert_eq!(results[0], Some(Err("lost in case 0.1".to_owned())));
        assert_eq!(results[1], Some(Ok(0.2)));
    }

    #[test]
    fn stopped_workers_keep_the_finished_results() {
        let stop = never();
        let cases = [spinning(0.1, &[0.1]), spinning(0.1, &[1e9]), spinning(0.1, &[1e9])];
        let results = on_all_cores(
            &cases,
            &stop,
            |case| steps(case, &stop),
            |completed| match completed {
                Some((0, _)) => ControlFlow::Break(()),
                _ => ControlFlow::Continue(()),
            },
        );
        assert_eq!(results[0], Some(Ok((CaseOutcome::Finished, 1))));
        assert_eq!(results[1..], [None, None]);
    }
}
