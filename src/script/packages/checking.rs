//! Checks: a script judges its own results; the first to fail does not stop the others.

use rhai::Dynamic;

use crate::script::bindings::call::Call;
use crate::script::bindings::kind::{Details, Scripted, Type};
use crate::script::bindings::parameter::{Parameter, boolean, number, text};
use crate::script::bindings::returns::Returns;
use crate::script::bindings::table::{BindingTable, function, property};
use crate::script::messages::brief::brief;
use crate::script::messages::checks::FailedCheck;
use crate::script::messages::error::{Failure, ScriptError};
use crate::script::messages::numbers::format_number;
use crate::script::presentation::details;
use crate::script::state::settings::RunMode;

/// The domain of checks, and of what `catch` receives.
pub const TABLE: BindingTable = BindingTable {
    name: "checks",
    doc: "Checks are recorded and the script goes on. If one fails, `withy run` ends with exit code 1.",
    types: &[PROBLEM],
    setup: "",
    constants: &[],
    rows: &[
        function("check", &[boolean("condition"), MESSAGE], check)
            .summary("Records whether a condition holds; the message says what should be so.")
            .example("check(1 / 20 == 0.05, \"division is never truncated\");")
            .see(&["check_close"]),
        function("check_close", &[number("actual").any_number(), number("expected"), TOLERANCE, MESSAGE], check_close)
            .summary("Records whether two numbers differ by no more than a tolerance, and shows both if they do.")
            .example("check_close(sin(PI), 0, 1e-15, \"a zero of the sine\");")
            .see(&["check"]),
        function("todo", &[text("what").doc("what is to stand in its place")], todo)
            .summary("Stops the script where something is still to be written, and says what.")
            .doc("It stands in exercises in the place of what one is to find.")
            .example("try { todo(\"a stiffness\") } catch (problem) { check(problem.message == \"still to do: a stiffness\"); }")
            .see(&["check"]),
        property(PROBLEM, "message", |call| Ok(call.receiver::<Failure>()?.message.into()))
            .returns(Returns::TEXT)
            .summary("What went wrong.")
            .example("try { sqrt(\"two\") } catch (problem) { print(problem.message); }"),
        property(PROBLEM, "hint", |call| Ok(call.receiver::<Failure>()?.hint.unwrap_or_default().into()))
            .returns(Returns::TEXT.note(", empty if there is nothing to advise"))
            .summary("What to do about it.")
            .example("try { mean([]) } catch (problem) { print(problem.hint); }"),
    ],
};

const PROBLEM: Type = Type::of::<Failure>();

impl Scripted for Failure {
    const NAME: &'static str = "error";
    const DOC: &'static str = "What `catch (problem)` receives when a function of withy refuses.";

    fn show(&self) -> String {
        self.message.clone()
    }

    fn details(&self) -> Details {
        details::of_failure(self)
    }
}

const MESSAGE: Parameter = text("message").doc("what should be so").optional();
const TOLERANCE: Parameter =
    number("tolerance").non_negative().doc("the largest difference allowed");

fn check(call: &mut Call) -> Result<Dynamic, ScriptError> {
    let holds = call.boolean("condition")?;
    record(call, holds, "");
    Ok(Dynamic::UNIT)
}

fn todo(call: &mut Call) -> Result<Dynamic, ScriptError> {
    let what = call.text("what")?;
    Err(ScriptError::new(format!("still to do: {what}"))
        .hint("write it in the place of todo(…), quotes and all"))
}

fn check_close(call: &mut Call) -> Result<Dynamic, ScriptError> {
    let (actual, expected) = (call.number("actual")?, call.number("expected")?);
    let difference = (actual - expected).abs();
    let detail = format!(
        "got {}, expected {} within {}",
        format_number(actual),
        format_number(expected),
        format_number(call.number("tolerance")?)
    );
    record(call, difference <= call.number("tolerance")?, &detail);
    Ok(Dynamic::UNIT)
}

fn record(call: &Call, holds: bool, detail: &str) {
    if call.context().mode() == RunMode::DryBuild {
        return;
    }
    if holds {
        return call.context().with_checks(|checks| checks.pass());
    }
    let said = call.text("message").unwrap_or_default();
    let message = match (said.is_empty(), detail.is_empty()) {
        (false, false) => format!("{said}: {detail}"),
        (false, true) => said.to_string(),
        (true, false) => detail.to_owned(),
        (true, true) => "the condition is false".to_owned(),
    };
    let message = brief(message);
    call.context().remark(&format!("line {}: check failed: {message}", call.line()));
    call.context().with_checks(|checks| checks.fail(FailedCheck { message, line: call.line() }));
}
