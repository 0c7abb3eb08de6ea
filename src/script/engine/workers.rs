//! Engines on all cores: each worker has one of its own, which has read the script of the run, and calls its functions.

use std::ops::ControlFlow;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Arc, Mutex, mpsc};
use std::thread;
use std::time::{Duration, Instant};

use rhai::{AST, CallFnOptions, Dynamic, Engine, FnPtr, Scope, Stmt};

use super::host::Host;
use super::parse::parse;
use super::stack::on_large_stack;
use crate::panics::caught;
use crate::script::diagnose::Diagnostic;
use crate::script::rows::catalog::Catalog;
use crate::script::rows::sources::Sources;
use crate::script::source::program::Program;
use crate::script::state::context::Context;
use crate::script::state::limits::Limits;
use crate::script::state::settings::{Mode, Settings};
use crate::script::words::error::{EngineResult, ScriptError};
use crate::simulation::cores;

/// How often it is asked whether to go on while no piece of work ends.
const PULSE: Duration = Duration::from_millis(50);
/// Results that may wait to be heard, for each worker.
const WAITING: usize = 256;

/// What an engine on another thread needs to be like the one of the run.
#[derive(Clone)]
pub struct Blueprint {
    catalog: Catalog,
    program: Program,
    limits: Limits,
    snapshots: usize,
    refusal: &'static str,
}

impl Blueprint {
    /// The blueprint of the engine of a run; none where its script is not there as a whole, as at the prompt. `refusal` says why a function may write no
    /// files there.
    pub fn of(engine: &Engine, context: &Context, refusal: &'static str) -> Option<Self> {
        let catalog = Sources::of(engine).catalog()?;
        // The clock and the memory are those of the whole process, which the run itself keeps.
        let limits = Limits { time: None, memory: None, ..*context.meter().limits() };
        let program = context.program()?.clone();
        let snapshots = context.snapshots();
        Some(Self { catalog: Catalog::clone(&catalog), program, limits, snapshots, refusal })
    }
}

/// An engine of another thread, with the functions and imports of the script, none of whose statements were run.
pub struct Worker {
    host: Host,
    script: AST,
    program: Program,
    interrupt: Arc<AtomicBool>,
}

impl Worker {
    fn open(blueprint: &Blueprint, interrupt: Arc<AtomicBool>) -> Result<Self, Diagnostic> {
        let Blueprint { catalog, program, limits, snapshots, refusal } = blueprint;
        let settings = Settings {
            folder: program.folder.clone(),
            limits: *limits,
            snapshots: *snapshots,
            interrupt: Arc::clone(&interrupt),
            refuses_files: Some(refusal),
            ..Settings::silent(Mode::Run)
        };
        let host = Host::open(catalog.clone(), settings)?;
        let read = parse(host.engine(), program);
        let script = read.map_err(|error| host.explain(&error, program))?;
        let imports = script.statements().iter().filter(|stmt| matches!(stmt, Stmt::Import(..)));
        let mut script =
            AST::new(imports.cloned().collect::<Vec<_>>(), script.shared_lib().clone());
        script.set_source(program.name.as_str());
        Ok(Self { host, script, program: program.clone(), interrupt })
    }

    /// Calls a function of the script by its name.
    ///
    /// # Errors
    /// The function's own.
    pub fn call(&self, name: &str, arguments: Vec<Dynamic>) -> EngineResult<Dynamic> {
        let options = CallFnOptions::new().eval_ast(true);
        let mut scope = Scope::new();
        self.host.engine().call_fn_with_options(options, &mut scope, &self.script, name, arguments)
    }

    /// A function of the script as a value, by its name and the number of its parameters.
    pub fn function(&self, name: &str, parameters: usize) -> Option<FnPtr> {
        self.script.shared_lib().get_script_fn(name, parameters).cloned().map(FnPtr::from)
    }

    /// What the calls of the engine share.
    pub fn context(&self) -> &Context {
        self.host.context()
    }

    /// The engine.
    pub fn engine(&self) -> &Engine {
        self.host.engine()
    }

    /// An error of the script in words.
    pub fn explain(&self, error: &rhai::EvalAltResult) -> Diagnostic {
        self.host.explain(error, &self.program)
    }

