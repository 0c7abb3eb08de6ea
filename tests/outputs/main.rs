//! Recorded outputs of scripts, exercises, studies, sessions, help, reference, definition files and messages, with all tables, pictures
//! and files that they write.
//!
//! Texts are snapshots in `tests/outputs/snapshots`; other files have checksums in `tests/outputs/pinned.txt`. To record intended
//! changes, run `INSTA_UPDATE=always WITHY_UPDATE=1 cargo test --test outputs` and read the difference. `WITHY_OUTPUTS=FOLDER` writes
//! all outputs into a folder.
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
fn outputs_equal_the_recorded_outputs() {
    let mut book = Book::default();
    pages::record(&mut book);
    language::record(&mut book);
    binary::record(&mut book);
    book.compare();
}
