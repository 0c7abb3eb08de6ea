//! Grades the attempts of a class in parallel.

use std::collections::BTreeMap;
use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};
use std::sync::mpsc::channel;
use std::thread;

use super::catalogue::EXERCISES;
use super::exercise::Exercise;
use super::submissions::Submission;

/// Grades a class: `workers` threads call `judge` for each exercise of each submission.
///
/// `note` receives each mark as soon as it is known.
/// `tell` receives the marks student by student, in the order of the exercises.
/// Returns false if grading ended before all marks were reported, because `judge` returned `None` or `stop` was set.
pub fn grade<M: Send>(
    submissions: &[Submission],
    workers: usize,
    stop: &AtomicBool,
    judge: impl Fn(&Submission, &'static Exercise) -> Option<M> + Sync,
    mut note: impl FnMut(&Submission, &'static Exercise, &M),
    mut tell: impl FnMut(&Submission, &'static Exercise, M),
) -> bool {
    let jobs = || submissions.iter().flat_map(|of| EXERCISES.iter().map(move |it| (of, it)));
    let jobs: Vec<_> = jobs().collect();
    let next = AtomicUsize::new(0);
    let mut reported = 0;
    thread::scope(|scope| {
        let (send, marks) = channel();
        for _ in 0..workers.clamp(1, jobs.len().max(1)) {
            let (send, jobs, next, judge) = (send.clone(), &jobs, &next, &judge);
            scope.spawn(move || {
                while !stop.load(Ordering::Relaxed) {
                    let number = next.fetch_add(1, Ordering::Relaxed);
                    let Some((submission, exercise)) = jobs.get(number) else { return };
                    let Some(mark) = judge(submission, exercise) else { return };
                    if send.send((number, mark)).is_err() {
                        return;
                    }
                }
            });
        }
        drop(send);
        let mut waiting = BTreeMap::new();
        for (number, mark) in marks {
            let (submission, exercise) = jobs[number];
            note(submission, exercise, &mark);
            waiting.insert(number, mark);
            while let Some(mark) = waiting.remove(&reported) {
                let (submission, exercise) = jobs[reported];
                tell(submission, exercise, mark);
                reported += 1;
            }
        }
    });
    reported == jobs.len()
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::time::Duration;

    fn class(students: usize) -> Vec<Submission> {
        let student = |number: usize| format!("student {number}");
        let of = |number| Submission { student: student(number), folder: student(number).into() };
        (0..students).map(of).collect()
    }

    #[test]
    fn marks_are_reported_in_order_despite_varying_durations() {
        let class = class(3);
        let mut reported = Vec::new();
        let judge = |submission: &Submission, exercise: &Exercise| {
            let length = submission.student.len() + exercise.name.len();
            thread::sleep(Duration::from_millis(length as u64 * 7 % 5));
            Some(exercise.id())
        };
        let stop = AtomicBool::new(false);
        let mut noted = Vec::new();
        let note = |submission: &Submission, exercise: &Exercise, mark: &String| {
            assert_eq!(*mark, exercise.id());
            noted.push((submission.student.clone(), mark.clone()));
        };
        let whole = grade(&class, 4, &stop, judge, note, |submission, exercise, mark| {
            assert_eq!(mark, exercise.id());
            reported.push((submission.student.clone(), mark));
        });
        noted.sort();
        let mut sorted = reported.clone();
        sorted.sort();
        assert_eq!(noted, sorted);
        let asked =
            class.iter().flat_map(|of| EXERCISES.iter().map(|it| (of.student.clone(), it.id())));
        assert!(whole && reported == asked.collect::<Vec<_>>());
    }

    #[test]
    fn finished_marks_are_stored_while_another_attempt_still_runs() {
        let (stop, noted) = (AtomicBool::new(false), AtomicUsize::new(0));
        let judge = |submission: &Submission, exercise: &Exercise| {
            let is_first = submission.student.ends_with('0') && exercise == &EXERCISES[0];
            while is_first && noted.load(Ordering::Relaxed) < EXERCISES.len() - 1 {
                thread::sleep(Duration::from_millis(1));
            }
            Some(())
        };
        let note = |_: &Submission, _: &Exercise, _: &()| _ = noted.fetch_add(1, Ordering::Relaxed);
        assert!(grade(&class(1), 2, &stop, judge, note, |_, _, ()| ()));
    }

    #[test]
    fn stopped_grading_reports_the_finished_marks() {
        let stop = AtomicBool::new(false);
        let (calls, mut reported) = (AtomicUsize::new(0), 0);
        let judge = |_: &Submission, _: &Exercise| {
            let number = calls.fetch_add(1, Ordering::Relaxed) + 1;
            stop.store(number == 5, Ordering::Relaxed);
            Some(())
        };
        let whole = grade(&class(50), 1, &stop, judge, |_, _, _| (), |_, _, ()| reported += 1);
        assert!(!whole && reported == 5);
    }
}
