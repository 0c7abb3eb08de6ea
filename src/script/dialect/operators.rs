//! Arithmetic and comparison of numbers as in scientific languages, for the operators of [`syntax`](crate::script::source::syntax).
//!
//! Comparisons follow IEEE 754, also between integers and floats. Division never truncates, and integer overflow is an error.
//! A power of integers with a non-negative exponent is an integer.
//! Comparing the order of values of different types is an error. For values other than numbers, all remaining operators are those of the engine.
//!
//! A remaining restriction of the engine is that `switch` distinguishes number types, so that `3.0` does not match `case 3`.
//! Another restriction is that a minus sign has precedence over a power. Therefore `-x^2` is an error.

use std::any::TypeId;
use std::cmp::Ordering;

use rhai::{Dynamic, Engine, EvalAltResult, INT, NativeCallContext, Position};

use crate::elementary::power;
use crate::script::messages::error::{EngineResult, ScriptError};
use crate::script::source::syntax::{DivisionOperand, LONGEST_CHAIN, OWN, REPLACED, power_name};

pub fn install(engine: &mut Engine) {
    use Ordering::{Equal, Greater, Less};
    register_comparison(engine, "<", |order| order == Some(Less));
    register_comparison(engine, ">", |order| order == Some(Greater));
    register_comparison(engine, "<=", |order| matches!(order, Some(Less | Equal)));
    register_comparison(engine, ">=", |order| matches!(order, Some(Greater | Equal)));
    register_comparison(engine, "==", |order| order == Some(Equal));
    register_comparison(engine, "!=", |order| order != Some(Equal));
    register_arithmetic(
        engine,
        &format!("{OWN}/"),
        |x, y| x / y,
        |m, n| Ok((m as f64 / n as f64).into()),
    );
    for chain in 0..LONGEST_CHAIN {
        register_arithmetic(engine, &power_name(chain), power, whole_power);
    }
    engine.register_fn(format!("{OWN}<<"), shifted_up);
    engine.register_fn(format!("{OWN}>>"), shifted_down);
    for (symbol, _) in REPLACED {
        forward_to_engine(engine, format!("{OWN}{symbol}"), symbol);
    }
    for chain in 0..LONGEST_CHAIN {
        forward_to_engine(engine, power_name(chain), "^");
    }
    register_assignment(engine, "/=", format!("{OWN}/"));
    register_assignment(engine, "**=", power_name(0));
    register_assignment(engine, "<<=", format!("{OWN}<<"));
    register_assignment(engine, ">>=", format!("{OWN}>>"));
}

/// Operator as written in scripts. For example, `num<` is `<`, and `num^3` is `^`.
pub fn written(operator: &str) -> &str {
    match operator.strip_prefix(OWN) {
        Some(power) if power.starts_with('^') => "^",
        Some(symbol)
            if !symbol.is_empty()
                && !symbol.starts_with(|c: char| c.is_alphanumeric() || c == '_') =>
        {
            symbol
        }
        _ => operator,
    }
}

/// Registers a comparison of numbers. `holds` receives `None` for a comparison with NaN.
fn register_comparison(engine: &mut Engine, symbol: &str, holds: fn(Option<Ordering>) -> bool) {
    // The comparison is also registered under the engine's own operator name, because arrays use this name to compare and search elements.
    for name in [symbol.to_owned(), format!("{OWN}{symbol}")] {
        engine.register_fn(&name, move |x: f64, y: f64| holds(x.partial_cmp(&y)));
        engine.register_fn(&name, move |m: INT, n: INT| holds(Some(m.cmp(&n))));
        engine.register_fn(&name, move |x: f64, n: INT| holds(order(n, x).map(Ordering::reverse)));
        engine.register_fn(&name, move |n: INT, x: f64| holds(order(n, x)));
    }
}

fn order(whole: INT, x: f64) -> Option<Ordering> {
    /// Smallest float that is larger than all integers: 2^63.
    const BEYOND: f64 = 9_223_372_036_854_775_808.0;
    if x >= BEYOND {
        return Some(Ordering::Less);
    }
    if x < -BEYOND {
        return Some(Ordering::Greater);
    }
    // NaN has no order, so the result is `None`.
    let rest = (x - x.trunc()).partial_cmp(&0.0)?.reverse();
    Some(whole.cmp(&(x.trunc() as INT)).then(rest))
}

