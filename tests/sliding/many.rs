//! Many sliders: their contacts are eliminated one by one, with the same solution, and all is kept as with few.
#![allow(clippy::unwrap_used)]

use crate::common::{line_of, meshes, simulate, sliding_scenes};
