//! Errors of stored simulations.

use crate::simulation::SimulationError;

/// Simulation that cannot be stored, or bytes that are not a valid file.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum ArchiveError {
    /// Load with a script function.
    #[error("{load} uses {function}, and functions of a script cannot be stored in a restart file")]
    Function {
        /// Name of the load.
        load: String,
        /// Description of the function.
        function: String,
    },
    /// Column filled by a script function.
    #[error(
        "the column '{column}' is computed by a function, and functions cannot be stored in a restart file"
    )]
    Sensor {
        /// Name of the column.
        column: String,
    },
    /// Release triggered by a script function.
    #[error("'{name}' is released by a function, and functions cannot be stored in a restart file")]
    Release {
        /// Name of the object to be released.
        name: String,
    },
    /// File of another kind.
    #[error("this is not a restart file: it does not begin with the header of one")]
    Foreign,
    /// Truncated file.
    #[error("the file is truncated: it has {found} of {needed} bytes; use another copy")]
    Truncated {
        /// Length of the file [bytes].
        found: usize,
        /// Length according to the header, as far as known [bytes].
        needed: u64,
    },
    /// File written by a later program.
    #[error(
        "it was written by withy {program} in format {format}, but this is withy {this_program}, which reads format {supported}; install a newer withy"
    )]
    Newer {
        /// Program and version that wrote the file.
        program: String,
        /// Format of the file.
        format: u16,
        /// This program and its version.
        this_program: &'static str,
        /// Supported format.
        supported: u16,
    },
    /// File in a format that is no longer supported.
    #[error(
        "it was written by withy {program} in format {format}, but this withy reads only format {supported}; load it with withy {program}"
    )]
    Older {
        /// Program and version that wrote the file.
        program: String,
        /// Format of the file.
        format: u16,
        /// Supported format.
        supported: u16,
    },
    /// File with a wrong checksum.
    #[error(
        "the file is damaged: its checksum is {found:08x}, but should be {right:08x}; use another copy"
    )]
    Damaged {
        /// Checksum stored in the file.
        found: u32,
        /// Checksum of the content.
        right: u32,
    },
    /// File with trailing bytes.
    #[error("the file is damaged: {trailing_bytes} bytes follow its end; use another copy")]
    TrailingBytes {
        /// Number of trailing bytes.
        trailing_bytes: u64,
    },
    /// Intact file with invalid content.
    #[error("its content is not a valid simulation: {reason}")]
    Content {
        /// Reason.
        reason: String,
    },
    /// File with a scene that cannot be built.
    #[error("its scene cannot be built: {0}")]
    Scene(#[from] SimulationError),
}
