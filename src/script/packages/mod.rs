//! The domains of the language, one file each. A new domain is a new file and a line in [`TABLES`].

mod arrays;
mod checking;
pub mod geometry;
mod math;
mod text;
mod vectors;

use super::table::Table;

/// All domains, in the order of the reference.
pub const TABLES: &[&Table] = &[
    &math::TABLE,
    &vectors::TABLE,
    &geometry::knots::TABLE,
    &geometry::curves::TABLE,
    &geometry::quadrature::TABLE,
    &arrays::TABLE,
    &text::TABLE,
    &checking::TABLE,
];

#[cfg(test)]
mod tests;
