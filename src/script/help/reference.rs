//! Language reference in Markdown, generated from the bindings.

use std::fmt::Write;

use super::lookup::{maps, presence};
use crate::script::bindings::built_in::BuiltInTable;
use crate::script::bindings::catalog::Catalog;
use crate::script::bindings::parameter::Parameter;
use crate::script::bindings::returns::Returns;
use crate::script::bindings::table::{BindingTable, FunctionBinding};
use crate::script::bindings::topics::{TOPICS, Topic};

const HEAD: &str = "# Language reference

*Generated from the bindings in `src/script`: `WITHY_UPDATE=1 cargo test --test house documents`.*

withy uses [Rhai](https://rhai.rs/book) with scientific numbers. `withy docs NAME` and `help(\"NAME\")` show the same pages. Modules with \
sections, shapes, schedules, mechanisms, checks and comparisons are in the [standard library](standard_library.md).

In an entry, `→` precedes the returned value and optional arguments are in brackets. `simulation.step()` is a method of that type. Units are \
dimensions, such as `[force]`. The keys of an option map are listed below it. Every example runs after the lines that its page begins with.
";

const ABOUT_RHAI: &str = "A function whose argument is written before a dot here can be called in both forms: \
    `text.len()` is `len(text)`.";

/// Page of the reference.
pub struct ReferencePage {
    /// Path of the page below `docs`.
    pub file: String,
    /// Text of the page in Markdown.
    pub text: String,
}

/// Pages of the reference: the index, the syntax, one page for each table of bindings, and the functions of Rhai.
pub fn pages(catalog: &Catalog) -> Vec<ReferencePage> {
    let mut syntax = String::from("# Syntax\n");
    TOPICS.iter().for_each(|topic| describe_topic(&mut syntax, topic));
    let mut rhai = format!("# Functions of Rhai\n\n{ABOUT_RHAI}");
    catalog.built_in_tables().for_each(|table| describe_built_ins(&mut rhai, table));
    let page = |file: &str, text| ReferencePage { file: file.to_owned(), text };
    let tables = catalog.tables().map(|table| page(&file(table), describe_table(table)));
    let mut pages = vec![page("language.md", index(catalog)), page("language/syntax.md", syntax)];
    pages.extend(tables);
    pages.push(page("language/rhai.md", rhai));
    pages
}

/// Returns the whole reference as one text.
pub fn reference(catalog: &Catalog) -> String {
    pages(catalog).into_iter().map(|page| page.text).collect::<Vec<_>>().join("\n")
}

fn file(table: &BindingTable) -> String {
    format!("language/{}.md", table.name.replace(' ', "_"))
}

fn index(catalog: &Catalog) -> String {
    let topics = TOPICS.iter().map(|topic| section_link("syntax", topic.name));
    let rhai = catalog.built_in_tables().map(|table| section_link("rhai", table.name));
    let mut text = format!("{HEAD}\n- [Syntax](language/syntax.md): ");
    text += &topics.collect::<Vec<_>>().join(", ");
    text += "\n";
    for table in catalog.tables() {
        let _ = writeln!(text, "- [{}]({}): {}", title(table.name), file(table), names(table));
    }
    text += "- [Functions of Rhai](language/rhai.md): ";
    text += &rhai.collect::<Vec<_>>().join(", ");
    text += "\n";
    text
}

fn section_link(page: &str, name: &str) -> String {
    format!("[{}](language/{page}.md#{})", title(name), name.replace(' ', "-"))
}

fn names(table: &BindingTable) -> String {
    let mut names: Vec<&str> = table.constants.iter().map(|constant| constant.name).collect();
    for row in table.rows {
        if !names.contains(&row.name) {
            names.push(row.name);
        }
    }
    names.iter().map(|name| format!("`{name}`")).collect::<Vec<_>>().join(" ")
}

fn title(name: &str) -> String {
    let mut letters = name.chars();
    letters.next().map_or_else(String::new, |first| first.to_uppercase().chain(letters).collect())
}

fn describe_topic(text: &mut String, topic: &Topic) {
    let _ = writeln!(text, "\n## {}\n\n{}\n\n{}", title(topic.name), topic.summary, topic.doc);
    example(text, topic.example);
    see(text, topic.see);
}

fn describe_table(table: &BindingTable) -> String {
    let mut text = format!("# {}\n\n{}\n", title(table.name), table.doc);
    for of in table.types {
        let _ = writeln!(text, "\n*{}*: {}", of.name(), of.doc());
    }
    if !table.setup.is_empty() {
        let _ = writeln!(text, "\nThe examples begin with\n\n```rhai\n{}\n```", table.setup);
    }
    for constant in table.constants {
        let _ = writeln!(text, "\n## `{}`\n\n{}", constant.name, constant.summary);
    }
    table.rows.iter().for_each(|row| describe_row(&mut text, row));
    text
}

fn describe_row(text: &mut String, row: &FunctionBinding) {
    let _ = writeln!(
        text,
        "\n## `{}`{}\n\n{}",
        row.signature(),
        returns_text(&row.returns),
        row.summary
    );
    if let Some(setter) = row.setter {
        let [value] = setter.value;
        let _ = writeln!(text, "\nIt can be assigned: {}.", value.expectation());
    }
    if !row.doc.is_empty() {
        let _ = writeln!(text, "\n{}", row.doc);
    }
    if !row.parameters.is_empty() {
        text.push('\n');
        row.parameters.iter().for_each(|parameter| describe_parameter(text, parameter, 0));
    }
    example(text, row.example);
    see(text, row.see);
}

fn describe_built_ins(text: &mut String, table: &BuiltInTable) {
    let _ = writeln!(text, "\n## {}\n\n{}\n", title(table.name), table.doc);
    for built_in in table.rows {
        let forms: Vec<_> = built_in.forms.iter().map(|form| format!("`{form}`")).collect();
        let doc =
            if built_in.doc.is_empty() { String::new() } else { format!(" {}", built_in.doc) };
        let _ = writeln!(
            text,
            "- {}{}: {}{doc}\n\n  ```rhai example\n  {}\n  ```\n",
            forms.join(", "),
            returns_text(&built_in.returns),
            built_in.summary,
            built_in.example.replace('\n', "\n  ")
        );
    }
    text.truncate(text.trim_end().len());
    text.push('\n');
}

fn example(text: &mut String, script: &str) {
    let _ = writeln!(text, "\n```rhai example\n{script}\n```");
}

fn see(text: &mut String, names: &[&str]) {
    if !names.is_empty() {
        let names: Vec<String> = names.iter().map(|name| format!("`{name}`")).collect();
        let _ = writeln!(text, "\nSee also {}.", names.join(", "));
    }
}

pub(super) fn returns_text(returns: &Returns) -> String {
    if returns.is_nothing() { String::new() } else { format!(" → {returns}") }
}

pub(super) fn describe_parameter(text: &mut String, parameter: &Parameter, depth: usize) {
    let doc = if parameter.doc.is_empty() { String::new() } else { format!(", {}", parameter.doc) };
    let _ = writeln!(
        text,
        "{}- `{}`: {}{doc}{}",
        "  ".repeat(depth),
        parameter.name,
        parameter.expectation(),
        presence(parameter.presence),
    );
    for keys in maps(&parameter.kind) {
        keys.iter().for_each(|key| describe_parameter(text, key, depth + 1));
    }
}
