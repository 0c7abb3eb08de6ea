//! Commands that advance or rewind the last used simulation.

use crate::repl::shell::{CommandOutcome, Shell};
use crate::script::diagnose::Diagnostic;
use crate::script::messages::numbers::format_number;

const MOST_STEPS: f64 = 9e15;

pub fn step(shell: &mut Shell, operand: &str) -> CommandOutcome {
    let count = match whole(operand, "step") {
        Ok(count) => count,
        Err(refusal) => return shell.report_error(&refusal),
    };
    if !shell.is_watching() {
        return move_latest(shell, &format!("step({count})"));
    }
    let mut outcome = CommandOutcome::Success;
    for _ in 0..count {
        outcome = shell.call_latest_and_watch("step()");
        if outcome != CommandOutcome::Success {
            break;
        }
    }
    outcome
}

pub fn run(shell: &mut Shell, operand: &str) -> CommandOutcome {
    let Ok(end) = operand.parse::<f64>() else {
        let hint = "write :run T with the end time T";
        return shell.report_error(&not_a_number(operand, "a time").with_hint(hint));
    };
    if !shell.is_watching() || !end.is_finite() || shell.next_stop(end).is_none() {
        return move_latest(shell, &format!("run_to({})", format_number(end)));
    }
    let mut outcome = CommandOutcome::Success;
    while let (CommandOutcome::Success, Some(next)) = (outcome, shell.next_stop(end)) {
        outcome = shell.call_latest_and_watch(&format!("run_to({})", format_number(next)));
    }
    outcome
}

pub fn back(shell: &mut Shell, operand: &str) -> CommandOutcome {
    match whole(operand, "back") {
        Ok(count) => move_latest(shell, &format!("back({count})")),
        Err(refusal) => shell.report_error(&refusal),
    }
}

pub fn watch(shell: &mut Shell, operand: &str) -> CommandOutcome {
    if operand.is_empty() {
        shell.clear_watched();
        return CommandOutcome::Success;
    }
    shell.watch(operand)
}

fn move_latest(shell: &mut Shell, call: &str) -> CommandOutcome {
    let outcome = shell.call_latest(call);
    if outcome == CommandOutcome::Success {
        match shell.is_watching() {
            true => return shell.show_watched(),
            false => shell.print_position(),
        }
    }
    outcome
}

fn whole(operand: &str, command: &str) -> Result<u64, Diagnostic> {
    if operand.is_empty() {
        return Ok(1);
    }
    let hint = format!("write :{command} or, for example, :{command} 10");
    let refused = || not_a_number(operand, "a number of steps").with_hint(hint);
    // Numbers such as `1e3` are accepted as integers.
    match operand.parse::<f64>() {
        Ok(count) if count >= 0.0 && count.fract() == 0.0 && count < MOST_STEPS => Ok(count as u64),
        _ => Err(refused()),
    }
}

fn not_a_number(operand: &str, wanted: &str) -> Diagnostic {
    Diagnostic::general(match operand {
        "" => format!("{wanted} is missing"),
        _ => format!("'{operand}' is not {wanted}"),
    })
}
