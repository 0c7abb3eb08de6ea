//! Help for bindings: signature, parameters, example.

use super::page::{HelpPage, StyledText};
use crate::script::bindings::built_in::BuiltIn;
use crate::script::bindings::kind::Kind;
use crate::script::bindings::parameter::{Parameter, Presence};
use crate::script::bindings::returns::Returns;
use crate::script::bindings::table::{BindingTable, FunctionBinding};

pub fn row(page: &mut HelpPage, table: &BindingTable, row: &FunctionBinding) {
    page.words(0, signature(&row.signature(), &row.returns));
    page.paragraph(row.summary);
    if let Some(setter) = row.setter {
        let [value] = setter.value;
        page.words(
            0,
            [vec![StyledText::plain("It can be assigned: ")], expectation(value)].concat(),
        );
    }
    if !row.doc.is_empty() {
        page.gap();
        page.paragraph(row.doc);
    }
    if !row.parameters.is_empty() {
        page.gap();
        row.parameters.iter().for_each(|known| parameter(page, known, 2));
    }
    example(page, table.setup, row.example);
    see(page, row.see);
}

pub fn built_in(page: &mut HelpPage, built_in: &BuiltIn) {
    for form in built_in.forms {
        page.words(0, signature(form, &built_in.returns));
    }
    page.paragraph(built_in.summary);
    if !built_in.doc.is_empty() {
        page.gap();
        page.paragraph(built_in.doc);
    }
    example(page, "", built_in.example);
    see(page, built_in.related);
}

pub fn example(page: &mut HelpPage, setup: &str, script: &str) {
    page.gap();
    page.heading("Example");
    if !setup.is_empty() {
        page.code(setup);
    }
    page.code(script);
}

pub fn see(page: &mut HelpPage, names: &[&str]) {
    if !names.is_empty() {
        page.gap();
        page.words(0, vec![StyledText::plain(format!("See also {}.", names.join(", ")))]);
    }
}

/// Appends the description of a parameter or key and, for an option map, of its keys.
pub fn parameter(page: &mut HelpPage, parameter: &Parameter, indent: usize) {
    let mut spans = vec![StyledText::name(parameter.name), StyledText::plain(": ")];
    spans.extend(expectation(parameter));
    if !parameter.doc.is_empty() {
        spans.push(StyledText::plain(format!(", {}", parameter.doc)));
    }
    spans.push(StyledText::remark(presence(parameter.presence)));
    page.words(indent, spans);
    for keys in maps(&parameter.kind) {
        for key in keys {
            self::parameter(page, key, indent + 2);
        }
    }
}

fn expectation(parameter: &Parameter) -> Vec<StyledText> {
    let kind = StyledText::plain(parameter.kind.to_string());
    match parameter.unit {
        "" => vec![kind],
        unit => vec![kind, StyledText::plain(" "), StyledText::remark(format!("[{unit}]"))],
    }
}

pub fn presence(presence: Presence) -> String {
    match presence {
        Presence::Required => String::new(),
        Presence::Optional => "; optional".to_owned(),
        Presence::Number(default) => format!("; default: {default}"),
        Presence::Integer(default) => format!("; default: {default}"),
        Presence::Text(default) => format!("; default: \"{default}\""),
        Presence::Boolean(default) => format!("; default: {default}"),
    }
}

pub fn maps(kind: &Kind) -> Vec<&'static [Parameter]> {
    match kind {
        Kind::Options(keys) => vec![*keys],
        Kind::Either(kinds) => kinds.iter().flat_map(maps).collect(),
        _ => Vec::new(),
    }
}

fn signature(written: &str, returns: &Returns) -> Vec<StyledText> {
    let mut spans = vec![StyledText::name(written)];
    if !returns.is_nothing() {
        spans.push(StyledText::plain(format!(" → {returns}")));
    }
    spans
}
