//! The language that the domains make together.

use super::TABLES;
use crate::script::bindings::catalog::Catalog;

/// The language of withy: all its domains.
pub fn language() -> Catalog {
    Catalog::of(TABLES)
}
