//! Storage of a sweep: its journal, a computed part, or the parts to be merged.

use std::path::PathBuf;

use super::run::SweepRequest;
use super::sweep_progress::SweepProgress;
use crate::analysis::{Journal, RowEntry, read_rows};
use crate::script::bindings::call::Call;
use crate::script::bindings::sources::Sources;
use crate::script::messages::error::ScriptError;
use crate::script::state::journals::{JournalLifetime, RowKeeper};
use crate::script::state::parts::{StudyPart, find_parts};
use crate::script::studies::calls::function::RunFunction;

impl SweepRequest<'_> {
    /// Opens the journal of the sweep, if the run uses journals, or reads the rows of all parts if they are merged.
    pub fn keeper(
        &self,
        call: &Call,
        function: &RunFunction,
        progress: &mut SweepProgress,
    ) -> Result<Option<RowKeeper>, ScriptError> {
        let context = call.context();
        let (options, rows) = (context.studies(), progress.rows as u64);
        let fingerprint = self.fingerprint(call, function);
        let about =
            |part: StudyPart| RowEntry::Sweep { fingerprint, rows, part: (part.number, part.of) };
        if options.part.is_none() && !options.merge.is_empty() {
            self.join(&options.merge, about, progress)?;
            return Ok(None);
        }
        let (file, lasting) = match options.part {
            Some(part) => (part.file(&self.name), JournalLifetime::Persistent),
            None => (format!("{}.journal", self.name), JournalLifetime::Run),
        };
        let path = context.output().path_of(&file)?;
        let about = about(options.part.unwrap_or(StudyPart::WHOLE));
        let kept = (options.journal, lasting);
        context.journals().open_rows(path, kept, about, |entry| progress.recall(entry))
    }

    fn join(
        &self,
        folders: &[PathBuf],
        about: impl Fn(StudyPart) -> RowEntry,
        progress: &mut SweepProgress,
    ) -> Result<(), ScriptError> {
        for (part, file) in find_parts(&self.name, folders)? {
            let (expected, mut is_same) = (about(part), None);
            let read = read_rows::<std::io::Error>(&file, |entry| {
                if *is_same.get_or_insert(entry == expected) {
                    progress.recall(entry);
                }
                Ok(())
            });
            let (file, number, of) = (file.display(), part.number, part.of);
            read.map_err(|error| {
                ScriptError::new(format!("cannot read the part '{file}': {error}"))
            })?;
            if is_same != Some(true) {
                let message = format!(
                    "'{file}' is not a part of this study: it is of another script, of other \
                    parameters, or of another build of withy"
                );
                return Err(ScriptError::new(message)
                    .hint("run the part again with this script and this withy"));
            }
            let is_missing = |row: &usize| part.has(*row) && !progress.knows(*row);
            let missing = (0..progress.rows).filter(is_missing).count();
            if missing > 0 {
                let name = &self.name;
                let message = format!(
                    "part {number} of {of} of the study '{name}' is not finished: {missing} rows are missing in '{file}'"
                );
                return Err(
                    ScriptError::new(message).hint("continue with the same command with --part")
                );
            }
        }
        Ok(())
    }

    /// Hash of all data on which the rows depend: program, script, imports, inputs, captured values, time limit, and parameters.
    fn fingerprint(&self, call: &Call, function: &RunFunction) -> u64 {
        let captured = format!("{:?} {:?}", function.captured, self.wall);
        let script = call.context().program().map(|program| program.text.to_string());
        let imports = Sources::of(call.engine()).checksum().to_le_bytes();
        let parameters = self.plan.checksum_data();
        let script = script.unwrap_or_default();
        let inputs = call.context().inputs().fingerprint();
        let parts: [&[u8]; 5] =
            [script.as_bytes(), captured.as_bytes(), &imports, &parameters, &inputs];
        Journal::fingerprint(&parts)
    }
}
