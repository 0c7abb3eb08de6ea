//! Command `:time`, which measures the first and further evaluations of an input.

use std::time::Duration;

use crate::repl::effects::SideEffects;
use crate::repl::sampling::{Figures, LONGEST, Sampling};
use crate::repl::session::Reply;
use crate::repl::shell::{CommandOutcome, Shell};
use crate::script::diagnose::Diagnostic;

pub fn time(shell: &mut Shell, operand: &str) -> CommandOutcome {
    if operand.is_empty() {
        let message = Diagnostic::general("no input to time");
        return shell.report_error(&message.with_hint("write :time followed by an input"));
    }
    let before = SideEffects::of(shell.session());
    let earlier = shell.session().context().latest_simulation();
    let clock = shell.clock();
    let begun = clock.now();
    let outcome = shell.submit(operand);
    let took = clock.now().saturating_sub(begun);
    // A simulation created by the timed input must not become the last used simulation if no variable contains it.
    if let Some(earlier) = earlier.filter(|_| !shell.has_latest_simulation()) {
        shell.session().context().set_latest_simulation(earlier);
    }
    if outcome != CommandOutcome::Success {
        return outcome;
    }
    let change = match operand.starts_with([':', '?']) {
        true => Some("is a command".into()),
        false => before.change(shell.session()),
    };
    let once = |why: &str| format!("took {}, timed once: {why}", in_words(took));
    match change {
        Some(change) => shell.print(&once(&format!("it {change} and is not repeated"))),
        None if took >= LONGEST => shell.print(&once("it takes more than a second")),
        None => return repeat(shell, operand, took),
    }
    CommandOutcome::Success
}

fn repeat(shell: &mut Shell, operand: &str, first: Duration) -> CommandOutcome {
    let first = in_words(first);
    let (before, places) =
        (SideEffects::of(shell.session()), shell.session().simulation_positions());
    let context = shell.session().context().clone();
    let (checks, latest) =
        (context.with_checks(|checks| checks.clone()), context.latest_simulation());
    let mut sampling = Sampling::new(shell.clock());
    let outcome =
        context.silently(|| shell.session_mut().evaluate_repeatedly(operand, &mut sampling));
    context.with_checks(|now| *now = checks);
    match latest {
        Some(latest) => context.set_latest_simulation(latest),
        None => context.clear_simulations(),
    }
    shell.session_mut().record_movement(&places);
    shell.print(&match (sampling.figures(), &outcome) {
        (Some(figures), Ok(()) | Err(Reply::Interrupted)) => report(&first, &figures),
        (_, Err(Reply::Failed(why))) => {
            format!("took {first}, timed once: it fails when repeated: {}", why.message)
        }
        _ => format!("took {first}, timed once"),
    });
    if let Some(change) = before.change(shell.session()) {
        shell.print_note(&format!("note: when repeated, it {change}"));
    }
    match outcome {
        Ok(()) | Err(Reply::Failed(_)) => CommandOutcome::Success,
        Err(stopped) => shell.print_reply(stopped),
    }
}

/// Text with the measured run times. The first run is separate, because it includes work that is done only once.
fn report(first: &str, figures: &Figures) -> String {
    let [least, median, low, high] =
        [figures.least, figures.median, figures.quartiles.0, figures.quartiles.1].map(in_words);
    let runs = match figures.runs {
        1 => "1 run".to_owned(),
        runs => format!("{runs} runs"),
    };
    format!(
        "first run {first}\n\
         {runs} more: minimum {least}, median {median}, middle half {low} to {high}"
    )
}

fn in_words(time: Duration) -> String {
    let seconds = time.as_secs_f64();
    let (value, unit) = match seconds {
        s if s < 1e-3 => (s * 1e6, "µs"),
        s if s < 1.0 => (s * 1e3, "ms"),
        s => (s, "s"),
    };
    let digits = if value < 10.0 {
        2
    } else if value < 100.0 {
        1
    } else {
        0
    };
    format!("{value:.digits$} {unit}")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn durations_are_shown_with_three_digits() {
        assert_eq!(in_words(Duration::from_nanos(1234)), "1.23 µs");
        assert_eq!(in_words(Duration::from_micros(45678)), "45.7 ms");
        assert_eq!(in_words(Duration::from_secs(321)), "321 s");
    }
}
