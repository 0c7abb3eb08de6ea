//! What a domain declares and how it is called: tables of rows, kinds and parameters, and from a row to a checked native call.

pub mod accept;
pub mod arguments;
pub mod built_in;
pub mod builtins;
pub mod call;
pub mod catalog;
pub mod decisions;
pub mod instead;
pub mod key_sets;
pub mod kind;
pub mod lifting;
pub mod members;
pub mod option_set;
pub mod options;
pub mod parameter;
pub mod register;
pub mod returns;
pub mod sources;
pub mod stored;
pub mod table;
pub mod topics;
