//! What a domain of the language does with values that depend on parameters.

use crate::script::bindings::table::{BindingTable, CallSyntax, FunctionBinding};

/// How a call is made when something in it depends on parameters.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Lifting {
    /// For each variant.
    Each,
    /// Once, at the values of the parameters, and with these.
    AtValues,
    /// Once, for what has variants of its own; arguments that depend on parameters are refused.
    Once,
    /// Not at all: what it gives would have lost its derivatives.
    Refused,
}

/// Domains that describe scenes, reckon and ask.
const EACH: &[&str] = &[
    "numbers",
    "vectors",
    "arrays",
    "curves",
    "sections",
    "tapers",
    "schedules",
    "scenes",
    "loads",
    "rigid bodies",
    "supports and drives",
    "springs and dampers",
    "drag",
    "sliding joints",
    "tracks",
    "releases",
    "simulations",
    "histories",
    "statistics",
    "sensors",
    "derivatives",
];

/// Domains that look at numbers.
const AT_VALUES: &[&str] = &[
    "text",
    "checks",
    "looking closely",
    "help",
    "notes",
    "pictures",
    "pictures of arrays",
    "pictures along beams",
    "exports",
    "viewers",
    "animations",
];

/// Domains whose results have no derivatives yet.
const REFUSED: &[&str] = &["equilibrium", "modes"];

/// What takes whole numbers, which do not change a little.
const WHOLE: &[&str] = &["quotient"];

/// What makes a simulation go on, which takes its variants along, or gives what is about it alone, as its time is.
const ONCE: &[&str] = &["start", "step", "run_to", "at", "t", "dt", "invariants", "parameter"];

/// What a row of a domain does with values that depend on parameters.
pub fn lifting_of(table: &BindingTable, row: &FunctionBinding) -> Lifting {
    let is_of = |names: &[&str]| names.contains(&table.name);
    match row.form {
        _ if table.name == "derivatives" => Lifting::Once,
        _ if WHOLE.contains(&row.name) => Lifting::AtValues,
        CallSyntax::Method(of) | CallSyntax::Property(of)
            if ONCE.contains(&row.name) && ["simulation", "scene"].contains(&of.name()) =>
        {
            Lifting::Once
        }
        _ if is_of(EACH) => Lifting::Each,
        _ if is_of(AT_VALUES) => Lifting::AtValues,
        _ if is_of(REFUSED) => Lifting::Refused,
        _ => Lifting::Once,
    }
}

/// The domains that are named here.
#[cfg(test)]
pub const NAMED: [&[&str]; 3] = [EACH, AT_VALUES, REFUSED];
