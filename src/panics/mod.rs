//! Panics: our mistakes, caught and told as words with their place.

mod caught;

pub use caught::{caught, silence};
