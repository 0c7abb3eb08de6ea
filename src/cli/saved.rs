//! Generates one-line scripts that load and use a saved simulation.

use std::path::{Path, PathBuf};

use crate::script::source::program::Program;

pub(super) fn folder_of(file: &Path) -> PathBuf {
    let parent = file.parent().filter(|parent| !parent.as_os_str().is_empty());
    parent.unwrap_or(Path::new(".")).to_owned()
}

pub(super) fn stem_of(file: &Path) -> String {
    file.file_stem().map(|stem| stem.to_string_lossy().into_owned()).unwrap_or_default()
}

pub(super) fn program(command: &str, file: &Path, line: &str) -> Program {
    let name = file.file_name().map(|name| name.to_string_lossy()).unwrap_or_default();
    let text = format!("let sim = load_simulation({}); {line}\n", literal(&name));
    Program { folder: folder_of(file), ..Program::named(command, &text) }
}

pub(super) fn literal(text: &str) -> String {
    let escape = |letter: char| match letter {
        '\\' | '"' => format!("\\{letter}"),
        '\n' => "\\n".to_owned(),
        '\r' => "\\r".to_owned(),
        other => other.to_string(),
    };
    format!("\"{}\"", text.chars().map(escape).collect::<String>())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn file_names_with_quotes_are_escaped_as_string_literals() {
        assert_eq!(literal("run.html"), "\"run.html\"");
        assert_eq!(literal("a \"b\" \\ c"), r#""a \"b\" \\ c""#);
    }

    #[test]
    fn saved_file_is_loaded_from_its_own_folder() {
        assert_eq!(folder_of(Path::new("a.withy")), Path::new("."));
        let program = program("withy convert", Path::new("out/a.b.withy"), "print(sim.t);");
        assert_eq!(program.folder, Path::new("out"));
        assert_eq!(&*program.text, "let sim = load_simulation(\"a.b.withy\"); print(sim.t);\n");
        assert_eq!(stem_of(Path::new("out/a.b.withy")), "a.b");
    }
}
