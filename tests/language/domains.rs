//! Test domain, written like a later extension: a type with methods, properties and options, callbacks, errors with hints, files, interrupts and panics.

use std::cell::RefCell;
use std::rc::Rc;
use std::sync::atomic::Ordering;

use rhai::Dynamic;
use withy::script::bindings::call::Call;
use withy::script::bindings::kind::{Kind, NumberRange, Scripted, Type};
use withy::script::bindings::parameter::{
    Parameter, Presence, callback, choice, either, integer, number, options, point, text,
};
use withy::script::bindings::table::{BindingTable, FunctionBinding, function, method, property};
use withy::script::diagnose::Diagnostic;
use withy::script::engine::runner::{Ending, RunOutcome, run};
use withy::script::messages::error::ScriptError;
use withy::script::messages::numbers::as_number;
use withy::script::messages::reports::Reporter;
use withy::script::packages::language;
use withy::script::source::program::Program;
use withy::script::state::settings::{RunMode, RunSettings};

/// Mass on a spring, as a shared handle.
#[derive(Clone)]
struct Spring(Rc<RefCell<State>>);

struct State {
    stiffness: f64,
    length: f64,
}

impl Scripted for Spring {
    const NAME: &'static str = "spring";
    const DOC: &'static str = "A spring for tests.";

    fn show(&self) -> String {
        format!("spring of length {}", self.0.borrow().length)
    }
}

const SPRING: Type = Type::of::<Spring>();

static TABLE: BindingTable = BindingTable {
    name: "springs",
    doc: "",
    types: &[SPRING],
    setup: "",
    constants: &[],
    rows: &[
        function("spring", &[options("options", KEYS)], spring),
        method(SPRING, "pull", &[number("force").unit("force"), PULL], pull),
        method(SPRING, "follow", &[callback("force")], follow),
        method(SPRING, "place", &[point("where")], |_| Ok(Dynamic::UNIT)),
        method(SPRING, "save", &[text("file")], save),
        property(SPRING, "length", |call| Ok(spring_of(call)?.0.borrow().length.into()))
            .writable(&[number("length").positive().unit("length")], set_length),
        property(SPRING, "stiffness", |call| Ok(spring_of(call)?.0.borrow().stiffness.into())),
        function(
            "mesh",
            &[either("spans", &[Kind::Integer(NumberRange::Positive), Kind::Options(MESH)])],
            mesh,
        ),
        function("broken", &[], |_| panic!("out of order")),
        function("forgotten", &[], |call| call.value("nothing")),
        function("work", &[], work),
        function("refuse", &[], |_| Err(std::fmt::Error.into())),
    ],
};

const KEYS: &[Parameter] = &[
    number("stiffness").positive().unit("force/length").doc("force per length"),
    number("length").positive().or(Presence::Number(1.0)),
    choice("end", &["free", "fixed"]).or(Presence::Text("free")),
    options("mesh", MESH).optional(),
];
const MESH: &[Parameter] = &[integer("spans").positive()];
const PULL: Parameter = integer("times").non_negative().or(Presence::Integer(1));

fn spring(call: &mut Call) -> Result<Dynamic, ScriptError> {
    let options = call.options("options")?;
    let state =
        State { stiffness: options.number("stiffness")?, length: options.number("length")? };
    Ok(Dynamic::from(Spring(Rc::new(RefCell::new(state)))))
}

fn spring_of(call: &Call) -> Result<Spring, ScriptError> {
    call.receiver()
}

fn pull(call: &mut Call) -> Result<Dynamic, ScriptError> {
    let spring = spring_of(call)?;
    let (force, times) = (call.number("force")?, call.count("times")?);
    let mut state = spring.0.borrow_mut();
    state.length += times as f64 * force / state.stiffness;
    if state.length <= 0.0 {
        return Err(call.error("the spring has no length left").hint("pull with less force"));
    }
    Ok(state.length.into())
}

fn follow(call: &mut Call) -> Result<Dynamic, ScriptError> {
    let force = call.callback("force")?;
    let value = call.invoke(&force, [Dynamic::from(0.5)])?;
    let number = as_number(&value).filter(|force| force.is_finite());
    let got = || call.describe(&value);
    let force = number
        .ok_or_else(|| call.error(format!("the force must give a finite number, got {}", got())))?;
    Ok(force.into())
}

fn save(call: &mut Call) -> Result<Dynamic, ScriptError> {
    let path = call.context().write_file(&call.text("file")?, b"saved")?;
    Ok(path.display().to_string().into())
}

