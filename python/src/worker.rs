//! Thread of a session. The values of the script engine cannot leave their thread, so that requests and results pass through channels.

use std::cell::{Cell, RefCell};
use std::collections::HashMap;
use std::io::{self, Write};
use std::path::PathBuf;
use std::rc::{Rc, Weak};
use std::sync::atomic::AtomicBool;
use std::sync::mpsc::{Receiver, Sender, channel};
use std::sync::{Arc, Mutex, PoisonError};
use std::thread;

use rhai::{Dynamic, Engine, EvalAltResult, FnPtr, NativeCallContext, Position, Scope};
use withy::repl::session::{PROMPT, Reply, Session};
use withy::script::bindings::catalog::Catalog;
use withy::script::diagnose::{Colours, Diagnostic, Explainer, is_interrupt};
use withy::script::engine::runner::SNAPSHOTS;
use withy::script::engine::stack::on_large_stack;
use withy::script::packages::language;
use withy::script::source::program::Program;
use withy::script::state::inputs::Inputs;
use withy::script::state::limits::Limits;
use withy::script::state::settings::{RunMode, RunSettings};

use crate::messages::{Failure, Message, Request, ScriptFailure, Stream, Task, Update};
use crate::value::{Keeper, ObjectReference, Value};

/// Settings of a session.
pub struct SessionSettings {
    /// Folder for imports and for files that the script reads.
    pub folder: PathBuf,
    /// Folder for written files.
    pub out: PathBuf,
    /// Flag that stops the running task.
    pub interrupt: Arc<AtomicBool>,
}

/// Starts the thread of a session. It ends when the sender is dropped.
pub fn start(settings: SessionSettings) -> Sender<Request> {
    let (sender, requests) = channel();
    thread::spawn(move || {
        // The memory of the process is that of Python, and not limited here.
        let limits = Limits { memory: None, ..Limits::default() };
        // A session that cannot start drops the receiver, which the sender reports.
        let _ = on_large_stack(&limits, move || serve(settings, limits, requests));
    });
    sender
}

fn serve(settings: SessionSettings, limits: Limits, requests: Receiver<Request>) {
    let listeners = Listeners::default();
    let catalog = language();
    let settings = RunSettings {
        folder: settings.folder,
        out: settings.out,
        interrupt: settings.interrupt,
        snapshots: SNAPSHOTS,
        limits,
        printed: Box::new(listeners.stream(Stream::Printed)),
        diagnostics: Box::new(listeners.stream(Stream::Notes)),
        ..RunSettings::silent(RunMode::Run)
    };
    let Ok(session) = Session::new(catalog.clone(), settings) else { return };
    let engine = session.context().engine();
    let worker = Rc::new_cyclic(|own| Worker {
        own: own.clone(),
        requests,
        listeners,
        catalog,
        engine,
        kept: RefCell::default(),
        answers: RefCell::default(),
        last_number: Cell::new(0),
    });
    worker.serve(session);
}

/// Receivers of the messages of the running tasks, the innermost task last.
#[derive(Clone, Default)]
struct Listeners(Arc<Mutex<Vec<Sender<Message>>>>);

impl Listeners {
    fn with<T>(&self, work: impl FnOnce(&mut Vec<Sender<Message>>) -> T) -> T {
        work(&mut self.0.lock().unwrap_or_else(PoisonError::into_inner))
    }

    /// Sends a message to the innermost task. It is lost if Python no longer waits for it.
    fn send(&self, message: Message) {
        self.with(|all| all.last().map(|last| last.send(message)));
    }

    fn stream(&self, stream: Stream) -> LineWriter {
        LineWriter { listeners: self.clone(), stream, begun: Vec::new() }
    }
}

/// Writer that sends each line as a message.
struct LineWriter {
    listeners: Listeners,
    stream: Stream,
    begun: Vec<u8>,
}

