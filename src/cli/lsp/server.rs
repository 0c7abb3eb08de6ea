//! Main loop of the language server, and dispatch of messages.

use std::io::{IsTerminal, stdin};

use gen_lsp_types as lsp;
use lsp::{LspNotificationMethod, LspRequestMethod, Uri};
use lsp_server::{ErrorCode, Message, Notification, Request, RequestId, Response, ResponseError};
use serde::Serialize;
use serde::de::DeserializeOwned;
use serde_json::{Value, json, to_value};

use super::answers::{self, Place};
use super::checks;
use super::connection::{messages, send};
use super::documents::{Document, Documents};
use super::positions;
use crate::cli::Exit;
use crate::cli::console::print_error;
use crate::panics;

pub fn lsp() -> Exit {
    panics::silence();
    if stdin().is_terminal() {
        print_error("note: editors start this command; docs/editors.md describes how\n");
    }
    let mut server = Server::default();
    for message in messages() {
        match message {
            Message::Request(Request { id, method, params }) => {
                send(server.handle_request(id, &method, params));
            }
            Message::Notification(Notification { method, .. }) if method == "exit" => break,
            Message::Notification(Notification { method, params }) => {
                // An error in a notification cannot be reported, because notifications have no answer.
                let _ = panics::caught(|| server.handle_notification(&method, params));
            }
            Message::Response(_) => (),
        }
    }
    match server.phase {
        Phase::ShutDown => Exit::Success,
        Phase::Start | Phase::Running => Exit::CheckFailed,
    }
}

#[derive(Clone, Copy, Default)]
enum Phase {
    #[default]
    Start,
    Running,
    ShutDown,
}

#[derive(Default)]
struct Server {
    phase: Phase,
    documents: Documents,
    shows_markdown: bool,
}

type Answer = Result<Value, ResponseError>;

fn response_error(code: ErrorCode, message: impl Into<String>) -> ResponseError {
    ResponseError { code: code as i32, message: message.into(), data: None }
}

fn from_json<P: DeserializeOwned>(params: Value) -> Result<P, ResponseError> {
    serde_json::from_value(params)
        .map_err(|error| response_error(ErrorCode::InvalidParams, error.to_string()))
}

fn to_json(result: impl Serialize) -> Answer {
    to_value(result).map_err(|error| response_error(ErrorCode::InternalError, error.to_string()))
}

impl Server {
    fn handle_request(&mut self, id: RequestId, method: &str, params: Value) -> Response {
        let answer = panics::caught(|| self.answer(method, params));
        let answer =
            answer.unwrap_or_else(|panic| Err(response_error(ErrorCode::InternalError, panic)));
        Response { id, response_result: answer }
    }

    fn answer(&mut self, method: &str, params: Value) -> Answer {
        match (self.phase, method) {
            (Phase::Start, "initialize") => self.initialize(from_json(params)?),
            (Phase::Start, _) => Err(response_error(
                ErrorCode::ServerNotInitialized,
                "expected the request initialize",
            )),
            (Phase::ShutDown, _) => {
                Err(response_error(ErrorCode::InvalidRequest, "expected the notification exit"))
            }
            (Phase::Running, "initialize") => {
                Err(response_error(ErrorCode::InvalidRequest, "the server is already initialized"))
            }
            (Phase::Running, "shutdown") => {
                self.phase = Phase::ShutDown;
                self.documents.0.values().for_each(checks::stop);
                Ok(Value::Null)
            }
            (Phase::Running, method) => self.answer_at_position(method, params),
        }
    }

    fn answer_at_position(&self, method: &str, params: Value) -> Answer {
        match LspRequestMethod::from(method) {
            LspRequestMethod::TextDocumentCompletion => {
                let params: lsp::CompletionParams = from_json(params)?;
                let at = self.place(&params.text_document_position_params)?;
                let trigger = params.context.and_then(|context| context.trigger_character);
                to_json(answers::completion(&at, trigger.as_deref()))
            }
            LspRequestMethod::TextDocumentHover => {
                let params: lsp::HoverParams = from_json(params)?;
                let at = self.place(&params.text_document_position_params)?;
                let format = match self.shows_markdown {
                    true => lsp::MarkupKind::Markdown,
                    false => lsp::MarkupKind::PlainText,
                };
                to_json(answers::hover(&at, format))
            }
            LspRequestMethod::TextDocumentSignatureHelp => {
                let params: lsp::SignatureHelpParams = from_json(params)?;
                let at = self.place(&params.text_document_position_params)?;
                to_json(answers::signature_help(&at))
            }
            LspRequestMethod::TextDocumentDefinition => {
                let params: lsp::DefinitionParams = from_json(params)?;
                let at = self.place(&params.text_document_position_params)?;
                to_json(answers::definitions(&at, &self.documents))
            }
            _ => {
                let message = format!("the method '{method}' is not supported");
                Err(response_error(ErrorCode::MethodNotFound, message))
            }
        }
    }

