//! Named constants of the language. Scripts may define variables with the same names.

use std::collections::HashMap;

use rhai::{Dynamic, Engine};

use super::sizes;
use crate::script::bindings::catalog::Catalog;

/// Makes constants visible by a variable resolver, because closures would not see the constants of a module.
#[expect(deprecated, reason = "so marked as it may change; the version of Rhai is fixed")]
pub fn install(engine: &mut Engine, catalog: &Catalog) {
    let all = catalog.tables().flat_map(|table| table.constants);
    let values: HashMap<&str, Dynamic> =
        all.map(|constant| (constant.name, constant.value.into())).collect();
    engine.on_var(move |name, place, context| {
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
