//! Interactive sessions: the binary in a pseudo-terminal.
#![allow(clippy::unwrap_used)]
#![cfg(unix)]

use std::path::Path;
use std::process::Command;
use std::thread::sleep;
use std::time::Duration;

use rexpect::ReadUntil;
use rexpect::session::{PtySession, spawn_command};

/// Time limit of a wait [ms], generous for loaded machines.
const TIME_LIMIT: u64 = 60_000;

/// First two bytes of braille characters in UTF-8. The terminal is read byte by byte.
const BRAILLE: &str = "\u{e2}[\u{a0}-\u{a3}]";

/// Sequence of the editor after it has read a line, which turns bracketed paste off.
const NO_LONGER_READING: &str = "\u{1b}[?2004l";

/// Starts `withy` in a folder and reads its greeting.
fn start(folder: &Path, arguments: &[&str]) -> PtySession {
    let mut command = Command::new(env!("CARGO_BIN_EXE_withy"));
    command.current_dir(folder).args(arguments);
    command.env("TERM", "xterm").env("LANG", "C.UTF-8").env_remove("LC_ALL").env_remove("LC_CTYPE");
    command
        .env("NO_COLOR", "1")
        .env("WITHY_HISTORY", folder.join("history"))
        .env_remove("WITHY_KEYS");
    let mut session = spawn_command(command, Some(TIME_LIMIT)).unwrap();
    session.exp_string(":help").unwrap();
    session.exp_string("withy:1> ").unwrap();
    session
}

/// Types an input and waits for the reply, which must not be a part of the input.
fn ask(session: &mut PtySession, input: &str, reply: &str) {
    assert!(!input.contains(reply), "the echo of the input would do");
    session.send_line(input).unwrap();
    session.exp_string(reply).unwrap_or_else(|error| panic!("{input}: {error}"));
}

/// Types an input without a reply, and waits for the next prompt.
fn tell(session: &mut PtySession, input: &str, next_line: usize) {
    ask(session, input, &format!("withy:{next_line}> "));
}

