//! Sessions for Python: they send tasks to their thread, wait without the global interpreter lock, and call Python functions for the script.

use std::path::PathBuf;
use std::sync::atomic::{AtomicBool, AtomicU64, Ordering};
use std::sync::mpsc::{Receiver, RecvTimeoutError, Sender, channel};
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};
use std::time::Duration;

use pyo3::exceptions::{PyKeyboardInterrupt, PyRuntimeError, PyValueError};
use pyo3::gc::{PyTraverseError, PyVisit};
use pyo3::prelude::*;
use pyo3::types::PyTuple;
use withy::script::state::inputs::{InputSetting, Inputs, NAMES, is_input_name};

use crate::convert::{from_python, to_python};
use crate::expressions;
use crate::messages::{Failure, Message, Request, ScriptFailure, Stream, Task, Update};
use crate::value::Value;
use crate::worker::{self, SessionSettings};

/// Time between two checks for Ctrl-C.
const BETWEEN_SIGNAL_CHECKS: Duration = Duration::from_millis(50);

/// Session of the language in a thread of its own.
#[pyclass(frozen, name = "Session", module = "withy._native")]
pub struct NativeSession {
    requests: Sender<Request>,
    interrupt: Arc<AtomicBool>,
    /// Python functions that scripts may call, with their numbers.
    functions: Mutex<Vec<(u64, Py<PyAny>)>>,
    last_function: AtomicU64,
    listener: Mutex<Option<Py<PyAny>>>,
}

/// Python exceptions that were raised while a task ran.
#[derive(Default)]
struct Raised {
    /// Exception that ends the task, such as that of Ctrl-C.
    ending: Option<PyErr>,
    /// Latest exception of a function that the script called, and its message in the script. The script may catch it.
    in_function: Option<(String, PyErr)>,
}

#[pymethods]
impl NativeSession {
    /// Starts a session. `listener` is called with "printed" or "notes" and a line.
    #[new]
    fn new(folder: PathBuf, out: PathBuf, listener: Py<PyAny>) -> Self {
        let interrupt = Arc::<AtomicBool>::default();
        let settings = SessionSettings { folder, out, interrupt: Arc::clone(&interrupt) };
        Self {
            requests: worker::start(settings),
            interrupt,
            functions: Mutex::default(),
            last_function: AtomicU64::default(),
            listener: Mutex::new(Some(listener)),
        }
    }

    /// Runs the script in a file. Inputs have their values as texts.
    fn run_file(
        slf: &Bound<'_, Self>,
        path: PathBuf,
        inputs: Vec<(String, String)>,
    ) -> PyResult<Py<PyAny>> {
        perform(slf, Task::RunFile { path, inputs: with_values(inputs)? })
    }

    /// Runs statements. Errors in them have the place `name`.
    fn run_text(
        slf: &Bound<'_, Self>,
        text: String,
        name: String,
        inputs: Vec<(String, String)>,
    ) -> PyResult<Py<PyAny>> {
        perform(slf, Task::RunText { text, name, inputs: with_values(inputs)? })
    }

    /// Calls a function of the language or of the script.
    #[pyo3(signature = (name, *arguments))]
    fn call(
        slf: &Bound<'_, Self>,
        name: &str,
        arguments: &Bound<'_, PyTuple>,
    ) -> PyResult<Py<PyAny>> {
        let values = values(slf, arguments)?;
        perform(slf, Task::Evaluate { expression: expressions::function(name, &values), values })
    }

    /// Calls a method of an object.
    #[pyo3(signature = (name, receiver, *arguments))]
    fn call_method(
        slf: &Bound<'_, Self>,
        name: &str,
        receiver: &Bound<'_, PyAny>,
        arguments: &Bound<'_, PyTuple>,
    ) -> PyResult<Py<PyAny>> {
        let mut all = vec![from_python(slf, receiver)?];
        all.extend(values(slf, arguments)?);
        perform(slf, Task::Evaluate { expression: expressions::method(name, &all), values: all })
    }

    /// Reads a property of an object.
    fn read_property(
        slf: &Bound<'_, Self>,
        name: &str,
        receiver: &Bound<'_, PyAny>,
    ) -> PyResult<Py<PyAny>> {
        let values = vec![from_python(slf, receiver)?];
        perform(slf, Task::Evaluate { expression: format!("a0.{name}"), values })
    }

    /// Names of the variables.
    fn names(slf: &Bound<'_, Self>) -> PyResult<Py<PyAny>> {
        perform(slf, Task::Names)
    }

    /// Value of a variable; None for unknown names.
    fn read(slf: &Bound<'_, Self>, name: String) -> PyResult<Py<PyAny>> {
        perform(slf, Task::Read { name })
    }

    /// Sets a variable.
    fn define(
        slf: &Bound<'_, Self>,
        name: String,
        value: &Bound<'_, PyAny>,
    ) -> PyResult<Py<PyAny>> {
        if !is_input_name(&name) {
            return Err(PyValueError::new_err(format!("'{name}' is not a name: {NAMES}")));
        }
        let value = from_python(slf, value)?;
        perform(slf, Task::Define { name, value })
    }

    /// Paths of the written files.
    fn files(slf: &Bound<'_, Self>) -> PyResult<Py<PyAny>> {
        perform(slf, Task::Files)
    }

    /// Messages of the failed checks.
    fn failed_checks(slf: &Bound<'_, Self>) -> PyResult<Py<PyAny>> {
        perform(slf, Task::FailedChecks)
    }

    /// Stops the running task after its present step.
    fn interrupt(&self) {
        self.interrupt.store(true, Ordering::Relaxed);
    }

