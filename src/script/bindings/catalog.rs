//! Catalog of the script language. Messages, help and completion look up names in it.

use super::built_in::{BuiltIn, BuiltInTable, FunctionForm};
use super::builtins;
use super::kind::Type;
use super::returns::ValueKind;
use super::table::{BindingTable, CallSyntax, FunctionBinding};

/// Catalog of all binding tables of the script language.
#[derive(Clone)]
pub struct Catalog {
    tables: Vec<&'static BindingTable>,
    built_ins: &'static [&'static BuiltInTable],
}

impl Catalog {
    /// Creates a catalog of the given binding tables and of the functions of Rhai.
    pub fn of(tables: &[&'static BindingTable]) -> Self {
        Self { tables: tables.to_vec(), built_ins: builtins::TABLES }
    }

    /// Adds a binding table.
    #[must_use]
    pub fn and(mut self, table: &'static BindingTable) -> Self {
        self.tables.push(table);
        self
    }

    /// Tables of the language, in the order of the reference.
    pub fn tables(&self) -> impl Iterator<Item = &'static BindingTable> {
        self.tables.iter().copied()
    }

    /// All bindings of the language.
    pub fn rows(&self) -> impl Iterator<Item = &'static FunctionBinding> {
        self.tables().flat_map(|table| table.rows)
    }

    /// Bindings with this name, which methods of several types may have.
    pub fn named<'a>(
        &self,
        name: &'a str,
    ) -> impl Iterator<Item = &'static FunctionBinding> + use<'a, '_> {
        self.rows().filter(move |row| row.name == name)
    }

    /// Names of the bindings that are functions. Methods and functions of Rhai are not included.
    pub fn function_names(&self) -> impl Iterator<Item = &'static str> {
        self.rows().filter(|row| matches!(row.form, CallSyntax::Function)).map(|row| row.name)
    }

    /// Type with this display name.
    pub fn type_named(&self, name: &str) -> Option<Type> {
        self.tables().flat_map(|table| table.types).find(|of| of.name() == name).copied()
    }

    /// Methods and properties of a type.
    pub fn members(&self, of: &str) -> Vec<&'static FunctionBinding> {
        self.rows()
            .filter(|row| row.receiver().is_some_and(|receiver| receiver.name() == of))
            .collect()
    }

    /// Kind of return value for the type with this display name.
    pub fn kind_named(&self, name: &str) -> Option<ValueKind> {
        ValueKind::plain(name).or_else(|| self.type_named(name).map(ValueKind::Object))
    }

    /// Methods and properties that Rhai provides for a type, with the first notation of each.
    pub fn built_in_members<'a>(
        &self,
        of: &'a str,
    ) -> impl Iterator<Item = (&'static BuiltIn, FunctionForm)> + use<'a> {
        self.built_ins().filter_map(move |known| Some((known, known.form_of(of)?)))
    }

    /// Names of the constants.
    pub fn constants(&self) -> impl Iterator<Item = &str> {
        self.tables().flat_map(|table| table.constants).map(|constant| constant.name)
    }

    /// Tables of Rhai functions, in the order of the reference.
    pub fn built_in_tables(&self) -> impl Iterator<Item = &'static BuiltInTable> + use<> {
        self.built_ins.iter().copied()
    }

    /// Functions of Rhai.
    pub fn built_ins(&self) -> impl Iterator<Item = &'static BuiltIn> + use<> {
        self.built_in_tables().flat_map(|table| table.rows)
    }

    /// Functions of Rhai with this name.
    pub fn built_ins_named<'a>(
        &self,
        name: &'a str,
    ) -> impl Iterator<Item = &'static BuiltIn> + use<'a, '_> {
        self.built_ins().filter(move |built_in| built_in.name() == name)
    }
}