fn register_arithmetic(
    engine: &mut Engine,
    name: &str,
    numbers: fn(f64, f64) -> f64,
    wholes: fn(INT, INT) -> EngineResult<Dynamic>,
) {
    engine.register_fn(name, numbers);
    engine.register_fn(name, wholes);
    engine.register_fn(name, move |x: f64, n: INT| numbers(x, n as f64));
    engine.register_fn(name, move |n: INT, x: f64| numbers(n as f64, x));
}

/// Power of integers. It is an integer for a non-negative exponent, otherwise a float: `2^3` is 8, `2^-1` is 0.5.
fn whole_power(base: INT, exponent: INT) -> EngineResult<Dynamic> {
    if exponent < 0 {
        return Ok(power(base as f64, exponent as f64).into());
    }
    let whole = match (base, u32::try_from(exponent)) {
        (_, Ok(exponent)) => base.checked_pow(exponent),
        (0 | 1, Err(_)) => Some(base),
        (-1, Err(_)) => Some(if exponent % 2 == 0 { 1 } else { -1 }),
        (_, Err(_)) => None,
    };
    whole.map(Dynamic::from).ok_or_else(|| {
        let written = if base < 0 { format!("({base}.0)") } else { format!("{base}.0") };
        let message = format!("{base}^{exponent} is too large for a whole number of 64 bits");
        let hint = format!("write {written}^{exponent} for the nearest number");
        ScriptError::new(message).hint(hint).into_engine(Position::NONE)
    })
}

/// Result of `number << places`. A loss of bits is an error.
fn shifted_up(number: INT, places: INT) -> EngineResult<INT> {
    let shifted = number << shift(places)?;
    match shifted >> places == number {
        true => Ok(shifted),
        false => {
            let message =
                format!("{number} << {places} is too large for a whole number of 64 bits");
            let hint = format!("write {number}.0 * 2^{places} for the nearest number");
            Err(ScriptError::new(message).hint(hint).into_engine(Position::NONE))
        }
    }
}

fn shifted_down(number: INT, places: INT) -> EngineResult<INT> {
    Ok(number >> shift(places)?)
}

fn shift(places: INT) -> EngineResult<INT> {
    match places {
        0..=63 => Ok(places),
        _ => {
            let message = format!("the shift of bits must be 0 to 63 places, got {places}");
            Err(ScriptError::new(message).into_engine(Position::NONE))
        }
    }
}

/// Registers the operator `name` for operands of any types by calling the operator `symbol` of the engine.
/// An order comparison of values of different types is an error.
fn forward_to_engine(engine: &mut Engine, name: String, symbol: &'static str) {
    let any_two = [TypeId::of::<Dynamic>(); 2];
    engine.register_raw_fn(
        name,
        any_two,
        move |context: NativeCallContext, operands| -> EngineResult<Dynamic> {
            let [left, right] = operands else { return Ok(Dynamic::UNIT) };
            let (mut left, mut right) = (left.clone(), right.clone());
            let ordered = matches!(symbol, "<" | ">" | "<=" | ">=");
            if ordered && left.type_id() != right.type_id() {
                let types =
                    [&left, &right].map(|value| context.engine().map_type_name(value.type_name()));
                let signature = format!("{symbol} ({}, {})", types[0], types[1]);
                return Err(EvalAltResult::ErrorFunctionNotFound(
                    signature,
                    context.call_position(),
                )
                .into());
            }
            context.call_native_fn_raw(symbol, false, &mut [&mut left, &mut right])
        },
    );
}

/// Registers `x /= y` and similar assignments as `x = x / y`, for any types.
fn register_assignment(engine: &mut Engine, name: &'static str, operator: String) {
    let types = [TypeId::of::<Dynamic>(), TypeId::of::<DivisionOperand>()];
    engine.register_raw_fn(
        name,
        types,
        move |context: NativeCallContext, values| -> EngineResult<()> {
            let [target, operand] = values else { return Ok(()) };
            let Some(DivisionOperand(mut right)) = operand.clone().try_cast::<DivisionOperand>()
            else {
                return Ok(());
            };
            let mut left = target.clone();
            **target =
                context.call_native_fn_raw(&operator, false, &mut [&mut left, &mut right])?;
            Ok(())
        },
    );
}
