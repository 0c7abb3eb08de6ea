//! The constants of the language: names that stand for numbers everywhere, unless a script gives them to something of its own.

use std::collections::HashMap;

use rhai::{Dynamic, Engine};

use super::sizes;
use crate::script::bindings::catalog::Catalog;

/// Lets scripts read the constants of `catalog`.
///
/// As values of a module of the engine they would not be seen by closures, which look for what they capture among variables.
#[expect(deprecated, reason = "so marked as it may change; the version of Rhai is fixed")]
pub fn install(engine: &mut Engine, catalog: &Catalog) {
    let all = catalog.tables().flat_map(|table| table.constants);
    let values: HashMap<&str, Dynamic> =
        all.map(|constant| (constant.name, constant.value.into())).collect();
    engine.on_var(move |name, place, context| {
        // A place is that of a variable which the parser has seen, counted from the last one.
        let own = match place.checked_sub(1) {
            Some(place) => context.scope().iter_raw().nth(place).map(|(_, _, value)| value),
            None => context.scope().get(name),
        };
        match own {
            Some(value) => sizes::check(value).map(|()| None),
            None => Ok(values.get(name).cloned()),
        }
    });
}
