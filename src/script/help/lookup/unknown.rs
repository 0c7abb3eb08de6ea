//! Unknown help topics, with suggestions of similar names.

use std::fmt;

use super::find::names;
use crate::script::bindings::catalog::Catalog;
use crate::script::bindings::topics::TOPICS;
use crate::script::messages::suggest::{nearest, related};

const MOST_MENTIONS: usize = 8;

#[derive(Clone, Debug, PartialEq)]
pub struct UnknownTopic {
    pub name: String,
    /// Most similar name with help; `None` if no name is similar enough, or if there are related names.
    pub meant: Option<&'static str>,
    /// Names with help that contain `name` as a word or begin with it.
    pub related: Vec<&'static str>,
    pub mentions: Vec<&'static str>,
}

impl UnknownTopic {
    pub fn new(catalog: &Catalog, name: &str) -> Self {
        let known = names(catalog);
        let related = related(name, known.iter().copied());
        let meant = if related.is_empty() { nearest(name, known) } else { None };
        Self { name: name.to_owned(), meant, related, mentions: mentions(catalog, name) }
    }

    pub fn hint(&self) -> String {
        let related =
            (!self.related.is_empty()).then(|| format!("there is {}", self.related.join(", ")));
        let meant = self.meant.map(|near| format!("did you mean '{near}'?"));
        let mentions = (!self.mentions.is_empty()).then(|| {
            format!("'{}' is mentioned in the help of {}", self.name, self.mentions.join(", "))
        });
        let hints: Vec<String> = [related, meant, mentions].into_iter().flatten().collect();
        match hints.is_empty() {
            true => "help() lists all topics".into(),
            false => hints.join("\n"),
        }
    }

    pub fn is_strange(&self) -> bool {
        self.related.is_empty() && self.meant.is_none() && self.mentions.is_empty()
    }
}

impl fmt::Display for UnknownTopic {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "there is no help on '{}'", self.name)
    }
}

fn mentions(catalog: &Catalog, word: &str) -> Vec<&'static str> {
    let word = word.trim().to_lowercase();
    if word.chars().count() < 3 {
        return Vec::new();
    }
    let is_in = |text: &str| text.to_lowercase().contains(&word);
    let topics = TOPICS.iter().filter(|topic| is_in(topic.summary) || is_in(topic.doc));
    let rows = catalog.rows().filter(|row| is_in(row.summary) || is_in(row.doc));
    let built_ins = catalog.built_ins().filter(|known| is_in(known.summary) || is_in(known.doc));
    let tables = catalog.tables().filter(|table| is_in(table.doc));
    let mut found = Vec::new();
    for name in rows
        .map(|row| row.name)
        .chain(built_ins.map(|known| known.name()))
        .chain(topics.map(|topic| topic.name))
        .chain(tables.map(|table| table.name))
    {
        if !found.contains(&name) {
            found.push(name);
        }
    }
    found.truncate(MOST_MENTIONS);
    found
}
