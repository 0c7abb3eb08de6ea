//! What was written into a folder by this program, so that files of somebody else, or with changes of his, are told from them.

use std::collections::BTreeMap;
use std::io::{self, Write};
use std::path::Path;

use super::Folder;

/// The name of the file that keeps the record: hidden, for it is of no use to anybody else.
const FILE: &str = ".withy-written";
/// The largest record that is read [bytes]: without it, files count as somebody else's and are kept.
const LARGEST: u64 = 16 << 20;
/// The largest file that is compared [bytes].
const LARGEST_COMPARED: u64 = 4 << 30;

/// Checksums and lengths of the files that this program has written into a folder, by name.
#[derive(Debug, Default)]
pub struct Record {
    files: BTreeMap<String, (u32, u64)>,
}

impl Record {
    /// Reads the record of what this program has written into a folder; one that is damaged knows less.
    pub fn of(folder: &Folder) -> Self {
        // Where there is none, or none that can be read, files count as somebody else's, and are kept.
        let text = folder.read(Path::new(FILE), LARGEST).unwrap_or_default();
        let text = String::from_utf8_lossy(&text);
        Self { files: text.lines().filter_map(entry).collect() }
    }

    /// Whether there is nothing of this name in the folder, or a file just as this program has written it.
    pub fn may_replace(&self, folder: &Folder, name: &str) -> bool {
        let path = Path::new(name);
        if !folder.has(path) {
            return true;
        }
        let Some((checksum, length)) = self.files.get(name) else { return false };
        folder.read(path, LARGEST_COMPARED).is_ok_and(|bytes| {
            bytes.len() as u64 == *length && crc32fast::hash(&bytes) == *checksum
        })
    }

    /// Notes, and writes down at once, that this program wrote a file of this name into the folder.
    ///
    /// # Errors
    /// When the record cannot be written.
    pub fn note(&mut self, folder: &Folder, name: &str, bytes: &[u8]) -> io::Result<()> {
        let entry = (crc32fast::hash(bytes), bytes.len() as u64);
        if name.contains(['\n', '\r']) || self.files.insert(name.into(), entry) == Some(entry) {
            return Ok(());
        }
        let line = format!("{:08x} {} {name}\n", entry.0, entry.1);
        folder.append(Path::new(FILE))?.write_all(line.as_bytes())
    }
}

/// `checksum length name`; later lines hold.
fn entry(line: &str) -> Option<(String, (u32, u64))> {
    let (checksum, rest) = line.split_once(' ')?;
    let (length, name) = rest.split_once(' ')?;
    let checksum = u32::from_str_radix(checksum, 16).ok()?;
    Some((name.to_owned(), (checksum, length.parse().ok()?)))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn only_files_just_as_they_were_written_may_be_replaced() {
        let home = tempfile::tempdir().unwrap();
        let folder = Folder::open(home.path()).unwrap();
        let write = |content: &[u8]| folder.write_whole(Path::new("a b"), content).unwrap();
        let mut record = Record::of(&folder);
        assert!(record.may_replace(&folder, "a b"));
        write(b"one");
        assert!(!record.may_replace(&folder, "a b"), "nobody has said whose it is");
        record.note(&folder, "a b", b"one").unwrap();
        assert!(record.may_replace(&folder, "a b"));
        write(b"two");
        record.note(&folder, "a b", b"two").unwrap();
        assert!(Record::of(&folder).may_replace(&folder, "a b"), "the last line holds");
        write(b"2wo");
        assert!(!Record::of(&folder).may_replace(&folder, "a b"));
    }
}
