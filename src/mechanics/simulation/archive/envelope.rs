//! File envelope: magic number, versions, lengths and checksum.
//!
//! A file starts with eight bytes: `89`, `withy`, `0D`, `0A` (hexadecimal). The byte 89 is not text, and 0D 0A reveal a conversion of line ends.
//! The version of the file format (`u16`) and the version of the program, as a length (`u8`) and a text, follow the first eight bytes.
//! The number of bytes of the content (`u64`) precedes the content. The file ends with the CRC-32 of all preceding bytes (`u32`).
//! All numbers in the file are little-endian.

use super::ArchiveError;

const MAGIC: [u8; 8] = *b"\x89withy\r\n";

/// Version of the file format. It must be incremented with any change of the stored data.
const FORMAT: u16 = 29;

const PROGRAM: &str = env!("CARGO_PKG_VERSION");

/// Length of a checksum [bytes].
const CHECKSUM: usize = 4;

struct ArchiveReader<'a> {
    bytes: &'a [u8],
    at: usize,
}

impl<'a> ArchiveReader<'a> {
    fn take(&mut self, count: usize) -> Result<&'a [u8], ArchiveError> {
        let taken = self.bytes[self.at..].get(..count).ok_or(ArchiveError::Truncated {
            found: self.bytes.len(),
            needed: (self.at as u64).saturating_add(count as u64),
        })?;
        self.at += count;
        Ok(taken)
    }

    fn array<const N: usize>(&mut self) -> Result<[u8; N], ArchiveError> {
        let mut array = [0; N];
        array.copy_from_slice(self.take(N)?);
        Ok(array)
    }
}

pub fn wrap(content: &[u8]) -> Vec<u8> {
    let program = &PROGRAM.as_bytes()[..PROGRAM.len().min(usize::from(u8::MAX))];
    let mut file = MAGIC.to_vec();
    file.extend(FORMAT.to_le_bytes());
    file.push(program.len() as u8);
    file.extend(program);
    file.extend((content.len() as u64).to_le_bytes());
    file.extend(content);
    file.extend(crc32fast::hash(&file).to_le_bytes());
    file
}

pub fn unwrap(file: &[u8]) -> Result<&[u8], ArchiveError> {
    if file.is_empty() || !file.starts_with(&MAGIC[..file.len().min(MAGIC.len())]) {
        return Err(ArchiveError::Foreign);
    }
    let mut reader = ArchiveReader { bytes: file, at: 0 };
    reader.take(MAGIC.len())?;
    let format = u16::from_le_bytes(reader.array()?);
    let [length] = reader.array()?;
    let program = String::from_utf8_lossy(reader.take(usize::from(length))?).into_owned();
    if format > FORMAT {
        return Err(ArchiveError::Newer {
            program,
            format,
            this_program: PROGRAM,
            supported: FORMAT,
        });
    }
    if format < FORMAT {
        return Err(ArchiveError::Older { program, format, supported: FORMAT });
    }
    let length = u64::from_le_bytes(reader.array()?);
    let whole = length.saturating_add((reader.at + CHECKSUM) as u64);
    let found = file.len();
    match whole.cmp(&(found as u64)) {
        std::cmp::Ordering::Greater => Err(ArchiveError::Truncated { found, needed: whole }),
        std::cmp::Ordering::Less => {
            Err(ArchiveError::TrailingBytes { trailing_bytes: found as u64 - whole })
        }
        std::cmp::Ordering::Equal => {
            let content = reader.take(found - reader.at - CHECKSUM)?;
            let right = crc32fast::hash(&file[..reader.at]);
            match u32::from_le_bytes(reader.array()?) {
                found if found != right => Err(ArchiveError::Damaged { found, right }),
                _ => Ok(content),
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn unwrapping_restores_the_wrapped_content() {
        for content in [&b""[..], b"a", &[7; 1000]] {
            assert_eq!(unwrap(&wrap(content)), Ok(content));
        }
    }

    #[test]
    fn each_archive_fault_has_its_own_error() {
        let file = wrap(b"content");
        for length in 1..file.len() {
            let error = unwrap(&file[..length]);
            assert!(matches!(error, Err(ArchiveError::Truncated { .. })), "{length}: {error:?}");
        }
        for foreign in [&b""[..], b"PK", b"\x89withy\n", b"t [time],energy [energy]\n0,1\n"] {
            assert_eq!(unwrap(foreign), Err(ArchiveError::Foreign));
        }
        let longer = [&file[..], b"more"].concat();
        assert_eq!(unwrap(&longer), Err(ArchiveError::TrailingBytes { trailing_bytes: 4 }));
        let mut newer = file.clone();
        newer[8] += 1;
        let message = unwrap(&newer).unwrap_err().to_string();
        let expected = format!("written by withy {PROGRAM} in format {}", FORMAT + 1);
        assert!(message.contains(&expected), "{message}");
    }

    #[test]
    fn every_flipped_bit_is_detected() {
        let file = wrap(b"content");
        for bit in 0..8 * file.len() {
            let mut flipped = file.clone();
            flipped[bit / 8] ^= 1 << (bit % 8);
            assert!(unwrap(&flipped).is_err(), "bit {bit}");
        }
    }

    #[test]
    fn huge_stored_length_is_rejected_as_truncated() {
        let mut file = wrap(b"");
        let at = file.len() - CHECKSUM - 8;
        file[at..at + 8].fill(0xff);
        assert!(matches!(unwrap(&file), Err(ArchiveError::Truncated { .. })));
    }
}
