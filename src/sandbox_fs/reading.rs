//! Reads regular files up to a maximum length.

use std::io::{self, Read};
use std::path::Path;

use super::dir::open_file;

/// Reads a file of at most `most` bytes at a path given by the user, following links.
pub fn read_file(path: &Path, most: u64) -> io::Result<Vec<u8>> {
    // The type is checked before the file is opened, because opening a device may have side effects.
    expect_ordinary(std::fs::metadata(path)?.is_file())?;
    read(open_file(path)?, most)
}

/// Reads a UTF-8 text file of at most `most` bytes at a path given by the user, following links.
pub fn read_text(path: &Path, most: u64) -> io::Result<String> {
    let bytes = read_file(path, most)?;
    String::from_utf8(bytes).map_err(|_| io::Error::other("it is not UTF-8 text"))
}

pub(super) fn read(file: std::fs::File, most: u64) -> io::Result<Vec<u8>> {
    let about = file.metadata()?;
    expect_ordinary(about.is_file())?;
    expect_length(about.len(), most)?;
    let mut bytes = Vec::new();
    // The number of bytes is limited while reading, because the system may report a wrong length, for example in /proc.
    file.take(most.saturating_add(1)).read_to_end(&mut bytes)?;
    expect_length(bytes.len() as u64, most)?;
    Ok(bytes)
}

pub(super) fn expect_ordinary(is_file: bool) -> io::Result<()> {
    match is_file {
        true => Ok(()),
        false => Err(io::Error::new(io::ErrorKind::InvalidInput, "it is not a regular file")),
    }
}

fn expect_length(bytes: u64, most: u64) -> io::Result<()> {
    match bytes <= most {
        true => Ok(()),
        false => {
            let message = format!("it has more than {most} bytes, the largest allowed size");
            Err(io::Error::new(io::ErrorKind::FileTooLarge, message))
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn files_above_the_length_limit_are_rejected() {
        let home = tempfile::tempdir().unwrap();
        let path = home.path().join("a");
        std::fs::write(&path, "12345").unwrap();
        assert_eq!(read_text(&path, 5).unwrap(), "12345");
        assert!(read_file(&path, 4).unwrap_err().to_string().contains("more than 4 bytes"));
        assert!(read_file(home.path(), 4).is_err());
    }

    #[cfg(target_os = "linux")]
    #[test]
    fn pipes_devices_and_huge_files_are_rejected_at_once() {
        use std::time::{Duration, Instant};
        let home = tempfile::tempdir().unwrap();
        let pipe = home.path().join("pipe");
        assert!(std::process::Command::new("mkfifo").arg(&pipe).status().unwrap().success());
        let sparse = home.path().join("sparse");
        std::fs::File::create(&sparse).unwrap().set_len(2 << 30).unwrap();
        let begun = Instant::now();
        for path in [pipe.as_path(), &sparse, Path::new("/dev/zero"), Path::new("/dev/tty")] {
            assert!(read_file(path, 1000).is_err(), "{}", path.display());
        }
        assert!(begun.elapsed() < Duration::from_secs(60));
    }
}
