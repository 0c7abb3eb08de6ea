//! Binding tables, types and parameters, and native calls with checked arguments.

pub(crate) mod accept;
pub(crate) mod arguments;
pub(crate) mod branch_detection;
pub(crate) mod built_in;
pub(crate) mod builtins;
pub mod call;
pub mod catalog;
pub(crate) mod input_calls;
pub(crate) mod key_sets;
pub mod kind;
pub(crate) mod members;
pub(crate) mod option_set;
pub(crate) mod options;
pub mod parameter;
pub(crate) mod parameter_variants;
pub(crate) mod register;
pub(crate) mod returns;
pub(crate) mod sources;
pub(crate) mod stored;
pub mod table;
pub(crate) mod topics;
pub(crate) mod type_hints;
