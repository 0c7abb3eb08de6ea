//! Worker threads that call functions of the script, each with a separate engine.

use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Arc, Mutex, mpsc};
use std::thread;
use std::time::{Duration, Instant};

use rhai::{AST, CallFnOptions, Dynamic, Engine, FnPtr, Scope, Stmt};

use super::parse::parse;
use super::script_engine::ScriptEngine;
use super::stack::{on_stack, workers};
use crate::panics::caught;
use crate::script::bindings::catalog::Catalog;
use crate::script::bindings::sources::Sources;
use crate::script::diagnose::Diagnostic;
use crate::script::messages::error::{EngineResult, ScriptError};
use crate::script::source::program::Program;
use crate::script::state::context::Context;
use crate::script::state::files_read::FilesRead;
use crate::script::state::inputs::Inputs;
use crate::script::state::limits::Limits;
use crate::script::state::settings::{RunMode, RunSettings};
use crate::simulation::cores;

const PULSE: Duration = Duration::from_millis(50);

const REST: Duration = Duration::from_millis(1);

#[derive(Clone)]
pub struct EngineConfig {
    catalog: Catalog,
    program: Program,
    limits: Limits,
    snapshots: usize,
    inputs: Inputs,
    files_read: FilesRead,
    refusal: &'static str,
    /// Number of workers, and stack size of each worker [bytes].
    workers: (usize, usize),
}

impl EngineConfig {
    /// Collects the data for worker engines; `None` without a complete script, as at the prompt, or with too little address space.
    /// In workers, functions that write files always fail with the error message `refusal`.
    pub fn of(engine: &Engine, context: &Context, refusal: &'static str) -> Option<Self> {
        let catalog = Sources::of(engine).catalog()?;
        // Workers have no limits of time and memory, which the run enforces for the whole process.
        let limits = Limits { time: None, memory: None, ..*context.meter().limits() };
        let program = context.program()?.clone();
        let snapshots = context.snapshots();
        let workers = workers(&limits, cores())?;
        let catalog = Catalog::clone(&catalog);
        let (inputs, files_read) = (context.inputs(), context.files_read());
        Some(Self { catalog, program, limits, snapshots, inputs, files_read, refusal, workers })
    }
}

/// Engine on another thread, with the functions and imports of the script, but without execution of its statements.
pub struct Worker {
    host: ScriptEngine,
    script: AST,
    program: Program,
    interrupt: Arc<AtomicBool>,
}

impl Worker {
    fn open(config: &EngineConfig, interrupt: Arc<AtomicBool>) -> Result<Self, Diagnostic> {
        let EngineConfig {
            catalog, program, limits, snapshots, inputs, files_read, refusal, ..
        } = config;
        let settings = RunSettings {
            folder: program.folder.clone(),
            limits: *limits,
            snapshots: *snapshots,
            inputs: inputs.clone(),
            files_read: files_read.clone(),
            interrupt: Arc::clone(&interrupt),
            refuses_files: Some(refusal),
            ..RunSettings::silent(RunMode::Run)
        };
        let host = ScriptEngine::open(catalog.clone(), settings)?;
        let read = parse(host.engine(), program);
        let script = read.map_err(|error| host.explain(&error, program))?;
        let imports = script.statements().iter().filter(|stmt| matches!(stmt, Stmt::Import(..)));
        let mut script =
            AST::new(imports.cloned().collect::<Vec<_>>(), script.shared_lib().clone());
        script.set_source(program.name.as_str());
        Ok(Self { host, script, program: program.clone(), interrupt })
    }

    pub fn call(&self, name: &str, arguments: Vec<Dynamic>) -> EngineResult<Dynamic> {
        let options = CallFnOptions::new().eval_ast(true);
        let mut scope = Scope::new();
        self.host.engine().call_fn_with_options(options, &mut scope, &self.script, name, arguments)
    }

    pub fn function(&self, name: &str, parameters: usize) -> Option<FnPtr> {
        self.script.shared_lib().get_script_fn(name, parameters).cloned().map(FnPtr::from)
    }

    pub fn context(&self) -> &Context {
        self.host.context()
    }

    pub fn explain(&self, error: &rhai::EvalAltResult) -> Diagnostic {
        self.host.explain(error, &self.program)
    }

    pub fn is_stopped(&self) -> bool {
        self.interrupt.load(Ordering::Relaxed)
    }
}

#[derive(Default)]
struct WorkerState {
    interrupt: Arc<AtomicBool>,
    since: Mutex<Option<Instant>>,
}

impl WorkerState {
    fn begin(&self, at: Option<Instant>) {
        if let Ok(mut since) = self.since.lock() {
            *since = at;
        }
    }

