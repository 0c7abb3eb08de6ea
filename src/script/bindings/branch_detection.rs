//! Detection of script functions that branch on parameters of a scene. The results of such functions may jump, so their derivatives are wrong.

use rhai::{Array, Dynamic, FnPtr, Map, NativeCallContext};

use self::search::Decision;
use super::parameter_variants::VariantValue;
use crate::script::state::context::Context;

mod jumps;
mod search;

/// Warns about the first branch of each function whose condition contains the argument of the function and a variable that depends on a parameter.
/// The warning is given once for each position. `given` may contain the functions in arrays and maps.
pub fn warn_once(native: &NativeCallContext, context: &Context, given: &[Dynamic]) {
    given.iter().for_each(|value| warn_about(native, context, value));
}

fn warn_about(native: &NativeCallContext, context: &Context, value: &Dynamic) {
    if let Some(map) = value.read_lock::<Map>() {
        return map.values().for_each(|element| warn_about(native, context, element));
    }
    if let Some(array) = value.read_lock::<Array>() {
        return array.iter().for_each(|element| warn_about(native, context, element));
    }
    let Some(function) = value.read_lock::<FnPtr>() else { return };
    let family = function.curry().iter().find_map(VariantValue::parameter_set_of);
    let Some(family) = family else { return };
    let Some(found) = Decision::find(native, &function) else { return };
    let (line, column) = (found.at.line().unwrap_or(0), found.at.position().unwrap_or(0));
    if family.is_first_report(line, column) {
        let Decision { parameter, sign, .. } = found;
        context.print_message(&format!(
            "note: line {line}, column {column}: {sign} compares with '{parameter}', which \
            depends on a parameter: if the function jumps there, derivatives are wrong; \
            compare with plain numbers, or use value_of(…)"
        ));
    }
}
