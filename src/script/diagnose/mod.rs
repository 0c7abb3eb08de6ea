//! Every error of a script as one message: what is wrong, where, what to do, and the calls that led there.

mod calls;
mod diagnostic;
pub(in crate::script) mod elsewhere;
mod faults;
mod habits;
mod locate;
mod operands;
mod parsing;
mod render;
mod translate;

pub use diagnostic::{Blame, Callee, Diagnostic, Location, Step};
pub use render::Colours;
pub use translate::{Explainer, is_interrupt, is_waiting};
