//! Errors of tracks.

/// Track that cannot be described.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum TrackError {
    /// Track without beams.
    #[error("track '{track}' has no beams")]
    Empty {
        /// Name of the track.
        track: String,
    },
    /// Track that contains a beam twice.
    #[error("track '{track}': beam '{beam}' occurs twice; list each beam once")]
    RepeatedBeam {
        /// Name of the track.
        track: String,
        /// Name of the beam.
        beam: String,
    },
    /// Track with a gap between consecutive beams.
    #[error(
        "track '{track}': beam '{before}' ends at {place}, but the next beam '{next}' has its ends at {start} and {end}; consecutive beams must meet"
    )]
    Gap {
        /// Name of the track.
        track: String,
        /// Name of the beam before the gap.
        before: String,
        /// Name of the beam after the gap.
        next: String,
        /// End of the beam before the gap.
        place: String,
        /// Start of the next beam.
        start: String,
        /// End of the next beam.
        end: String,
    },
    /// Closed track with a gap between its last and first beams.
    #[error(
        "track '{track}' is declared closed, but it ends at {place}, {gap:.3e} from its start {start}"
    )]
    Open {
        /// Name of the track.
        track: String,
        /// End of the last beam.
        place: String,
        /// Start of the first beam.
        start: String,
        /// Distance between both [length].
        gap: f64,
    },
    /// Consecutive beams of a track that touch but are not joined.
    #[error("track '{track}': {first_end} and {other} are both at {place}, but are not joined")]
    NotJoined {
        /// Name of the track.
        track: String,
        /// End of the first beam.
        first_end: String,
        /// End of the second beam.
        other: String,
        /// Place of both.
        place: String,
    },
}
