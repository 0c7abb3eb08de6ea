//! The language reference as a document, from the same rows that the engine registers.

use std::fmt::Write;

use super::catalog::Catalog;
use super::kind::Kind;
use super::parameter::{Parameter, Presence};
use super::table::{Row, Table};

/// The reference of a language in Markdown.
pub fn reference(catalog: &Catalog) -> String {
    let mut text = String::from(
        "# The language\n\n\
         *Made from the tables in `src/script/packages`; `WITHY_UPDATE=1 cargo test --test documents` makes it again.*\n\n\
         withy speaks [Rhai](https://rhai.rs/book) with numbers as in science: `1/20` is 0.05, `2^3` is 8, comparisons are \
         IEEE ones, and a whole number is welcome wherever a number is. Points are arrays `[x, y]` or vectors. Options are \
         maps `#{ … }`; a misspelt key is an error. Optional parameters stand in brackets.\n\n",
    );
    for table in catalog.tables() {
        text +=
            &format!("- [{0}](#{1}): {2}\n", title(table), table.name.replace(' ', "-"), table.doc);
    }
    for table in catalog.tables() {
        describe_table(&mut text, table);
    }
    text
}

fn title(table: &Table) -> String {
    let mut letters = table.name.chars();
    letters.next().map_or_else(String::new, |first| first.to_uppercase().chain(letters).collect())
}

fn describe_table(text: &mut String, table: &Table) {
    // Writing to a text cannot fail.
    let _ = writeln!(text, "\n## {}\n\n{}", title(table), table.doc);
    for of in table.types {
        let _ = writeln!(text, "\n*{}*: {}", of.name(), of.doc());
    }
    if !table.setup.is_empty() {
        let _ = writeln!(text, "\nThe examples begin with\n\n```rhai\n{}\n```", table.setup);
    }
    for constant in table.constants {
        let _ = writeln!(text, "\n### `{}`\n\n{}", constant.name, constant.summary);
    }
    for row in table.rows {
        describe_row(text, row);
    }
}

fn describe_row(text: &mut String, row: &Row) {
    let gives =
        if row.returns.is_empty() { String::new() } else { format!(" → {}", row.returns) };
    let _ = writeln!(text, "\n### `{}`{gives}\n\n{}", row.signature(), row.summary);
    if !row.doc.is_empty() {
        let _ = writeln!(text, "\n{}", row.doc);
    }
    if !row.parameters.is_empty() {
        text.push('\n');
        row.parameters.iter().for_each(|parameter| describe_parameter(text, parameter, 0));
    }
    let _ = writeln!(text, "\n```rhai example\n{}\n```", row.example);
    if !row.see.is_empty() {
        let names: Vec<String> = row.see.iter().map(|name| format!("`{name}`")).collect();
        let _ = writeln!(text, "\nSee also {}.", names.join(", "));
    }
}

fn describe_parameter(text: &mut String, parameter: &Parameter, depth: usize) {
    let doc = if parameter.doc.is_empty() { String::new() } else { format!(", {}", parameter.doc) };
    let presence = match parameter.presence {
        Presence::Required => String::new(),
        Presence::Optional => "; optional".to_owned(),
        Presence::Number(default) => format!("; {default} unless given"),
        Presence::Whole(default) => format!("; {default} unless given"),
        Presence::Text(default) => format!("; \"{default}\" unless given"),
        Presence::Boolean(default) => format!("; {default} unless given"),
    };
    let indent = "  ".repeat(depth);
    let _ = writeln!(
        text,
        "{indent}- `{}`: {}{doc}{presence}",
        parameter.name,
        parameter.expectation()
    );
    let kinds = match &parameter.kind {
        Kind::Either(kinds) => kinds,
        kind => std::slice::from_ref(kind),
    };
    for kind in kinds {
        if let Kind::Options(keys) = kind {
            keys.iter().for_each(|key| describe_parameter(text, key, depth + 1));
        }
    }
}
