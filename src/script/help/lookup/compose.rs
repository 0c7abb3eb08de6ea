//! Help pages, and the overview.

use super::find::{HelpSubject, find};
use super::page::{HelpPage, StyledText};
use super::unknown::UnknownTopic;
use super::{library, rows};
use crate::script::bindings::built_in::BuiltInTable;
use crate::script::bindings::catalog::Catalog;
use crate::script::bindings::kind::Type;
use crate::script::bindings::parameter::Parameter;
use crate::script::bindings::table::{BindingTable, Constant, FunctionBinding};
use crate::script::bindings::topics::{TOPICS, Topic};
use crate::script::diagnose::foreign_names;
use crate::script::library::{DocBlock, pages};
use crate::script::messages::numbers::format_number;

/// Help page for `name`, or the overview if the name is empty.
///
/// # Errors
/// Fails with suggestions if no help exists for this name.
pub fn page(catalog: &Catalog, name: &str) -> Result<HelpPage, UnknownTopic> {
    if name.trim().is_empty() {
        return Ok(overview(catalog));
    }
    let subjects = find(catalog, name);
    let foreign = match subjects.is_empty() {
        true => foreign_names::find(name.trim()),
        false => foreign_names::find_exactly(name.trim()),
    };
    if subjects.is_empty() && foreign.is_none() {
        return Err(UnknownTopic::new(catalog, name.trim()));
    }
    let mut page = HelpPage::default();
    let mut options: Vec<(&FunctionBinding, &Parameter)> = Vec::new();
    for subject in subjects {
        if let HelpSubject::Option(row, key) = subject {
            options.push((row, key));
            continue;
        }
        separate(&mut page);
        match subject {
            HelpSubject::Topic(topic) => describe_topic(&mut page, topic),
            HelpSubject::Row(table, row) => rows::row(&mut page, table, row),
            HelpSubject::BuiltIn(built_in) => rows::built_in(&mut page, built_in),
            HelpSubject::Type(of) => describe_type(&mut page, catalog, of),
            HelpSubject::Constant(constant) => describe_constant(&mut page, constant),
            HelpSubject::Table(table) => describe_table(&mut page, table),
            HelpSubject::BuiltIns(table) => describe_built_ins(&mut page, table),
            HelpSubject::Module(of) => library::module(&mut page, of),
            HelpSubject::ModuleFunction(of) => library::function(&mut page, of),
            HelpSubject::Option(..) => (),
        }
    }
    if !options.is_empty() {
        separate(&mut page);
        describe_option(&mut page, &options);
    }
    if let Some(found) = foreign {
        separate(&mut page);
        page.paragraph(&found.explanation());
    }
    Ok(page)
}

fn separate(page: &mut HelpPage) {
    if !page.parts.is_empty() {
        page.gap();
        page.words(0, vec![StyledText::remark("────────────────")]);
        page.gap();
    }
}

fn overview(catalog: &Catalog) -> HelpPage {
    let mut page = HelpPage::default();
    page.heading("Help");
    page.paragraph(
        "help(\"NAME\") explains a function, a type such as simulation, an option such as \
        rho_A, a constant, or a heading below. Every page has a complete example: copy its \
        lines into a script or to the prompt.",
    );
    page.gap();
    page.heading("The language");
    TOPICS.iter().for_each(|topic| entry(&mut page, topic.name, topic.summary));
    page.gap();
    page.heading("Beams and related functions");
    catalog.tables().for_each(|table| entry(&mut page, table.name, first_sentence(table.doc)));
    page.gap();
    page.heading("From Rhai");
    let tables = catalog.built_in_tables();
    tables.for_each(|table| entry(&mut page, table.name, first_sentence(table.doc)));
    page.gap();
    page.heading("The standard library, import \"std/sections\" as sections;");
    for of in pages() {
        if let Some(DocBlock::Paragraph(about)) = of.about.first() {
            entry(&mut page, of.module.name, first_sentence(about));
        }
    }
    page
}

fn first_sentence(text: &str) -> &str {
    text.split_inclusive(". ").next().unwrap_or(text).trim_end()
}

fn entry(page: &mut HelpPage, name: &str, summary: &str) {
    page.words(
        2,
        vec![StyledText::name(name), StyledText::plain(format!(": {}", summary.replace('`', "")))],
    );
}

fn row_entry(page: &mut HelpPage, row: &FunctionBinding) {
    entry(page, &row.signature(), row.summary);
}

fn describe_topic(page: &mut HelpPage, topic: &Topic) {
    page.heading(format!("The language: {}", topic.name));
    page.paragraph(topic.summary);
    page.gap();
    page.paragraph(topic.doc);
    rows::example(page, "", topic.example);
    rows::see(page, topic.see);
}

fn describe_type(page: &mut HelpPage, catalog: &Catalog, of: Type) {
    page.heading(format!("The type {}", of.name()));
    page.paragraph(of.doc());
    let members = catalog.members(of.name());
    if !members.is_empty() {
        page.gap();
        members.into_iter().for_each(|row| row_entry(page, row));
    }
    let makers: Vec<_> = catalog
        .rows()
        .filter(|row| row.returns.kind.type_name() == Some(of.name()))
        .map(FunctionBinding::signature)
        .collect();
    if !makers.is_empty() {
        page.gap();
        page.words(0, vec![StyledText::plain(format!("It comes from {}.", makers.join(", ")))]);
    }
}

fn describe_constant(page: &mut HelpPage, constant: &Constant) {
    page.words(
        0,
        vec![
            StyledText::name(constant.name),
            StyledText::plain(format!(" = {}", format_number(constant.value))),
        ],
    );
    page.paragraph(constant.summary);
}

fn describe_table(page: &mut HelpPage, table: &BindingTable) {
    page.heading(format!("About {}", table.name));
    page.paragraph(table.doc);
    page.gap();
    for of in table.types {
        entry(page, of.name(), of.doc());
    }
    table.constants.iter().for_each(|constant| entry(page, constant.name, constant.summary));
    table.rows.iter().for_each(|row| row_entry(page, row));
}

fn describe_built_ins(page: &mut HelpPage, table: &BuiltInTable) {
    page.heading(format!("From Rhai: {}", table.name));
    page.paragraph(table.doc);
    page.gap();
    for built_in in table.rows {
        entry(page, &built_in.forms.join(", "), built_in.summary);
    }
}

fn describe_option(page: &mut HelpPage, options: &[(&FunctionBinding, &Parameter)]) {
    let mut listed: Vec<(&Parameter, Vec<String>)> = Vec::new();
    for (row, key) in options {
        let same = listed.iter_mut().find(|(other, _)| {
            other.doc == key.doc
                && other.expectation() == key.expectation()
                && other.presence == key.presence
        });
        match same {
            Some((_, rows)) if rows.contains(&row.signature()) => (),
            Some((_, rows)) => rows.push(row.signature()),
            None => listed.push((*key, vec![row.signature()])),
        }
    }
    for (key, rows) in listed {
        page.words(0, vec![StyledText::plain(format!("An option of {}:", rows.join(", ")))]);
        rows::parameter(page, key, 2);
    }
}
