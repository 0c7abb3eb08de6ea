//! Error messages for users: message, location, hint, and call trace.

mod calls;
mod diagnostic;
mod faults;
pub(in crate::script) mod foreign_names;
mod foreign_syntax;
mod locate;
mod operands;
mod parsing;
mod render;
mod translate;

pub use diagnostic::{Blame, CallFrame, Callee, Diagnostic, Location};
pub use render::Colours;
pub use translate::{Explainer, is_interrupt, is_waiting};
