//! Translation of engine errors to the form shown to the user.

use std::path::Path;

use rhai::{Dynamic, Engine, EvalAltResult, ParseErrorType, Position};

use super::calls::{UnknownName, of_library};
use super::faults::{arithmetic, bounds, mismatch, too_large};
use super::{CallFrame, Callee, Diagnostic, foreign_names, foreign_syntax, locate, parsing};
use crate::script::bindings::catalog::Catalog;
use crate::script::bindings::kind::Scripted;
use crate::script::bindings::parameter_variants::VariantValue;
use crate::script::bindings::register::CONTROLLER_HINT;
use crate::script::bindings::sources::{FOLDER, Sources};
use crate::script::bindings::table::{CallSyntax, FunctionBinding, SETTER};
use crate::script::dialect::naming::not_visible;
use crate::script::library;
use crate::script::messages::brief::brief;
use crate::script::messages::error::{BUG, CallPart, Failure};
use crate::script::messages::nouns::{type_word, with_article};
use crate::script::messages::stop::Stop;
use crate::script::messages::suggest::nearest;
use crate::script::source::outline::ScriptOutline;
use crate::script::source::program::Program;

/// Translator of engine errors.
pub struct Explainer<'a> {
    /// Script that was run.
    pub program: &'a Program,
    /// Catalog of the language.
    pub catalog: &'a Catalog,
    /// Engine that ran the script.
    pub engine: &'a Engine,
}

struct Unwrapped<'e> {
    inner: &'e EvalAltResult,
    program: Program,
    trace: Vec<CallFrame>,
    called_at: Option<(Program, Position)>,
    /// Position from which the standard library was called; `None` if the error did not occur in the library.
    library_called_at: Option<(Program, Position)>,
}

type Diagnosis = (String, Option<String>);

/// Returns true if the run was stopped from outside, not by a limit.
pub fn is_interrupt(error: &EvalAltResult) -> bool {
    match error.unwrap_inner() {
        EvalAltResult::ErrorTerminated(stop, _) => {
            matches!(Stop::of_token(stop), Stop::Interrupt | Stop::PipeClosed)
        }
        _ => false,
    }
}

/// Returns true if a dry run ended because the script waits for a result that only a real run computes.
pub fn is_waiting(error: &EvalAltResult) -> bool {
    match error.unwrap_inner() {
        EvalAltResult::ErrorTerminated(stop, _) => matches!(Stop::of_token(stop), Stop::Waiting),
        _ => false,
    }
}

const PLAIN: &str =
    "value_of(x) is the number without its derivatives; int(x) and round(x) are whole numbers";