    fn stop_after(&self, wall: Duration) {
        let began = self.since.lock().ok().and_then(|since| *since);
        if began.is_some_and(|began| began.elapsed() > wall) {
            self.interrupt.store(true, Ordering::Relaxed);
        }
    }
}

pub struct WorkerPool<'c, J, R> {
    states: &'c [WorkerState],
    jobs: mpsc::Sender<(usize, J)>,
    results: mpsc::Receiver<(usize, R)>,
    is_over: &'c AtomicBool,
    wall: Duration,
}

pub enum WorkerEvent<R> {
    Done(usize, R),
    /// No result has arrived within the waiting time, after which the caller can check for interruption.
    Timeout,
    NoWorkers,
}

impl<J, R> WorkerPool<'_, J, R> {
    pub fn size(&self) -> usize {
        self.states.len()
    }

    /// Queues a job. The number of the job is returned with its result.
    pub fn submit(&self, number: usize, job: J) {
        // The error is ignored, because missing workers are detected when results are received.
        let _ = self.jobs.send((number, job));
    }

    /// Waits for the next result, and collects waiting results in batches, because each wake-up of the thread takes time.
    pub fn receive_batch(&self) -> WorkerEvent<R> {
        match self.results.try_recv() {
            Ok((number, result)) => WorkerEvent::Done(number, result),
            Err(_) => {
                thread::sleep(REST);
                self.receive()
            }
        }
    }

    /// Waits for the next result, in any order. A job that takes too long is stopped.
    pub fn receive(&self) -> WorkerEvent<R> {
        match self.results.recv_timeout(PULSE) {
            Ok((number, result)) => WorkerEvent::Done(number, result),
            Err(mpsc::RecvTimeoutError::Timeout) => {
                self.states.iter().for_each(|state| state.stop_after(self.wall));
                WorkerEvent::Timeout
            }
            Err(mpsc::RecvTimeoutError::Disconnected) => WorkerEvent::NoWorkers,
        }
    }
}

/// Calls `drive` with a pool of worker threads, and then stops unfinished jobs. A job that takes longer than `wall` is stopped.
/// `panicked` converts the message of a panic to a result.
pub fn with_worker_pool<J: Send, R: Send, T>(
    config: &EngineConfig,
    wall: Duration,
    work: impl Fn(&Worker, J) -> R + Sync,
    panicked: impl Fn(String) -> R + Sync,
    drive: impl FnOnce(&WorkerPool<J, R>) -> T,
) -> Result<T, ScriptError> {
    let is_over = AtomicBool::new(false);
    let (count, stack) = config.workers;
    let states: Vec<WorkerState> = (0..count).map(|_| WorkerState::default()).collect();
    let (jobs, given) = mpsc::channel();
    let (done, results) = mpsc::channel();
    let given = Mutex::new(given);
    let next = || given.lock().ok()?.recv().ok();
    let run_worker = |state: &WorkerState, done: mpsc::Sender<_>| -> Result<(), Diagnostic> {
        let worker = match Worker::open(config, Arc::clone(&state.interrupt)) {
            Err(_) if is_over.load(Ordering::Relaxed) => return Ok(()),
            opened => opened?,
        };
        while let Some((number, job)) = next() {
            if is_over.load(Ordering::Relaxed) {
                break;
            }
            state.begin(Some(Instant::now()));
            let result = caught(|| work(&worker, job)).unwrap_or_else(&panicked);
            state.begin(None);
            state.interrupt.store(false, Ordering::Relaxed);
            if done.send((number, result)).is_err() {
                break;
            }
        }
        Ok(())
    };
    thread::scope(|scope| {
        let spawn = |state| {
            let (done, run_worker, limits) = (done.clone(), &run_worker, config.limits);
            let is_over = &is_over;
            scope.spawn(move || {
                let ended = on_stack(stack, &limits, || run_worker(state, done)).flatten();
                if is_over.load(Ordering::Relaxed) { Ok(()) } else { ended }
            })
        };
        let running: Vec<_> = states.iter().map(spawn).collect();
        drop(done);
        let pool = WorkerPool { states: &states, jobs, results, is_over: &is_over, wall };
        let driven = drive(&pool);
        pool.dismiss();
        let ends = running.into_iter().filter_map(|worker| worker.join().ok());
        match ends.collect::<Result<Vec<()>, Diagnostic>>() {
            Ok(_) => Ok(driven),
            Err(diagnostic) => Err(ScriptError::new(format!(
                "a worker thread cannot start: {}",
                diagnostic.message
            ))),
        }
    })
}

impl<J, R> WorkerPool<'_, J, R> {
    fn dismiss(self) {
        self.is_over.store(true, Ordering::Relaxed);
        self.states.iter().for_each(|state| state.interrupt.store(true, Ordering::Relaxed));
    }
}
