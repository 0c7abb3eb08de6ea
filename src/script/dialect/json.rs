//! The method `map.to_json()`. A value without a JSON form is an error.
//! Unlike in Rhai, vectors become arrays, and values that depend on parameters become plain values.

use rhai::{
    Array, Dynamic, Engine, EvalAltResult, FnPtr, Map, NativeCallContext, Position,
    format_map_as_json,
};

use crate::geometry::Vec2;
use crate::script::bindings::parameter_variants::{VariantValue, present_variant};
use crate::script::messages::error::ScriptError;
use crate::script::messages::numbers::describe;

pub fn install(engine: &mut Engine) {
    engine.register_fn(
        "to_json",
        |call: NativeCallContext, map: &mut Map| -> Result<String, Box<EvalAltResult>> {
            let plain = |(key, value): (&rhai::Identifier, &Dynamic)| {
                let own = writable(call.engine(), value, key, call.call_position());
                own.map(|value| (key.clone(), value))
            };
            Ok(format_map_as_json(&map.iter().map(plain).collect::<Result<Map, _>>()?))
        },
    );
}

fn writable(
    engine: &Engine,
    value: &Dynamic,
    key: &str,
    at: Position,
) -> Result<Dynamic, Box<EvalAltResult>> {
    let value = VariantValue::project(value, present_variant());
    let value = value.flatten();
    if let Some(vector) = value.read_lock::<Vec2>() {
        return Ok(vec![Dynamic::from(vector.x), Dynamic::from(vector.y)].into());
    }
    if let Some(array) = value.read_lock::<Array>() {
        let element = |(index, element): (usize, &Dynamic)| {
            writable(engine, element, &format!("{key}[{index}]"), at)
        };
        return Ok(array.iter().enumerate().map(element).collect::<Result<Array, _>>()?.into());
    }
    if let Some(map) = value.read_lock::<Map>() {
        let entry = |(name, entry): (&rhai::Identifier, &Dynamic)| {
            let own = writable(engine, entry, &format!("{key}.{name}"), at);
            own.map(|entry| (name.clone(), entry))
        };
        return Ok(map.iter().map(entry).collect::<Result<Map, _>>()?.into());
    }
    // JSON has neither infinity nor NaN.
    if value.as_float().is_ok_and(|number| !number.is_finite()) {
        return Ok(Dynamic::UNIT);
    }
    let is_plain = value.is_unit()
        || value.is_bool()
        || value.is_int()
        || value.is_float()
        || value.is_char()
        || value.is_string();
    if is_plain {
        return Ok(value);
    }
    let own = match value.is::<FnPtr>() {
        true => "a function".to_owned(),
        false => describe(engine, &value),
    };
    let message = format!("to_json: '{key}' is {own}, which has no JSON form");
    let hint = "JSON allows numbers, texts, truth values, arrays and maps; give the numbers to be \
        written";
    Err(ScriptError::new(message).hint(hint).into_engine(at))
}
