//! Options of which a map takes one set out of several: a section is given by its stiffness and inertia, or by a material and a
//! shape, and a mixture says two things at once.

use super::options::Options;
use crate::script::messages::error::{CallPart, ScriptError};
use crate::script::messages::nouns::with_article;

/// The sets of keys of a map of options, each with what it means to the body that reads it.
pub struct KeySets<T: 'static> {
    /// The sets of keys in a sentence for messages.
    pub told: &'static str,
    /// The keys that may be given besides, whichever set is.
    pub besides: &'static [&'static str],
    /// The sets of keys; where it is not clear which one is meant, the first counts.
    pub sets: &'static [KeySet<T>],
}

/// A set of keys of a map of options that are given together, all of them.
pub struct KeySet<T> {
    /// What the set of keys means to the body that reads the map.
    pub meaning: T,
    /// What the keys of the set tell, in words that follow `given by`.
    pub told: &'static str,
    /// The keys of the set, in the order in which a missing one is asked for.
    pub keys: &'static [&'static str],
    /// The key whose text chooses this set of keys, and that text.
    pub chosen_by: Option<(&'static str, &'static str)>,
}

impl<T: Copy> KeySets<T> {
    /// The meaning of the set of keys that `options`, given to `owner`, has.
    ///
    /// # Errors
    /// When a key of the set is missing, or one of another set is given besides.
    pub fn choose(&self, owner: &str, options: &Options) -> Result<T, ScriptError> {
        let Some(meant) = self.meant(options) else {
            return Err(ScriptError::bug(format!("{owner} has no sets of keys")));
        };
        let odd: Vec<&str> = options
            .given()
            .filter(|key| !meant.keys.contains(key) && !self.besides.contains(key))
            .collect();
        match odd.first() {
            Some(first) => Err(self.mixture(owner, meant, &odd).at(CallPart::Key((*first).into()))),
            None => match meant.keys.iter().find(|key| !options.has(key)) {
                Some(missing) => Err(options.missing(owner, missing, self.told)),
                None => Ok(meant.meaning),
            },
        }
    }

    /// The set that a text chooses, or else the first of those of which the most keys are given.
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
            meant.told
        ))
        .hint(format!(
            "leave {} out: it takes {} alone; {}",
            listed(odd),
            listed(meant.keys),
            self.told
        ))
    }
}

/// Names in a sentence: `a, b and c`.
fn listed<S: AsRef<str>>(names: &[S]) -> String {
    let names: Vec<&str> = names.iter().map(AsRef::as_ref).collect();
    match names.as_slice() {
        [first @ .., last] if !first.is_empty() => format!("{} and {last}", first.join(", ")),
        few => few.concat(),
    }
}
