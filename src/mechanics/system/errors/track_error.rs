//! What can be wrong with a track.

/// A track that cannot be described.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum TrackError {
    /// A track of no beams.
    #[error("track '{track}' has no beams")]
    Empty {
        /// The name of the track without beams.
        track: String,
    },
    /// A track that leads along a beam twice.
    #[error(
        "track '{track}': beam '{beam}' is in it twice; a track leads along each of its beams once"
    )]
    Again {
        /// The name of the track.
        track: String,
        /// The name of the beam that is in it twice.
        beam: String,
    },
    /// A track whose next beam does not touch where the track has come to.
    #[error(
        "track '{track}': beam '{before}' leads to {here}, where beam '{next}' neither starts nor ends: its ends are at {start} and {end}"
    )]
    Apart {
        /// The name of the track.
        track: String,
        /// The name of the beam along which the track has come.
        before: String,
        /// The name of the beam that should go on there.
        next: String,
        /// The place to which the track has come, in words.
        here: String,
        /// The place where the next beam starts, in words.
        start: String,
        /// The place where the next beam ends, in words.
        end: String,
    },
    /// A closed track whose last beam does not come back to where the first one begins.
    #[error(
        "track '{track}' is closed, but it leads to {here}, {gap:.3e} from {start}, where it begins"
    )]
    Open {
        /// The name of the track.
        track: String,
        /// The place to which the last beam leads, in words.
        here: String,
        /// The place where the first beam begins, in words.
        start: String,
        /// The distance of both [length].
        gap: f64,
    },
    /// Two beams of a track that touch and are not joined.
    #[error("track '{track}': {one} and {other} are both at {here}, but not joined")]
    Loose {
        /// The name of the track.
        track: String,
        /// The end of the one beam, in words.
        one: String,
        /// The end of the other beam, in words.
        other: String,
        /// The place where both are, in words.
        here: String,
    },
}
