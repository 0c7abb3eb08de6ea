//! Markdown document about the standard library, generated from the comments of its modules.

use std::fmt::Write;

use super::pages::{DocBlock, ModulePage, pages};

const HEAD: &str = "# Standard library

*Generated from the comments in `stdlib/*.rhai`: `WITHY_UPDATE=1 cargo test --test house documents`.*

Modules written in the [language](language.md), which are part of the program: `import \"std/sections\" as sections;` works in every script, \
in imported files, and at the prompt. A module is read only when it is imported. Names that begin with `std/` belong to the library: files in \
your own folder `std` are never read. `withy docs std/sections` and `help(\"sections::rectangle\")` show the same pages. You can copy and \
change the files in [stdlib/](../stdlib). Every example runs.
";

/// Pages of all modules, in Markdown.
pub fn document() -> String {
    let mut text = HEAD.to_owned();
    text.push('\n');
    for page in pages() {
        let anchor = page.module.name.replace('/', "-");
        let names: Vec<_> =
            page.functions.iter().map(|known| format!("`{}`", known.name())).collect();
        let _ = writeln!(text, "- [{}](#{anchor}): {}", page.module.name, names.join(" "));
    }
    pages().iter().for_each(|page| describe(&mut text, page));
    text
}

fn describe(text: &mut String, page: &ModulePage) {
    let name = page.module.name;
    let _ = write!(text, "\n<a id=\"{}\"></a>\n\n## {name}\n", name.replace('/', "-"));
    write_blocks(text, &page.about);
    for function in &page.functions {
        let _ = write!(text, "\n### `{}`\n", function.signature());
        write_blocks(text, &function.text);
    }
}

fn write_blocks(text: &mut String, blocks: &[DocBlock]) {
    let mut was_item = false;
    for block in blocks {
        let is_item = matches!(block, DocBlock::Item(_));
        if !(was_item && is_item) {
            text.push('\n');
        }
        let _ = match block {
            DocBlock::Paragraph(words) => writeln!(text, "{words}"),
            DocBlock::Item(words) => writeln!(text, "- {words}"),
            DocBlock::Example(script) => writeln!(text, "```rhai example\n{script}\n```"),
        };
        was_item = is_item;
    }
}
