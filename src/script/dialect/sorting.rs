//! Sorting by a script function or in natural order.
//! The method of Rhai ignores errors and wrong results of the function, and rejects arrays with both integers and floats.

use std::any::TypeId;
use std::cmp::Ordering;

use rhai::{Array, Dynamic, Engine, EvalAltResult, FnPtr, NativeCallContext};

use super::elements::array_of;
use super::repetitions::PULSE;
use crate::script::bindings::parameter_variants::VariantValue;
use crate::script::messages::error::{EngineResult, ScriptError};
use crate::script::messages::numbers::describe;
use crate::script::state::context::Context;

type SortFunction = fn(Ordering) -> Ordering;

pub fn install(engine: &mut Engine, context: &Context) {
    let types = [TypeId::of::<Array>(), TypeId::of::<FnPtr>()];
    for name in ["sort", "sort_by"] {
        engine.register_raw_fn(name, types, |native, values| -> EngineResult<()> {
            let sorted = sorted(&native, values)?;
            if let [array, _] = values {
                **array = sorted.into();
            }
            Ok(())
        });
    }
    for name in ["order", "order_by"] {
        engine.register_raw_fn(name, types, |native, values| -> EngineResult<Array> {
            sorted(&native, values)
        });
    }
    for (sort, order, turned) in [
        ("sort", "order", (|order| order) as SortFunction),
        ("sort_desc", "order_desc", Ordering::reverse as SortFunction),
    ] {
        let types = [TypeId::of::<Array>()];
        let asked = context.clone();
        engine.register_raw_fn(sort, types, move |native, values| -> EngineResult<()> {
            let sorted = sorted_naturally(&native, &asked, values, turned)?;
            if let [array] = values {
                **array = sorted.into();
            }
            Ok(())
        });
        let asked = context.clone();
        engine.register_raw_fn(order, types, move |native, values| -> EngineResult<Array> {
            sorted_naturally(&native, &asked, values, turned)
        });
    }
}

fn sorted_naturally(
    native: &NativeCallContext,
    context: &Context,
    values: &[&mut Dynamic],
    turned: SortFunction,
) -> EngineResult<Array> {
    let array = array_of(values);
    let [first, others @ ..] = array.as_slice() else { return Ok(array) };
    if let Some(stranger) = others.iter().find(|other| natural_order(first, other).is_none()) {
        let engine = native.engine();
        let (first, stranger) = (describe(engine, first), describe(engine, stranger));
        let message = format!("{first} and {stranger} cannot be compared for sorting");
        let hint = "give the order: sort(|a, b| a.x - b.x)";
        return Err(ScriptError::new(message).hint(hint).into_engine(native.call_position()));
    }
    // Integers above 2^53 are compared as integers, because as floats different integers could be equal.
    let order: fn(&Dynamic, &Dynamic) -> Ordering = match array.iter().all(Dynamic::is_int) {
        true => |x, y| x.as_int().ok().cmp(&y.as_int().ok()),
        false => |x, y| natural_order(x, y).unwrap_or(Ordering::Equal),
    };
    let mut compared = 0_usize;
    merged(array, &mut |x, y| {
        compared += 1;
        if compared.is_multiple_of(PULSE) {
            context.proceed().map_err(|error| error.into_engine(native.call_position()))?;
        }
        Ok(turned(order(x, y)) == Ordering::Greater)
    })
}

/// Natural order of two numbers, strings, characters or booleans, with NaN last; `None` for other values.
fn natural_order(x: &Dynamic, y: &Dynamic) -> Option<Ordering> {
    if let (Some(x), Some(y)) = (VariantValue::number(x), VariantValue::number(y)) {
        return Some(x.partial_cmp(&y).unwrap_or_else(|| x.is_nan().cmp(&y.is_nan())));
    }
    if let (Ok(x), Ok(y)) = (x.as_immutable_string_ref(), y.as_immutable_string_ref()) {
        return Some(x.as_str().cmp(y.as_str()));
    }
    let characters = x.as_char().ok().zip(y.as_char().ok()).map(|(x, y)| x.cmp(&y));
    characters.or_else(|| x.as_bool().ok().zip(y.as_bool().ok()).map(|(x, y)| x.cmp(&y)))
}

fn sorted(native: &NativeCallContext, values: &[&mut Dynamic]) -> EngineResult<Array> {
    let [_, function] = values else { return Ok(Array::new()) };
    let array = array_of(values);
    let Some(function) = (**function).clone().try_cast::<FnPtr>() else { return Ok(array) };
    merged(array, &mut |x, y| {
        let order = function.call_raw(native, None, [x.clone(), y.clone()])?;
        is_after(native, &order)
    })
}

fn is_after(native: &NativeCallContext, order: &Dynamic) -> EngineResult<bool> {
    if let Ok(is_before) = order.as_bool() {
        return Ok(!is_before);
    }
    VariantValue::number(order).filter(|order| !order.is_nan()).map(|order| order > 0.0).ok_or_else(
        || {
            let got = describe(native.engine(), order);
            let message = format!(
                "the function that compares must return a number or true or false, got {got}"
            );
            let refusal = ScriptError::new(message);
            refusal
                .hint("write |x, y| x - y for ascending order")
                .into_engine(native.call_position())
        },
    )
}

fn merged(
    mut left: Array,
    is_after: &mut impl FnMut(&Dynamic, &Dynamic) -> Result<bool, Box<EvalAltResult>>,
) -> EngineResult<Array> {
    if left.len() <= 1 {
        return Ok(left);
    }
    let right = left.split_off(left.len() / 2);
    let mut all = Array::with_capacity(left.len() + right.len());
    let mut left = merged(left, is_after)?.into_iter().peekable();
    let mut right = merged(right, is_after)?.into_iter().peekable();
    while let (Some(x), Some(y)) = (left.peek(), right.peek()) {
        let next = if is_after(x, y)? { right.next() } else { left.next() };
        all.extend(next);
    }
    all.extend(left);
    all.extend(right);
    Ok(all)
}
