//! Search for help subjects. A name may refer to several subjects.

use std::collections::BTreeSet;

use crate::script::bindings::built_in::{BuiltIn, BuiltInTable};
use crate::script::bindings::catalog::Catalog;
use crate::script::bindings::kind::{Kind, Type};
use crate::script::bindings::parameter::Parameter;
use crate::script::bindings::table::{BindingTable, CallSyntax, Constant, FunctionBinding};
use crate::script::bindings::topics::{TOPICS, Topic};
use crate::script::library::{ModuleFunction, ModulePage, page_of, pages};

#[derive(Clone, Copy)]
pub enum HelpSubject {
    Topic(&'static Topic),
    Row(&'static BindingTable, &'static FunctionBinding),
    BuiltIn(&'static BuiltIn),
    Type(Type),
    Constant(&'static Constant),
    Option(&'static FunctionBinding, &'static Parameter),
    Table(&'static BindingTable),
    BuiltIns(&'static BuiltInTable),
    Module(&'static ModulePage),
    ModuleFunction(&'static ModuleFunction),
}

/// All subjects with the name `name`, the most likely first.
///
/// A name such as `simulation.run_to` refers to the method of a type.
/// If the text before the dot is not a type, as in `sim.run_to`, the methods of all types are returned.
pub fn find(catalog: &Catalog, name: &str) -> Vec<HelpSubject> {
    let name = name.trim();
    let name = name.strip_suffix("()").filter(|name| !name.is_empty()).unwrap_or(name);
    let found = named(catalog, name);
    if !found.is_empty() {
        return found;
    }
    if let Some(page) = page_of(&format!("std/{name}")) {
        return vec![HelpSubject::Module(page)];
    }
    let singular = |table: &&'static BindingTable| table.name.strip_suffix('s') == Some(name);
    if let Some(table) = catalog.tables().find(singular) {
        return vec![HelpSubject::Table(table)];
    }
    let Some((owner, member)) = name.rsplit_once('.') else { return found };
    let members: Vec<_> =
        named(catalog, member).into_iter().filter(|subject| is_member(*subject)).collect();
    let of_owner: Vec<_> =
        members.iter().copied().filter(|subject| belongs_to(*subject, owner)).collect();
    if of_owner.is_empty() { members } else { of_owner }
}

/// All names with help, in alphabetical order, for completion and suggestions.
pub fn names(catalog: &Catalog) -> BTreeSet<&'static str> {
    let mut names = BTreeSet::new();
    for table in catalog.tables() {
        names.insert(table.name);
        names.extend(table.types.iter().map(Type::name));
        names.extend(table.constants.iter().map(|constant| constant.name));
        for row in table.rows {
            names.insert(row.name);
            names.extend(keys(row).iter().map(|key| key.name));
        }
    }
    for table in catalog.built_in_tables() {
        names.insert(table.name);
        names.extend(table.rows.iter().map(BuiltIn::name));
    }
    for topic in TOPICS {
        names.insert(topic.name);
        names.extend(topic.words);
    }
    for page in pages() {
        names.insert(page.module.name);
        names.extend(page.functions.iter().map(|function| function.full_name.as_str()));
    }
    names
}

fn named(catalog: &Catalog, name: &str) -> Vec<HelpSubject> {
    let rows = catalog.tables().flat_map(|table| table.rows.iter().map(move |row| (table, row)));
    let types = catalog.tables().flat_map(|table| table.types).filter(|of| of.name() == name);
    let constants =
        catalog.tables().flat_map(|table| table.constants).filter(|known| known.name == name);
    let options = catalog.rows().flat_map(|row| {
        let keys = keys(row).into_iter().filter(move |key| key.name == name);
        keys.map(move |key| HelpSubject::Option(row, key))
    });
    let topics = TOPICS.iter().filter(|topic| topic.name == name || topic.words.contains(&name));
    topics
        .map(HelpSubject::Topic)
        .chain(
            rows.filter(|(_, row)| row.name == name)
                .map(|(table, row)| HelpSubject::Row(table, row)),
        )
        .chain(catalog.built_ins_named(name).map(HelpSubject::BuiltIn))
        .chain(types.copied().map(HelpSubject::Type))
        .chain(constants.map(HelpSubject::Constant))
        .chain(options)
        .chain(catalog.tables().filter(|table| table.name == name).map(HelpSubject::Table))
        .chain(
            catalog
                .built_in_tables()
                .filter(|table| table.name.strip_suffix('s') == Some(name) || table.name == name)
                .map(HelpSubject::BuiltIns),
        )
        .chain(page_of(name).map(HelpSubject::Module))
        .chain(pages().iter().filter_map(|page| page.named(name)).map(HelpSubject::ModuleFunction))
        .collect()
}

fn keys(row: &'static FunctionBinding) -> Vec<&'static Parameter> {
    let mut found = Vec::new();
    row.parameters.iter().for_each(|parameter| collect_keys(&parameter.kind, &mut found));
    found
}

fn collect_keys(kind: &'static Kind, found: &mut Vec<&'static Parameter>) {
    match kind {
        Kind::Options(keys) => {
            for key in *keys {
                found.push(key);
                collect_keys(&key.kind, found);
            }
        }
        Kind::Either(kinds) => kinds.iter().for_each(|kind| collect_keys(kind, found)),
        _ => (),
    }
}

fn is_member(subject: HelpSubject) -> bool {
    matches!(subject, HelpSubject::Row(..) | HelpSubject::BuiltIn(_))
}

fn belongs_to(subject: HelpSubject, owner: &str) -> bool {
    match subject {
        HelpSubject::Row(_, row) => match row.form {
            CallSyntax::Method(of) | CallSyntax::Property(of) => of.name() == owner,
            CallSyntax::Function | CallSyntax::Operator => false,
        },
        HelpSubject::BuiltIn(built_in) => built_in.is_of(owner),
        _ => false,
    }
}
