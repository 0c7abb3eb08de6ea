//! Tables of the functions of Rhai that belong to the language, by type of value.

mod arrays;
mod conversions;
mod functions;
mod maps;
mod ranges;
mod searches;
mod texts;
mod values;

use super::built_in::BuiltInTable;

pub const TABLES: &[&BuiltInTable] = &[
    &texts::TABLE,
    &arrays::TABLE,
    &searches::TABLE,
    &maps::TABLE,
    &ranges::TABLE,
    &functions::TABLE,
    &conversions::TABLE,
    &values::TABLE,
];

#[cfg(test)]
mod tests;
