//! Catalog of all domains.

use super::TABLES;
use crate::script::bindings::catalog::Catalog;

/// Catalog of the language of withy.
pub fn language() -> Catalog {
    Catalog::of(TABLES)
}
