//! Run time of the language: a step called from a script, a load given by a closure, the start of the engine, and the prompt.
#![allow(clippy::unwrap_used)]

use std::io::{Read, Write};
use std::process::{Command, Stdio};
use std::sync::{Arc, Mutex};
use std::time::{Duration, Instant};

use withy::script::engine::parse::parse;
use withy::script::engine::runner::{Ending, run};
use withy::script::engine::script_engine::ScriptEngine;
use withy::script::engine::stack::on_large_stack;
use withy::script::packages::language;
use withy::script::source::program::Program;
use withy::script::state::limits::Limits;
use withy::script::state::settings::{RunMode, RunSettings};

/// Number of repetitions. The smallest time is reported. Both compared scripts are measured alternately.
const REPEATS: usize = 15;
/// Number of steps per repetition.
const STEPS: usize = 1000;
/// Number of starts, of which the median time is reported.
const STARTS: usize = 20;

/// Scene of a free particle. Its steps take little time, so the time of the call dominates.
const PARTICLE: &str = "let scene = new_scene(\"a\");
    scene.particle([0, 0], 1, #{ velocity: [1, 0] });\n";

/// Scene of the flying spaghetti. SCHEDULE is replaced by the schedule of its force.
const SPAGHETTI: &str = "let scene = new_scene(\"spaghetti\");
    let s = section(#{ EA: 1e4, GA: 1e4, EI: 100, rho_A: 1, rho_I: 10 });
    let rod = scene.beam(#{ name: \"rod\", axis: line([6, 0], [0, 8]), basis: bspline(14), section: s });
    scene.force(rod.start, [8, 0], SCHEDULE);
    scene.moment(rod.start, -80, hold_for(2.5));\n";

#[derive(Clone, Default)]
struct Printed(Arc<Mutex<Vec<u8>>>);

impl Write for Printed {
    fn write(&mut self, bytes: &[u8]) -> std::io::Result<usize> {
        self.0.lock().unwrap().extend_from_slice(bytes);
        Ok(bytes.len())
    }

    fn flush(&mut self) -> std::io::Result<()> {
        Ok(())
    }
}

/// Run time of the script `work` after the scene is built, measured by the clock of the script [s].
fn seconds(scene: &str, work: &str) -> f64 {
    let text = format!(
        "{scene} let sim = scene.start(#{{ dt: 0.05 }});
         let begun = timestamp(); {work} print(begun.elapsed);"
    );
    let printed = Printed::default();
    let settings =
        RunSettings { printed: Box::new(printed.clone()), ..RunSettings::silent(RunMode::Run) };
    let outcome = run(&Program::named("bench", &text), &language(), settings);
    if let Ending::Failed(diagnostic) = outcome.ending {
        panic!("{diagnostic}");
    }
    let printed = printed.0.lock().unwrap();
    String::from_utf8_lossy(&printed).trim().parse().unwrap()
}

/// Smallest run times of two scripts, in microseconds per step.
fn compare(first: (&str, &str), second: (&str, &str)) -> [f64; 2] {
    let mut least = [f64::INFINITY; 2];
    for _ in 0..REPEATS {
        for (least, (scene, work)) in least.iter_mut().zip([first, second]) {
            *least = least.min(seconds(scene, work) * 1e6 / STEPS as f64);
        }
    }
    least
}

fn timed(action: impl FnOnce()) -> Duration {
    let begun = Instant::now();
    action();
    begun.elapsed()
}

/// Smallest value and median of several times, in milliseconds.
fn median(mut time: impl FnMut() -> Duration) -> [f64; 2] {
    let mut times: Vec<f64> = (0..STARTS).map(|_| time().as_secs_f64() * 1e3).collect();
    times.sort_by(f64::total_cmp);
    [times[0], times[STARTS / 2]]
}

fn main() {
    let native = format!("sim.step({STEPS});");
    let looped = format!("for i in 0..{STEPS} {{ sim.step(); }}");
    let spaghetti = |schedule: &str| SPAGHETTI.replace("SCHEDULE", schedule);
    let held = spaghetti("hold_for(2.5)");

    println!("microseconds a step, least of {REPEATS} repeats of {STEPS} steps\n");
    println!("{:<44} {:>9} {:>9} {:>9}", "", "native", "script", "more");
    let show = |name: &str, [native, script]: [f64; 2]| {
        println!("{name:<44} {native:>9.2} {script:>9.2} {:>9.2}", script - native);
    };
    show(
        "a particle, each step called by the script",
        compare((PARTICLE, &native), (PARTICLE, &looped)),
    );
    show("14 spans, each step called by the script", compare((&held, &native), (&held, &looped)));
    for (name, schedule, closure) in [
        ("14 spans, |t| 1", "1", "|t| 1"),
        ("14 spans, |t| sin(2 * t)", "sine(1, 2, 0)", "|t| sin(2 * t)"),
        (
            "14 spans, |t| if t < 2.5 { 1 } else { 0 }",
            "hold_for(2.5)",
            "schedule(|t| if t < 2.5 { 1 } else { 0 }, [2.5])",
        ),
    ] {
        let [native, script] =
            compare((&spaghetti(schedule), &native), (&spaghetti(closure), &native));
        show(name, [native, script]);
        println!("{:>44} {:>28.1} %", "", 100.0 * (script - native) / native);
    }

    println!("\nmilliseconds, least and median of {STARTS}\n");
    let [least, middle] = on_large_stack(&Limits::default(), || {
        median(|| {
            timed(|| {
                let host =
                    ScriptEngine::open(language(), RunSettings::silent(RunMode::Run)).unwrap();
                let ast = parse(host.engine(), &Program::named("empty", "")).unwrap();
                host.engine().run_ast(&ast).unwrap();
            })
        })
    })
    .unwrap();
    println!("{:<44} {least:>9.2} {middle:>9.2}", "engine built, empty script run");
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("empty.rhai");
    std::fs::write(&file, "").unwrap();
    let [least, middle] = median(|| {
        timed(|| {
            let mut command = Command::new(env!("CARGO_BIN_EXE_withy"));
            let status = command.arg("run").arg(&file).stderr(Stdio::null()).status().unwrap();
            assert!(status.success());
        })
    });
    println!("{:<44} {least:>9.2} {middle:>9.2}", "withy run of an empty script");
    #[cfg(unix)]
    {
        let [least, middle] = median(|| time_to_prompt(folder.path()));
        println!("{:<44} {least:>9.2} {middle:>9.2}", "withy at a terminal, until its prompt");
    }
}

/// Time from the start of withy at a pseudo-terminal until it is ready for an input.
#[cfg(unix)]
fn time_to_prompt(folder: &std::path::Path) -> Duration {
    let mut command = Command::new(env!("CARGO_BIN_EXE_withy"));
    command.current_dir(folder).env("TERM", "xterm").env("WITHY_HISTORY", folder.join("history"));
    let begun = Instant::now();
    let process = rexpect::process::PtyProcess::new(command).unwrap();
    let mut terminal = process.get_file_handle().unwrap();
    let (mut seen, mut bytes) = (Vec::new(), [0; 4096]);
    while !String::from_utf8_lossy(&seen).contains("withy:1> ") {
        let count = terminal.read(&mut bytes).unwrap();
        seen.extend_from_slice(&bytes[..count]);
    }
    begun.elapsed()
}
