//! TextMate grammar for syntax highlighting in editors, generated from the keywords and bindings.
//!
//! The rules are regular expressions of Oniguruma that correspond to the scanner ([`scan`](crate::script::source::scanner::scan)).
//! Editors do not know types, so every name called after a dot is shown as a member.

use std::collections::BTreeSet;

use serde_json::{Value, json};

use crate::script::bindings::catalog::Catalog;
use crate::script::source::keywords::KEYWORDS;

const VALUES: [&str; 2] = ["true", "false"];
const THINGS: [&str; 2] = ["this", "global"];

/// Text of `withy.tmLanguage.json`.
pub fn grammar(catalog: &Catalog) -> String {
    let built_in = catalog.built_ins().filter(|known| known.is_function());
    let functions: BTreeSet<&str> =
        catalog.function_names().chain(built_in.map(|known| known.name())).collect();
    let functions = functions.into_iter().filter(|name| !KEYWORDS.contains(name));
    let constants: BTreeSet<&str> = catalog.constants().collect();
    let plain = KEYWORDS.iter().filter(|word| !VALUES.contains(word) && !THINGS.contains(word));
    let grammar = json!({
        "name": "Rhai (withy)",
        "scopeName": "source.rhai",
        "fileTypes": ["rhai"],
        "patterns": [
            { "include": "#comments" }, { "include": "#texts" }, { "include": "#numbers" }, { "include": "#members" },
            { "include": "#braces" }, { "include": "#words" },
        ],
        "repository": {
            "comments": { "patterns": [
                { "name": "comment.line.double-slash.rhai", "match": "//.*$" },
                { "include": "#block_comment" },
            ] },
            "block_comment": {
                "name": "comment.block.rhai", "begin": "/\\*", "end": "\\*/",
                "patterns": [{ "include": "#block_comment" }],
            },
            "texts": { "patterns": [
                text("string.quoted.double.rhai", "\""),
                text("string.quoted.single.rhai", "'"),
                { "name": "string.quoted.other.rhai", "begin": "(#+)\"", "end": "\"\\1" },
                {
                    "name": "string.interpolated.rhai", "begin": "`", "end": "`",
                    "patterns": [{
                        "name": "meta.embedded.rhai", "begin": "\\$\\{", "end": "\\}", "patterns": [{ "include": "$self" }],
                    }],
                },
            ] },
            "numbers": {
                "name": "constant.numeric.rhai",
                "match": "\\b0x\\w*|\\b\\d\\w*(?:\\.(?![.\\p{L}_])\\w*)?(?:(?<=[eE])[+-]\\d\\w*)?",
            },
            "members": { "patterns": [
                { "match": "(?<![.])(?:\\?\\.|\\.)\\s*([\\p{L}_]\\w*)(?=\\s*\\()", "captures": { "1": { "name": "entity.name.function.member.rhai" } } },
                { "match": "(?<![.])(?:\\?\\.|\\.)\\s*([\\p{L}_]\\w*)", "captures": { "1": { "name": "variable.other.member.rhai" } } },
                { "match": "::\\s*([\\p{L}_]\\w*)", "captures": { "1": { "name": "entity.name.function.module.rhai" } } },
            ] },
            "braces": { "begin": "#?\\{", "end": "\\}", "patterns": [{ "include": "$self" }] },
            "words": { "patterns": [
                words("constant.language.rhai", VALUES.into_iter()),
                words("variable.language.rhai", THINGS.into_iter()),
                words("keyword.control.rhai", plain.copied()),
                words("support.function.rhai", functions),
                words("support.constant.rhai", constants.into_iter()),
            ] },
        },
    });
    format!("{grammar:#}\n")
}

fn text(name: &str, quote: &str) -> Value {
    json!({
        "name": name, "begin": quote, "end": format!("{quote}|(?<!\\\\)$"),
        "patterns": [{ "name": "constant.character.escape.rhai", "match": "\\\\(?:.|$)" }],
    })
}

fn words<'w>(name: &str, words: impl Iterator<Item = &'w str>) -> Value {
    let words: Vec<&str> = words.collect();
    json!({ "name": name, "match": format!("\\b(?:{})\\b", words.join("|")) })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::script::packages::language;
    use crate::script::presentation::highlight::{FUNCTION, KEYWORD, Vocabulary, highlight};

    fn listed(grammar: &Value, scope: &str) -> Vec<String> {
        let rules = grammar["repository"]["words"]["patterns"].as_array().unwrap().iter();
        let rules = rules.filter(|rule| rule["name"].as_str().unwrap().starts_with(scope));
        let words = rules.flat_map(|rule| {
            let words = rule["match"].as_str().unwrap();
            let words = words.trim_start_matches("\\b(?:").trim_end_matches(")\\b");
            words.split('|').map(str::to_owned).collect::<Vec<_>>()
        });
        words.collect()
    }

    #[test]
    fn grammar_gives_words_the_colours_of_the_prompt() {
        let catalog = language();
        let vocabulary = Vocabulary::of_language(&catalog);
        let grammar: Value = serde_json::from_str(&grammar(&catalog)).unwrap();
        let mut keywords: Vec<String> = KEYWORDS.iter().map(|&word| word.to_owned()).collect();
        let mut ruled: Vec<String> = ["constant.language", "variable.language", "keyword"]
            .iter()
            .flat_map(|scope| listed(&grammar, scope))
            .collect();
        keywords.sort();
        ruled.sort();
        assert_eq!(ruled, keywords);
        let drawn = |word: &str| highlight(word, None, &vocabulary);
        let coloured = |word: &str, colour: &str| format!("\x1b[{colour}m{word}\x1b[0m");
        assert!(keywords.iter().all(|word| drawn(word) == coloured(word, KEYWORD.0)));
        let functions = listed(&grammar, "support.function");
        assert!(functions.len() > 100, "{}", functions.len());
        let odd = functions.iter().find(|word| drawn(word) != coloured(word, FUNCTION.0));
        assert_eq!(odd, None);
    }
}
