//! Messages of layers below the script do not depend on the script language, so that they are valid for programs that use the library.
//! `script/messages/advice.rs` adds advice on the language.

use crate::layering::{layer, sources};

/// Layers whose messages may use the script language.
const SPEAKERS: [&str; 7] =
    ["script", "repl", "exercises", "cli", "main.rs", "lib.rs", "elementary"];

/// Prefixes of members that scripts call: `scene.beam`, `sim.step`, `beam.end`.
const OBJECTS: [&str; 4] = ["scene.", "sim.", "beam.", "call."];

/// Marks of the script language: maps, closures, calls with omitted arguments, options with a string.
const SIGNS: [&str; 5] = ["#{", "|t|", "(…)", "[[", ": \\\""];

/// Schedules are displayed, in scripts and in explanations of scenes, as calls of their constructors.
const SHOWN: (&str, &str) = ("loads/schedule.rs", "schedule(|t| …)");

/// String literals of a file, without comments and unit tests, with the line where each starts.
fn texts(code: &str) -> Vec<(usize, String)> {
    let code = code.split("#[cfg(test)]").next().unwrap_or_default();
    let mut found = Vec::new();
    let (mut rest, mut line) = (code, 1);
    while let Some(at) = rest.find(['"', '\'', '/', '\n']) {
        let (sign, behind) = rest[at..].split_at(1);
        rest = match sign {
            "\n" => {
                line += 1;
                behind
            }
            "/" if behind.starts_with('/') => &behind[behind.find('\n').unwrap_or(behind.len())..],
            // Character literal, not a lifetime.
            "'" if behind.chars().nth(1) == Some('\'') => {
                &behind[behind.char_indices().nth(2).map_or(behind.len(), |(at, _)| at)..]
            }
            "'" if behind.starts_with("\\\"'") || behind.starts_with("\\''") => &behind[3..],
            "\"" => {
                let mut is_escaped = false;
                let end = behind.find(|letter| {
                    let ends = letter == '"' && !is_escaped;
                    is_escaped = letter == '\\' && !is_escaped;
                    ends
                });
                let end = end.unwrap_or(behind.len());
                found.push((line, behind[..end].to_owned()));
                line += behind[..end].matches('\n').count();
                behind.get(end + 1..).unwrap_or_default()
            }
            _ => behind,
        };
    }
    found
}

/// Returns true if a text is in the script language or names a member of it.
fn speaks(text: &str) -> bool {
    // `format!` doubles braces.
    let text = text.replace("{{", "{");
    let names_a_member = |object: &&str| {
        text.match_indices(*object).any(|(at, _)| {
            let (before, behind) =
                (text[..at].chars().last(), text[at + object.len()..].chars().next());
            !before.is_some_and(|letter| letter.is_alphanumeric() || letter == '_')
                && behind.is_some_and(|letter| letter.is_ascii_lowercase())
        })
    };
    SIGNS.iter().any(|sign| text.contains(sign)) || OBJECTS.iter().any(names_a_member)
}

#[test]
fn messages_below_the_script_layer_contain_no_script_syntax() {
    let mut count = 0;
    let mut found = Vec::new();
    for (path, code) in sources() {
        let is_test = path.file_stem().is_some_and(|name| name == "tests");
        if is_test || SPEAKERS.contains(&layer(&path).as_str()) {
            continue;
        }
        for (line, text) in texts(&code) {
            count += 1;
            let is_shown = path.ends_with(SHOWN.0) && text == SHOWN.1;
            if speaks(&text) && !is_shown {
                found.push(format!("{}:{line}: {text}", path.display()));
            }
        }
    }
    assert!(count > 700, "only {count} texts were found");
    assert!(found.is_empty(), "{}", found.join("\n"));
}

#[test]
fn script_syntax_in_messages_is_detected() {
    let code = "// \"sim.a\"\nlet c = '\"';\nf(\"a \\\" b\", \"in the\nscene\");\n\"use sim.step()\"\n#[cfg(test)]\n\"sim.b\"";
    let found = texts(code);
    let lines: Vec<usize> = found.iter().map(|(line, _)| *line).collect();
    assert_eq!(lines, [3, 3, 5], "{found:?}");
    let spoken: Vec<&str> =
        found.iter().filter(|(_, text)| speaks(text)).map(|(_, text)| text.as_str()).collect();
    assert_eq!(spoken, ["use sim.step()"]);
    for text in ["start with scene.start(#{{ dt: 1 }})", "ends: \\\"stop\\\"", "f(…)", "beam.end"]
    {
        assert!(speaks(text), "{text}");
    }
    for text in ["the scene. It moves", "simulation", "t = {time}: {source}", "a = (1, 2)"] {
        assert!(!speaks(text), "{text}");
    }
}
