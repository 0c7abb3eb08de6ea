//! Check of the values of `switch`: numbers, texts, characters, booleans, `()`, functions, and arrays and maps of these.
//! For values of other types, such as vectors, Rhai would silently execute the default case.

use rhai::{Array, Dynamic, Engine, FnPtr, Map};

use crate::script::bindings::parameter_variants::{VariantValue, present};
use crate::script::messages::error::ScriptError;
use crate::script::messages::numbers::describe;
use crate::script::source::switch_rewrite;

pub fn install(engine: &mut Engine) {
    switch_rewrite::install(engine, |engine, value, at| {
        let value = match present() {
            Some(present) => VariantValue::project(&value, present.variant),
            None => value,
        };
        judge(engine, &value).map_err(|error| error.into_engine(at))?;
        Ok(value)
    });
}

fn judge(engine: &Engine, value: &Dynamic) -> Result<(), ScriptError> {
    if VariantValue::parameter_set_of(value).is_some() {
        let message = "switch cannot compare a value that depends on a parameter of a scene";
        let hint = "use switch int(x) { … } for a whole number, or switch value_of(x) for the number \
            without derivatives; the derivatives ignore the choice";
        return Err(ScriptError::new(message).hint(hint));
    }
    match unusual_value(value) {
        None => Ok(()),
        Some(odd) => {
            let message = format!("switch cannot compare {}", describe(engine, &odd));
            let hint = "switch compares numbers, texts, truth values, (), and arrays and maps of \
                these; use if for other conditions";
            Err(ScriptError::new(message).hint(hint))
        }
    }
}

fn unusual_value(value: &Dynamic) -> Option<Dynamic> {
    if let Some(array) = value.read_lock::<Array>() {
        return array.iter().find_map(unusual_value);
    }
    if let Some(map) = value.read_lock::<Map>() {
        return map.values().find_map(unusual_value);
    }
    let is_known = value.is_unit()
        || value.is_bool()
        || value.is_int()
        || value.is_float()
        || value.is_char()
        || value.is_string()
        || value.is::<FnPtr>();
    (!is_known).then(|| value.clone())
}
