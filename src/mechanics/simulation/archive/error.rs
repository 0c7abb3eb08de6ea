//! Why a simulation cannot be stored, or a file is none.

use crate::simulation::SimulationError;

/// A simulation that cannot be stored, or bytes that are not a whole and sound one.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum ArchiveError {
    /// A load with a function of a script.
    #[error("{load} follows {function}, and functions of a script cannot be stored")]
    Function {
        /// The name of the load that follows a function of a script.
        load: String,
        /// How the function is written.
        function: String,
    },
    /// A column that a function of a script fills.
    #[error("the column '{column}' is filled by a function, and functions cannot be stored")]
    Sensor {
        /// The column.
        column: String,
    },
    /// Something of which a function of a script says when it lets go.
    #[error("a function says when '{name}' lets go, and functions cannot be stored")]
    Release {
        /// What is still to let go.
        name: String,
    },
    /// Something else.
    #[error("this is no simulation: it does not begin as stored simulations do")]
    Foreign,
    /// A file of a simulation of which a part is missing.
    #[error(
        "the file ends too early: it has {found} bytes, but {needed} are needed; it was cut off"
    )]
    Truncated {
        /// The length of the incomplete file [bytes].
        found: usize,
        /// The length that the header of the incomplete file asks for, as far as that is known [bytes].
        needed: u64,
    },
    /// A file of a simulation that was written by a later program.
    #[error(
        "it was written by withy {program} in format {format}, but this is withy {own_program}, which reads format {own}; use a newer withy"
    )]
    Newer {
        /// The program that wrote the file, with its version.
        program: String,
        /// The format of the old file.
        format: u16,
        /// This program, with its version.
        own_program: &'static str,
        /// The format that this program reads.
        own: u16,
    },
    /// A file of a simulation whose format is not read any more.
    #[error(
        "it was written by withy {program} in format {format}, but only format {own} is read; load it with that withy"
    )]
    Older {
        /// The program that wrote the old file, with its version.
        program: String,
        /// The format of the old file.
        format: u16,
        /// The format that this program reads.
        own: u16,
    },
    /// A file of a simulation whose checksum is wrong.
    #[error(
        "the file is damaged: its checksum is {found:08x}, but its bytes have {right:08x}; use another copy"
    )]
    Damaged {
        /// The checksum in the header of the file.
        found: u32,
        /// The checksum of the bytes of the file.
        right: u32,
    },
    /// A file of a simulation with more bytes than there should be.
    #[error("the file is damaged: {more} bytes follow behind its end; use another copy")]
    Longer {
        /// The number of bytes too many.
        more: u64,
    },
    /// A sound file with a content that makes no sense.
    #[error("its content is not that of a simulation: {reason}")]
    Content {
        /// What is wrong with the content of the file.
        reason: String,
    },
    /// A file with a scene that cannot be built.
    #[error("its scene cannot be built: {0}")]
    Scene(#[from] SimulationError),
}
