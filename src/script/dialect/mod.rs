//! Adaptation of Rhai to the language of withy.

pub mod constants;
pub mod derivatives;
pub mod elements;
pub mod foundation;
pub mod json;
pub mod naming;
pub mod operators;
pub mod reading;
pub mod repetitions;
pub mod replacing;
pub mod sizes;
pub mod sorting;
pub mod switch_values;
