//! Judges an attempt in a separate process, so that keys are handled meanwhile and the attempt can be killed.

use std::io::{self, Read};
use std::process::{self, Child, Command, ExitStatus, Stdio};
use std::sync::mpsc::{Receiver, TryRecvError, channel};
use std::sync::{Arc, Mutex, PoisonError};
use std::time::{Duration, Instant};
use std::{env, thread};

use crate::cli::Exit;
use crate::cli::console::print_line;
use crate::cli::limits::LimitOptions;
use crate::exercises::attempt;
use crate::exercises::captured_output::{CaptureWriter, CapturedOutput};
use crate::exercises::exercise::Exercise;
use crate::exercises::judging::{AttemptVerdict, DEFAULT_TIME_LIMIT, judge};
use crate::exercises::report::{AttemptError, AttemptOutcome, AttemptReport};
use crate::exercises::workbook::Workbook;
use crate::script::messages::stop::Stop;
use crate::script::state::limits::Limits;
use crate::script::state::settings::{RunMode, RunSettings};

const SLACK: Duration = Duration::from_secs(12);
/// Maximum size of the report on an attempt [bytes].
const LONGEST: u64 = 1 << 20;

pub struct JudgeProcess {
    process: Child,
    messages: Receiver<String>,
    start: Instant,
    limits: Limits,
}

impl JudgeProcess {
    pub fn begin(exercise: &Exercise, options: &LimitOptions) -> io::Result<Self> {
        let mut command = Command::new(env::current_exe()?);
        command.args(["learn", "try"]).args(options.to_arguments()).args(["--", &exercise.id()]);
        command.stdin(Stdio::null()).stdout(Stdio::piped()).stderr(Stdio::null());
        // A separate process group keeps signals of keys such as Ctrl-C from the process.
        #[cfg(unix)]
        std::os::unix::process::CommandExt::process_group(&mut command, 0);
        let mut process = command.spawn()?;
        let (send, said) = channel();
        let output = process.stdout.take();
        thread::spawn(move || {
            let mut text = Vec::new();
            if let Some(output) = output {
                let _ = output.take(LONGEST).read_to_end(&mut text);
            }
            let _ = send.send(String::from_utf8_lossy(&text).into_owned());
        });
        let mut limits = options.limits();
        limits.time = limits.time.or(Some(DEFAULT_TIME_LIMIT));
        Ok(Self { process, messages: said, start: Instant::now(), limits })
    }

    pub fn seconds(&self) -> u64 {
        self.start.elapsed().as_secs()
    }

    /// Returns the report on the attempt; `None` while the process is running.
    pub fn result(&mut self) -> Option<AttemptReport> {
        let longest = self.limits.time.unwrap_or(DEFAULT_TIME_LIMIT) * 2 + SLACK;
        match self.messages.try_recv() {
            Ok(said) => Some(self.report(&said)),
            Err(TryRecvError::Disconnected) => Some(self.report("")),
            Err(TryRecvError::Empty) if self.start.elapsed() > longest => {
                Some(stopped(Stop::Time(longest), CapturedOutput::default()))
            }
            Err(TryRecvError::Empty) => None,
        }
    }

    fn report(&mut self, said: &str) -> AttemptReport {
        match said.lines().last().and_then(|line| serde_json::from_str(line).ok()) {
            Some(report) => report,
            None => match self.process.wait() {
                Ok(status) => killed_report(status, &self.limits),
                Err(error) => cannot(&error),
            },
        }
    }
}

impl Drop for JudgeProcess {
    fn drop(&mut self) {
        let _ = self.process.kill();
        let _ = self.process.wait();
    }
}

/// Returns the report for an attempt whose process could not be started because of `error`.
pub fn cannot(error: &io::Error) -> AttemptReport {
    let message = format!("cannot start a process for it: {error}");
    let why = AttemptError { message, ..AttemptError::default() };
    AttemptReport { outcome: AttemptOutcome::Error(why), printed: CapturedOutput::default() }
}

fn killed_report(status: ExitStatus, limits: &Limits) -> AttemptReport {
    match limits.memory.filter(|_| is_out_of_memory(status)) {
        Some(memory) => stopped(Stop::Memory(memory), CapturedOutput::default()),
        None => {
            let message = format!("its process ended without a result: {status}");
            let why = AttemptError { message, ..AttemptError::default() };
            AttemptReport {
                outcome: AttemptOutcome::Error(why),
                printed: CapturedOutput::default(),
            }
        }
    }
}

/// Returns true if the process probably ended because of its memory use.
/// A Rust program aborts if an allocation fails, and the system kills a process that uses too much memory.
#[cfg(unix)]
fn is_out_of_memory(status: ExitStatus) -> bool {
    use nix::libc::{SIGABRT, SIGKILL};
    use std::os::unix::process::ExitStatusExt;
    matches!(status.signal(), Some(SIGABRT | SIGKILL))
}

#[cfg(not(unix))]
fn is_out_of_memory(_: ExitStatus) -> bool {
    false
}

fn stopped(stop: Stop, printed: CapturedOutput) -> AttemptReport {
    let (message, help) = stop.message_and_hint();
    let why = AttemptError { message, help, ..AttemptError::default() };
    AttemptReport { outcome: AttemptOutcome::Stopped(why), printed }
}

pub fn try_here(workbook: &Workbook, exercise: &Exercise, options: &LimitOptions) -> Exit {
    exit_with_parent();
    let output = CaptureWriter::default();
    let captured = output.clone();
    // The lock prevents a second report by the thread that watches the limits.
    let turn = Arc::new(Mutex::new(()));
    let last_turn = Arc::clone(&turn);
    let resort = move |stop: Stop| {
        let _turn = last_turn.lock().unwrap_or_else(PoisonError::into_inner);
        send_report(&stopped(stop, captured.captured()));
        process::exit(0)
    };
    let settings = RunSettings {
        out: workbook.folder().join("out"),
        limits: options.limits(),
        printed: Box::new(output.clone()),
        diagnostics: Box::new(output.clone()),
        last_resort: Some(Arc::new(resort)),
        ..RunSettings::silent(RunMode::Run)
    };
    let verdict = match attempt::load(&workbook.file(exercise), workbook.folder()) {
        Ok(attempt) => judge(exercise, &attempt, settings),
        Err(why) => AttemptVerdict::Error(why),
    };
    let _turn = turn.lock().unwrap_or_else(PoisonError::into_inner);
    send_report(&AttemptReport { outcome: verdict.into(), printed: output.captured() });
    // The process exits without dropping the data of the attempt, because that may take long.
    process::exit(0)
}

fn send_report(report: &AttemptReport) {
    match serde_json::to_string(report) {
        Ok(line) => print_line(&line),
        Err(error) => eprintln!("error: {error}"),
    }
}

/// Requests the system to kill this process when its parent ends, because only the parent reads the report.
#[cfg(target_os = "linux")]
fn exit_with_parent() {
    use nix::sys::signal::Signal;
    let _ = nix::sys::prctl::set_pdeathsig(Signal::SIGKILL);
}

#[cfg(not(target_os = "linux"))]
fn exit_with_parent() {}
