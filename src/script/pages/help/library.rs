//! Pages on modules of the standard library and their functions.

use super::page::{Page, Span};
use crate::script::library::{Block, ModuleFunction, ModulePage};

/// Adds the description of a module of the standard library to a page.
pub fn module(page: &mut Page, of: &ModulePage) {
    page.heading(format!("The library: {}", of.module.name));
    blocks(page, &of.about);
    page.gap();
    for function in &of.functions {
        let summary = function.summary().replace('`', "");
        let words = vec![Span::name(function.signature()), Span::plain(format!(": {summary}"))];
        page.words(2, words);
    }
}

/// Adds the description of a function of a module to a page.
pub fn function(page: &mut Page, of: &ModuleFunction) {
    page.words(0, vec![Span::name(of.signature())]);
    blocks(page, &of.text);
}

fn blocks(page: &mut Page, blocks: &[Block]) {
    for (number, block) in blocks.iter().enumerate() {
        let follows_item = number > 0 && matches!(blocks[number - 1], Block::Item(_));
        match block {
            Block::Paragraph(text) => {
                if number > 0 {
                    page.gap();
                }
                page.paragraph(text);
            }
            Block::Item(text) => {
                if !follows_item {
                    page.gap();
                }
                page.words(2, vec![Span::plain(text.replace('`', ""))]);
            }
            Block::Example(script) => {
                page.gap();
                page.heading("Example");
                page.code(script);
            }
        }
    }
}