    fn __traverse__(&self, visit: PyVisit<'_>) -> Result<(), PyTraverseError> {
        self.functions().iter().try_for_each(|(_, function)| visit.call(function))?;
        visit.call(&*self.listener())
    }

    fn __clear__(&self) {
        let functions = std::mem::take(&mut *self.functions());
        let listener = self.listener().take();
        drop((functions, listener));
    }
}

impl NativeSession {
    /// Releases a kept value.
    pub fn release(&self, number: u64) {
        // The values of a session that has ended are released already.
        let _ = self.requests.send(Request::Update(Update::Release(number)));
    }

    /// Registers a Python function, and returns its number.
    pub fn register(&self, function: Py<PyAny>) -> u64 {
        let number = self.last_function.fetch_add(1, Ordering::Relaxed);
        self.functions().push((number, function));
        number
    }

    fn send(&self, request: Request) -> PyResult<()> {
        self.requests.send(request).map_err(|_| ended())
    }

    fn forward_line(&self, py: Python<'_>, stream: Stream, line: &str) -> PyResult<()> {
        let stream = match stream {
            Stream::Printed => "printed",
            Stream::Notes => "notes",
        };
        let listener = self.listener().as_ref().map(|listener| listener.clone_ref(py));
        listener.map_or(Ok(()), |listener| listener.call1(py, (stream, line)).map(drop))
    }

    fn function(&self, py: Python<'_>, number: u64) -> PyResult<Py<PyAny>> {
        let functions = self.functions();
        let function = functions.iter().find(|(of, _)| *of == number);
        let function = function.map(|(_, function)| function.clone_ref(py));
        function.ok_or_else(|| PyRuntimeError::new_err("the function is not registered"))
    }

    fn functions(&self) -> MutexGuard<'_, Vec<(u64, Py<PyAny>)>> {
        self.functions.lock().unwrap_or_else(PoisonError::into_inner)
    }

    fn listener(&self) -> MutexGuard<'_, Option<Py<PyAny>>> {
        self.listener.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

/// Performs a task and returns its result. Ctrl-C stops the task; a second Ctrl-C no longer waits for it.
fn perform(session: &Bound<'_, NativeSession>, task: Task) -> PyResult<Py<PyAny>> {
    let (py, own) = (session.py(), session.get());
    let (sender, mut messages) = channel();
    own.send(Request::Perform(task, sender))?;
    let mut raised = Raised::default();
    loop {
        let received;
        (messages, received) = wait(py, messages);
        let handled = match received {
            Ok(Message::Done(result)) => return finish(session, result, raised),
            Ok(Message::Line(stream, line)) => own.forward_line(py, stream, &line),
            Ok(Message::Call { call, function, arguments }) => {
                let result = call_function(session, function, arguments).map_err(|error| {
                    let message = error.to_string();
                    raised.in_function = Some((message.clone(), error));
                    message
                });
                own.send(Request::Update(Update::Answer { call, result }))
            }
            Err(RecvTimeoutError::Timeout) => Ok(()),
            Err(RecvTimeoutError::Disconnected) => return Err(ended()),
        };
        if let Err(error) = handled.and_then(|()| py.check_signals()) {
            if raised.ending.is_some() {
                return Err(error);
            }
            raised.ending = Some(error);
            own.interrupt();
        }
    }
}

/// Waits for a message without the global interpreter lock, and returns the receiver with the message.
/// The receiver is passed by value, because threads cannot share it.
fn wait(
    py: Python<'_>,
    messages: Receiver<Message>,
) -> (Receiver<Message>, Result<Message, RecvTimeoutError>) {
    py.detach(move || {
        let received = messages.recv_timeout(BETWEEN_SIGNAL_CHECKS);
        (messages, received)
    })
}

fn call_function(
    session: &Bound<'_, NativeSession>,
    function: u64,
    arguments: Vec<Value>,
) -> PyResult<Value> {
    let py = session.py();
    let function = session.get().function(py, function)?;
    let arguments = arguments.into_iter().map(|value| to_python(session, value));
    let arguments = PyTuple::new(py, arguments.collect::<PyResult<Vec<_>>>()?)?;
    from_python(session, &function.bind(py).call1(arguments)?)
}

fn finish(
    session: &Bound<'_, NativeSession>,
    result: Result<Value, Failure>,
    raised: Raised,
) -> PyResult<Py<PyAny>> {
    if let Some(exception) = raised.ending {
        return Err(exception);
    }
    match result {
        Ok(value) => Ok(to_python(session, value)?.unbind()),
        Err(Failure::Interrupted) => Err(PyKeyboardInterrupt::new_err("the run was interrupted")),
        Err(Failure::Script(failure)) => match raised.in_function {
            Some((message, exception)) if message == failure.message => Err(exception),
            _ => Err(script_error(session.py(), failure)?),
        },
    }
}

fn values(
    session: &Bound<'_, NativeSession>,
    arguments: &Bound<'_, PyTuple>,
) -> PyResult<Vec<Value>> {
    arguments.iter().map(|argument| from_python(session, &argument)).collect()
}

fn with_values(inputs: Vec<(String, String)>) -> PyResult<Inputs> {
    let settings = inputs.into_iter().map(|(name, text)| InputSetting { name, text });
    Inputs::new(settings.collect()).map_err(PyValueError::new_err)
}

fn ended() -> PyErr {
    PyRuntimeError::new_err("the thread of the session has ended, or could not be started")
}

fn script_error(py: Python<'_>, failure: ScriptFailure) -> PyResult<PyErr> {
    let class = py.import("withy._errors")?.getattr("ScriptError")?;
    let ScriptFailure { message, hint, place, report } = failure;
    Ok(PyErr::from_value(class.call1((message, hint, place, report))?))
}