fn set_length(call: &mut Call) -> Result<Dynamic, ScriptError> {
    spring_of(call)?.0.borrow_mut().length = call.number("length")?;
    Ok(Dynamic::UNIT)
}

fn mesh(call: &mut Call) -> Result<Dynamic, ScriptError> {
    match call.get_if::<i64>("spans") {
        Some(spans) => Ok(spans.into()),
        None => Ok(call.options("spans")?.integer("spans")?.into()),
    }
}

fn work(call: &mut Call) -> Result<Dynamic, ScriptError> {
    call.context().add_reporter(Box::new(Work));
    call.context().interrupt_flag().store(true, Ordering::Relaxed);
    loop {
        call.proceed()?;
    }
}

fn outcome(script: &str) -> RunOutcome {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let settings =
        RunSettings { out: folder.path().join("out"), ..RunSettings::silent(RunMode::Run) };
    run(&Program::named("test", script), &language().and(&TABLE), settings)
}

fn runs(script: &str) {
    let outcome = outcome(script);
    assert!(matches!(outcome.ending, Ending::Finished), "{script}\n{:?}", outcome.ending);
    assert_eq!(outcome.checks.failed(), [], "{script}");
}

fn error(script: &str) -> Diagnostic {
    match outcome(script).ending {
        Ending::Failed(diagnostic) => diagnostic,
        other => panic!("{script}: {other:?}"),
    }
}

/// Column, message and hint of an error.
fn said(script: &str) -> (usize, String, String) {
    let error = error(script);
    (error.location.map_or(0, |at| at.column), error.message, error.hint.unwrap_or_default())
}

#[test]
fn type_page_lists_methods_properties_and_options() {
    runs(
        "let s = spring(#{ stiffness: 2 }); check(s.length == 1); check(s.pull(2) == 2); check(s.pull(2, 3) == 5);",
    );
    runs(
        "let s = spring(#{ stiffness: 2, length: 3, end: \"fixed\", mesh: #{ spans: 4 } }); s.length = 7; check(s.length == 7);",
    );
    runs(
        "let s = spring(#{ stiffness: 2 }); s.length += 1; check(s.length == 2); s.length /= 4; check(s.length == 0.5);",
    );
    runs(
        "let s = spring(#{ stiffness: 2 }); check(`${s}` == \"spring of length 1\"); check(type_of(s) == \"spring\");",
    );
    runs("let s = spring(#{ stiffness: 2 }); s.place([1, 2]); s.place(vec(1, 2));");
    runs("check(mesh(3) == 3 && mesh(#{ spans: 4 }) == 4);");
    runs("const S = spring(#{ stiffness: 2 }); check(S.length == 1 && S.pull(2) == 2);");
}

#[test]
fn wrong_options_are_underlined() {
    let (column, message, hint) = said("spring(#{ stiffnes: 2 });");
    assert_eq!((column, message.as_str()), (11, "spring: unknown option 'stiffnes'"));
    assert_eq!(
        hint,
        "did you mean 'stiffness'? known options: stiffness (required), length, end, mesh"
    );
    let (column, message, hint) = said("spring(#{ length: 1 });");
    assert_eq!((column, message.as_str()), (8, "spring: the option 'stiffness' is missing"));
    assert_eq!(hint, "add stiffness: a positive number [force/length] (force per length)");
    let (column, message, _) = said("spring(#{ stiffness: -3 });");
    assert_eq!(column, 11);
    assert_eq!(message, "spring: 'stiffness' must be a positive number [force/length], got -3");
    let (column, message, _) = said("spring(#{ length: 1, stiffness: 1/0 });");
    assert_eq!(column, 22);
    assert!(message.ends_with("got inf, which is not finite"), "{message}");
    let (_, message, hint) = said("spring(#{ stiffness: 1, end: \"fred\" });");
    assert_eq!(message, "spring: 'end' must be one of \"free\", \"fixed\", got the text \"fred\"");
    assert_eq!(hint, "did you mean \"free\"?");
    let (column, message, _) = said("spring(#{ stiffness: 1, mesh: #{ spans: 0 } });");
    assert_eq!(
        (column, message.as_str()),
        (34, "spring: 'spans' must be a positive whole number, got 0")
    );
    let (_, message, hint) = said("spring(5);");
    assert_eq!(message, "spring: 'options' must be a map of options #{ … }, got 5");
    assert_eq!(hint, "write #{ stiffness: … }");
}

#[test]
fn errors_of_options_in_a_variable_are_located_at_the_call() {
    let (column, message, _) = said("let o = #{ stiffnes: 2 }; spring(o);");
    assert_eq!((column, message.as_str()), (27, "spring: unknown option 'stiffnes'"));
}

