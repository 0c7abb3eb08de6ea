//! Record of the files that this program wrote to a folder, to distinguish them from files of other programs and edited files.

use std::collections::BTreeMap;
use std::io::{self, Read, Write};
use std::path::Path;

use super::Folder;

const FILE: &str = ".withy-written";
/// Maximum size of the record [bytes]. If it is larger, all files count as files of other programs and are not replaced.
const LARGEST: u64 = 16 << 20;
const PIECE: usize = 1 << 16;

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct FileChecksum {
    pub checksum: u32,
    /// Length of the file [bytes].
    pub length: u64,
}

impl FileChecksum {
    pub fn of(mut content: impl Read) -> io::Result<Self> {
        let (mut hasher, mut length, mut piece) = (crc32fast::Hasher::new(), 0, vec![0; PIECE]);
        loop {
            match content.read(&mut piece)? {
                0 => return Ok(Self { checksum: hasher.finalize(), length }),
                count => {
                    hasher.update(&piece[..count]);
                    length += count as u64;
                }
            }
        }
    }
}

pub struct ChecksumWriter<W> {
    inner: W,
    hasher: crc32fast::Hasher,
    length: u64,
}

impl<W: Write> ChecksumWriter<W> {
    pub fn new(inner: W) -> Self {
        Self { inner, hasher: crc32fast::Hasher::new(), length: 0 }
    }

    pub fn checksum(&self) -> FileChecksum {
        FileChecksum { checksum: self.hasher.clone().finalize(), length: self.length }
    }
}

impl<W: Write> Write for ChecksumWriter<W> {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        let count = self.inner.write(bytes)?;
        self.hasher.update(&bytes[..count]);
        self.length += count as u64;
        Ok(count)
    }

    fn flush(&mut self) -> io::Result<()> {
        self.inner.flush()
    }
}

/// Checksums and lengths of the last two contents of each file that this program has written to a folder.
/// Two contents are kept, because a new one is recorded before it replaces the old one.
#[derive(Debug, Default)]
pub struct WrittenFiles {
    files: BTreeMap<String, [Option<FileChecksum>; 2]>,
    is_truncated: bool,
}

impl WrittenFiles {
    /// Reads the record of a folder, without damaged lines.
    pub fn of(folder: &Folder) -> Self {
        // Without a readable record, all files count as files of other programs and are not replaced.
        let text = folder.read(Path::new(FILE), LARGEST).unwrap_or_default();
        let text = String::from_utf8_lossy(&text);
        let is_torn = !text.is_empty() && !text.ends_with('\n');
        let mut record = Self { files: BTreeMap::new(), is_truncated: is_torn };
        for (name, file_checksum) in text.lines().filter_map(entry) {
            record.add(name, file_checksum);
        }
        record
    }

    /// Returns true if no file has this name, or if the file is unchanged since this program wrote it.
    pub fn may_replace(&mut self, folder: &Folder, name: &str) -> bool {
        let path = Path::new(name);
        if !folder.has(path) {
            return true;
        }
        let found = folder.open_file(path).and_then(FileChecksum::of).ok();
        if found.is_some() && !self.knows(name, found) {
            *self = Self::of(folder);
        }
        found.is_some() && self.knows(name, found)
    }

    fn knows(&self, name: &str, file_checksum: Option<FileChecksum>) -> bool {
        self.files.get(name).is_some_and(|known| known.contains(&file_checksum))
    }

    fn add(&mut self, name: String, file_checksum: FileChecksum) {
        let known = self.files.entry(name).or_default();
        if known[1] != Some(file_checksum) {
            *known = [known[1], Some(file_checksum)];
        }
    }

    /// Records the content of a file on disk. Must be called before the file gets its final name.
    pub fn record(&mut self, folder: &Folder, name: &str, written: FileChecksum) -> io::Result<()> {
        let is_last = self.files.get(name).is_some_and(|known| known[1] == Some(written));
        if name.contains(['\n', '\r']) || is_last {
            return Ok(());
        }
        let end = if self.is_truncated { "\n" } else { "" };
        let line = format!("{end}{:08x} {} {name}\n", written.checksum, written.length);
        folder.append(Path::new(FILE))?.write_all(line.as_bytes())?;
        self.is_truncated = false;
        self.add(name.into(), written);
        Ok(())
    }
}

fn entry(line: &str) -> Option<(String, FileChecksum)> {
    let (checksum, rest) = line.split_once(' ')?;
    let (length, name) = rest.split_once(' ')?;
    let checksum = u32::from_str_radix(checksum, 16).ok()?;
    Some((name.to_owned(), FileChecksum { checksum, length: length.parse().ok()? }))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn checksum(bytes: &[u8]) -> FileChecksum {
        FileChecksum { checksum: crc32fast::hash(bytes), length: bytes.len() as u64 }
    }

    #[test]
    fn only_files_with_the_recorded_content_may_be_replaced() {
        let home = tempfile::tempdir().unwrap();
        let folder = Folder::open(home.path()).unwrap();
        let write = |content: &[u8]| folder.write_atomic(Path::new("a b"), content).unwrap();
        let mut record = WrittenFiles::of(&folder);
        assert!(record.may_replace(&folder, "a b"));
        write(b"one");
        assert!(!record.may_replace(&folder, "a b"), "nobody has said whose it is");
        record.record(&folder, "a b", checksum(b"one")).unwrap();
        assert!(record.may_replace(&folder, "a b"));
        write(b"two");
        record.record(&folder, "a b", checksum(b"two")).unwrap();
        assert!(WrittenFiles::of(&folder).may_replace(&folder, "a b"), "the last line holds");
        write(b"2wo");
        assert!(!WrittenFiles::of(&folder).may_replace(&folder, "a b"));
    }

    #[test]
    fn crash_between_journal_and_file_leaves_both_contents_known() {
        let home = tempfile::tempdir().unwrap();
        let folder = Folder::open(home.path()).unwrap();
        let mut record = WrittenFiles::of(&folder);
        for content in [&b"one"[..], b"two"] {
            record.record(&folder, "a", checksum(content)).unwrap();
            for on_disk in [&b"one"[..], content] {
                folder.write_atomic(Path::new("a"), on_disk).unwrap();
                assert!(WrittenFiles::of(&folder).may_replace(&folder, "a"));
            }
        }
        folder.append(Path::new(FILE)).unwrap().write_all(b"0123").unwrap();
        let mut record = WrittenFiles::of(&folder);
        record.record(&folder, "a", checksum(b"three")).unwrap();
        folder.write_atomic(Path::new("a"), b"three").unwrap();
        assert!(WrittenFiles::of(&folder).may_replace(&folder, "a"));
    }

    #[test]
    fn records_of_concurrent_runs_are_read() {
        let home = tempfile::tempdir().unwrap();
        let folder = Folder::open(home.path()).unwrap();
        let [mut first, mut second] = [WrittenFiles::of(&folder), WrittenFiles::of(&folder)];
        first.record(&folder, "a", checksum(b"one")).unwrap();
        folder.write_atomic(Path::new("a"), b"one").unwrap();
        assert!(second.may_replace(&folder, "a"));
    }
}
