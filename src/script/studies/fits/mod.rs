//! Parameters found by runs, as scripts ask for them: fits to data, designs within constraints.

pub mod design;
pub mod fit;
pub mod ranges;
pub mod root;
mod scales;
