//! Declaration and call of bindings: tables, kinds and parameters, and checked native calls.

pub mod accept;
pub mod arguments;
pub mod branch_detection;
pub mod built_in;
pub mod builtins;
pub mod call;
pub mod catalog;
pub mod key_sets;
pub mod kind;
pub mod members;
pub mod option_set;
pub mod options;
pub mod parameter;
pub mod parameter_variants;
pub mod register;
pub mod returns;
pub mod sources;
pub mod stored;
pub mod table;
pub mod topics;
pub mod type_hints;
