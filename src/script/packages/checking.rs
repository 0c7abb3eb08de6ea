//! Checks by which a script verifies its results. After a failed check, the script continues.

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

pub const TABLE: BindingTable = BindingTable {
    name: "checks",
    doc: "Checks of results. A failed check is recorded and the script continues; `withy run` \
        then ends with exit code 1.",
    types: &[PROBLEM],
    setup: "",
    constants: &[],
    rows: &[
        function("check", &[boolean("condition"), MESSAGE], check)
            .summary("Records a check of a condition; the message states the requirement.")
            .example("check(1 / 20 == 0.05, \"division is never truncated\");")
            .with_related(&["check_close"]),
        function("check_close", &[number("actual").allow_non_finite(), number("expected"), TOLERANCE, MESSAGE], check_close)
            .summary("Records a check that two numbers differ by at most a tolerance, and shows both \
                if they differ more.")
            .example("check_close(sin(PI), 0, 1e-15, \"a zero of the sine\");")
            .with_related(&["check"]),
        function("todo", &[text("what").doc("description of the missing expression")], todo)
            .summary("Stops the script with an error at a place that is still to be written.")
            .doc("Exercises use it in place of the expression to be found.")
            .example("try { todo(\"a stiffness\") } catch (problem) { check(problem.message == \"still to do: a stiffness\"); }")
            .with_related(&["check"]),
        property(PROBLEM, "message", |call| Ok(call.receiver::<Failure>()?.message.into()))
            .returns(Returns::TEXT)
            .summary("Description of the error.")
            .example("try { sqrt(\"two\") } catch (problem) { print(problem.message); }"),
        property(PROBLEM, "hint", |call| Ok(call.receiver::<Failure>()?.hint.unwrap_or_default().into()))
            .returns(Returns::TEXT.with_remark(", empty if there is nothing to advise"))
            .summary("Advice on how to correct the error.")
            .example("try { mean([]) } catch (problem) { print(problem.hint); }"),
    ],
};

const PROBLEM: Type = Type::of::<Failure>();

impl Scripted for Failure {
    const NAME: &'static str = "error";
    const DOC: &'static str =
        "Value that `catch (problem)` receives after an error of a function of withy.";

    fn show(&self) -> String {
        self.message.clone()
    }

    fn details(&self) -> Details {
        details::of_failure(self)
    }
}

const MESSAGE: Parameter = text("message").doc("requirement that is checked").optional();
const TOLERANCE: Parameter = number("tolerance").non_negative().doc("largest allowed difference");

fn check(call: &mut Call) -> Result<Dynamic, ScriptError> {
    let holds = call.boolean("condition")?;
    record(call, holds, "");
    Ok(Dynamic::UNIT)
}

fn todo(call: &mut Call) -> Result<Dynamic, ScriptError> {
    let what = call.text("what")?;
    Err(ScriptError::new(format!("still to do: {what}"))
        .hint("replace all of todo(…), including the quotes"))
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
    if call.context().mode() == RunMode::DryRun {
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
    call.context().print_debug(&format!("line {}: check failed: {message}", call.line()));
    call.context().with_checks(|checks| checks.fail(FailedCheck { message, line: call.line() }));
}
