//! `withy learn grade`: grades the attempts of a class.

use std::path::Path;
use std::sync::Arc;
use std::sync::atomic::Ordering;
use std::thread;

use super::Exit;
use super::attempt_process::{JudgeLimits, mark_in_process};
use super::console::{print_error, print_line};
use super::interrupt::{self, InterruptLoss};
use super::limits::LimitOptions;
use crate::exercises::catalogue::EXERCISES;
use crate::exercises::class;
use crate::exercises::error::ExerciseError;
use crate::exercises::exercise::Exercise;
use crate::exercises::fingerprint::fingerprint;
use crate::exercises::grading::{Graded, GradingTask, Mark, StudentReport};
use crate::exercises::marks::{self, KnownMarks};
use crate::exercises::submissions::Submission;
use crate::output::{Cell, TextTable, columns, padded, printable_line};
use crate::sandbox_fs::Scratch;

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum GradeFormat {
    Table,
    Json,
}

pub struct GradeOptions<'a> {
    pub folder: &'a Path,
    pub form: GradeFormat,
    pub marks: Option<&'a Path>,
    pub jobs: Option<u16>,
    pub limits: &'a LimitOptions,
}

pub fn grade(options: &GradeOptions) -> Result<Exit, ExerciseError> {
    let submissions = Submission::all_in(options.folder)?;
    let refused = |path: &Path, source| ExerciseError::Marks { path: path.into(), source };
    let (known, mut file) = match options.marks {
        Some(path) => {
            let (known, file) = marks::open(path).map_err(|source| refused(path, source))?;
            (known, Some((path, file)))
        }
        None => (KnownMarks::default(), None),
    };
    let scratch = Scratch::new().map_err(ExerciseError::Scratch)?;
    let stop = interrupt::flag(InterruptLoss::Run);
    let cores = thread::available_parallelism().map_or(1, usize::from);
    let workers = options.jobs.map_or(cores, usize::from);
    let mut sheet = GradeSheet::begin(options.form, &submissions);
    let (mut first_error, mut kept) = (None, 0);
    let room = JudgeLimits { scratch: &scratch, limits: options.limits, stop: &stop };
    let judge = |submission: &Submission, exercise: &'static Exercise| {
        GradedMark::find(submission, exercise, &known, &room)
    };
    let note = |submission: &Submission, exercise: &'static Exercise, judged: &GradedMark| {
        if judged.origin == MarkOrigin::EarlierRun {
            kept += 1;
        } else if let Some((path, file)) = &mut file {
            let mark = (judged.mark, judged.message.as_str());
            let noted = file.append(submission, exercise, mark, judged.fingerprint.as_deref());
            if let Err(source) = noted
                && first_error.is_none()
            {
                first_error = Some(refused(path, source));
                Arc::clone(&stop).store(true, Ordering::Relaxed);
            }
        }
    };
    let is_whole = class::grade(
        &submissions,
        workers,
        &stop,
        judge,
        note,
        |submission, exercise, GradedMark { mark, message, .. }| {
            sheet.add(submission, Graded { exercise, mark, message });
        },
    );
    sheet.end();
    if let (Some((path, _)), true) = (&file, kept > 0) {
        let path = path.display();
        print_error(&format!(
            "note: {kept} marks were taken from '{path}', because nothing they depend on has changed\n"
        ));
    }
    match first_error {
        Some(first_error) => Err(first_error),
        None if is_whole => Ok(Exit::Success),
        None => Ok(Exit::Interrupted),
    }
}

struct GradedMark {
    mark: Mark,
    message: String,
    /// Fingerprint of the attempt; `None` if the mark must not be reused, because grading again may give another mark.
    fingerprint: Option<String>,
    origin: MarkOrigin,
}

#[derive(Clone, Copy, PartialEq, Eq)]
enum MarkOrigin {
    ThisRun,
    EarlierRun,
}

