//! The session at the prompt. [`editor`] is how its lines are typed.

pub mod editor;
