//! Why a simulation cannot be stored, or a file is none.

use crate::simulation::SimulationError;

/// A simulation that cannot be stored, or bytes that are not a whole and sound one.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum ArchiveError {
    /// A load with a function of a script.
    #[error("the {load} has a function as its schedule, and functions cannot be stored")]
    Function {
        /// The load.
        load: String,
    },
    /// A column that a function of a script fills.
    #[error(
        "the column '{column}' is filled by a function, and functions cannot be stored; record ready quantities such as \"rod.end.x\""
    )]
    Sensor {
        /// The column.
        column: String,
    },
    /// Something else.
    #[error("this is no simulation: it does not begin as stored simulations do")]
    Foreign,
    /// A part is missing.
    #[error(
        "the file ends too early: it has {found} bytes, but {needed} are needed; it was cut off"
    )]
    Truncated {
        /// Its length [bytes].
        found: usize,
        /// The length that its header asks for, as far as that is known [bytes].
        needed: u64,
    },
    /// Written by a later program.
    #[error(
        "it was written by withy {program} in format {format}, but this is withy {own_program}, which reads format {own}; use a newer withy"
    )]
    Newer {
        /// What wrote it.
        program: String,
        /// The format of the file.
        format: u16,
        /// This program.
        own_program: &'static str,
        /// The format that it reads.
        own: u16,
    },
    /// It is of a format that is not read any more.
    #[error(
        "it was written by withy {program} in format {format}, but only format {own} is read; load it with that withy"
    )]
    Older {
        /// What wrote it.
        program: String,
        /// The format of the file.
        format: u16,
        /// The format that this program reads.
        own: u16,
    },
    /// Its checksum is wrong.
    #[error(
        "the file is damaged: its checksum is {found:08x}, but its bytes have {right:08x}; use another copy"
    )]
    Damaged {
        /// In the file.
        found: u32,
        /// Of its bytes.
        right: u32,
    },
    /// More than there should be.
    #[error("the file is damaged: {more} bytes follow behind its end; use another copy")]
    Longer {
        /// How many.
        more: u64,
    },
    /// A sound file with a content that makes no sense.
    #[error("its content is not that of a simulation: {reason}")]
    Content {
        /// What is wrong.
        reason: String,
    },
    /// A scene that cannot be built.
    #[error("its scene cannot be built: {0}")]
    Scene(#[from] SimulationError),
}