    /// Whether the work of this worker was stopped from outside.
    pub fn is_stopped(&self) -> bool {
        self.interrupt.load(Ordering::Relaxed)
    }
}

/// A worker as the thread that waits for it sees it.
#[derive(Default)]
struct Post {
    interrupt: Arc<AtomicBool>,
    /// Since when it has been at its present piece of work.
    since: Mutex<Option<Instant>>,
}

impl Post {
    fn begin(&self, at: Option<Instant>) {
        if let Ok(mut since) = self.since.lock() {
            *since = at;
        }
    }

    /// Stops what has taken longer than `wall`.
    fn stop_after(&self, wall: Duration) {
        let began = self.since.lock().ok().and_then(|since| *since);
        if began.is_some_and(|began| began.elapsed() > wall) {
            self.interrupt.store(true, Ordering::Relaxed);
        }
    }
}

/// Does numbered pieces of work on all cores, each with a worker of its own; a piece that takes longer than `wall` is stopped.
///
/// `heed` is called on the calling thread: with the number and the result of a piece as soon as it has one, in no order, and with `None` now and then
/// between; when it breaks off, all workers are stopped, and pieces without a result get none. A piece that panics gives what `panicked` makes of it.
///
/// # Errors
/// When a worker cannot be made: nothing is wrong with the script then, which has been read before.
pub fn on_all_engines<R: Send>(
    blueprint: &Blueprint,
    wall: Duration,
    numbers: impl Iterator<Item = usize> + Send,
    work: impl Fn(&Worker, usize) -> R + Sync,
    panicked: impl Fn(String) -> R + Sync,
    mut heed: impl FnMut(Option<(usize, R)>) -> ControlFlow<()>,
) -> Result<(), ScriptError> {
    let numbers = Mutex::new(numbers);
    let next = || numbers.lock().ok()?.next();
    let is_over = AtomicBool::new(false);
    let posts: Vec<Post> = (0..cores()).map(|_| Post::default()).collect();
    let (done, finished) = mpsc::sync_channel(WAITING * posts.len());
    let labour = |post: &Post, done: mpsc::SyncSender<_>| -> Result<(), Diagnostic> {
        let worker = Worker::open(blueprint, Arc::clone(&post.interrupt))?;
        while !is_over.load(Ordering::Relaxed) {
            let Some(number) = next() else { break };
            post.begin(Some(Instant::now()));
            let result = caught(|| work(&worker, number)).unwrap_or_else(&panicked);
            post.begin(None);
            // The limit of one piece is not that of the next.
            if post.interrupt.swap(false, Ordering::Relaxed) && is_over.load(Ordering::Relaxed) {
                break;
            }
            if done.send((number, result)).is_err() {
                break;
            }
        }
        Ok(())
    };
    let made = thread::scope(|scope| {
        let running: Vec<_> = posts
            .iter()
            .map(|post| {
                let (done, labour) = (done.clone(), &labour);
                let limits = blueprint.limits;
                scope.spawn(move || {
                    on_large_stack(&limits, || labour(post, done)).and_then(|done| done)
                })
            })
            .collect();
        drop(done);
        loop {
            let news = match finished.recv_timeout(PULSE) {
                Ok(news) => Some(news),
                Err(mpsc::RecvTimeoutError::Timeout) => None,
                Err(mpsc::RecvTimeoutError::Disconnected) => break,
            };
            if news.is_none() {
                posts.iter().for_each(|post| post.stop_after(wall));
            }
            if heed(news).is_break() {
                is_over.store(true, Ordering::Relaxed);
                posts.iter().for_each(|post| post.interrupt.store(true, Ordering::Relaxed));
                // Whoever waits to be heard goes on, and ends.
                drop(finished);
                break;
            }
        }
        let ends = running.into_iter().map(|worker| worker.join());
        ends.filter_map(Result::ok).collect::<Result<Vec<()>, Diagnostic>>()
    });
    match made {
        Ok(_) => Ok(()),
        Err(diagnostic) => {
            Err(ScriptError::new(format!("a worker cannot begin: {}", diagnostic.message)))
        }
    }
}
