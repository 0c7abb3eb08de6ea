//! File access that counts towards the limits of the run.

use std::io::{self, Write};
use std::path::PathBuf;

use super::Context;
use crate::script::messages::error::ScriptError;
use crate::script::state::files::WrittenFile;
use crate::script::state::settings::RunMode;

/// Memory for the content of a read file and its parsed form, as a multiple of its length.
const TIMES_ITS_LENGTH: u64 = 4;

/// File whose written bytes are counted. Writing fails if the run must end.
struct CountedFile<'c> {
    file: &'c mut dyn Write,
    context: &'c Context,
}

impl Write for CountedFile<'_> {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        let may_write =
            !self.context.is_stopped() && self.context.meter().allows_to_write(bytes.len() as u64);
        match may_write {
            true => self.file.write(bytes),
            false => Err(io::Error::other("the run must end")),
        }
    }

    fn flush(&mut self) -> io::Result<()> {
        self.file.flush()
    }
}

impl Context {
    /// Writes a file in the output folder.
    /// An existing file that this program has not written is kept under another name, and a message is printed.
    ///
    /// # Errors
    /// Fails if the file cannot be written, if the run must not write files, or if it is stopped or exceeds a limit.
    pub fn write_file(&self, name: &str, content: &[u8]) -> Result<PathBuf, ScriptError> {
        self.account_for(content)?;
        self.output().write(name, content).map(|written| self.report_kept(written))
    }

    /// Writes a file in the output folder in pieces. An existing file is treated as in [`Self::write_file`].
    ///
    /// # Errors
    /// Fails if the file cannot be written, if the run must not write files, or if it is stopped or exceeds a limit.
    pub fn write_file_by(
        &self,
        name: &str,
        write: impl FnOnce(&mut dyn Write) -> io::Result<()>,
    ) -> Result<PathBuf, ScriptError> {
        self.account_for(&[])?;
        let written =
            self.output().write_by(name, |file| write(&mut CountedFile { file, context: self }));
        self.proceed()?;
        Ok(self.report_kept(written?))
    }

    /// Writes a file that the script may [read](Self::read_file) later, also in a dry run.
    /// An existing file is treated as in [`Self::write_file`].
    ///
    /// # Errors
    /// Fails if the file cannot be written, if the run must not write files, or if it is stopped or exceeds a limit.
    pub fn write_to_read(&self, name: &str, content: Vec<u8>) -> Result<PathBuf, ScriptError> {
        self.account_for(&content)?;
        self.output().write_to_read(name, content).map(|written| self.report_kept(written))
    }

    /// Reads a file in the output folder or in the folder of the script.
    ///
    /// # Errors
    /// Fails if the name leads out of these folders, or if the file does not exist, is too large, or is not a regular file.
    pub fn read_file(&self, name: &str) -> Result<Vec<u8>, ScriptError> {
        let room = self.meter().limits().memory.map(|bytes| bytes / TIMES_ITS_LENGTH);
        self.output().read(name, room)
    }

    fn account_for(&self, content: &[u8]) -> Result<(), ScriptError> {
        if let Some(refusal) = self.0.refuses_files.get() {
            return Err(ScriptError::new("no file is written here").hint(refusal));
        }
        match self.mode() == RunMode::DryRun || self.meter().allows_a_file(content.len() as u64) {
            true => Ok(()),
            false => self.proceed(),
        }
    }

    fn report_kept(&self, written: WrittenFile) -> PathBuf {
        if let Some(kept) = written.kept {
            self.print_message(&format!(
                "note: '{}' existed already and was not written by withy: it is kept as '{}'",
                written.path.display(),
                kept.display()
            ));
        }
        written.path
    }

    pub(super) fn write_remains(&self, name: &str, content: &[u8]) -> Result<PathBuf, ScriptError> {
        let bytes = content.len() as u64;
        if self.mode() == RunMode::Run && bytes > self.meter().rescue_budget() {
            let message =
                format!("note: '{name}' was not written: the limit on written bytes is reached");
            return Err(ScriptError::new(message));
        }
        self.meter().allows_to_write(bytes);
        self.output().write(name, content).map(|written| self.report_kept(written))
    }
}

#[cfg(test)]
mod tests {
    use std::sync::atomic::Ordering;

    use super::*;
    use crate::script::messages::stop::Stop;
    use crate::script::state::settings::RunSettings;

    #[test]
    fn interrupt_stops_writing_a_file() {
        let out = tempfile::tempdir().expect("a temporary folder");
        let settings =
            RunSettings { out: out.path().to_owned(), ..RunSettings::silent(RunMode::Run) };
        let context = Context::new(settings);
        let interrupt = context.interrupt_flag();
        let mut refused = 0;
        let written = context.write_file_by("long.csv", |file| {
            file.write_all(b"0\n")?;
            interrupt.store(true, Ordering::Relaxed);
            file.write_all(b"1\n").inspect_err(|_| refused += 1)
        });
        assert!(matches!(written, Err(ScriptError::Stopped(Stop::Interrupt))));
        assert_eq!((refused, std::fs::read_dir(out.path()).expect("the folder").count()), (1, 0));
    }
}
