//! Inspection commands of the prompt: output of `:plot`, `:time` and `name?`, and their absence of side effects.
#![allow(clippy::unwrap_used)]

use std::cell::{Cell, RefCell};
use std::rc::Rc;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::Duration;

use crate::common::notepad::Notepad;
use withy::output::{Colours, Glyphs, TerminalStyle};
use withy::repl::clock::Clock;
use withy::repl::pager::{Pager, PagerOutcome};
use withy::repl::session::Session;
use withy::repl::shell::{CommandOutcome, ReplyTarget, Shell};
use withy::script::packages::language;
use withy::script::state::settings::{RunMode, RunSettings};

struct Prompt {
    shell: Shell,
    printed: Notepad,
    message: Notepad,
    interrupt: Arc<AtomicBool>,
}

const SPINNING: &str = "let scene = new_scene(\"spin\");
let s = section(#{ EA: 1e4, GA: 1e4, EI: 100, rho_A: 1, rho_I: 10 });
let rod = scene.beam(#{ axis: line([0, 0], [2, 0]), basis: bspline(4), section: s, spin: 1 });
let sim = scene.start(#{ dt: 0.1 });";

const MEGABYTE: usize = 1_000_000;

impl Prompt {
    fn with(snapshots: usize, screen: ReplyTarget) -> Self {
        let (printed, message) = (Notepad::default(), Notepad::default());
        let interrupt = Arc::new(AtomicBool::new(false));
        let folder = tempfile::tempdir().unwrap();
        let settings = RunSettings {
            printed: Box::new(printed.clone()),
            diagnostics: Box::new(message.clone()),
            interrupt: interrupt.clone(),
            out: folder.keep(),
            snapshots,
            ..RunSettings::silent(RunMode::Run)
        };
        let session = Session::new(language(), settings).unwrap();
        let clock = Ticks { now: Cell::new(Duration::ZERO) };
        let shell = Shell::new(session, screen).with_clock(Rc::new(clock));
        Self { shell, printed, message, interrupt }
    }

    fn new() -> Self {
        Self::with(MEGABYTE, ReplyTarget::Pipe)
    }

    fn spinning() -> Self {
        let mut prompt = Self::new();
        prompt.ask(SPINNING);
        prompt
    }

    /// Output and messages of an input that succeeds.
    fn ask_both(&mut self, input: &str) -> (String, String) {
        let outcome = self.shell.submit(input);
        let (printed, message) = (self.printed.take(), self.message.take());
        assert_eq!(outcome, CommandOutcome::Success, "{input}: {printed}{message}");
        (printed, message)
    }

    fn ask(&mut self, input: &str) -> String {
        self.ask_both(input).0
    }

    /// Messages of an input that fails.
    fn refusal(&mut self, input: &str) -> String {
        let outcome = self.shell.submit(input);
        assert_eq!(outcome, CommandOutcome::Failed, "{input}: {}", self.printed.take());
        self.printed.take();
        self.message.take()
    }
}

/// Clock that advances by a millisecond at each query, so that the test counts work instead of time.
struct Ticks {
    now: Cell<Duration>,
}

impl Clock for Ticks {
    fn now(&self) -> Duration {
        self.now.set(self.now.get() + Duration::from_millis(1));
        self.now.get()
    }
}

#[test]
fn expression_is_plotted_over_all_states_without_changing_the_simulation() {
    let mut prompt = Prompt::spinning();
    prompt.ask(":step 10");
    let path: Vec<String> = (0..=10)
        .map(|step| {
            let at = prompt.ask(&format!(
                "{{ let f = sim.fork(); f.back({}); f.position(rod.end).x }}",
                10 - step
            ));
            at.trim().to_owned()
        })
        .collect();
    prompt.ask("sim.step(0)");
    let before = prompt.ask("`${sim.t} ${sim.steps} ${sim.energy} ${sim.history.rows}`");
    let (reply, message) = prompt.ask_both(":plot sim.position(rod.end).x");
    assert!(reply.starts_with("sim.position(rod.end).x: 2 at the start, minimum "), "{reply}");
    assert!(reply.contains("(11 states)"), "{reply}");
    let now: f64 = path.last().unwrap().parse().unwrap();
    assert!(reply.contains(&format!("now {:.5}", now)[..9]), "{reply} {now}");
    assert_eq!(message, "evaluated in all 11 states of simulation 'spin', t = 0 to 1\n");
    assert_eq!(prompt.ask("`${sim.t} ${sim.steps} ${sim.energy} ${sim.history.rows}`"), before);
    // Earlier states are still available.
    prompt.ask(":back 3");
    assert!(prompt.ask(":plot sim.steps").contains("now 7 (8 states)"));
}

#[test]
fn copied_prompts_and_commands_without_a_colon_are_accepted() {
    let mut prompt = Prompt::spinning();
    assert_eq!(prompt.ask("withy:5> 1 + 2").trim(), "3");
    prompt.ask("withy:6> step 3");
    prompt.ask("run 1");
    assert_eq!(prompt.ask("sim.t").trim(), "1");
    let message = prompt.refusal("withy:x> 1");
    assert!(!message.is_empty());
}

#[test]
fn history_in_each_state_ends_at_that_state() {
    let mut prompt = Prompt::spinning();
    prompt.ask(":step 4");
    let rows = prompt.ask(":plot sim.history.rows");
    assert!(rows.contains("1 at the start, minimum 1, maximum 5, now 5 (5 states)"), "{rows}");
    // Through another variable, and through a function.
    prompt.ask("let other = sim; fn tip() { latest_simulation().t }");
    for same in [
        "other.t",
        "tip()",
        "latest_simulation().t",
        "if true { sim.t } else { 0 }",
        "[sim].map(|s| s.t)[0]",
    ] {
        let reply = prompt.ask(&format!(":plot {same}"));
        assert!(
            reply.contains("0 at the start, minimum 0, maximum 0.4, now 0.4"),
            "{same}: {reply}"
        );
    }
}

#[test]
fn vector_gives_two_curves_and_commas_separate_expressions() {
    let mut prompt = Prompt::spinning();
    prompt.ask(":step 3");
    let reply = prompt.ask(":plot energy, sim.position(rod.end), 2 * sim.t");
    let names: Vec<&str> = reply.lines().map(|line| line.split(": ").next().unwrap()).collect();
    assert_eq!(
        names,
        ["energy", "sim.position(rod.end).x", "sim.position(rod.end).y", "2 * sim.t"]
    );
    // Column names need no commas.
    assert_eq!(prompt.ask(":plot kinetic strain #{ y_log: true }").lines().count(), 2);
    let labelled =
        prompt.ask(":plot kinetic, 2 * sim.t, #{ labels: [\"one\", \"two\"], title: \"both\" }");
    assert_eq!(labelled.lines().count(), 2, "{labelled}");
    let message = prompt.refusal(":plot energy, #{ y_lag: true }");
    assert!(message.contains("unknown option 'y_lag'") && message.contains("y_log"), "{message}");
    let message = prompt.refusal(":plot energy #{ y_limits: [2, 1] }");
    assert!(message.contains(":plot: 'y_limits' must be [low, high], got [2, 1]"), "{message}");
    assert_eq!(prompt.ask(":plot kinetic strain").lines().count(), 2);
    assert_eq!(prompt.ask(":plot \"kinetic\", strain").lines().count(), 2);
    assert_eq!(prompt.ask(":plot").lines().count(), 3);
}

#[test]
fn arrays_are_plotted_without_a_simulation() {
    let mut prompt = Prompt::new();
    let of = |prompt: &mut Prompt, text: &str| prompt.ask(&format!(":plot {text}"));
    let squares = of(&mut prompt, "[0, 1, 2, 3].map(|x| x ^ 2)");
    assert!(
        squares.ends_with("0 at the first, minimum 0, maximum 9, 9 at the last (4 points)\n"),
        "{squares}"
    );
    prompt.ask("let x = [1, 2]; let y = [3, 4];");
    assert!(of(&mut prompt, "[x, y]").contains("3 at the first, minimum 3, maximum 4"));
    assert_eq!(of(&mut prompt, "x, y").lines().count(), 2);
    assert!(of(&mut prompt, "[vec(0, 1), vec(1, 5)]").contains("maximum 5"));
    let message = prompt.refusal(":plot x, [x, y]");
    assert!(
        message.contains("the index of an array") && message.contains("one after the other"),
        "{message}"
    );
}

#[test]
fn terminal_shows_a_chart_and_text() {
    let style =
        TerminalStyle { glyphs: Glyphs::Ascii, colours: Colours::None, width: 60, height: 12 };
    let mut prompt = Prompt::with(MEGABYTE, ReplyTarget::Terminal(style));
    prompt.ask(SPINNING);
    prompt.ask(":step 5");
    let (chart, message) = prompt.ask_both(":plot 10 * sim.t, energy");
    assert!(chart.starts_with("10 * sim.t, energy\na 10 * sim.t   b energy\n"), "{chart}");
    assert!(message.contains("in all 6 states"), "{message}");
    for units in [":plot energy momentum_x", ":plot energy, momentum_x, #{ x_log: false }"] {
        let charts = prompt.ask(units);
        let headings: Vec<&str> =
            charts.lines().filter(|line| line.starts_with(char::is_alphabetic)).collect();
        assert!(
            matches!(headings[..], [a, b] if a.starts_with("energy") && b.starts_with("momentum")),
            "{charts}"
        );
    }
    let message = prompt.refusal(":plot energy momentum_x #{ y_limits: [0, 1] }");
    assert!(
        message.contains("'y_limits' is for one axis, but the columns have 2 units"),
        "{message}"
    );
}

#[test]
fn doubtful_expressions_get_a_note() {
    let mut prompt = Prompt::spinning();
    for (input, note) in [
        ("let n = 7 // 2\n;", "column 11: // begins a comment"),
        ("let a = 2; let words = \"a is {a}\";", "write `… ${a} …` in backticks"),
        ("let sum = [1, 2] + [3, 4];", "vec(1, 2) + [3, 4]"),
        ("scene.force(rod.end, [0, -5], 2.5);", "hold_for(2.5)"),
        ("scene.moment(rod.end, max(1, 2), 2.5, #{ name: \"turn\" });", "moment: 2.5 is a factor"),
    ] {
        let (_, message) = prompt.ask_both(input);
        assert!(message.contains("note: line") && message.contains(note), "{input}: {message}");
    }
    for input in [
        "let n = 7; // 2",
        "let n = 7 // 2 elements\n;",
        "let words = \"{} {1}\";",
        "let joined = [1, 2] + [3, 4, 5];",
        "let joined = [[1, 2]] + [[3, 4]];",
        "scene.force(rod.end, [0, -5], 1);",
        "scene.force(rod.end, [0, -5], hold_for(2.5));",
        "scene.moment(rod.end, 2.5);",
    ] {
        let (_, message) = prompt.ask_both(input);
        assert!(!message.contains("note: line"), "{input}: {message}");
    }
}

#[test]
fn values_that_cannot_be_plotted_are_rejected_with_a_suggestion() {
    let mut prompt = Prompt::spinning();
    prompt.ask(":step 2");
    prompt.ask("let twin = scene.start(#{ dt: 0.2 }); sim.step(0);");
    for (text, why, hint) in [
        ("2 + 3", "is a single number, not a curve", "an expression with a simulation"),
        ("rod", "it is a beam", "plot a number or a vector"),
        ("sim.t > 0", "it is a truth value", "{ 1 } else { 0 }"),
        ("sim.enrgy", "enrgy", "did you mean"),
        ("enrgy", "the history has no column \"enrgy\"", "did you mean \"energy\"?"),
        ("sim.step()", "advances a simulation", "an expression that changes nothing"),
        ("{ sim.step(); sim.t }", "advances a simulation", "an expression that changes nothing"),
        ("sim.t - twin.t", "uses two simulations", "comma"),
        ("[1, \"a\"]", "with entries that are not numbers", "array of numbers"),
        ("[]", "empty array", "array of numbers"),
        ("let a = 1;", "has no value", "expression"),
        ("sim.t, [1, 2]", "over the index of an array", "one after the other"),
        ("if sim.t < 0.15 { \"a\" } else { 1 }", "cannot be plotted at t = 0.1", "at all times"),
        ("1 / if sim.t < 0.15 { throw \"early\" } else { 1 }", "fails at t = 0.1", ""),
    ] {
        let message = prompt.refusal(&format!(":plot {text}"));
        assert!(message.contains(why) && message.contains(hint), "{text}: {message}");
    }
    assert_eq!(prompt.ask("`${sim.steps} ${twin.steps}`"), "\"2 0\"\n");
    let message = Prompt::new().refusal(":plot nothing_there");
    assert!(message.contains("there is no variable 'nothing_there'"), "{message}");
}

#[test]
fn column_is_preferred_to_a_variable_of_its_name_with_a_note() {
    let mut prompt = Prompt::spinning();
    prompt.ask(":step 2; let energy = [1, 2, 3];".strip_prefix(":step 2; ").unwrap());
    let (reply, message) = prompt.ask_both(":plot energy");
    assert!(
        reply.starts_with("energy [energy]: ") && message.contains("write (energy)"),
        "{message}"
    );
    assert!(prompt.ask(":plot (energy)").contains("(3 points)"));
}

#[test]
fn generated_input_is_not_quoted_and_a_single_state_is_no_curve() {
    let style =
        TerminalStyle { glyphs: Glyphs::Ascii, colours: Colours::None, width: 50, height: 14 };
    let mut prompt = Prompt::with(MEGABYTE, ReplyTarget::Terminal(style));
    prompt.ask(SPINNING);
    for curves in [":plot energy", ":plot sim.position(rod.end).x"] {
        let (reply, message) = prompt.ask_both(curves);
        assert!(
            reply.contains("at the start") && message.contains("one state so far"),
            "{reply}{message}"
        );
    }
    prompt.ask(":step 2e0");
    for (input, expected) in [
        (":run 0", "cannot run to t = 0"),
        (":back 1e7", "cannot go back 10000000 steps"),
        (":plot 0.0/0.0", "no finite value"),
    ] {
        assert_eq!(prompt.shell.submit(input), CommandOutcome::Failed);
        let said = format!("{}{}", prompt.message.take(), prompt.printed.take());
        assert!(said.contains(expected) && !said.contains("prompt:"), "{input}: {said}");
    }
    prompt.ask("let words = \"a text that is far too long for the screen of a telephone\";");
    let listed = prompt.ask(":vars");
    assert!(listed.lines().all(|line| line.chars().count() <= 50), "{listed}");
    let (_, message) = prompt.ask_both("scene.gravity([0, -9.81]); scene.gravity([0, -9.81]);");
    assert_eq!(message, "");
    let (_, message) = prompt.ask_both("scene.gravity([0, -1.62]);");
    assert!(message.contains("was (0, -9.81) and is now (0, -1.62)"), "{message}");
}

#[test]
fn run_is_repeated_and_compared_if_states_were_dropped() {
    let mut prompt = Prompt::with(0, ReplyTarget::Pipe);
    prompt.ask(SPINNING);
    prompt.ask(":step 10");
    prompt.ask("sim.run_to(1.55);");
    let (reply, message) = prompt.ask_both(":plot sim.position(rod.end).x");
    assert!(reply.contains("2 at the start") && reply.contains("(17 states)"), "{reply}");
    assert!(message.contains("repeated in a copy, with identical energies"), "{message}");
    let mut kept = Prompt::spinning();
    kept.ask(":step 10");
    kept.ask("sim.run_to(1.55);");
    assert_eq!(kept.ask(":plot sim.position(rod.end).x"), reply, "both ways see the same states");

    // A load function with another value gives another run, which a message reports.
    let mut changed = Prompt::with(0, ReplyTarget::Pipe);
    changed.ask(SPINNING);
    changed.ask("let f = 1; scene.force(rod.end, [1, 0], schedule(|t| f)); let sim = scene.start(#{ dt: 0.1 });");
    changed.ask(":step 4");
    changed.ask("f = 2;");
    let (reply, message) = changed.ask_both(":plot sim.t");
    assert!(message.contains("the repeated run differs at t = 0.1"), "{message}");
    assert!(
        message.contains("in the last 1 states") && reply.contains("(1 state)"),
        "{message}{reply}"
    );
}

#[test]
fn scheduled_functions_are_called_only_by_the_simulation() {
    let mut prompt = Prompt::with(0, ReplyTarget::Pipe);
    prompt.ask(SPINNING);
    prompt.ask(
        "sim.at(0.25, |s| print(`event at ${s.t}`)); sim.at(0.6, |s| print(`late at ${s.t}`));",
    );
    assert_eq!(prompt.ask("sim.run_to(0.5);"), "event at 0.25\n");
    let reply = prompt.ask(":plot sim.t");
    assert!(!reply.contains("event") && reply.contains("now 0.5 (7 states)"), "{reply}");
    prompt.refusal(":plot { sim.run_to(0.9); sim.t }");
    assert_eq!(prompt.ask("sim.run_to(0.7);"), "late at 0.6\n", "it still waits");
}

#[test]
fn many_states_are_thinned_out_with_a_note() {
    let mut prompt = Prompt::with(100 * MEGABYTE, ReplyTarget::Pipe);
    prompt.ask(SPINNING);
    prompt.ask("sim.step(2500);");
    let (reply, message) = prompt.ask_both(":plot sim.steps");
    assert!(reply.contains("0 at the start") && reply.contains("now 2500 (835 states)"), "{reply}");
    assert!(message.contains("in 835 of the 2501 states"), "{message}");
}

#[test]
fn interrupt_while_plotting_restores_the_simulation() {
    let mut prompt = Prompt::spinning();
    prompt.ask(":step 5");
    let flag = prompt.interrupt.clone();
    // Interrupts during the evaluation of an expression, with repeated signals for slow machines.
    let is_over = Arc::new(AtomicBool::new(false));
    let over = Arc::clone(&is_over);
    let setter = std::thread::spawn(move || {
        while !over.load(Ordering::Relaxed) {
            std::thread::sleep(Duration::from_millis(300));
            flag.store(true, Ordering::Relaxed);
        }
    });
    let outcome = prompt.shell.submit(":plot { let i = 0; while true { i += 1 } sim.t }");
    is_over.store(true, Ordering::Relaxed);
    setter.join().unwrap();
    prompt.interrupt.store(false, Ordering::Relaxed);
    assert_eq!(outcome, CommandOutcome::Interrupted);
    assert_eq!(prompt.ask("sim.steps"), "5\n");
}

#[test]
fn input_without_side_effects_is_timed_until_the_median_is_accurate() {
    let mut prompt = Prompt::new();
    prompt.ask("let x = 1;");
    let (reply, message) = prompt.ask_both(":time { x += 1; x }");
    // The value, the first run, and the other runs. Each query of the clock takes a millisecond.
    let expected = "2\nfirst run 1.00 ms\n67 runs more: minimum 1.00 ms, median 1.00 ms, middle half 1.00 ms to 1.00 ms\n";
    assert_eq!((&*reply, &*message), (expected, ""));
    assert_eq!(prompt.ask("x"), "2\n", "done again from the same variables, and taken back");
    let reply = prompt.ask(":time let fresh = 3;");
    assert!(reply.contains("more: minimum"), "{reply}");
    assert_eq!(prompt.ask("fresh"), "3\n", "the first time counts");
}

#[test]
fn output_of_a_timed_input_is_printed_once() {
    let mut prompt = Prompt::new();
    let reply = prompt.ask(":time print(\"seen\")");
    assert_eq!(reply.matches("seen").count(), 1, "{reply}");
    assert!(reply.contains("more: minimum"), "{reply}");
    assert_eq!(prompt.ask("print(\"still\")"), "still\n");
}

#[test]
fn input_with_side_effects_is_timed_once_with_a_note() {
    let mut prompt = Prompt::spinning();
    prompt.ask("let n = 0; let count = || n += 1;");
    for (input, why) in [
        ("sim.step()", "it advances simulation 'spin'"),
        ("sim.back()", "it advances simulation 'spin'"),
        ("sim.at(9, |s| ())", "it advances simulation 'spin'"),
        ("scene.force(rod.end, [1, 0])", "it changes scene 'spin'"),
        ("[scene].map(|s| s.gravity([0, -1]))", "it changes scene 'spin'"),
        ("sim.plot_history([\"energy\"], \"energies.svg\")", "it writes files"),
        ("count.call()", "it changes a variable shared by functions"),
        (":step", "it is a command"),
    ] {
        let reply = prompt.ask(&format!(":time {input}"));
        assert!(reply.contains(&format!("timed once: {why}")), "{input}: {reply}");
        assert!(!reply.contains("more: minimum"), "{input}: {reply}");
    }
    assert_eq!(prompt.ask("`${n} ${sim.steps}`"), "\"1 1\"\n");
}

#[test]
fn input_that_runs_its_own_simulation_is_timed_repeatedly() {
    let mut prompt = Prompt::spinning();
    let reply = prompt.ask(":time { let own = scene.start(#{ dt: 0.1 }); own.step(3); own.t }");
    assert!(reply.starts_with("0.3\n") && reply.contains("more: minimum"), "{reply}");
    // A simulation without a variable is unreachable, so commands use the previous simulation.
    assert_eq!(prompt.ask("latest_simulation().t"), "0\n");
    assert_eq!(prompt.ask("sim.steps"), "0\n");
}

#[test]
fn checks_that_fail_are_counted_once() {
    let mut prompt = Prompt::new();
    prompt.ask(":time check(1 > 2)");
    let made = prompt.shell.session().context().with_checks(|checks| checks.made());
    assert_eq!(made, 1);
}

#[test]
fn failed_repetition_is_reported() {
    let mut prompt = Prompt::new();
    prompt.ask("let a = [1];");
    let (reply, _) = prompt.ask_both(":time if a.len() == 0 { throw \"gone\" } else { a.pop() }");
    assert!(
        reply.contains("timed once: it fails when repeated: ") && reply.contains("gone"),
        "{reply}"
    );
    assert!(prompt.refusal(":time").contains("no input to time"));
    assert!(prompt.refusal(":time nonsense").contains("there is no variable"));
}

#[test]
fn names_of_the_session_are_explained_with_their_values() {
    let mut prompt = Prompt::spinning();
    prompt.ask("/// Half of it.\n/// Really.\nfn half(x) { x / 2 }");
    prompt.ask("let values = [3, 1, 2]; let map = #{ a: 1, b: \"x\" }; const G = 9.81; 6 * 7");
    prompt.ask("import \"std/sections\" as shapes;");
    for (question, expected) in [
        (
            "sim?",
            &[
                "sim is a variable: a simulation\n",
                "simulation 'spin' at t = 0",
                "The type simulation",
                "run_to(t)",
            ][..],
        ),
        ("?sim", &["sim is a variable: a simulation\n"]),
        (":help sim", &["sim is a variable: a simulation\n"]),
        (
            "values?",
            &["values is a variable: an array of 3 elements, numbers from 1 to 3\n[3, 1, 2]"],
        ),
        ("map?", &["map is a variable: a map of 2 keys", "#{a: 1, b: \"x\"}"]),
        ("G?", &["G is a constant: a number\n9.81"]),
        ("ans?", &["ans is the value of the last input that had one: a whole number\n42"]),
        (
            "half?",
            &["half(x) is a function of this session.\nHalf of it.\nReally.\nfn half(x) { x / 2 }"],
        ),
        ("half()?", &["half(x) is a function"]),
        ("rod.end?", &["rod.end is a station\nthe end of beam", "beam.end"]),
        ("sim.energy?", &["sim.energy is a number\n10", "simulation.energy"]),
        ("sim.history.drift?", &["drift(invariant)"]),
        (
            "shapes?",
            &["shapes is an import of \"std/sections\"", "The library: std/sections", "rectangle"],
        ),
        ("shapes::rectangle?", &["sections::rectangle("]),
        ("EA?", &["An option of"]),
        ("sqrt?", &["sqrt("]),
        (":plot?", &[":plot [CURVES, OPTIONS]", "separated by commas"]),
        ("plot?", &[":plot [CURVES, OPTIONS]", "plot_motion"]),
        (
            "?plot",
            &[
                "To plot the height of a tip and the bending moment",
                "scene.record(\"rod.end.y\")",
                "plot_history(sim, [\"rod.end.y\"]",
                "plot_history(sim, [\"rod.start.M\"]",
                "plot_along(sim, \"M\"",
            ],
        ),
        ("?:time", &[":time INPUT"]),
        ("let?", &["let"]),
    ] {
        let reply = prompt.ask(question);
        for part in expected {
            assert!(reply.contains(part), "{question}: {part}\n{reply}");
        }
    }
    // A variable does not hide the help on a function of the same name.
    prompt.ask("let line = 3;");
    let reply = prompt.ask("line?");
    assert!(
        reply.contains("line is a variable: a whole number\n3") && reply.contains("line(from, to)"),
        "{reply}"
    );
    assert!(prompt.refusal("nowhere_to_be_found?").contains("there is no help on"));
}

#[test]
fn functions_of_imported_files_are_explained() {
    let folder = tempfile::tempdir().unwrap();
    std::fs::write(
        folder.path().join("parts.rhai"),
        "/// A third.\nfn third(x) { x / 3 }\nprivate fn own() { 1 }",
    )
    .unwrap();
    let settings =
        RunSettings { folder: folder.path().into(), ..RunSettings::silent(RunMode::Run) };
    let printed = Notepad::default();
    let settings = RunSettings { printed: Box::new(printed.clone()), ..settings };
    let session = Session::new(language(), settings).unwrap();
    let mut shell = Shell::new(session, ReplyTarget::Pipe);
    shell.submit("import \"parts\" as parts;");
    shell.submit("parts?");
    let reply = printed.take();
    assert!(
        reply.contains("parts is an import") && reply.contains("parts::third(x): A third."),
        "{reply}"
    );
    assert!(!reply.contains("own"), "private functions stay private: {reply}");
    shell.submit("parts::third?");
    assert_eq!(printed.take(), "parts::third(x) is a function of an imported file.\nA third.\n");
}

/// Pager that records its input.
#[derive(Clone, Default)]
struct Reader(Rc<RefCell<Vec<String>>>);

impl Pager for Reader {
    fn resize(&mut self, _: usize, _: usize) {}

    fn show(&mut self, text: &str, _: &dyn Fn() -> bool) -> PagerOutcome {
        self.0.borrow_mut().push(text.to_owned());
        if text.lines().count() > 40 { PagerOutcome::Interrupted } else { PagerOutcome::NotPaged }
    }
}

#[test]
fn help_goes_through_the_pager_and_short_help_is_printed() {
    let mut prompt = Prompt::new();
    let reader = Reader::default();
    prompt.shell.page_with(Box::new(reader.clone()));
    assert_eq!(prompt.shell.submit(":help topics"), CommandOutcome::Interrupted);
    assert_eq!(prompt.printed.take(), "");
    assert!(prompt.ask("?sqrt").contains("sqrt("));
    assert_eq!(reader.0.borrow().len(), 2);
    assert_eq!(prompt.ask("1 + 1"), "2\n");
    assert_eq!(reader.0.borrow().len(), 2, "only help is paged");
}

#[test]
fn simulation_created_for_timing_is_not_the_last_used() {
    let mut prompt = Prompt::spinning();
    prompt.ask(":time { let own = scene.start(#{ dt: 0.01 }); own.run_to(1); }");
    assert_eq!(prompt.ask("latest_simulation().t == sim.t"), "true\n");
    prompt.ask(":time let own = scene.start(#{ dt: 0.01 });");
    assert_eq!(prompt.ask("latest_simulation().dt"), "0.01\n");
}

#[test]
fn plotting_a_column_without_a_simulation_is_rejected() {
    let mut prompt = Prompt::new();
    for input in
        [":plot energy", ":plot kinetic strain", ":plot momentum_x", ":plot energy, [1, 2]"]
    {
        let message = prompt.refusal(input);
        assert!(message.contains("there is no simulation yet"), "{input}: {message}");
    }
}
