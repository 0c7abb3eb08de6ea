//! Grades each attempt in a separate process, so that an attempt cannot affect other attempts or the marks.
//!
//! The process has limits on time, memory and output, and runs in a new folder with an unpredictable name.
//! The process prints its verdict as one line of JSON. If the process dies, the attempt still receives a mark.

use std::io::Read;
use std::path::Path;
use std::process::{Child, Command, ExitStatus, Stdio};
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::{Duration, Instant};
use std::{env, io, process, thread};

use serde_json::{Value, json};

use super::Exit;
use super::console::{print_error, print_line};
use super::limits::LimitOptions;
use crate::exercises::attempt;
use crate::exercises::exercise::Exercise;
use crate::exercises::grading::{self, Mark};
use crate::exercises::judging::{AttemptVerdict, judge};
use crate::exercises::submissions::Submission;
use crate::sandbox_fs::Scratch;
use crate::script::messages::stop::Stop;
use crate::script::state::limits::Limits;
use crate::script::state::settings::{RunMode, RunSettings};

const INTERVAL: Duration = Duration::from_millis(5);
const START: Duration = Duration::from_secs(2);
/// Maximum length of the message in a verdict [characters], at which the verdict fits into the buffer of a pipe.
const LONGEST_MESSAGE: usize = 4000;
/// Maximum size of a verdict [bytes].
const LONGEST_VERDICT: u64 = 1 << 20;

pub(super) struct JudgeLimits<'a> {
    pub scratch: &'a Scratch,
    pub limits: &'a LimitOptions,
    pub stop: &'a AtomicBool,
}

/// Grades an attempt in a separate process; `None` if grading was stopped before the mark was known.
///
/// # Errors
/// Fails if the process cannot be started, which is not the fault of the student.
pub(super) fn mark_in_process(
    submission: &Submission,
    file: &Path,
    exercise: &Exercise,
    room: &JudgeLimits,
) -> io::Result<Option<(Mark, String)>> {
    let bounds = room.limits.for_an_attempt();
    Ok(match run_in_process(submission, file, exercise, room)? {
        ProcessReport::Line(line) => {
            Some(read(&line).unwrap_or_else(|| (Mark::Error, "its judge gave no result".into())))
        }
        ProcessReport::Nothing(status) => Some(mark_of_exit(status, &bounds)),
        ProcessReport::TooLate => Some((Mark::Stopped, too_late(&bounds))),
        ProcessReport::Interrupted => None,
    })
}

enum ProcessReport {
    Line(String),
    Nothing(ExitStatus),
    TooLate,
    Interrupted,
}

fn run_in_process(
    submission: &Submission,
    file: &Path,
    exercise: &Exercise,
    JudgeLimits { scratch, limits, stop }: &JudgeLimits,
) -> io::Result<ProcessReport> {
    let folder = scratch.part()?;
    let begun = Instant::now();
    let home = submission.folder.canonicalize()?;
    let below = file.strip_prefix(&submission.folder).map_err(io::Error::other)?;
    let mut command = Command::new(env::current_exe()?);
    command
        .args(["learn", "attempt"])
        .args(limits.to_arguments())
        .arg("--")
        .args([&home, &home.join(below)])
        .arg(exercise.id())
        .current_dir(folder.path())
        .env("TMPDIR", folder.path())
        .stdin(Stdio::null())
        .stdout(Stdio::piped())
        .stderr(Stdio::null());
    let mut process = shield_from_interrupt(&mut command).spawn()?;
    let time = limits.for_an_attempt().time.unwrap_or_default() * 2 + START;
    let ended = loop {
        if let Some(status) = process.try_wait()? {
            break ProcessReport::Nothing(status);
        }
        if stop.load(Ordering::Relaxed) || begun.elapsed() > time {
            process.kill()?;
            process.wait()?;
            break if stop.load(Ordering::Relaxed) {
                ProcessReport::Interrupted
            } else {
                ProcessReport::TooLate
            };
        }
        thread::sleep(INTERVAL);
    };
    Ok(match (ended, line_of(&mut process)) {
        (ProcessReport::Nothing(status), Some(line)) if status.success() => {
            ProcessReport::Line(line)
        }
        (ended, _) => ended,
    })
}

fn line_of(process: &mut Child) -> Option<String> {
    let mut said = Vec::new();
    process.stdout.take()?.take(LONGEST_VERDICT).read_to_end(&mut said).ok()?;
    let said = String::from_utf8(said).ok()?;
    said.lines().next().map(str::to_owned)
}

fn read(line: &str) -> Option<(Mark, String)> {
    let verdict: Value = serde_json::from_str(line).ok()?;
    let mark = Mark::of(verdict.get("result")?.as_str()?)?;
    Some((mark, verdict.get("message")?.as_str()?.to_owned()))
}

fn write((mark, message): &(Mark, String)) -> String {
    let message: String = message.chars().take(LONGEST_MESSAGE).collect();
    json!({ "result": mark.keyword(), "message": message }).to_string()
}

