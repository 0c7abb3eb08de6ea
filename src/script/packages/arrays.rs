//! Functions of numeric arrays: sums, extremes, equal spacing.

use rhai::{Array, Dynamic};

use crate::elementary::{exp, ln};
use crate::script::bindings::call::Call;
use crate::script::bindings::parameter::{Parameter, integer, number, numbers};
use crate::script::bindings::parameter_variants::{at_largest_change, at_smallest_change};
use crate::script::bindings::returns::Returns;
use crate::script::bindings::table::{BindingTable, function};
use crate::script::messages::error::{CallPart, ScriptError};
use crate::script::messages::numbers::format_number;

pub const TABLE: BindingTable = BindingTable {
    name: "arrays",
    doc: "Arrays of numbers. Indices count from 0; -1 is the last.",
    types: &[],
    setup: "",
    constants: &[],
    rows: &[
        function(
            "linspace",
            &[number("from"), number("to"), integer("count").between(2.0, 1e6)],
            linspace,
        )
        .returns(Returns::NUMBERS)
        .summary("Creates an array of equally spaced numbers, including both ends.")
        .example(
            "check(linspace(0, 1, 3) == [0, 0.5, 1]);\nfor t in linspace(0, 2, 5) { print(t); }",
        ),
        function(
            "logspace",
            &[number("from"), number("to"), integer("count").between(2.0, 1e6)],
            logspace,
        )
        .returns(Returns::NUMBERS)
        .summary("Creates an array of positive numbers with equal ratios, including both ends.")
        .doc("The ends are values, not exponents: logspace(1, 1000, 4) is [1, 10, 100, 1000].")
        .example("let ten = logspace(0.01, 100, 5);\ncheck(ten[0] == 0.01 && ten[4] == 100);\ncheck_close(ten[2], 1, 1e-14);"),
        function("sum", &[VALUES], |call| Ok(call.numbers("values")?.iter().sum::<f64>().into()))
            .returns(Returns::NUMBER)
            .summary("Returns the sum of the numbers.")
            .example("check(sum([1, 2, 3.5]) == 6.5);"),
        function("mean", &[VALUES], mean)
            .returns(Returns::NUMBER)
            .summary("Returns the mean of the numbers.")
            .example("check(mean([1, 2, 3]) == 2);"),
        function("min", &[VALUES], |call| extreme(call, f64::min))
            .returns(Returns::NUMBER)
            .summary("Returns the smallest number of an array.")
            .example("check(min([3, 1, 2]) == 1);")
            .corner(at_smallest_change),
        function("max", &[VALUES], |call| extreme(call, f64::max))
            .returns(Returns::NUMBER)
            .summary("Returns the largest number of an array.")
            .example("check(max([3, 1, 2]) == 3);")
            .corner(at_largest_change),
    ],
};

const VALUES: Parameter = numbers("values");

fn linspace(call: &mut Call) -> Result<Dynamic, ScriptError> {
    let (from, to, count) = (call.number("from")?, call.number("to")?, call.count("count")?);
    let last = (count - 1) as f64;
    let at = |i: usize| {
        if i + 1 == count {
            return to;
        }
        let (before, after) = (last - i as f64, i as f64);
        let x = (from * before + to * after) / last;
        // Near the largest float, products of ends and weights overflow, but fractions of the ends do not.
        if x.is_finite() { x } else { from * (before / last) + to * (after / last) }
    };
    Ok((0..count).map(|i| Dynamic::from(at(i))).collect::<Array>().into())
}

fn logspace(call: &mut Call) -> Result<Dynamic, ScriptError> {
    let (from, to, count) = (call.number("from")?, call.number("to")?, call.count("count")?);
    for (at, value) in [from, to].into_iter().enumerate() {
        if value <= 0.0 {
            let message =
                format!("the ends must be positive numbers, got {}", format_number(value));
            let hint =
                "the ends are values, not exponents: logspace(1, 1000, 4) is [1, 10, 100, 1000]";
            return Err(call.error(message).hint(hint).at(CallPart::Argument(at)));
        }
    }
    let (low, high, last) = (ln(from), ln(to), count - 1);
    let at = |i: usize| match i {
        0 => from,
        i if i == last => to,
        i => exp((low * (last - i) as f64 + high * i as f64) / last as f64),
    };
    Ok((0..count).map(|i| Dynamic::from(at(i))).collect::<Array>().into())
}

fn mean(call: &mut Call) -> Result<Dynamic, ScriptError> {
    let values = filled(call)?;
    Ok((values.iter().sum::<f64>() / values.len() as f64).into())
}

fn extreme(call: &Call, choose: fn(f64, f64) -> f64) -> Result<Dynamic, ScriptError> {
    let values = filled(call)?;
    Ok(values.into_iter().reduce(choose).unwrap_or(f64::NAN).into())
}

fn filled(call: &Call) -> Result<Vec<f64>, ScriptError> {
    let values = call.numbers("values")?;
    match values.is_empty() {
        true => Err(call.error("the array is empty").at(CallPart::Argument(0))),
        false => Ok(values),
    }
}
