//! Numbers: functions of one and two numbers, rounding, and constants.

use rhai::{Dynamic, INT};

use crate::elementary;
use crate::script::bindings::call::Call;
use crate::script::bindings::parameter::{Parameter, integer, number, numeric};
use crate::script::bindings::parameter_variants::{
    at_branch_cut, at_digit_changes, at_equality, at_integers, at_origin, at_zero,
    near_ends_of_logarithm, near_one, near_quarters, near_zero,
};
use crate::script::bindings::returns::Returns;
use crate::script::bindings::table::{
    BindingTable, Constant, FunctionBinding, NativeFunction, function,
};
use crate::script::messages::error::ScriptError;
use crate::script::messages::numbers::as_number;

pub const TABLE: BindingTable = BindingTable {
    name: "numbers",
    doc: "Elementary functions. Arguments may be whole numbers; angles are in radians; infinity \
        and nan are handled as in IEEE 754. Results have the same bits on every machine.",
    types: &[],
    setup: "",
    constants: &[
        Constant { name: "PI", value: std::f64::consts::PI, summary: "Half a turn in radians." },
        Constant { name: "TAU", value: std::f64::consts::TAU, summary: "Full turn in radians." },
        Constant {
            name: "E",
            value: std::f64::consts::E,
            summary: "Base of the natural logarithm.",
        },
        Constant { name: "inf", value: f64::INFINITY, summary: "Infinity." },
        Constant {
            name: "nan",
            value: f64::NAN,
            summary: "Undefined number (not a number); it is not equal to anything, including \
                itself.",
        },
    ],
    rows: &[
        of_x(
            "sin",
            |call| map(call, elementary::sin),
            "Returns the sine.",
            "check(abs(sin(PI / 6) - 0.5) < 1e-15);",
        ),
        of_x(
            "cos",
            |call| map(call, elementary::cos),
            "Returns the cosine.",
            "check(cos(0) == 1);",
        ),
        of_x(
            "tan",
            |call| map(call, elementary::tan),
            "Returns the tangent.",
            "check(tan(0) == 0);",
        )
        .corner(near_quarters),
        of_x(
            "asin",
            |call| map(call, elementary::asin),
            "Returns the arc sine.",
            "check(asin(1) == PI / 2);",
        )
        .corner(near_one),
        of_x(
            "acos",
            |call| map(call, elementary::acos),
            "Returns the arc cosine.",
            "check(acos(1) == 0);",
        )
        .corner(near_one),
        of_x(
            "atan",
            |call| map(call, elementary::atan),
            "Returns the arc tangent.",
            "check(4 * atan(1) == PI);",
        )
        .with_related(&["atan2"]),
        of_x(
            "sinh",
            |call| map(call, elementary::sinh),
            "Returns the hyperbolic sine.",
            "check(sinh(0) == 0);",
        ),
        of_x(
            "cosh",
            |call| map(call, elementary::cosh),
            "Returns the hyperbolic cosine.",
            "check(cosh(0) == 1);",
        ),
        of_x(
            "tanh",
            |call| map(call, elementary::tanh),
            "Returns the hyperbolic tangent.",
            "check(tanh(0) == 0);",
        ),
        of_x(
            "asinh",
            |call| map(call, elementary::asinh),
            "Returns the inverse hyperbolic sine.",
            "check(asinh(0) == 0);",
        ),
        of_x(
            "acosh",
            |call| map(call, elementary::acosh),
            "Returns the inverse hyperbolic cosine, which is not negative.",
            "check(acosh(1) == 0);",
        )
        .corner(near_one),
        of_x(
            "atanh",
            |call| map(call, elementary::atanh),
            "Returns the inverse hyperbolic tangent.",
            "check(atanh(0) == 0);",
        )
        .corner(near_one),
        of_x(
            "exp",
            |call| map(call, elementary::exp),
            "Returns the exponential.",
            "check(exp(0) == 1);",
        ),
        of_x(
            "ln",
            |call| map(call, elementary::ln),
            "Returns the natural logarithm.",
            "check(ln(E) == 1);",
        )
        .corner(near_zero),
        of_x(
            "log10",
            |call| map(call, elementary::log10),
            "Returns the logarithm to base 10.",
            "check(log10(1000) == 3);",
        )
        .corner(near_zero),
        of_x(
            "log2",
            |call| map(call, elementary::log2),
            "Returns the logarithm to base 2.",
            "check(log2(8) == 3);",
        )
        .corner(near_zero),
        function("log", &[ANY_X, number("base")], |call| {
            Ok(elementary::log(x(call)?, call.number("base")?).into())
        })
        .returns(Returns::NUMBER)
        .summary("Returns the logarithm to a given base; the base is required.")
        .example("check_close(log(81, 3), 4, 1e-15);")
        .with_related(&["ln", "log10", "log2"])
        .corner(near_ends_of_logarithm),
        of_x(
            "sqrt",
            |call| map(call, f64::sqrt),
            "Returns the square root.",
            "check(sqrt(16) == 4);",
        )
        .with_related(&["hypot"])
        .corner(near_zero),
        of_x(
            "radians",
            |call| map(call, f64::to_radians),
            "Converts an angle from degrees to radians.",
            "check(radians(180) == PI);",
        ),
        of_x(
            "degrees",
            |call| map(call, f64::to_degrees),
            "Converts an angle from radians to degrees.",
            "check(degrees(PI) == 180);",
        ),
        of_x(
            "floor",
            |call| round(call, f64::floor),
            "Returns the largest whole number not above x.",
            "check(floor(2.7) == 2);",
        )
        .returns(WHOLE),
        of_x(
            "ceiling",
            |call| round(call, f64::ceil),
            "Returns the smallest whole number not below x.",
            "check(ceiling(2.1) == 3);",
        )
        .returns(WHOLE),
        of_x(
            "int",
            |call| round(call, f64::trunc),
            "Rounds x towards zero to a whole number.",
            "check(int(2.7) == 2 && int(-2.7) == -2);",
        )
        .returns(WHOLE)
        .with_related(&["floor", "fraction"]),
        of_x(
            "fraction",
            |call| map(call, f64::fract),
            "Returns the fractional part of x, x - int(x).",
            "check(fraction(2.75) == 0.75);",
        )
        .with_related(&["int"])
        .corner(at_integers),
        of_x(
            "round",
            |call| round(call, f64::round),
            "Rounds x to the nearest whole number.",
            "check(round(2.6) == 3);",
        )
        .returns(WHOLE)
        .with_related(&["round_to"]),
        of_x(
            "is_nan",
            |call| Ok(x(call)?.is_nan().into()),
            "Returns true if x is nan.",
            "check(is_nan(0 / 0));",
        )
        .returns(Returns::BOOLEAN),
        of_x(
            "is_finite",
            |call| Ok(x(call)?.is_finite().into()),
            "Returns true if x is neither infinite nor nan.",
            "check(!is_finite(1 / 0));",
        )
        .returns(Returns::BOOLEAN),
        of_x(
            "is_infinite",
            |call| Ok(x(call)?.is_infinite().into()),
            "Returns true if x is infinite.",
            "check(is_infinite(1 / 0));",
        )
        .returns(Returns::BOOLEAN),
        function("abs", &[numeric("x")], absolute)
            .returns(Returns::NUMBER.with_remark(", whole if x is"))
            .summary("Returns the absolute value of a number.")
            .example("check(abs(-3) == 3);")
            .corner(at_zero),
        function("hypot", &[ANY_X, ANY_Y], |call| {
            Ok(elementary::hypot(x(call)?, call.number("y")?).into())
        })
        .returns(Returns::NUMBER)
        .summary("Returns the length of the vector with components x and y, without overflow.")
        .example("check(hypot(3, 4) == 5);")
        .with_related(&["norm"])
        .corner(at_origin),
        function("atan2", &[ANY_Y, ANY_X], |call| {
            Ok(elementary::atan2(call.number("y")?, x(call)?).into())
        })
        .returns(Returns::NUMBER.with_description("an angle from -PI to PI"))
        .summary(
            "Returns the angle of the vector with components x and y; y is the first argument.",
        )
        .example("check(atan2(1, 0) == PI / 2);")
        .with_related(&["angle"])
        .corner(at_branch_cut),
        function("min", &[numeric("x"), numeric("y")], |call| choose(call, |x, y| x < y))
            .returns(Returns::NUMBER)
            .summary("Returns the smaller of two numbers; nan if one of them is nan.")
            .example("check(min(2, 0.5) == 0.5);")
            .corner(at_equality),
        function("max", &[numeric("x"), numeric("y")], |call| choose(call, |x, y| x > y))
            .returns(Returns::NUMBER)
            .summary("Returns the larger of two numbers; nan if one of them is nan.")
            .example("check(max(2, 0.5) == 2);")
            .corner(at_equality),
        function("quotient", &[integer("n"), integer("d")], quotient)
            .returns(Returns::INTEGER)
            .summary("Returns the quotient n/d rounded down to a whole number, for indices.")
            .example("check(quotient(7, 2) == 3);\ncheck(7 / 2 == 3.5);"),
        function("round_to", &[ANY_X, integer("digits").between(0.0, 15.0)], round_to)
            .returns(Returns::NUMBER)
            .summary("Rounds x to this many digits after the decimal point.")
            .example("check(round_to(PI, 2) == 3.14);")
            .with_related(&["round", "fixed"])
            .corner(at_digit_changes),
    ],
};

