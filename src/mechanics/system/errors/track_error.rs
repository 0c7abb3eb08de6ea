//! Errors of tracks.

use super::rounded;

#[expect(missing_docs, reason = "the messages describe the variants and their fields")]
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum TrackError {
    #[error("track '{track}' has no beams")]
    Empty { track: String },
    #[error("track '{track}': beam '{beam}' occurs twice; list each beam once")]
    RepeatedBeam { track: String, beam: String },
    #[error(
        "track '{track}': beam '{before}' ends at {place}, but the next beam '{next}' has its ends at {start} and {end}; consecutive beams must meet"
    )]
    Gap { track: String, before: String, next: String, place: String, start: String, end: String },
    #[error(
        "track '{track}' is declared closed, but it ends at {place}, {} from its start {start}", rounded(*gap)
    )]
    Open { track: String, place: String, start: String, gap: f64 },
    #[error("track '{track}': {first_end} and {other} are both at {place}, but are not joined")]
    NotJoined { track: String, first_end: String, other: String, place: String },
}
