//! Files with the completed rows of a sweep. Rows are appended and read one by one, which limits the memory.

use std::fs::File;
use std::io::{self, BufReader, BufWriter, Read, Write};
use std::path::{Path, PathBuf};
use std::time::{Duration, Instant};

use serde::{Deserialize, Serialize};

use crate::sandbox_fs::Folder;

/// Maximum length of an entry [bytes]. A longer entry counts as damaged.
const LONGEST: u32 = 1 << 20;
const DELAY: Duration = Duration::from_millis(100);

#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub enum RowEntry {
    Sweep {
        fingerprint: u64,
        rows: u64,
        /// Number of this part of the sweep, counted from 1, and number of parts; (1, 1) for a whole sweep.
        part: (u32, u32),
    },
    Names(Vec<String>),
    Computed(u64, Vec<f64>),
    Failed(u64, String),
}

#[derive(Debug)]
pub struct RowJournal {
    file: BufWriter<File>,
    flushed: Instant,
}

/// Reads the entries up to the first damaged or incomplete one, and passes each to `heed`.
/// Returns the length of the valid part of the file [bytes]; zero if there is no file.
pub fn read_rows<E: From<io::Error>>(
    path: &Path,
    mut heed: impl FnMut(RowEntry) -> Result<(), E>,
) -> Result<u64, E> {
    let opened = place(path, Folder::find).and_then(|(folder, name)| folder.open_file(&name));
    let mut file = match opened {
        Ok(file) => BufReader::new(file),
        Err(error) if error.kind() == io::ErrorKind::NotFound => return Ok(0),
        Err(error) => return Err(error.into()),
    };
    let mut whole = 0;
    while let Some((entry, length)) = next_entry(&mut file) {
        heed(entry)?;
        whole += length;
    }
    Ok(whole)
}

impl RowJournal {
    pub fn append(path: &Path, whole: u64) -> io::Result<Self> {
        let (folder, name) = place(path, Folder::open_or_create)?;
        let file = folder.append(&name)?;
        file.set_len(whole)?;
        Ok(Self { file: BufWriter::new(file), flushed: Instant::now() })
    }

    /// Appends an entry. Returns its length [bytes].
    pub fn write(&mut self, entry: &RowEntry) -> io::Result<u64> {
        let payload = postcard::to_stdvec(entry).map_err(io::Error::other)?;
        let length = u32::try_from(payload.len()).map_err(io::Error::other)?;
        self.file.write_all(&length.to_le_bytes())?;
        self.file.write_all(&crc32fast::hash(&payload).to_le_bytes())?;
        self.file.write_all(&payload)?;
        self.flush_periodically()?;
        Ok(8 + u64::from(length))
    }

    pub fn flush_periodically(&mut self) -> io::Result<()> {
        if self.flushed.elapsed() > DELAY {
            self.flush()?;
        }
        Ok(())
    }

    pub fn flush(&mut self) -> io::Result<()> {
        self.flushed = Instant::now();
        self.file.flush()
    }
}

pub fn remove_rows(path: &Path) -> io::Result<()> {
    match place(path, Folder::find).and_then(|(folder, name)| folder.remove(&name)) {
        Err(error) if error.kind() != io::ErrorKind::NotFound => Err(error),
        _ => Ok(()),
    }
}

fn place(path: &Path, open: fn(&Path) -> io::Result<Folder>) -> io::Result<(Folder, PathBuf)> {
    let name = path.file_name().ok_or(io::ErrorKind::InvalidInput)?;
    Ok((open(path.parent().unwrap_or(Path::new(".")))?, name.into()))
}

fn next_entry(file: &mut impl Read) -> Option<(RowEntry, u64)> {
    let mut head = [0; 8];
    file.read_exact(&mut head).ok()?;
    let (length, checksum) = head.split_at(4);
    let length = u32::from_le_bytes(length.try_into().ok()?);
    let checksum = u32::from_le_bytes(checksum.try_into().ok()?);
    let mut payload = Vec::new();
    file.take(u64::from(length.min(LONGEST))).read_to_end(&mut payload).ok()?;
    let is_whole = payload.len() == length as usize && crc32fast::hash(&payload) == checksum;
    let entry = is_whole.then(|| postcard::from_bytes(&payload).ok())??;
    Some((entry, 8 + u64::from(length)))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn read(path: &Path) -> (Vec<RowEntry>, u64) {
        let mut entries = Vec::new();
        let whole = read_rows::<io::Error>(path, |entry| {
            entries.push(entry);
            Ok(())
        });
        (entries, whole.unwrap())
    }

    #[test]
    fn journal_entries_are_read_up_to_the_first_truncated_one() {
        let home = tempfile::tempdir().unwrap();
        let path = home.path().join("a.journal");
        assert_eq!(read(&path), (vec![], 0));
        let written = [
            RowEntry::Sweep { fingerprint: 7, rows: 3, part: (1, 1) },
            RowEntry::Names(vec!["peak".into()]),
            RowEntry::Computed(2, vec![0.5]),
        ];
        let mut journal = RowJournal::append(&path, 0).unwrap();
        let bytes: u64 = written.iter().map(|entry| journal.write(entry).unwrap()).sum();
        drop(journal);
        assert_eq!(read(&path), (written.to_vec(), bytes));

        let cut = std::fs::read(&path).unwrap();
        std::fs::write(&path, &cut[..cut.len() - 3]).unwrap();
        let (entries, whole) = read(&path);
        assert_eq!(entries, written[..2]);
        let mut journal = RowJournal::append(&path, whole).unwrap();
        journal.write(&RowEntry::Failed(0, "lost".into())).unwrap();
        drop(journal);
        let expected = [written[0].clone(), written[1].clone(), RowEntry::Failed(0, "lost".into())];
        assert_eq!(read(&path).0, expected);
        remove_rows(&path).unwrap();
        remove_rows(&path).unwrap();
        assert!(!path.exists());
    }
}