    fn initialize(&mut self, client: lsp::InitializeParams) -> Answer {
        let formats = client.capabilities.text_document.and_then(|of| of.hover?.content_format);
        self.shows_markdown =
            formats.is_some_and(|formats| formats.contains(&lsp::MarkupKind::Markdown));
        self.phase = Phase::Running;
        let triggers = |letters: &[&str]| Some(letters.iter().map(|one| (*one).into()).collect());
        let sync = lsp::TextDocumentSyncOptions {
            open_close: Some(true),
            change: Some(lsp::TextDocumentSyncKind::Incremental),
            save: Some(true.into()),
            ..lsp::TextDocumentSyncOptions::default()
        };
        let capabilities = lsp::ServerCapabilities {
            text_document_sync: Some(sync.into()),
            completion_provider: Some(lsp::CompletionOptions {
                trigger_characters: triggers(&[".", ":", "\""]),
                ..lsp::CompletionOptions::default()
            }),
            hover_provider: Some(true.into()),
            signature_help_provider: Some(lsp::SignatureHelpOptions {
                trigger_characters: triggers(&["(", ",", "{", ":"]),
                ..lsp::SignatureHelpOptions::default()
            }),
            definition_provider: Some(true.into()),
            ..lsp::ServerCapabilities::default()
        };
        let server = json!({ "name": "withy", "version": env!("CARGO_PKG_VERSION") });
        to_json(json!({ "capabilities": capabilities, "serverInfo": server }))
    }

    fn place<'s>(
        &'s self,
        params: &'s lsp::TextDocumentPositionParams,
    ) -> Result<Place<'s>, ResponseError> {
        let uri = &params.text_document.uri;
        let document = self.documents.0.get(uri).ok_or_else(|| {
            response_error(ErrorCode::InvalidParams, format!("the document {} is not open", uri.0))
        })?;
        Ok(Place { uri, document, offset: positions::offset(&document.text, params.position) })
    }

    fn handle_notification(&mut self, method: &str, params: Value) -> Result<(), ResponseError> {
        if !matches!(self.phase, Phase::Running) {
            return Ok(());
        }
        match LspNotificationMethod::from(method) {
            LspNotificationMethod::TextDocumentDidOpen => {
                let opened: lsp::DidOpenTextDocumentParams = from_json(params)?;
                let lsp::TextDocumentItem { uri, version, text, .. } = opened.text_document;
                self.set(uri, Document::new(version, text));
            }
            LspNotificationMethod::TextDocumentDidChange => {
                let changed: lsp::DidChangeTextDocumentParams = from_json(params)?;
                let of = changed.text_document;
                if let Some(document) = self.documents.0.get_mut(&of.text_document_identifier.uri) {
                    document.version = of.version;
                    changed.content_changes.into_iter().for_each(|part| document.change(part));
                    checks::start(&of.text_document_identifier.uri, document);
                }
            }
            // The other open documents are checked again, because they may import the saved file.
            LspNotificationMethod::TextDocumentDidSave => {
                for (uri, document) in &mut self.documents.0 {
                    document.forget_names();
                    checks::start(uri, document);
                }
            }
            LspNotificationMethod::TextDocumentDidClose => {
                let closed: lsp::DidCloseTextDocumentParams = from_json(params)?;
                let uri = closed.text_document.uri;
                self.documents.0.remove(&uri).iter().for_each(checks::stop);
                checks::publish(uri, None, Vec::new());
            }
            _ => (),
        }
        Ok(())
    }

    fn set(&mut self, uri: Uri, mut document: Document) {
        checks::start(&uri, &mut document);
        self.documents.0.insert(uri, document).iter().for_each(checks::stop);
    }
}
