//! From a scene to a model.

mod assemble;
mod numbering;
mod redundancy;

pub(super) use assemble::Assembly;
pub(super) use numbering::{Numbering, check_ties, same_place, written};
