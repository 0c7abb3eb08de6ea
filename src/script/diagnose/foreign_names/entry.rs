//! Type of the entries for names from other languages and programs, and the search for the entry of a name.

use super::{languages, mechanics};

/// Names with the same meaning in other languages and programs, with their replacement in withy.
#[derive(Debug, PartialEq)]
pub struct ForeignName {
    pub words: &'static [&'static str],
    pub cure: &'static str,
    pub see: &'static [&'static str],
}

/// Entry for a name from another language, or for this name in other letter case; `None` if there is none.
pub fn find(name: &str) -> Option<&'static ForeignName> {
    find_exactly(name).or_else(|| {
        let lower = name.to_lowercase();
        let same = |word: &&str| word.to_lowercase() == lower;
        all().find(|entry| entry.words.iter().any(same))
    })
}

pub fn find_exactly(name: &str) -> Option<&'static ForeignName> {
    all().find(|entry| entry.words.contains(&name))
}

impl ForeignName {
    pub fn explanation(&self) -> String {
        match self.see {
            [] => self.cure.to_owned(),
            names => format!("{}; see {}", self.cure, names.join(", ")),
        }
    }
}

pub fn called_with(name: &str, count: usize) -> Option<&'static str> {
    Some(match (name, count) {
        ("print" | "debug", 2..) => "print takes one value: print(`a = ${a}, b = ${b}`)",
        ("range", 1) => "write 0..10, which ends with 9; range(from, to, step) has other steps",
        ("append", 2) => "write array.push(value) for one value; append joins two arrays",
        ("round", 2) => "write round_to(x, digits), or fixed(x, digits) for a text",
        ("max", 3..) => "write max(values) with an array: max([1, 2, 3])",
        ("min", 3..) => "write min(values) with an array: min([1, 2, 3])",
        ("clamp", 3) => "write min(max(x, low), high) to limit x to an interval",
        ("sum", 2..) => "write sum(values) with an array: sum([1, 2, 3])",
        _ => return None,
    })
}

fn all() -> impl Iterator<Item = &'static ForeignName> {
    languages::WORDS.iter().chain(mechanics::WORDS)
}

pub(super) const fn entry(
    words: &'static [&'static str],
    cure: &'static str,
    see: &'static [&'static str],
) -> ForeignName {
    ForeignName { words, cure, see }
}

#[cfg(test)]
mod tests {
    use std::collections::BTreeSet;

    use super::*;
    use crate::script::help::lookup;
    use crate::script::packages::language;

    #[test]
    fn names_referenced_by_foreign_name_entries_have_help() {
        let catalog = language();
        for entry in all() {
            for name in entry.see {
                assert!(!lookup::find(&catalog, name).is_empty(), "{:?}: {name}", entry.words);
            }
            assert!(!entry.cure.ends_with('.'), "{}", entry.cure);
        }
    }

    #[test]
    fn foreign_names_are_unique() {
        let mut seen = BTreeSet::new();
        for word in all().flat_map(|entry| entry.words) {
            assert!(seen.insert(word), "{word}");
        }
    }
}
