//! Every error of a script as one message: what is wrong, where, what to do, and the calls that led there.

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
