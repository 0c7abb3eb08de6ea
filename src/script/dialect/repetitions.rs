//! The method `array.dedup()`. Unlike in Rhai, it can be interrupted, and it returns errors of its function.

use std::any::TypeId;

use rhai::{Array, Dynamic, Engine, FnPtr, NativeCallContext};

use super::elements::{array_of, boolean_result};
use crate::script::messages::error::EngineResult;
use crate::script::source::syntax::OWN;
use crate::script::state::context::Context;

pub(super) const PULSE: usize = 4096;

pub fn install(engine: &mut Engine, context: &Context) {
    let types = [TypeId::of::<Array>(), TypeId::of::<FnPtr>()];
    for count in 1..=2 {
        let (context, equal) = (context.clone(), format!("{OWN}=="));
        engine.register_raw_fn("dedup", &types[..count], move |native, values| {
            let kept = match values.get(1).and_then(|same| (**same).clone().try_cast::<FnPtr>()) {
                Some(same) => without_repetitions(&native, &context, values, |earlier, later| {
                    boolean_result(&native, &same.call_raw(&native, None, [earlier, later])?)
                })?,
                None => {
                    without_repetitions(&native, &context, values, |mut earlier, mut later| {
                        let both = &mut [&mut earlier, &mut later];
                        let answer = native.call_native_fn_raw(&equal, false, both);
                        Ok(answer.is_ok_and(|answer| answer.as_bool().unwrap_or(false)))
                    })?
                }
            };
            if let Some(array) = values.first_mut() {
                **array = kept.into();
            }
            Ok(())
        });
    }
}

fn without_repetitions(
    native: &NativeCallContext,
    context: &Context,
    values: &[&mut Dynamic],
    is_same: impl Fn(Dynamic, Dynamic) -> EngineResult<bool>,
) -> EngineResult<Array> {
    let mut kept = Array::new();
    for (index, element) in array_of(values).into_iter().enumerate() {
        if index.is_multiple_of(PULSE) {
            context.proceed().map_err(|error| error.into_engine(native.call_position()))?;
        }
        let is_repeated = match kept.last() {
            Some(last) => is_same(Dynamic::clone(last), element.clone())?,
            None => false,
        };
        if !is_repeated {
            kept.push(element);
        }
    }
    Ok(kept)
}