fn too_late(limits: &Limits) -> String {
    limits
        .time
        .map_or_else(|| "it takes too long".into(), |time| Stop::Time(time).message_and_hint().0)
}

fn mark_of_exit(status: ExitStatus, limits: &Limits) -> (Mark, String) {
    let passed = match kill_reason(status) {
        KillReason::Time => return (Mark::Stopped, too_late(limits)),
        KillReason::Memory => limits.memory.map(Stop::Memory),
        KillReason::Written => limits.written.map(Stop::Written),
        KillReason::Other => None,
    };
    match passed {
        Some(stop) => (Mark::Stopped, stop.message_and_hint().0),
        None => (Mark::Error, format!("its process ended without a result: {status}")),
    }
}

enum KillReason {
    Time,
    Memory,
    Written,
    Other,
}

#[cfg(unix)]
fn kill_reason(status: ExitStatus) -> KillReason {
    use nix::sys::signal::Signal;
    use std::os::unix::process::ExitStatusExt;
    match status.signal().and_then(|number| Signal::try_from(number).ok()) {
        Some(Signal::SIGXCPU) => KillReason::Time,
        Some(Signal::SIGXFSZ) => KillReason::Written,
        // A Rust program aborts if an allocation fails, and the system kills a process that uses too much memory.
        Some(Signal::SIGABRT | Signal::SIGKILL) => KillReason::Memory,
        _ => KillReason::Other,
    }
}

#[cfg(not(unix))]
fn kill_reason(_: ExitStatus) -> KillReason {
    KillReason::Other
}

/// Puts the process into its own process group, so that Ctrl-C at the terminal does not reach it.
fn shield_from_interrupt(command: &mut Command) -> &mut Command {
    #[cfg(unix)]
    std::os::unix::process::CommandExt::process_group(command, 0);
    command
}

/// Prints the mark for an exceeded limit and exits, for code that does not check the limits and therefore does not stop.
fn stopped_hard(stop: Stop) {
    print_line(&write(&(Mark::Stopped, stop.message_and_hint().0)));
    process::exit(0)
}

pub(super) fn judge_one(
    folder: &Path,
    file: &Path,
    exercise: &Exercise,
    limits: &LimitOptions,
) -> Exit {
    let limits = limits.for_an_attempt();
    if let Err(error) = confine(&limits) {
        print_error(&format!("error: the limits of this process cannot be set: {error}\n"));
        return Exit::Failure;
    }
    let settings = RunSettings {
        limits,
        last_resort: Some(Arc::new(stopped_hard)),
        ..RunSettings::silent(RunMode::Run)
    };
    let verdict = match attempt::load(file, folder) {
        Ok(attempt) => judge(exercise, &attempt, settings),
        Err(why) => AttemptVerdict::Error(why),
    };
    match grading::mark(verdict) {
        Some(mark) => print_line(&write(&mark)),
        None => return Exit::Interrupted,
    }
    // The process exits without dropping the data of the attempt, because that may take long.
    process::exit(0)
}

#[cfg(unix)]
fn confine(limits: &Limits) -> nix::Result<()> {
    use nix::sys::resource::{Resource, getrlimit, setrlimit};
    let cores = thread::available_parallelism().map_or(1, usize::from) as u64;
    let set = |resource, most: u64| {
        let (_, hard) = getrlimit(resource)?;
        setrlimit(resource, most.min(hard), hard.min(most.saturating_add(1)))
    };
    if let Some(time) = limits.time {
        set(Resource::RLIMIT_CPU, (time * 2 + START).as_secs().saturating_mul(cores) + 1)?;
    }
    if let Some(memory) = limits.memory {
        let stack = limits.stack() as u64;
        set(Resource::RLIMIT_AS, memory.saturating_mul(2).saturating_add(stack + CODE))?;
    }
    if let Some(written) = limits.written {
        set(Resource::RLIMIT_FSIZE, written)?;
    }
    set(Resource::RLIMIT_NOFILE, FILES_OPEN)?;
    set(Resource::RLIMIT_CORE, 0)?;
    #[cfg(target_os = "linux")]
    nix::sys::prctl::set_pdeathsig(nix::sys::signal::Signal::SIGKILL)?;
    Ok(())
}

#[cfg(unix)]
const FILES_OPEN: u64 = 64;
/// Address space reserved for the program itself [bytes].
#[cfg(unix)]
const CODE: u64 = 1 << 30;

#[cfg(not(unix))]
fn confine(_: &Limits) -> io::Result<()> {
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn verdicts_survive_serialisation_to_one_line() {
        let said = "two\nlines, \"quotes\" and \u{1b}[2J".to_owned();
        let line = write(&(Mark::WrongResult, said.clone()));
        assert!(!line.contains(['\n', '\u{1b}']));
        assert_eq!(read(&line), Some((Mark::WrongResult, said)));
        let line = write(&(Mark::Error, "x".repeat(1 << 20)));
        assert_eq!(read(&line).unwrap().1.len(), LONGEST_MESSAGE);
        for wrong in ["", "passed", "{}", r#"{ "result": "great", "message": "" }"#] {
            assert_eq!(read(wrong), None);
        }
    }
}
