//! The language that the domains make together.

use super::TABLES;
use crate::script::rows::catalog::Catalog;

/// The language of withy.
pub fn language() -> Catalog {
    Catalog::of(TABLES)
}
