//! All that withy says and writes, kept as fingerprints: output of scripts, exercises, studies and sessions, help, reference, definition
//! files, messages about what is wrong, and every table, picture and file of a simulation that comes of them.
//!
//! Who moves code changes no line of `pinned.txt`. Who means to change what is said pins it anew with `WITHY_UPDATE=1 cargo test --test
//! outputs` and reads the difference: with `WITHY_OUTPUTS=FOLDER` everything is written there in full, for a comparison of two versions.
#![allow(clippy::unwrap_used)]

#[path = "../common/fingerprint.rs"]
mod fingerprint;
#[path = "../common/notepad.rs"]
#[allow(dead_code)]
mod notepad;

mod binary;
mod book;
mod language;
mod pages;
mod times;

use book::Book;

#[test]
fn nothing_is_said_or_written_otherwise() {
    let mut book = Book::default();
    pages::record(&mut book);
    language::record(&mut book);
    binary::record(&mut book);
    book.compare();
}