#[test]
fn session_simulates_and_rewinds_a_beam() {
    let folder = tempfile::tempdir().unwrap();
    let mut session = start(folder.path(), &[]);
    let s = &mut session;
    tell(s, "let slender = section(#{ EA: 1e4, GA: 1e4, EI: 100, rho_A: 1, rho_I: 10 });", 2);
    tell(s, "let scene = new_scene(\"flying spaghetti\");", 3);
    s.send_line("let rod = scene.beam(#{").unwrap();
    s.send_line("axis: line([0, 8], [6, 0]), basis: bspline(7),").unwrap();
    tell(s, "section: slender });", 6);
    tell(s, "scene.force(rod.end, [8, 0], hold_for(2.5));", 7);
    tell(s, "scene.moment(rod.end, -80, hold_for(2.5));", 8);
    tell(s, "let sim = scene.start(#{ integrator: energy_momentum(), dt: 0.1 });", 9);

    // Completion finds the only member of a beam with this prefix.
    s.send("rod.e\t\n").unwrap();
    s.exp_string("the end of beam 'beam1'").unwrap();

    ask(s, ":step 10", "t = 1 after 10 steps");
    ask(s, ":invariants", "energy E - W + D");
    ask(s, ":back 5", "t = 0.5 after 5 steps");

    // The session continues after an error.
    ask(s, "rod.ende", "did you mean 'end'?");
    ask(s, "6 * 7", "42");

    // An interrupt stops an endless run, and the session continues.
    s.send_line(":run 1e7").unwrap();
    s.exp_string(NO_LONGER_READING).unwrap();
    sleep(Duration::from_millis(300));
    s.send_control('c').unwrap();
    s.exp_string("interrupted: simulation 'flying spaghetti' at t = ").unwrap();
    ask(s, "sim.t > 0.5 && sim.t < 1e7", "true");
    ask(s, ":back 3", " steps");

    // Ctrl-C at the prompt discards the typed text.
    s.send("let nonsense = (((").unwrap();
    s.flush().unwrap();
    s.exp_string("(((").unwrap();
    s.send_control('c').unwrap();
    s.exp_string("> ").unwrap();
    ask(s, "1 / 16", "0.0625");

    ask(s, ":save thrown.rhai", "saved to");
    s.send_line("`end ${sim.t} ${sim.energy}\u{60}").unwrap();
    let (_, end) = s.exp_regex(r#""end [^$"]*""#).unwrap();
    s.send_control('d').unwrap();
    s.exp_eof().unwrap();

    let asked = ["-e", ":load thrown.rhai", "-e", "`end ${sim.t} ${sim.energy}`"];
    let output = Command::new(env!("CARGO_BIN_EXE_withy"))
        .current_dir(folder.path())
        .args(asked)
        .output()
        .unwrap();
    let again = String::from_utf8(output.stdout).unwrap();
    assert_eq!(
        again.lines().last(),
        Some(end.trim()),
        "{}",
        String::from_utf8_lossy(&output.stderr)
    );
}

#[test]
fn input_typed_ahead_is_not_lost() {
    let folder = tempfile::tempdir().unwrap();
    let mut session = start(folder.path(), &[]);
    session.send("let a = 1\nlet b = 2\nlet c = 4\n").unwrap();
    session.exp_string("withy:4> ").unwrap();
    ask(&mut session, "a + b + c", "7");

    // Control characters that a terminal in line mode would interpret, during the evaluation of an input.
    let begin = |session: &mut PtySession, last: &str| {
        let second = "let t = timestamp(); while t.elapsed < 1.0 {}";
        session.send_line(&format!("{second}; `${{2 * 300}} {last}`")).unwrap();
        session.exp_string(NO_LONGER_READING).unwrap();
    };
    begin(&mut session, "and search");
    session.send("\u{12}a + b\n").unwrap();
    session.exp_string("600 and search").unwrap();
    session.exp_string("7\r\n").unwrap();
    begin(&mut session, "and leave");
    session.send_control('d').unwrap();
    session.exp_string("600 and leave").unwrap();
    session.exp_eof().unwrap();
}

#[test]
fn history_is_kept_between_sessions() {
    let folder = tempfile::tempdir().unwrap();
    let mut first = start(folder.path(), &[]);
    ask(&mut first, "111 + 222", "333");
    first.send_line(":quit").unwrap();
    first.exp_eof().unwrap();

    let mut second = start(folder.path(), &[]);
    // Up twice: `:quit`, then the sum.
    second.send("\u{1b}[A\u{1b}[A\n").unwrap();
    second.exp_string("333").unwrap();
    // Ctrl-R searches.
    second.send("\u{12}111\n").unwrap();
    second.exp_string("333").unwrap();
    second.send_control('d').unwrap();
    second.exp_eof().unwrap();
}

#[test]
fn session_starts_with_a_script_and_draws_pictures() {
    let folder = tempfile::tempdir().unwrap();
    let script = "let scene = new_scene(\"spin\");\n\
        let s = section(#{ EA: 1e4, GA: 1e4, EI: 100, rho_A: 1, rho_I: 10 });\n\
        let rod = scene.beam(#{ axis: line([0, 0], [2, 0]), basis: bspline(4), section: s, spin: 1 });\n\
        let sim = scene.start(#{ dt: 0.1 });\n";
    std::fs::write(folder.path().join("spin.rhai"), script).unwrap();
    let mut command = Command::new(env!("CARGO_BIN_EXE_withy"));
    command.current_dir(folder.path()).args(["repl", "spin.rhai", "--keys", "vi"]);
    command
        .env("TERM", "xterm")
        .env("LANG", "C.UTF-8")
        .env("NO_COLOR", "1")
        .env("WITHY_HISTORY", "");
    let mut session = spawn_command(command, Some(TIME_LIMIT)).unwrap();
    session.exp_string("withy:5> ").unwrap();
    ask(&mut session, ":step 5", "after 5 steps");
    let commands =
        [":plot kinetic", ":show", ":show #{ every: 0.1, trace: [rod.end] }", ":along Q"];
    for command in commands {
        session.send_line(command).unwrap();
        session.exp_regex(BRAILLE).unwrap();
        session.exp_string("withy:6> ").unwrap();
    }
    session.send_line(":quit").unwrap();
    session.exp_eof().unwrap();
}

/// Starts `withy` on a terminal of 80 columns and 20 lines, with additional environment variables.
fn start_sized(folder: &Path, variables: &[(&str, &str)]) -> PtySession {
    let mut command = Command::new("sh");
    let start = format!("stty rows 20 cols 80; exec {}", env!("CARGO_BIN_EXE_withy"));
    command.current_dir(folder).args(["-c", &start]);
    command.env("TERM", "xterm").env("LANG", "C.UTF-8").env_remove("LC_ALL").env_remove("LC_CTYPE");
    command.env("WITHY_HISTORY", "").env_remove("WITHY_KEYS").env_remove("NO_COLOR");
    command.env_remove("PAGER").env_remove("LINES").env_remove("COLUMNS").env_remove("LESS");
    for (name, value) in variables {
        command.env(name, value);
    }
    let mut session = spawn_command(command, Some(TIME_LIMIT)).unwrap();
    session.exp_string("withy:1> ").unwrap();
    session
}

fn press(session: &mut PtySession, key: &str) {
    session.send(key).unwrap();
    session.flush().unwrap();
}

#[test]
fn long_help_is_paged_and_every_exit_returns_to_the_prompt() {
    let folder = tempfile::tempdir().unwrap();
    let mut session = start_sized(folder.path(), &[("NO_COLOR", "1")]);
    let s = &mut session;
    const STATUS: &str = "space: next page";
    // Searches for a word, and quits.
    s.send_line(":help topics").unwrap();
    let first = s.exp_string(STATUS).unwrap();
    assert!(first.contains("The language") && !first.contains("From Rhai"), "{first}");
    s.send("/from rhai\n").unwrap();
    s.exp_string("From Rhai").unwrap();
    s.exp_string(STATUS).unwrap();
    press(s, "q");
    s.exp_string("withy:1> ").unwrap();
    ask(s, "6 * 7", "42");
    // Quits with Ctrl-C.
    s.send_line("sim?").unwrap();
    s.exp_string("there is no help on 'sim'").unwrap();
    s.send_line(":help topics").unwrap();
    s.exp_string(STATUS).unwrap();
    s.send_control('c').unwrap();
    s.exp_string("withy:2> ").unwrap();
    ask(s, "6 * 8", "48");
    // Goes to the end of the text.
    s.send_line(":help topics").unwrap();
    s.exp_string(STATUS).unwrap();
    press(s, "G");
    s.exp_string("withy:3> ").unwrap();
    ask(s, "6 * 9", "54");
    // Short help is printed without the pager.
    s.send_line("?TAU").unwrap();
    s.exp_string(NO_LONGER_READING).unwrap();
    assert!(!s.exp_string("withy:4> ").unwrap().contains(STATUS));
    // Input that is typed ahead is not lost. Whether the pager appears depends on which reader receives the keys.
    s.send("let t = timestamp(); while t.elapsed < 0.5 {}\n:help topics\n70 + 7\n").unwrap();
    let either = vec![ReadUntil::String(STATUS.into()), ReadUntil::String("77\r\n".into())];
    if s.exp_any(either).unwrap().1 == STATUS {
        press(s, "q");
        s.exp_string("77\r\n").unwrap();
    }
}

#[test]
fn pager_of_the_environment_is_used() {
    let folder = tempfile::tempdir().unwrap();
    let mut session = start_sized(folder.path(), &[("NO_COLOR", "1"), ("PAGER", "head -n 1")]);
    session.send_line(":help topics").unwrap();
    session.exp_string(NO_LONGER_READING).unwrap();
    let shown = session.exp_string("withy:1> ").unwrap();
    assert!(shown.contains("Help\r\n") && !shown.contains("The language"), "{shown}");
    ask(&mut session, "6 * 7", "42");
    let mut session = start_sized(folder.path(), &[("NO_COLOR", "1"), ("PAGER", "no-such-pager")]);
    session.send_line(":help topics").unwrap();
    session.exp_string("cannot start the pager 'no-such-pager'").unwrap();
    session.exp_string("space: next page").unwrap();
    press(&mut session, "q");
    session.exp_string("withy:1> ").unwrap();
}

#[test]
fn typed_input_is_coloured_unless_colours_are_disabled() {
    let folder = tempfile::tempdir().unwrap();
    let mut coloured = start_sized(folder.path(), &[]);
    coloured.send_line("let a = sqrt(4); // two").unwrap();
    let drawn = coloured.exp_string("withy:2> ").unwrap();
    for piece in ["\u{1b}[35mlet", "\u{1b}[34msqrt", "\u{1b}[36m4", "\u{1b}[2m// two"] {
        assert!(drawn.contains(piece), "{piece:?}: {drawn:?}");
    }
    coloured.send_line(":nonsense").unwrap();
    coloured.exp_string("\u{1b}[31m:nonsense").unwrap();
    let is_coloured = |drawn: &str| {
        ["\u{1b}[3", "\u{1b}[1m", "\u{1b}[2m"].iter().any(|code| drawn.contains(code))
    };
    for plain in [("NO_COLOR", "1"), ("TERM", "dumb")] {
        let mut session = start_sized(folder.path(), &[plain]);
        session.send_line("let a = sqrt(4); // two").unwrap();
        let drawn = session.exp_string("withy:2> ").unwrap();
        assert!(!is_coloured(&drawn), "{plain:?}: {drawn:?}");
        ask(&mut session, "a + 40", "42");
    }
}

#[test]
fn timings_and_plots_that_take_long_are_stopped() {
    let folder = tempfile::tempdir().unwrap();
    let mut session = start_sized(folder.path(), &[("NO_COLOR", "1")]);
    let s = &mut session;
    s.send_line(":time while true {}").unwrap();
    s.exp_string(NO_LONGER_READING).unwrap();
    sleep(Duration::from_millis(300));
    s.send_control('c').unwrap();
    s.exp_string("interrupted").unwrap();
    s.send_line(":plot [0, 1, 4, 9]").unwrap();
    s.exp_regex(BRAILLE).unwrap();
    s.exp_string("index").unwrap();
    ask(s, "6 * 7", "42");
}
