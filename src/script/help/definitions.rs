//! Definition files (`.d.rhai`) for the Rhai language server in editors, generated from the bindings.
//!
//! A function with optional arguments has one declaration for each number of arguments, because the format has no optional arguments.
//! Units, allowed values, options and examples are in the comment above a declaration, which editors show.

mod types;

use std::fmt::Write;

use super::reference::{describe_parameter, returns_text};
use crate::script::bindings::built_in::{BuiltIn, BuiltInTable, FunctionForm, NameSuffix};
use crate::script::bindings::catalog::Catalog;
use crate::script::bindings::table::{BindingTable, CallSyntax, FunctionBinding};
use types::{for_kind, for_value, identifier};

/// Definition file.
#[derive(Clone, Debug, PartialEq)]
pub struct DefinitionFile {
    /// File name.
    pub name: String,
    /// Text.
    pub text: String,
}

/// Definition files of the language: one for all types, and one for each table of bindings or of functions of Rhai.
pub fn definitions(catalog: &Catalog) -> Vec<DefinitionFile> {
    let mut files =
        vec![DefinitionFile { name: "types.d.rhai".into(), text: types::file(catalog) }];
    files.extend(catalog.tables().map(of_table));
    files.extend(catalog.built_in_tables().map(of_built_ins));
    files
}

const HEADER: &str = "module static;\n";

fn of_table(table: &BindingTable) -> DefinitionFile {
    let mut text = format!("/// {}\n{HEADER}", table.doc);
    for constant in table.constants {
        let _ = writeln!(text, "\n/// {}\nconst {}: number;", constant.summary, constant.name);
    }
    for row in table.rows {
        let comment = comment(&row_comment(table, row));
        for declaration in declarations(row) {
            let _ = write!(text, "\n{comment}{declaration};\n");
        }
    }
    DefinitionFile { name: format!("{}.d.rhai", identifier(table.name)), text }
}

fn of_built_ins(table: &BuiltInTable) -> DefinitionFile {
    let mut text = format!("/// {}\n{HEADER}", table.doc);
    for built_in in table.rows {
        let comment = comment(&built_in_comment(built_in));
        let returns = for_value(&built_in.returns.kind);
        for declaration in built_in.written().flat_map(|form| built_in_declarations(&form)) {
            let _ = write!(text, "\n{comment}{declaration} -> {returns};\n");
        }
    }
    DefinitionFile { name: format!("rhai_{}.d.rhai", table.name), text }
}

fn declarations(row: &FunctionBinding) -> Vec<String> {
    let returns = for_value(&row.returns.kind);
    let typed = |count: usize| {
        let parameters = row.parameters[..count].iter();
        parameters.map(|known| format!("{}: {}", identifier(known.name), for_kind(&known.kind)))
    };
    let receiver = row.receiver().map(|of| format!("{0}: {0}", identifier(of.name())));
    let list = |count: usize| {
        receiver.clone().into_iter().chain(typed(count)).collect::<Vec<_>>().join(", ")
    };
    match row.form {
        CallSyntax::Function | CallSyntax::Method(_) => (row.required()..=row.parameters.len())
            .map(|count| format!("fn {}({}) -> {returns}", row.name, list(count)))
            .collect(),
        CallSyntax::Property(_) => {
            let mut declared = vec![format!("fn get {}({}) -> {returns}", row.name, list(0))];
            if let Some(setter) = row.setter {
                let [value] = setter.value;
                let value = format!("value: {}", for_kind(&value.kind));
                declared.push(format!("fn set {}({}, {value})", row.name, list(0)));
            }
            declared
        }
        CallSyntax::Operator => {
            let operands: Vec<_> =
                row.parameters.iter().map(|known| for_kind(&known.kind)).collect();
            vec![format!("op {}({}) -> {returns}", row.name, operands.join(", "))]
        }
    }
}

fn built_in_declarations(form: &FunctionForm) -> Vec<String> {
    let receiver = form.receiver.map(|of| format!("{of}: {}", types::for_receiver(of)));
    let named = |count: usize| {
        let arguments = form.required.iter().chain(form.optional.iter().take(count));
        let arguments = arguments.map(|name| format!("{name}: ?"));
        receiver.clone().into_iter().chain(arguments).collect::<Vec<_>>().join(", ")
    };
    let name = form.name;
    match form.ending {
        NameSuffix::Property => vec![format!("fn get {name}({})", named(0))],
        NameSuffix::Arguments => {
            (0..=form.optional.len()).map(|count| format!("fn {name}({})", named(count))).collect()
        }
        NameSuffix::Repeated => vec![format!("fn {name}({}, ...values: ?)", named(0))],
    }
}

fn row_comment(table: &BindingTable, row: &FunctionBinding) -> String {
    let mut text =
        format!("`{}`{}\n\n{}\n", row.signature(), returns_text(&row.returns), row.summary);
    if !row.doc.is_empty() {
        let _ = writeln!(text, "\n{}", row.doc);
    }
    if !row.parameters.is_empty() {
        text.push('\n');
        row.parameters.iter().for_each(|parameter| describe_parameter(&mut text, parameter, 0));
    }
    let setup = if table.setup.is_empty() { String::new() } else { format!("{}\n", table.setup) };
    text += &example(&format!("{setup}{}", row.example));
    text
}

fn built_in_comment(built_in: &BuiltIn) -> String {
    let forms: Vec<_> = built_in.forms.iter().map(|form| format!("`{form}`")).collect();
    let mut text = format!(
        "{}{}\n\n{}\n",
        forms.join(", "),
        returns_text(&built_in.returns),
        built_in.summary
    );
    if !built_in.doc.is_empty() {
        let _ = writeln!(text, "\n{}", built_in.doc);
    }
    text += &example(built_in.example);
    text
}

fn example(script: &str) -> String {
    format!("\n# Example\n\n```rhai\n{script}\n```\n")
}

fn comment(text: &str) -> String {
    text.lines().map(|line| format!("{}\n", format!("/// {line}").trim_end())).collect()
}

#[cfg(test)]
mod tests;
