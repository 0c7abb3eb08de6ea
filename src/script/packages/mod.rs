//! The domains of the language, one file each. A new domain is a new file and a line in [`TABLES`].

mod arrays;
mod checking;
mod math;
mod text;
mod vectors;

use super::table::Table;

/// All domains, in the order of the reference.
pub const TABLES: &[&Table] =
    &[&math::TABLE, &vectors::TABLE, &arrays::TABLE, &text::TABLE, &checking::TABLE];

#[cfg(test)]
mod tests;
