//! The constants of the language: names that stand for numbers everywhere, unless a script gives them to something of its own.

use std::collections::HashMap;

use rhai::{Dynamic, Engine};

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
        // A place is that of a variable which the parser has seen.
        let is_own = place > 0 || context.scope().contains(name);
        Ok(if is_own { None } else { values.get(name).cloned() })
    });
}
