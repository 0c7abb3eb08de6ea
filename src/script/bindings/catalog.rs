//! All tables of a language together: what is known under which name, for messages, help and completion.

use super::built_in::{BuiltIn, BuiltInTable, FunctionForm};
use super::builtins;
use super::kind::Type;
use super::returns::ValueKind;
use super::table::{BindingTable, CallSyntax, FunctionBinding};

/// The catalogue of a language: the tables that make it up.
#[derive(Clone)]
pub struct Catalog {
    tables: Vec<&'static BindingTable>,
    built_ins: &'static [&'static BuiltInTable],
}

impl Catalog {
    /// The catalogue of a language of these domains, on what is taken over from Rhai.
    pub fn of(tables: &[&'static BindingTable]) -> Self {
        Self { tables: tables.to_vec(), built_ins: builtins::TABLES }
    }

    /// The catalogue with one more table.
    #[must_use]
    pub fn and(mut self, table: &'static BindingTable) -> Self {
        self.tables.push(table);
        self
    }

    /// The tables of the language, in the order of the reference.
    pub fn tables(&self) -> impl Iterator<Item = &'static BindingTable> {
        self.tables.iter().copied()
    }

    /// All rows of the language.
    pub fn rows(&self) -> impl Iterator<Item = &'static FunctionBinding> {
        self.tables().flat_map(|table| table.rows)
    }

    /// The rows of the language with this name: several when types share a method name.
    pub fn named<'a>(
        &self,
        name: &'a str,
    ) -> impl Iterator<Item = &'static FunctionBinding> + use<'a, '_> {
        self.rows().filter(move |row| row.name == name)
    }

    /// The names of the language that can be called as functions.
    pub fn function_names(&self) -> impl Iterator<Item = &'static str> {
        self.rows().filter(|row| matches!(row.form, CallSyntax::Function)).map(|row| row.name)
    }

    /// The type of the language with this display name.
    pub fn type_named(&self, name: &str) -> Option<Type> {
        self.tables().flat_map(|table| table.types).find(|of| of.name() == name).copied()
    }

    /// The methods and properties of a type of the language.
    pub fn members(&self, of: &str) -> Vec<&'static FunctionBinding> {
        self.rows()
            .filter(|row| row.receiver().is_some_and(|receiver| receiver.name() == of))
            .collect()
    }

    /// The kind of the values whose type has this display name.
    pub fn kind_named(&self, name: &str) -> Option<ValueKind> {
        ValueKind::plain(name).or_else(|| self.type_named(name).map(ValueKind::Object))
    }

    /// The methods and properties that values of a type have from Rhai, each as it is written on them first of all.
    pub fn built_in_members<'a>(
        &self,
        of: &'a str,
    ) -> impl Iterator<Item = (&'static BuiltIn, FunctionForm)> + use<'a> {
        self.built_ins().filter_map(move |known| Some((known, known.form_of(of)?)))
    }

    /// The names of the language with a fixed value.
    pub fn constants(&self) -> impl Iterator<Item = &str> {
        self.tables().flat_map(|table| table.constants).map(|constant| constant.name)
    }

    /// The tables of what the language takes over from Rhai, in the order of the reference.
    pub fn built_in_tables(&self) -> impl Iterator<Item = &'static BuiltInTable> + use<> {
        self.built_ins.iter().copied()
    }

    /// The functions of Rhai that the language takes over.
    pub fn built_ins(&self) -> impl Iterator<Item = &'static BuiltIn> + use<> {
        self.built_in_tables().flat_map(|table| table.rows)
    }

    /// The functions of Rhai with this name that the language takes over.
    pub fn built_ins_named<'a>(
        &self,
        name: &'a str,
    ) -> impl Iterator<Item = &'static BuiltIn> + use<'a, '_> {
        self.built_ins().filter(move |built_in| built_in.name() == name)
    }
}