impl Explainer<'_> {
    /// Translates `error` to the form shown to the user.
    pub fn explain(&self, error: &EvalAltResult) -> Diagnostic {
        let Unwrapped { inner, program, mut trace, called_at, library_called_at } =
            self.unwrap(error);
        if let EvalAltResult::ErrorSystem(message, mark) = inner
            && mark.to_string() == BUG
        {
            return Diagnostic { trace, ..Diagnostic::internal_error(message) };
        }
        if let EvalAltResult::ErrorParsing(kind, at) = inner
            && let Some(cure) = foreign_syntax::explain(&program, self.catalog, kind, *at)
        {
            let location = match cure.at.is_none() {
                true => Some(locate::end_of(&program, &program.text)),
                false => locate::word_at(&program, cure.at),
            };
            return Diagnostic {
                hint: Some(brief(cure.hint)),
                location,
                trace,
                ..Diagnostic::general(cure.message)
            };
        }
        let outline = ScriptOutline::of(&program.text);
        let (message, hint) = self.words(inner, &program, &outline, &trace);
        let is_of_engine = !matches!(inner, EvalAltResult::ErrorRuntime(..));
        let plain =
            (is_of_engine && message.contains(VariantValue::NAME)).then(|| PLAIN.to_owned());
        let hint = plain.or(hint).map(brief);
        if let Some((caller, at)) = library_called_at {
            let file = Some(program.name.clone());
            let line = inner.position().line();
            trace.insert(0, CallFrame { callee: Callee::Library, line, file });
            let place = match inner {
                EvalAltResult::ErrorRuntime(payload, _) => payload.read_lock::<Failure>(),
                _ => None,
            };
            let place = match place.map(|failure| failure.place.clone()) {
                Some(CallPart::Key(key)) => CallPart::Key(key),
                _ => CallPart::Call,
            };
            let location = locate::part_of_call(&caller, self.catalog, at, &place);
            return Diagnostic { hint, location, trace, ..Diagnostic::general(message) };
        }
        let location = self.location(inner, &program).or_else(|| {
            let (caller, at) = called_at.as_ref()?;
            locate::word_at(caller, *at)
        });
        Diagnostic { hint, location, trace, ..Diagnostic::general(message) }
    }

    fn unwrap<'e>(&self, error: &'e EvalAltResult) -> Unwrapped<'e> {
        let sources = Sources::of(self.engine);
        let mut trace = Vec::new();
        let mut program = self.program.clone();
        let mut inner = error;
        let mut called_at = None;
        let mut library_called_at = None;
        loop {
            let (callee, file, cause, at) = match inner {
                EvalAltResult::ErrorInFunctionCall(name, source, cause, at) => {
                    let callee = match name.starts_with("anon$") {
                        true => Callee::Closure,
                        false => Callee::Function(name.clone()),
                    };
                    (callee, sources.find(name, source), cause, at)
                }
                EvalAltResult::ErrorInModule(path, cause, at) => {
                    (Callee::File(path.clone()), Some(path.clone()), cause, at)
                }
                _ => return Unwrapped { inner, program, trace, called_at, library_called_at },
            };
            let caller = (program.name != self.program.name).then(|| program.name.clone());
            trace.insert(0, CallFrame { callee, line: at.line(), file: caller });
            called_at = Some((program.clone(), *at));
            if let Some(file) = file {
                library_called_at = match file.starts_with(FOLDER) {
                    true => library_called_at.or(called_at.clone()),
                    false => None,
                };
                program = source(self.program, &file);
            }
            inner = cause;
        }
    }

    fn location(&self, error: &EvalAltResult, program: &Program) -> Option<super::Location> {
        match error {
            EvalAltResult::ErrorRuntime(payload, at) if payload.is::<Failure>() => {
                let failure = payload.read_lock::<Failure>()?;
                locate::part_of_call(program, self.catalog, *at, &failure.place)
            }
            EvalAltResult::ErrorParsing(ParseErrorType::UnexpectedEOF, _) => {
                Some(locate::end_of(program, &program.text))
            }
            EvalAltResult::ErrorParsing(ParseErrorType::MissingToken(token, _), at)
                if token == ";" =>
            {
                Some(locate::end_of(program, locate::text_before(program, *at)))
            }
            other => locate::word_at(program, other.position()),
        }
    }

    fn words(
        &self,
        error: &EvalAltResult,
        program: &Program,
        outline: &ScriptOutline,
        trace: &[CallFrame],
    ) -> Diagnosis {
        use EvalAltResult as Error;
        let sources = Sources::of(self.engine);
        let unknown = UnknownName { catalog: self.catalog, program, outline, sources: &sources };
        match error {
            Error::ErrorParsing(kind, at) => parsing::explain(kind, &word_of(program, *at)),
            Error::ErrorFunctionNotFound(signature, at) => unknown.function(signature, *at),
            Error::ErrorDotExpr(text, _) => unknown.property(text),
            Error::ErrorVariableNotFound(name, at) => {
                let before = locate::text_before(program, *at).trim_end();
                match before.ends_with("import") {
                    true => not_imported(name),
                    false => self.variable(name, outline, trace),
                }
            }
            Error::ErrorModuleNotFound(name, _) => unknown.module(name),
            Error::ErrorPropertyNotFound(key, _) => missing_key(key, outline),
            Error::ErrorRuntime(payload, _) => self.diagnose_thrown(payload),
            Error::ErrorMismatchDataType(wanted, got, _)
            | Error::ErrorMismatchOutputType(wanted, got, _) => mismatch(wanted, got),
            Error::ErrorArrayBounds(length, index, _) => {
                let hint = "indices count from 0; array[-1] is the last";
                (bounds("array", *length, *index), Some(hint.into()))
            }
            Error::ErrorStringBounds(length, index, _) => (bounds("text", *length, *index), None),
            Error::ErrorIndexingType(access, _) => {
                let indexed = access.split(" [").next().unwrap_or(access);
                let indexed = type_word(indexed);
                let hint = match indexed {
                    "range" => Some(
                        "use linspace(0, 1, 5) for an array; ranges are for loops and parts \
                            of arrays",
                    ),
                    "beam" => Some(
                        "rod.at(2) is the station at the arc length 2; rod.start, rod.middle and rod.end are stations too",
                    ),
                    "vector" => Some("the components of a vector are v.x and v.y"),
                    "function" => Some("call a function by f.call(x)"),
                    "history" => Some(
                        "write history.column(\"energy\") for a column, history.last(\"energy\") for its last value",
                    ),
                    _ => None,
                };
                (format!("{} cannot be indexed", with_article(indexed)), hint.map(str::to_owned))
            }
            Error::ErrorFor(_) => {
                ("for cannot loop over this value".into(), Some(parsing::FOR_HINT.into()))
            }
            Error::ErrorAssignmentToConstant(name, _) => (
                format!("the constant '{name}' cannot be changed"),
                Some("declare it with let instead of const".into()),
            ),
            Error::ErrorNonPureMethodCallOnConstant(name, _) => {
                let name = name.trim_start_matches(SETTER);
                (
                    format!("'{name}' is a constant and cannot be changed"),
                    Some("declare it with let instead of const".into()),
                )
            }
            Error::ErrorArithmetic(what, _) => arithmetic(what),
            Error::ErrorStackOverflow(_) => (
                "functions call each other too deeply".into(),
                Some("a function may call itself without end; --max-depth N allows more".into()),
            ),
            Error::ErrorDataTooLarge(what, _) => {
                (too_large(what), Some("a loop may add elements without end".into()))
            }
            Error::ErrorDataRace(..) => (
                "a closure uses the object whose method it is passed to".into(),
                Some(format!(
                    "in sim.at, use the argument: sim.at(t, |sim| print(sim.t)); if a map holds \
                    the object, take it out first: let scene = parts.scene; \
                    scene.record(\"height\", |q| q.position(parts.tip).y); {CONTROLLER_HINT}"
                )),
            ),
            Error::ErrorTerminated(stop, _) => Stop::of_token(stop).message_and_hint(),
            Error::ErrorSystem(message, cause) => {
                (format!("{message} {cause}").trim().to_owned(), None)
            }
            other => (plain(other), None),
        }
    }

    fn variable(&self, name: &str, outline: &ScriptOutline, trace: &[CallFrame]) -> Diagnosis {
        let message = format!("there is no variable '{name}' here");
        if let Some((_, own)) = name.rsplit_once("::").filter(|_| !name.starts_with("global::")) {
            let hint = format!("the file must export it: export const {own} = …");
            return (message, Some(hint));
        }
        if let Some((_, line)) = outline.top_level.iter().find(|(known, _)| known == name) {
            let hint = match trace.is_empty() {
                true => format!("'{name}' is declared later, at line {line}"),
                false => not_visible(name, *line),
            };
            return (message, Some(hint));
        }
        let declared = || outline.variables.iter().map(String::as_str);
        let is_own = declared().any(|known| known == name) || nearest(name, declared()).is_some();
        if let Some(found) = foreign_names::find(name).filter(|_| !is_own) {
            return (message, Some(found.cure.into()));
        }
        let is_function = |row: &&FunctionBinding| matches!(row.form, CallSyntax::Function);
        if let Some(row) = self.catalog.named(name).find(is_function) {
            return (
                message,
                Some(format!("'{name}' is a function: call it as {}", row.signature())),
            );
        }
        let known = outline.variables.iter().map(String::as_str).chain(self.catalog.constants());
        let hint = match nearest(name, known) {
            Some(near) => format!("did you mean '{near}'?"),
            None if of_library(name).is_some() => of_library(name).unwrap_or_default(),
            None => format!("declare it first: let {name} = …"),
        };
        (message, Some(hint))
    }

    fn diagnose_thrown(&self, payload: &Dynamic) -> Diagnosis {
        if let Some(failure) = payload.read_lock::<Failure>() {
            return (failure.message.clone(), failure.hint.clone());
        }
        match payload.is_unit() {
            true => ("the script was stopped".into(), None),
            false => (payload.to_string(), None),
        }
    }
}

