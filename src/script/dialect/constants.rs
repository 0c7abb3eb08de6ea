//! Named constants of the language, which scripts may shadow.

use std::collections::HashMap;

use rhai::{Dynamic, Engine};

use crate::script::bindings::catalog::Catalog;

/// Makes the constants of `catalog` available to scripts.
///
/// A variable resolver is used, because closures capture variables only and would not see constants of a module.
#[expect(deprecated, reason = "so marked as it may change; the version of Rhai is fixed")]
pub fn install(engine: &mut Engine, catalog: &Catalog) {
    let all = catalog.tables().flat_map(|table| table.constants);
    let values: HashMap<&str, Dynamic> =
        all.map(|constant| (constant.name, constant.value.into())).collect();
    engine.on_var(move |name, place, context| {
        // A non-zero index refers to a variable known to the parser.
        let is_own = place > 0 || context.scope().contains(name);
        Ok(if is_own { None } else { values.get(name).cloned() })
    });
}