impl GradedMark {
    fn find(
        submission: &Submission,
        exercise: &'static Exercise,
        known: &KnownMarks,
        room: &JudgeLimits,
    ) -> Option<Self> {
        let limits = room.limits.to_arguments();
        let of_attempt = || fingerprint(submission, exercise, &limits);
        let before = of_attempt();
        if let Some((mark, message)) = known.find(submission, exercise, &before) {
            let origin = MarkOrigin::EarlierRun;
            return Some(Self { mark, message, fingerprint: Some(before), origin });
        }
        let marked = match GradingTask::of(submission, exercise) {
            GradingTask::Known(mark, message) => Ok(Some((mark, message))),
            GradingTask::Judge(file) => mark_in_process(submission, &file, exercise, room),
        };
        let (is_ours, (mark, message)) = match marked {
            Ok(marked) => (false, marked?),
            Err(error) => (true, (Mark::Error, format!("cannot start a process for it: {error}"))),
        };
        // The mark is not reused if the attempt changed while it was judged.
        let fingerprint = (!is_ours && of_attempt() == before).then_some(before);
        Some(Self { mark, message, fingerprint, origin: MarkOrigin::ThisRun })
    }
}

struct GradeSheet {
    form: GradeFormat,
    student_width: usize,
    exercise_width: usize,
    reports: Vec<StudentReport>,
}

const WIDEST: usize = 40;

impl GradeSheet {
    fn begin(form: GradeFormat, submissions: &[Submission]) -> Self {
        let names = submissions.iter().map(|of| columns(&of.student));
        let student_width = names.max().unwrap_or(0).clamp("student".len(), WIDEST);
        let exercise_width = EXERCISES.iter().map(|it| it.id().len()).max().unwrap_or(0);
        let sheet = Self { form, student_width, exercise_width, reports: Vec::new() };
        match form {
            GradeFormat::Table => sheet.line("student", "exercise", "result", "errors"),
            GradeFormat::Json => {
                print_line(&format!("{{\n  \"exercises\": {},\n  \"students\": [", EXERCISES.len()))
            }
        }
        sheet
    }

    fn line(&self, student: &str, exercise: &str, result: &str, off: &str) {
        let (first, second) = (self.student_width, self.exercise_width);
        let line = format!("{}  {exercise:<second$}  {result:<9}  {off}", padded(student, first));
        print_line(line.trim_end());
    }

    fn add(&mut self, submission: &Submission, graded: Graded) {
        if self.form == GradeFormat::Table {
            let off = graded.message.lines().next().unwrap_or_default();
            self.line(
                &printable_line(&submission.student),
                &graded.exercise.id(),
                graded.mark.keyword(),
                &printable_line(off),
            );
        }
        let is_new = self.reports.last().is_none_or(|last| last.graded.len() == EXERCISES.len());
        if is_new {
            let student = submission.student.clone();
            self.reports.push(StudentReport { student, graded: Vec::new() });
        }
        if let Some(report) = self.reports.last_mut() {
            report.graded.push(graded);
            if self.form == GradeFormat::Json && report.graded.len() == EXERCISES.len() {
                self.print_student();
            }
        }
    }

    fn print_student(&self) {
        let Some(report) = self.reports.last() else { return };
        let comma = if self.reports.len() > 1 { "    ,\n" } else { "" };
        let text = format!("{:#}", report.json());
        let lines: Vec<String> = text.lines().map(|line| format!("    {line}")).collect();
        print_line(&format!("{comma}{}", lines.join("\n")));
    }

    fn end(&self) {
        match self.form {
            GradeFormat::Json => print_line("  ]\n}"),
            GradeFormat::Table => {
                let mut sums = TextTable::new(&["student", "passed", "of"]);
                for report in &self.reports {
                    let counts =
                        [report.passed(), EXERCISES.len()].map(|count| Cell::from(count as f64));
                    let student = Cell::from(report.student.as_str());
                    sums.row([student].into_iter().chain(counts));
                }
                print_line(&format!("\n{}", sums.to_string().trim_end()));
            }
        }
    }
}