impl Write for LineWriter {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        self.begun.extend(bytes);
        while let Some(end) = self.begun.iter().position(|byte| *byte == b'\n') {
            let line: Vec<u8> = self.begun.drain(..=end).collect();
            let line = String::from_utf8_lossy(&line[..end]).into_owned();
            self.listeners.send(Message::Line(self.stream, line));
        }
        Ok(bytes.len())
    }

    fn flush(&mut self) -> io::Result<()> {
        Ok(())
    }
}

struct Worker {
    own: Weak<Worker>,
    requests: Receiver<Request>,
    listeners: Listeners,
    catalog: Catalog,
    engine: Option<Rc<Engine>>,
    kept: RefCell<HashMap<u64, Dynamic>>,
    /// Answers that arrived while another call waited for its own.
    answers: RefCell<HashMap<u64, Result<Value, String>>>,
    last_number: Cell<u64>,
}

impl Worker {
    fn serve(&self, mut session: Session) {
        while let Ok(request) = self.requests.recv() {
            match request {
                Request::Perform(task, listener) => {
                    session.clear_interrupt();
                    self.perform(listener, |worker| worker.task(&mut session, task));
                }
                Request::Update(update) => self.update(update),
            }
        }
    }

    fn perform(
        &self,
        listener: Sender<Message>,
        work: impl FnOnce(&Self) -> Result<Value, Failure>,
    ) {
        self.listeners.with(|all| all.push(listener));
        let done = work(self);
        if let Some(listener) = self.listeners.with(Vec::pop) {
            let _ = listener.send(Message::Done(done));
        }
    }

    /// Performs a task while a script function written in Python runs.
    fn perform_inside(&self, engine: &Engine, task: Task) -> Result<Value, Failure> {
        match task {
            Task::Evaluate { expression, values } => {
                let mut scope = self.scope(&values);
                match engine.eval_with_scope::<Dynamic>(&mut scope, &expression) {
                    Ok(value) => Ok(Value::of(value, self)),
                    Err(error) if is_interrupt(&error) => Err(Failure::Interrupted),
                    Err(error) => {
                        let program = &Program::named(PROMPT, &expression);
                        let explainer = Explainer { program, catalog: &self.catalog, engine };
                        Err(script_failure(&explainer.explain(&error)))
                    }
                }
            }
            _ => Err(script_failure(
                &Diagnostic::general("the session is running a script")
                    .with_hint("only methods, properties and functions can be used in a function that the script calls"),
            )),
        }
    }

    fn update(&self, update: Update) {
        match update {
            Update::Answer { call, result } => _ = self.answers.borrow_mut().insert(call, result),
            Update::Release(number) => {
                // The value is dropped after the end of the borrow, because dropping it may run code of this worker.
                let released = self.kept.borrow_mut().remove(&number);
                drop(released);
            }
        }
    }

    fn task(&self, session: &mut Session, task: Task) -> Result<Value, Failure> {
        match task {
            Task::RunFile { path, inputs } => {
                let program =
                    Program::load(&path).map_err(|error| script_failure(&error.into()))?;
                self.value(session.load(program, inputs))
            }
            Task::RunText { text, name, inputs } => {
                let folder = session.folder().to_owned();
                let program = Program { folder, ..Program::named(&name, &text) };
                self.run(session, program, inputs)
            }
            Task::Evaluate { expression, values } => {
                let scope = self.scope(&values);
                self.value(session.evaluate_with(scope, &expression))
            }
            Task::Define { name, value } => {
                session.define(&name, value.to_dynamic(self));
                Ok(Value::Nothing)
            }
            Task::Read { name } => {
                let value = session.variables().get_value::<Dynamic>(&name);
                Ok(value.map_or(Value::Nothing, |value| Value::of(value, self)))
            }
            Task::Names => Ok(texts(session.variables().iter().map(|(name, ..)| name.to_owned()))),
            Task::Files => {
                let files = session.context().output().written().into_iter();
                Ok(texts(files.map(|file| file.display().to_string())))
            }
            Task::FailedChecks => {
                let failed = session.context().with_checks(|checks| checks.failed().to_vec());
                Ok(texts(failed.into_iter().map(|check| check.message)))
            }
        }
    }

