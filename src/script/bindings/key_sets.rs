//! Option maps with alternative sets of keys. For example, a section is given either by stiffness and inertia, or by a material and a shape.

use super::options::Options;
use crate::script::messages::error::{CallPart, ScriptError};
use crate::script::messages::nouns::with_article;

/// Alternative sets of keys of an option map, each with a value of type `T` that identifies it.
pub struct KeySets<T: 'static> {
    pub description: &'static str,
    pub always_allowed: &'static [&'static str],
    /// Sets of keys. Among sets with equally many given keys, the first is preferred.
    pub sets: &'static [KeySet<T>],
}

pub struct KeySet<T> {
    pub meaning: T,
    /// Description of the set, which follows the words `given by` in messages.
    pub description: &'static str,
    pub keys: &'static [&'static str],
    /// Key and text value that select this set; `None` if only its keys select it.
    pub chosen_by: Option<(&'static str, &'static str)>,
}

impl<T: Copy> KeySets<T> {
    /// Returns the value that identifies the key set whose keys are present in `options`.
    ///
    /// # Errors
    /// Fails if a key of the set is missing, or a key of another set is given.
    pub fn choose(&self, owner: &str, options: &Options) -> Result<T, ScriptError> {
        let Some(meant) = self.meant(options) else {
            return Err(ScriptError::internal_error(format!("{owner} has no sets of keys")));
        };
        let odd: Vec<&str> = options
            .present_names()
            .filter(|key| !meant.keys.contains(key) && !self.always_allowed.contains(key))
            .collect();
        match odd.first() {
            Some(first) => Err(self.mixture(owner, meant, &odd).at(CallPart::Key((*first).into()))),
            None => match meant.keys.iter().find(|key| !options.has(key)) {
                Some(missing) => Err(options.missing(owner, missing, self.description)),
                None => Ok(meant.meaning),
            },
        }
    }

    fn meant(&self, options: &Options) -> Option<&'static KeySet<T>> {
        let is_chosen = |set: &&KeySet<T>| {
            let chosen = set.chosen_by.map(|(key, text)| (options.text(key), text));
            chosen.is_some_and(|(given, text)| given.is_ok_and(|given| given == text))
        };
        let count = |set: &KeySet<T>| set.keys.iter().filter(|key| options.has(key)).count();
        let most = self.sets.iter().map(count).max()?;
        let mut sets = self.sets.iter();
        sets.clone().find(is_chosen).or_else(|| sets.find(|set| count(set) == most))
    }

    fn mixture(&self, owner: &str, meant: &KeySet<T>, odd: &[&str]) -> ScriptError {
        let quoted: Vec<String> = odd.iter().map(|key| format!("'{key}'")).collect();
        let belong = if odd.len() == 1 { "does not belong" } else { "do not belong" };
        let whole = with_article(owner);
        ScriptError::new(format!(
            "{owner}: {} {belong} to {whole} given by {}",
            listed(&quoted),
            meant.description
        ))
        .hint(format!(
            "leave {} out: it takes {} alone; {}",
            listed(odd),
            listed(meant.keys),
            self.description
        ))
    }
}

fn listed<S: AsRef<str>>(names: &[S]) -> String {
    let names: Vec<&str> = names.iter().map(AsRef::as_ref).collect();
    match names.as_slice() {
        [first @ .., last] if !first.is_empty() => format!("{} and {last}", first.join(", ")),
        few => few.concat(),
    }
}