#[test]
fn errors_of_wrong_calls_show_the_signature() {
    let s = "let s = spring(#{ stiffness: 2 }); ";
    let (_, message, hint) = said(&format!("{s}s.pull();"));
    assert_eq!(message, "pull takes 1 to 2 arguments, got 0");
    assert!(
        hint.starts_with("write spring.pull(force, [times])\nforce: a number [force]"),
        "{hint}"
    );
    let (_, message, hint) = said(&format!("{s}s.pul(1);"));
    assert_eq!(message, "a spring has no method 'pul'");
    assert_eq!(hint, "did you mean 'pull'? spring.pull(force, [times])");
    let (_, message, hint) = said("let x = 1; x.pull(2);");
    assert_eq!(message, "a whole number has no method 'pull'");
    assert_eq!(hint, "'pull' belongs to a spring: spring.pull(force, [times])");
    let (_, message, _) = said(&format!("{s}s.stiffness = 3;"));
    assert_eq!(message, "'stiffness' of a spring cannot be assigned");
    let (_, message, _) = said(&format!("{s}s.length = -3;"));
    assert_eq!(message, "length: 'length' must be a positive number [length], got -3");
    let (_, message, hint) = said(&format!("{s}print(s.lenght);"));
    assert_eq!(
        (message.as_str(), hint.as_str()),
        ("a spring has no property 'lenght'", "did you mean 'length'? spring.length")
    );
}

#[test]
fn errors_of_bindings_have_hints_and_errors_of_lower_layers_keep_their_messages() {
    let (_, message, hint) = said("spring(#{ stiffness: 2 }).pull(-100);");
    assert_eq!(
        (message.as_str(), hint.as_str()),
        ("pull: the spring has no length left", "pull with less force")
    );
    let (_, message, _) = said("refuse();");
    assert_eq!(message, std::fmt::Error.to_string());
}

#[test]
fn callbacks_keep_their_own_errors_and_positions() {
    runs("let k = 4; check(spring(#{ stiffness: 2 }).follow(|t| k * t) == 2);");
    runs("check(spring(#{ stiffness: 2 }).follow(|t| 1) == 1);");
    let (_, message, _) = said("spring(#{ stiffness: 2 }).follow(|t| \"a\");");
    assert_eq!(message, "follow: the force must give a finite number, got the text \"a\"");
    let error = error("spring(#{ stiffness: 2 }).follow(|t|\n    sqrt(\"a\"));");
    assert_eq!(error.location_text().as_deref(), Some("test:2:10"));
    assert_eq!(error.message, "sqrt: 'x' must be a number, got the text \"a\"");
    assert_eq!(error.trace.len(), 1);
}

#[test]
fn internal_errors_are_reported_as_bugs() {
    for script in ["broken();", "forgotten();"] {
        let error = error(script);
        assert!(error.message.starts_with("internal error of withy"), "{}", error.message);
        assert!(error.hint.is_some_and(|hint| hint.contains("report")));
    }
}

#[test]
fn an_interrupt_ends_native_loops_and_cannot_be_caught() {
    for script in ["work();", "try { work(); } catch { }"] {
        let outcome = outcome(script);
        assert!(matches!(outcome.ending, Ending::Interrupted), "{:?}", outcome.ending);
        assert_eq!(outcome.simulations, [serde_json::json!({ "name": "work" })]);
    }
}

#[test]
fn files_stay_in_the_output_folder() {
    assert_eq!(outcome("spring(#{ stiffness: 2 }).save(\"a.txt\");").files.len(), 1);
    let (_, message, _) = said("spring(#{ stiffness: 2 }).save(\"../a.txt\");");
    assert_eq!(message, "\"../a.txt\" is not the name of a file in the output folder");
}

#[test]
fn signatures_show_optional_parameters() {
    let signature =
        |name: &str| TABLE.rows.iter().find(|row| row.name == name).map(FunctionBinding::signature);
    assert_eq!(signature("pull").as_deref(), Some("spring.pull(force, [times])"));
    assert_eq!(signature("spring").as_deref(), Some("spring(options)"));
    assert_eq!(signature("length").as_deref(), Some("spring.length"));
}

struct Work;

impl Reporter for Work {
    fn report(&self) -> serde_json::Value {
        serde_json::json!({ "name": "work" })
    }

    fn object(&self) -> rhai::Dynamic {
        rhai::Dynamic::UNIT
    }

    fn is_in_use(&self) -> bool {
        true
    }

    fn remains(&self, _numbers: usize) -> Option<(String, String)> {
        None
    }
}