    fn run(
        &self,
        session: &mut Session,
        program: Program,
        inputs: Inputs,
    ) -> Result<Value, Failure> {
        let reply = match inputs.are_defaults() {
            true => session.eval_program(program),
            false => session.load(program, inputs),
        };
        self.value(reply)
    }

    fn value(&self, reply: Reply) -> Result<Value, Failure> {
        match reply {
            Reply::Done => Ok(Value::Nothing),
            Reply::Value(value) => Ok(Value::of(value, self)),
            Reply::Failed(diagnostic) => Err(script_failure(&diagnostic)),
            Reply::Interrupted | Reply::PipeClosed => Err(Failure::Interrupted),
        }
    }

    fn scope(&self, values: &[Value]) -> Scope<'static> {
        let mut scope = Scope::new();
        for (index, value) in values.iter().enumerate() {
            scope.push_dynamic(format!("a{index}"), value.to_dynamic(self));
        }
        scope
    }

    fn number(&self) -> u64 {
        self.last_number.update(|last| last + 1);
        self.last_number.get()
    }

    fn call_python(
        &self,
        engine: &Engine,
        function: u64,
        arguments: &[&mut Dynamic],
    ) -> Result<Dynamic, Box<EvalAltResult>> {
        let call = self.number();
        let arguments = arguments.iter().map(|value| Value::of((**value).clone(), self)).collect();
        self.listeners.send(Message::Call { call, function, arguments });
        loop {
            if let Some(result) = self.answers.borrow_mut().remove(&call) {
                let raised =
                    |message: String| EvalAltResult::ErrorRuntime(message.into(), Position::NONE);
                return Ok(result.map_err(raised)?.to_dynamic(self));
            }
            match self.requests.recv() {
                Ok(Request::Perform(task, listener)) => {
                    self.perform(listener, |worker| worker.perform_inside(engine, task));
                }
                Ok(Request::Update(update)) => self.update(update),
                Err(_) => return Err("the session has ended".into()),
            }
        }
    }
}

impl Keeper for Worker {
    fn keep(&self, value: Dynamic) -> ObjectReference {
        let number = self.number();
        let type_name = match (&self.engine, value.is_fnptr()) {
            (Some(engine), false) => engine.map_type_name(value.type_name()).to_owned(),
            _ => "function".to_owned(),
        };
        self.kept.borrow_mut().insert(number, value);
        ObjectReference { number, type_name }
    }

    fn kept(&self, reference: &ObjectReference) -> Dynamic {
        self.kept.borrow().get(&reference.number).cloned().unwrap_or_default()
    }

    fn function(&self, number: u64) -> Dynamic {
        let worker = self.own.clone();
        let call = move |native: NativeCallContext, arguments: &mut [&mut Dynamic]| match worker
            .upgrade()
        {
            Some(worker) => worker.call_python(native.engine(), number, arguments),
            None => Err("the session has ended".into()),
        };
        // Rhai marks this function as deprecated, because its signature may change.
        #[allow(deprecated)]
        FnPtr::from_fn("python_function", call).map_or(Dynamic::UNIT, Dynamic::from)
    }
}

fn texts(texts: impl Iterator<Item = String>) -> Value {
    Value::Array(texts.map(Value::Text).collect())
}

fn script_failure(diagnostic: &Diagnostic) -> Failure {
    let in_script = diagnostic.location.as_ref().filter(|at| at.program.name != PROMPT);
    let place = in_script.map(|at| (at.program.name.clone(), at.line, at.column));
    // The expression of a call from Python is not shown.
    let shown = Diagnostic { location: in_script.cloned(), ..diagnostic.clone() };
    let report = shown.render(Colours::None);
    let report = report.strip_prefix("error: ").unwrap_or(&report).trim_end().to_owned();
    Failure::Script(ScriptFailure {
        message: diagnostic.message.clone(),
        hint: diagnostic.hint.clone(),
        place,
        report,
    })
}
