//! Help, reference, definition files, and pages of the library.

use crate::book::Book;
use withy::script::help::definitions::definitions;
use withy::script::help::lookup::{self, WIDTH};
use withy::script::help::reference::reference;
use withy::script::library;
use withy::script::packages::language;

/// Unknown names, whose messages are recorded.
const UNKNOWN: &[&str] = &["", "bspilne", "sim.rnu_to", "spring.pull", "%", "gravity.x"];

pub fn record(book: &mut Book) {
    let catalog = language();
    book.keep("pages/reference.md", reference(&catalog));
    book.keep("pages/library.md", library::document());
    for file in definitions(&catalog) {
        book.keep(format!("pages/definitions/{}", file.name), file.text);
    }
    for name in lookup::names(&catalog) {
        let page = lookup::page(&catalog, name).unwrap();
        book.keep(format!("pages/help/{name}"), page.plain(WIDTH) + &*page.ansi(60));
    }
    for name in UNKNOWN {
        let said = match lookup::page(&catalog, name) {
            Ok(page) => page.plain(WIDTH),
            Err(unknown) => format!("{unknown}\n{}", unknown.hint()),
        };
        book.keep(format!("pages/unknown/{name}"), said);
    }
}
