//! Answers to requests about a position in a document.

use std::iter;
use std::ops::Range;

use gen_lsp_types as lsp;
use lsp::Uri;

use super::documents::{Document, Documents, limits};
use super::{positions, uris};
use crate::repl::document::help_at;
use crate::repl::editor::candidates::Candidate;
use crate::repl::editor::completion::complete;
use crate::repl::editor::definition::{Definition, definition, exported};
use crate::repl::editor::hints::{CallHint, call_hint};

pub struct Place<'d> {
    pub uri: &'d Uri,
    pub document: &'d Document,
    /// Position in the text [bytes].
    pub offset: usize,
}

impl Place<'_> {
    fn before(&self) -> &str {
        &self.document.text[..self.offset]
    }
}

/// Completion candidates for the word at a place. After a typed colon, candidates are returned only if it completes `::`.
pub fn completion(at: &Place, trigger: Option<&str>) -> Option<lsp::CompletionResponse> {
    if trigger == Some(":") && !at.before().ends_with("::") {
        return None;
    }
    let names = at.document.names(at.uri, at.offset)?;
    let (start, candidates) = complete(&at.document.text, at.offset, &names);
    let range = positions::range(&at.document.text, start..at.offset);
    // Candidates that insert only blanks are omitted, because the editor itself indents lines.
    let words = candidates.into_iter().filter(|known| !known.replacement.trim().is_empty());
    Some(words.map(|known| item(known, range)).collect::<Vec<_>>().into())
}

fn item(candidate: Candidate, range: lsp::Range) -> lsp::CompletionItem {
    let Candidate { display, replacement, summary } = candidate;
    let kind = match replacement.as_bytes() {
        [.., b'('] | [.., b'(', b')'] => lsp::CompletionItemKind::Function,
        [.., b':', b' '] => lsp::CompletionItemKind::Property,
        [.., b':', b':'] => lsp::CompletionItemKind::Module,
        _ => lsp::CompletionItemKind::Variable,
    };
    lsp::CompletionItem {
        label: display,
        kind: Some(kind),
        detail: Some(summary).filter(|summary| !summary.is_empty()),
        filter_text: Some(replacement.clone()),
        text_edit: Some(lsp::TextEdit { range, new_text: replacement }.into()),
        ..lsp::CompletionItem::default()
    }
}

pub fn hover(at: &Place, format: lsp::MarkupKind) -> Option<lsp::Hover> {
    let (name, help) = help_at(&at.document.program(at.uri), at.offset, limits())?;
    let value = match format {
        lsp::MarkupKind::Markdown => format!("```text\n{help}```"),
        _ => help,
    };
    Some(lsp::Hover {
        contents: lsp::MarkupContent { kind: format, value }.into(),
        range: Some(positions::range(&at.document.text, name)),
    })
}

pub fn signature_help(at: &Place) -> Option<lsp::SignatureHelp> {
    let names = at.document.names(at.uri, at.offset)?;
    let CallHint { label, current, about } = call_hint(at.before(), &names)?;
    let units = |end: usize| label[..end].encode_utf16().count() as u32;
    let parameter = current.map(|part| lsp::ParameterInformation {
        label: (units(part.start), units(part.end)).into(),
        documentation: None,
    });
    let signature = lsp::SignatureInformation {
        documentation: Some(about).filter(|about| !about.is_empty()).map(Into::into),
        parameters: Some(parameter.into_iter().collect()),
        label,
        ..lsp::SignatureInformation::default()
    };
    let (active_signature, active_parameter) = (Some(0), Some(0.into()));
    Some(lsp::SignatureHelp { signatures: vec![signature], active_signature, active_parameter })
}

pub fn definitions(at: &Place, documents: &Documents) -> Option<lsp::DefinitionResponse> {
    let text = &at.document.text;
    let located = |uri: &Uri, text: &str, places: Vec<Range<usize>>| -> Vec<lsp::Location> {
        let place =
            |place| lsp::Location { uri: uri.clone(), range: positions::range(text, place) };
        places.into_iter().map(place).collect()
    };
    let found = match definition(text, at.offset)? {
        Definition::Here(places) => located(at.uri, text, places),
        Definition::Imported { path, name } => {
            let file = uris::path(at.uri);
            let (uri, text) = documents.imported(file.parent()?, path)?;
            let start = || iter::once(0..0).collect();
            let places = name.map_or_else(start, |name| exported(&text, name));
            located(&uri, &text, places)
        }
    };
    Some(lsp::Definition::LocationList(found).into())
}