fn word_of(program: &Program, at: Position) -> String {
    locate::word_at(program, at).map(|place| place.text().to_owned()).unwrap_or_default()
}

/// Message for statements such as `import numpy`, in which Rhai regards the name as a variable.
fn not_imported(name: &str) -> Diagnosis {
    let hint = match foreign_names::find(name) {
        Some(found) => found.cure.to_owned(),
        None => format!(
            "write the name of a file in quotes: import \"{name}\" as {name}; modules of the \
            library: import \"std/sections\" as sections;"
        ),
    };
    (format!("there is no variable '{name}' here"), Some(hint))
}

fn missing_key(key: &str, outline: &ScriptOutline) -> Diagnosis {
    let hint = match nearest(key, outline.keys.iter().map(String::as_str)) {
        Some(near) => format!("did you mean '{near}'?"),
        None => format!("test with \"{key}\" in map before reading it"),
    };
    (format!("the map has no key '{key}'"), Some(hint))
}

fn source(program: &Program, named: &str) -> Program {
    if named.is_empty() || named == program.name {
        return program.clone();
    }
    if let Some(Ok(module)) = library::find(named) {
        return module.program();
    }
    // If the file no longer exists, the error is reported without source lines.
    Program::load(Path::new(named)).unwrap_or_else(|_| Program {
        name: named.into(),
        text: "".into(),
        folder: program.folder.clone(),
    })
}

fn plain(error: &EvalAltResult) -> String {
    let text = error.to_string();
    let end = text.rfind(" (line ").unwrap_or(text.len());
    text[..end].to_owned()
}
