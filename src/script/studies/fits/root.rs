//! Roots of a script function.

use rhai::Dynamic;

use crate::fitting::{RootError, root};
use crate::output::significant;
use crate::script::bindings::call::Call;
use crate::script::bindings::parameter_variants::VariantValue;
use crate::script::messages::error::{CallPart, ScriptError};
use crate::script::messages::numbers::format_number;
use crate::script::state::settings::RunMode;

pub fn find_root(call: &mut Call) -> Result<Dynamic, ScriptError> {
    let (function, from, to) =
        (call.callback("function")?, call.number("from")?, call.number("to")?);
    call.expect_arguments(&function, 1, "|x| …")?;
    let tolerance = call.optional_number("tolerance").unwrap_or(1e-9 * (to - from).abs());
    let value = |x: f64| {
        let given = call.invoke(&function, [Dynamic::from(x)])?;
        VariantValue::number(&given).ok_or_else(|| {
            let message =
                format!("the function returns {} at {}", call.describe(&given), format_number(x));
            let hint = match given.is_bool() {
                true => "return a number that changes its sign: x - 2 in place of x > 2",
                false => "its last expression must be a number",
            };
            call.error(message).hint(hint).at(CallPart::Argument(0))
        })
    };
    if call.context().mode() == RunMode::DryRun {
        value(from)?;
        return Ok(from.into());
    }
    let wrong =
        |message: String, hint: &str| call.error(message).hint(hint).at(CallPart::Argument(0));
    match root((from, to), tolerance, value) {
        Ok(found) => Ok(found.at.into()),
        Err(RootError::Function(error)) => Err(error),
        Err(RootError::SameSign(low, high)) => {
            let [from, to, low, high] = [from, to, low, high].map(format_number);
            let message = format!("the function is {low} at {from} and {high} at {to}");
            Err(wrong(message, "give two arguments at which the signs differ"))
        }
        Err(RootError::NotFinite(x, value)) => {
            let [x, value] = [x, value].map(format_number);
            Err(wrong(
                format!("the function is {value} at {x}"),
                "it must be finite between the two arguments",
            ))
        }
        Err(RootError::Pole(x, value)) => {
            let [x, value] = [x, value].map(|number| significant(number, 6));
            Err(wrong(
                format!(
                    "the function has a pole near {x}: its sign changes there, and it is {value}"
                ),
                "give two places without a pole between them",
            ))
        }
        Err(RootError::Unfinished(x, value)) => {
            let [x, value] = [x, value].map(|number| significant(number, 6));
            Err(wrong(
                format!(
                    "no root is found in 200 calls; the best place is {x}, where the function is {value}"
                ),
                "give places nearer to each other, or a larger tolerance",
            ))
        }
    }
}
