//! Help pages of the library, from the comments `//!` and `///` of its files.

use std::sync::LazyLock;

use super::modules::{MODULES, Module};
use crate::script::bindings::sources::FOLDER;

/// Page of a module of the standard library.
#[derive(Debug)]
pub struct ModulePage {
    /// Module of the page.
    pub module: &'static Module,
    /// Description of the module.
    pub about: Vec<DocBlock>,
    /// Public functions of the module, in the order of the file.
    pub functions: Vec<ModuleFunction>,
}

/// Help on a library function.
#[derive(Debug)]
pub struct ModuleFunction {
    /// Name with the module: `sections::rectangle`.
    pub full_name: String,
    /// Names of the parameters.
    pub parameters: Vec<String>,
    /// Help text of the function: summary, parameters, sources, and examples.
    pub text: Vec<DocBlock>,
}

/// Block of help text.
#[derive(Debug, PartialEq, Eq)]
pub enum DocBlock {
    /// Paragraph.
    Paragraph(String),
    /// List entry.
    Item(String),
    /// Runnable script.
    Example(String),
}

static PAGES: LazyLock<Vec<ModulePage>> =
    LazyLock::new(|| MODULES.iter().map(ModulePage::of).collect());

/// Pages of all modules.
pub fn pages() -> &'static [ModulePage] {
    &PAGES
}

/// Help page of the module with an import path; `None` if the path is not in the library.
pub fn page_of(path: &str) -> Option<&'static ModulePage> {
    let name = path.strip_suffix(".rhai").unwrap_or(path);
    PAGES.iter().find(|page| page.module.name == name)
}

impl ModulePage {
    fn of(module: &'static Module) -> Self {
        let mut page = Self { module, about: Vec::new(), functions: Vec::new() };
        let (mut about, mut said) = (Vec::new(), Vec::new());
        for line in module.text.lines() {
            if let Some(text) = line.strip_prefix("//!") {
                about.push(text);
            } else if let Some(text) = line.strip_prefix("///") {
                said.push(text);
            } else {
                if let Some(head) = line.strip_prefix("fn ") {
                    page.functions.extend(ModuleFunction::of(module, head, &said));
                }
                said.clear();
            }
        }
        page.about = blocks(&about);
        page
    }

    /// Function with this name, with or without the module.
    pub fn named(&self, name: &str) -> Option<&ModuleFunction> {
        self.functions.iter().find(|known| known.full_name == name || known.name() == name)
    }
}

impl ModuleFunction {
    fn of(module: &Module, head: &str, said: &[&str]) -> Option<Self> {
        let (name, rest) = head.split_once('(')?;
        let (parameters, _) = rest.split_once(')')?;
        let parameters = parameters.split(',').map(|name| name.trim().to_owned());
        Some(Self {
            full_name: format!("{}::{name}", module.name.trim_start_matches(FOLDER)),
            parameters: parameters.filter(|name| !name.is_empty()).collect(),
            text: blocks(said),
        })
    }

    /// Name of the function without its module.
    pub fn name(&self) -> &str {
        self.full_name.rsplit("::").next().unwrap_or_default()
    }

    /// Signature with the usual import name of the module.
    pub fn signature(&self) -> String {
        format!("{}({})", self.full_name, self.parameters.join(", "))
    }

    /// Summary of the function: the first paragraph.
    pub fn summary(&self) -> &str {
        match self.text.first() {
            Some(DocBlock::Paragraph(text)) => text,
            _ => "",
        }
    }

    /// Option keys of the function with their descriptions.
    pub fn keys(&self) -> Vec<(String, String)> {
        let mut keys: Vec<(String, String)> = Vec::new();
        let items = self.text.iter().filter_map(|block| match block {
            DocBlock::Item(text) => text.strip_prefix("`options`:"),
            _ => None,
        });
        for clause in items.flat_map(|item| item.split(';')) {
            let about = clause.replace('`', "").trim().to_owned();
            for name in clause.split('`').skip(1).step_by(2) {
                let is_key = name.chars().all(|letter| letter.is_alphanumeric() || letter == '_');
                if is_key && keys.iter().all(|(known, _)| known != name) {
                    keys.push((name.to_owned(), about.clone()));
                }
            }
        }
        keys
    }

