//! Rules for calls whose arguments depend on parameters, by domain of the language.

use crate::script::bindings::table::{BindingTable, CallSyntax, FunctionBinding};

/// Rule for the evaluation of a call whose arguments depend on parameters.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Lifting {
    Each,
    AtValues,
    /// The call is evaluated once, because its receiver contains all variants. Arguments that depend on parameters are errors,
    /// except in functions of derivatives.
    Once,
    /// The call is rejected, because the result would have no derivatives.
    Refused,
}

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
    "obstacles",
    "sliding joints",
    "sleeves",
    "tracks",
    "releases",
    "simulations",
    "histories",
    "statistics",
    "sensors",
    "derivatives",
];

const AT_VALUES: &[&str] = &[
    "text",
    "checks",
    "looking closely",
    "help",
    "notes",
    "error estimates",
    "pictures",
    "pictures of arrays",
    "pictures along beams",
    "exports",
    "viewers",
    "animations",
];

/// Domains without derivatives, whose calls are rejected.
const REFUSED: &[&str] = &["equilibrium", "modes", "buckling"];

const WHOLE: &[&str] = &["quotient"];

/// Methods that advance a simulation in all variants, or whose result is the same in all variants, such as the time.
const ONCE: &[&str] = &["start", "step", "run_to", "at", "t", "dt", "invariants", "parameter"];

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

/// Names of all domains in the constants of this file. A test checks that the domains exist.
#[cfg(test)]
pub const NAMED: [&[&str]; 3] = [EACH, AT_VALUES, REFUSED];