const WHOLE: Returns = Returns::INTEGER.with_remark(", or x itself if it is too large for one");
const ANY_X: Parameter = number("x").allow_non_finite();
const ANY_Y: Parameter = number("y").allow_non_finite();

const fn of_x(
    name: &'static str,
    body: NativeFunction,
    summary: &'static str,
    example: &'static str,
) -> FunctionBinding {
    function(name, &[ANY_X], body).returns(Returns::NUMBER).summary(summary).example(example)
}

fn x(call: &Call) -> Result<f64, ScriptError> {
    call.number("x")
}

fn map(call: &Call, f: fn(f64) -> f64) -> Result<Dynamic, ScriptError> {
    Ok(f(x(call)?).into())
}

/// Rounded number, as an integer if it is within the range of integers, so that it can be an index.
fn round(call: &Call, f: fn(f64) -> f64) -> Result<Dynamic, ScriptError> {
    const LIMIT: f64 = 9e18;
    let rounded = f(x(call)?);
    Ok(if rounded.abs() < LIMIT { (rounded as INT).into() } else { rounded.into() })
}

fn absolute(call: &mut Call) -> Result<Dynamic, ScriptError> {
    let value = call.value("x")?;
    match value.as_int() {
        Ok(n) => Ok(n.checked_abs().map_or_else(|| (n as f64).abs().into(), Dynamic::from)),
        Err(_) => Ok(as_number(&value).unwrap_or(f64::NAN).abs().into()),
    }
}

fn choose(call: &Call, prefers_first: fn(f64, f64) -> bool) -> Result<Dynamic, ScriptError> {
    let (first, second) = (call.value("x")?, call.value("y")?);
    let (x, y) = (as_number(&first).unwrap_or(f64::NAN), as_number(&second).unwrap_or(f64::NAN));
    Ok(if x.is_nan() || prefers_first(x, y) { first } else { second })
}

fn quotient(call: &mut Call) -> Result<Dynamic, ScriptError> {
    let (n, d) = (call.integer("n")?, call.integer("d")?);
    match n.checked_div_euclid(d) {
        Some(quotient) => Ok(quotient.into()),
        None => Err(call
            .error(format!("the whole quotient of {n} by {d} does not exist"))
            .hint("use n / d for the quotient as a number")),
    }
}

fn round_to(call: &mut Call) -> Result<Dynamic, ScriptError> {
    let (x, digits) = (x(call)?, call.count("digits")?);
    // The decimal text is parsed to give the float nearest to the printed number.
    Ok(format!("{x:.digits$}").parse().unwrap_or(x).into())
}
