//! Sorting by a script function. Rhai's own ignores errors of the function and differences that are not whole.

use std::any::TypeId;

use rhai::{Array, Dynamic, Engine, EvalAltResult, FnPtr, NativeCallContext};

use super::error::ScriptError;
use super::numbers::{as_number, describe};
use super::register::EngineResult;

/// Registers `sort` and `order` with a function that compares.
pub fn install(engine: &mut Engine) {
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
}

fn sorted(native: &NativeCallContext, values: &[&mut Dynamic]) -> EngineResult<Array> {
    let [array, function] = values else { return Ok(Array::new()) };
    let array = array.read_lock::<Array>().map(|array| array.clone()).unwrap_or_default();
    let Some(function) = (**function).clone().try_cast::<FnPtr>() else { return Ok(array) };
    merged(array, &mut |x, y| {
        let order = function.call_raw(native, None, [x.clone(), y.clone()])?;
        is_after(native, &order)
    })
}

/// Whether the first of two elements belongs behind the second, by what the function says of them.
fn is_after(native: &NativeCallContext, order: &Dynamic) -> EngineResult<bool> {
    // True says that the first comes before the second.
    if let Ok(is_before) = order.as_bool() {
        return Ok(!is_before);
    }
    as_number(order).filter(|order| !order.is_nan()).map(|order| order > 0.0).ok_or_else(|| {
        let got = describe(native.engine(), order);
        let told =
            format!("the function that compares must give a number or true or false, got {got}");
        let refusal = ScriptError::new(told);
        refusal.hint("write |x, y| x - y for rising order").into_engine(native.call_position())
    })
}

/// Merge sort: stable, and safe with a function that contradicts itself.
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
