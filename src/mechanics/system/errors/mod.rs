//! Errors of a model, rules for names, and number formats for messages.

mod error;
mod names;
mod numbers;
mod slider_error;
mod track_error;

pub use error::{SystemError, Turning, finite};
pub use names::{check_name, refusal};
pub use numbers::{MOST, in_words, plural, rounded, with_article, written};
pub use slider_error::{Approach, SliderError, SliderParts};
pub use track_error::TrackError;
