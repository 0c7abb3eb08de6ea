//! What a run reads and writes: counted against its limits, and told where something else stood there.

use std::io::{self, Write};
use std::path::PathBuf;

use super::Context;
use crate::script::messages::error::ScriptError;
use crate::script::state::files::WrittenFile;
use crate::script::state::limits::Meter;
use crate::script::state::settings::RunMode;

/// A file that is read takes a few times its length: the bytes, and what is made of them.
const TIMES_ITS_LENGTH: u64 = 4;

/// A file in which what is written is counted, as long as the run may write.
struct CountedFile<'c> {
    file: &'c mut dyn Write,
    meter: &'c Meter,
}

impl Write for CountedFile<'_> {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        match self.meter.allows_to_write(bytes.len() as u64) {
            true => self.file.write(bytes),
            false => Err(io::Error::other("the run may write no more")),
        }
    }

    fn flush(&mut self) -> io::Result<()> {
        self.file.flush()
    }
}

impl Context {
    /// Writes a file of the output folder. What stood there and was not written by this program is kept, and that is told.
    ///
    /// # Errors
    /// When it cannot be written, or the run may write no more.
    pub fn write_file(&self, name: &str, content: &[u8]) -> Result<PathBuf, ScriptError> {
        self.account_for(content)?;
        self.output().write(name, content).map(|written| self.tell_kept(written))
    }

    /// Writes a file of the output folder piece by piece, and counts what was written. What stood there is kept as for other files.
    ///
    /// # Errors
    /// When it cannot be written, or the run may write no more.
    pub fn write_file_by(
        &self,
        name: &str,
        write: impl FnOnce(&mut dyn Write) -> io::Result<()>,
    ) -> Result<PathBuf, ScriptError> {
        self.account_for(&[])?;
        let written = self
            .output()
            .write_by(name, |file| write(&mut CountedFile { file, meter: self.meter() }))?;
        self.proceed()?;
        Ok(self.tell_kept(written))
    }

    /// Writes a file that the script may [read](Self::read_file) again, which a dry build then can too. What stood there is kept as for other files.
    ///
    /// # Errors
    /// When it cannot be written, or the run may write no more.
    pub fn write_to_read(&self, name: &str, content: Vec<u8>) -> Result<PathBuf, ScriptError> {
        self.account_for(&content)?;
        self.output().write_to_read(name, content).map(|written| self.tell_kept(written))
    }

    /// Reads a file of the output folder or of the script's own folder, as far as there is memory for it.
    ///
    /// # Errors
    /// When there is none, or it is no ordinary file of such a length.
    pub fn read_file(&self, name: &str) -> Result<Vec<u8>, ScriptError> {
        let room = self.meter().limits().memory.map(|bytes| bytes / TIMES_ITS_LENGTH);
        self.output().read(name, room)
    }

    fn account_for(&self, content: &[u8]) -> Result<(), ScriptError> {
        if let Some(refusal) = self.0.refuses_files.get() {
            return Err(ScriptError::new("no file is written here").hint(refusal));
        }
        match self.mode() == RunMode::DryBuild || self.meter().allows_a_file(content.len() as u64) {
            true => Ok(()),
            false => self.proceed(),
        }
    }

    fn tell_kept(&self, written: WrittenFile) -> PathBuf {
        if let Some(kept) = written.kept {
            self.tell(&format!(
                "note: '{}' was there already, and not as withy has written it: it is kept as '{}'",
                written.path.display(),
                kept.display()
            ));
        }
        written.path
    }

    /// Writes what would be lost of a run that was stopped, if there is room for it.
    pub(super) fn write_remains(&self, name: &str, content: &[u8]) -> Result<PathBuf, ScriptError> {
        let bytes = content.len() as u64;
        if self.mode() == RunMode::Run && bytes > self.meter().left_for_remains() {
            let told = format!("note: '{name}' is not written: the run may write no more");
            return Err(ScriptError::new(told));
        }
        self.meter().allows_to_write(bytes);
        self.output().write(name, content).map(|written| self.tell_kept(written))
    }
}
