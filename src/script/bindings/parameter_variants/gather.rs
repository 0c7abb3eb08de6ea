//! Combination of the results of a call in all variants to one value.

use std::rc::Rc;

use rhai::{Array, Dynamic, Map};

use super::parameter_set::ParameterSet;
use super::variant_value::VariantValue;
use crate::geometry::Vec2;
use crate::script::messages::error::ScriptError;
use crate::script::messages::numbers::as_number;

/// Combines the results of all variants, the unperturbed variant first, to one value.
/// The result is a plain value if all results are equal.
/// For booleans, texts and integers, only the result of the unperturbed variant is kept.
/// The same applies to objects for which `is_thing` is true, because objects of a scene contain their variants.
///
/// # Errors
/// Fails if arrays have different lengths in the variants, or maps different keys.
pub fn combine_variants(
    family: &Rc<ParameterSet>,
    results: &[Dynamic],
    lost: Option<&Rc<str>>,
    is_thing: &dyn Fn(&Dynamic) -> bool,
) -> Result<Dynamic, ScriptError> {
    let first = &results[0];
    if first.is_unit() || first.is_bool() || first.is_string() || is_thing(first) {
        return Ok(first.clone());
    }
    if let Some(own) = first.read_lock::<Array>() {
        let all: Vec<Array> = results.iter().filter_map(|of| of.clone().try_cast()).collect();
        if all.len() != results.len() || all.iter().any(|of| of.len() != own.len()) {
            return Err(differ("array"));
        }
        let element = |at: usize| {
            let each: Vec<Dynamic> = all.iter().map(|of| of[at].clone()).collect();
            combine_variants(family, &each, lost, is_thing)
        };
        return Ok((0..own.len()).map(element).collect::<Result<Array, _>>()?.into());
    }
    if let Some(own) = first.read_lock::<Map>() {
        let all: Vec<Map> = results.iter().filter_map(|of| of.clone().try_cast()).collect();
        if all.len() != results.len() || all.iter().any(|of| !of.keys().eq(own.keys())) {
            return Err(differ("map"));
        }
        let entry = |(at, key): (usize, &rhai::Identifier)| {
            let each: Vec<Dynamic> =
                all.iter().filter_map(|of| of.values().nth(at).cloned()).collect();
            Ok((key.clone(), combine_variants(family, &each, lost, is_thing)?))
        };
        return Ok(own.keys().enumerate().map(entry).collect::<Result<Map, ScriptError>>()?.into());
    }
    if results.iter().all(Dynamic::is_int) {
        return Ok(first.clone());
    }
    if lost.is_none() && results.iter().all(|other| are_equal(first, other)) {
        return Ok(first.clone());
    }
    let undefined = || match (is_defined(first), results.iter().all(is_defined)) {
        (false, _) => Some("it is infinite or undefined".into()),
        (true, false) => Some("it becomes infinite or undefined when a parameter changes".into()),
        (true, true) => None,
    };
    let lost = lost.cloned().or_else(undefined);
    Ok(Dynamic::from(VariantValue::new(family, results.to_vec(), lost)))
}

fn differ(what: &str) -> ScriptError {
    ScriptError::new(format!("the {what} has other places when a parameter changes slightly")).hint(
        "only numbers may depend on a parameter; for other cases use plain numbers in place of \
        scene.parameter(…) and central differences",
    )
}

fn is_defined(value: &Dynamic) -> bool {
    let vector = value.read_lock::<Vec2>();
    as_number(value).is_none_or(f64::is_finite)
        && vector.is_none_or(|of| of.x.is_finite() && of.y.is_finite())
}

fn are_equal(one: &Dynamic, other: &Dynamic) -> bool {
    if let (Some(one), Some(other)) = (as_number(one), as_number(other)) {
        return one.to_bits() == other.to_bits();
    }
    match (one.read_lock::<Vec2>(), other.read_lock::<Vec2>()) {
        (Some(one), Some(other)) => *one == *other,
        _ => false,
    }
}