    /// Examples of the function.
    pub fn examples(&self) -> impl Iterator<Item = &str> {
        self.text.iter().filter_map(|block| match block {
            DocBlock::Example(script) => Some(script.as_str()),
            _ => None,
        })
    }
}

fn blocks(lines: &[&str]) -> Vec<DocBlock> {
    let mut blocks = Vec::new();
    let mut example: Option<Vec<&str>> = None;
    let mut is_new = true;
    for line in lines {
        let line = line.strip_prefix(' ').unwrap_or(line);
        if line.starts_with("```") {
            match example.take() {
                Some(script) => blocks.push(DocBlock::Example(script.join("\n"))),
                None => example = Some(Vec::new()),
            }
            is_new = true;
        } else if let Some(script) = &mut example {
            script.push(line);
        } else if let Some(item) = line.strip_prefix("- ") {
            blocks.push(DocBlock::Item(item.to_owned()));
            is_new = false;
        } else if line.trim().is_empty() {
            is_new = true;
        } else {
            match blocks.last_mut() {
                Some(DocBlock::Paragraph(text) | DocBlock::Item(text)) if !is_new => {
                    *text += &format!(" {}", line.trim());
                }
                _ => blocks.push(DocBlock::Paragraph(line.trim().to_owned())),
            }
            is_new = false;
        }
    }
    blocks
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::script::engine::runner::{Ending, run};
    use crate::script::packages::language;
    use crate::script::source::program::Program;
    use crate::script::state::settings::{RunMode, RunSettings};

    #[test]
    fn doc_comment_is_parsed_into_blocks() {
        let lines = [
            " One",
            " sentence.",
            "",
            " - `a`: a length,",
            "   as drawn",
            "",
            " ```rhai",
            " f(1);",
            " ```",
        ];
        let expected = [
            DocBlock::Paragraph("One sentence.".into()),
            DocBlock::Item("`a`: a length, as drawn".into()),
            DocBlock::Example("f(1);".into()),
        ];
        assert_eq!(blocks(&lines), expected);
    }

    #[test]
    fn option_keys_are_read_from_doc_comments() {
        let page = page_of("std/sections").expect("a module");
        let keys = page.named("rectangle").expect("a function").keys();
        let names: Vec<&str> = keys.iter().map(|(name, _)| name.as_str()).collect();
        assert_eq!(names, ["width", "height", "E", "nu", "density"]);
        assert_eq!(keys[0].1, "width (across the plane) and height (in the plane) [length]");
        assert!(page.named("steel").expect("a function").keys().is_empty());
    }

    #[test]
    fn every_function_is_documented_with_an_example() {
        for page in pages() {
            assert!(!page.about.is_empty() && !page.functions.is_empty(), "{}", page.module.name);
            for function in &page.functions {
                let name = &function.full_name;
                assert!(function.summary().ends_with('.'), "{name}: the summary is a sentence");
                assert!(function.examples().count() > 0, "{name}: an example is missing");
                for parameter in &function.parameters {
                    let named = format!("`{parameter}`");
                    let is_told = |block: &DocBlock| match block {
                        DocBlock::Paragraph(text) | DocBlock::Item(text) => text.contains(&named),
                        DocBlock::Example(_) => false,
                    };
                    assert!(function.text.iter().any(is_told), "{name}: what is {parameter}?");
                }
            }
        }
    }

    #[test]
    fn every_example_of_the_library_runs() {
        for function in pages().iter().flat_map(|page| &page.functions) {
            for example in function.examples() {
                let name = &function.full_name;
                assert!(example.contains(name.as_str()), "{name}: the example does not show it");
                let out = tempfile::tempdir().unwrap();
                let settings =
                    RunSettings { out: out.path().into(), ..RunSettings::silent(RunMode::Run) };
                let outcome = run(&Program::named(name, example), &language(), settings);
                assert!(matches!(outcome.ending, Ending::Finished), "{name}: {:?}", outcome.ending);
                assert_eq!(outcome.checks.failed(), [], "{name}");
            }
        }
    }
}
