//! Help pages of the standard library.

use super::page::{HelpPage, StyledText};
use crate::script::library::{DocBlock, ModuleFunction, ModulePage};

pub fn module(page: &mut HelpPage, of: &ModulePage) {
    page.heading(format!("The library: {}", of.module.name));
    blocks(page, &of.about);
    page.gap();
    for function in &of.functions {
        let summary = function.summary().replace('`', "");
        let words =
            vec![StyledText::name(function.signature()), StyledText::plain(format!(": {summary}"))];
        page.words(2, words);
    }
}

pub fn function(page: &mut HelpPage, of: &ModuleFunction) {
    page.words(0, vec![StyledText::name(of.signature())]);
    blocks(page, &of.text);
}

fn blocks(page: &mut HelpPage, blocks: &[DocBlock]) {
    for (number, block) in blocks.iter().enumerate() {
        let follows_item = number > 0 && matches!(blocks[number - 1], DocBlock::Item(_));
        match block {
            DocBlock::Paragraph(text) => {
                if number > 0 {
                    page.gap();
                }
                page.paragraph(text);
            }
            DocBlock::Item(text) => {
                if !follows_item {
                    page.gap();
                }
                page.words(2, vec![StyledText::plain(text.replace('`', ""))]);
            }
            DocBlock::Example(script) => {
                page.gap();
                page.heading("Example");
                page.code(script);
            }
        }
    }
}
