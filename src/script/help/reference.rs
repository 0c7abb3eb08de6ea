//! Markdown language reference, generated from the bindings.

use std::fmt::Write;

use super::lookup::{maps, presence};
use crate::script::bindings::built_in::BuiltInTable;
use crate::script::bindings::catalog::Catalog;
use crate::script::bindings::parameter::Parameter;
use crate::script::bindings::returns::Returns;
use crate::script::bindings::table::{BindingTable, FunctionBinding};
use crate::script::bindings::topics::{TOPICS, Topic};

const HEAD: &str = "# The language

*Made from the tables in `src/script`; `WITHY_UPDATE=1 cargo test --test house documents` makes it again.*

withy speaks [Rhai](https://rhai.rs/book) with numbers as in science. The same pages are shown by `withy docs NAME`, and by \
`help(\"NAME\")` in a script. Every example runs, after the lines that its section begins with. Ready-made sections, shapes, schedules, mechanisms, \
checks and comparisons are in the [standard library](standard_library.md).
";

const ABOUT_ROWS: &str = "How to read an entry: after `→` stands what it gives back. Optional arguments stand in brackets. \
`simulation.step()` is a method: it is called on a value of that type. Units are dimensions, such as `[force]`. The keys of a map \
of options are listed below it.
";

const ABOUT_RHAI: &str = "What the language takes over from Rhai. A function whose first argument stands before a dot here can be \
written either way: `text.len()` is `len(text)`.
";

/// Reference of a language in Markdown.
pub fn reference(catalog: &Catalog) -> String {
    let mut text = format!("{HEAD}\n{}", contents(catalog));
    text += "\n## The language itself\n";
    TOPICS.iter().for_each(|topic| describe_topic(&mut text, topic));
    let _ = write!(text, "\n## Functions of withy\n\n{ABOUT_ROWS}");
    catalog.tables().for_each(|table| describe_table(&mut text, table));
    let _ = write!(text, "\n## From Rhai\n\n{ABOUT_RHAI}");
    catalog.built_in_tables().for_each(|table| describe_built_ins(&mut text, table));
    text
}

fn contents(catalog: &Catalog) -> String {
    let topics =
        TOPICS.iter().map(|topic| link(&title(topic.name), &anchor("language", topic.name)));
    let rhai = catalog
        .built_in_tables()
        .map(|table| link(&title(table.name), &anchor("rhai", table.name)));
    let mut text = format!("- The language itself: {}\n", topics.collect::<Vec<_>>().join(", "));
    text += "- Functions of withy\n";
    for table in catalog.tables() {
        let _ = writeln!(
            text,
            "  - {}: {}",
            link(&title(table.name), &anchor("withy", table.name)),
            names(table)
        );
    }
    text += &format!("- From Rhai: {}\n", rhai.collect::<Vec<_>>().join(", "));
    text
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

fn link(title: &str, anchor: &str) -> String {
    format!("[{title}](#{anchor})")
}

/// Anchors, because headings of different parts may be equal.
fn anchor(part: &str, name: &str) -> String {
    format!("{part}-{}", name.replace(' ', "-"))
}

fn heading(text: &mut String, part: &str, name: &str) {
    let _ = write!(text, "\n<a id=\"{}\"></a>\n\n### {}\n", anchor(part, name), title(name));
}

fn title(name: &str) -> String {
    let mut letters = name.chars();
    letters.next().map_or_else(String::new, |first| first.to_uppercase().chain(letters).collect())
}

fn describe_topic(text: &mut String, topic: &Topic) {
    heading(text, "language", topic.name);
    let _ = writeln!(text, "\n{}\n\n{}", topic.summary, topic.doc);
    example(text, topic.example);
    see(text, topic.see);
}

fn describe_table(text: &mut String, table: &BindingTable) {
    heading(text, "withy", table.name);
    let _ = writeln!(text, "\n{}", table.doc);
    for of in table.types {
        let _ = writeln!(text, "\n*{}*: {}", of.name(), of.doc());
    }
    if !table.setup.is_empty() {
        let _ = writeln!(text, "\nThe examples begin with\n\n```rhai\n{}\n```", table.setup);
    }
    for constant in table.constants {
        let _ = writeln!(text, "\n#### `{}`\n\n{}", constant.name, constant.summary);
    }
    table.rows.iter().for_each(|row| describe_row(text, row));
}

fn describe_row(text: &mut String, row: &FunctionBinding) {
    let _ =
        writeln!(text, "\n#### `{}`{}\n\n{}", row.signature(), gives(&row.returns), row.summary);
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
    heading(text, "rhai", table.name);
    let _ = writeln!(text, "\n{}\n", table.doc);
    for built_in in table.rows {
        let forms: Vec<_> = built_in.forms.iter().map(|form| format!("`{form}`")).collect();
        let doc =
            if built_in.doc.is_empty() { String::new() } else { format!(" {}", built_in.doc) };
        let _ = writeln!(
            text,
            "- {}{}: {}{doc}\n\n  ```rhai example\n  {}\n  ```\n",
            forms.join(", "),
            gives(&built_in.returns),
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

pub(super) fn gives(returns: &Returns) -> String {
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
