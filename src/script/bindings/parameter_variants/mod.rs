//! Evaluation of calls for variants of the parameters of a scene: a call with an argument that depends on a parameter is evaluated for the
//! scene and for all side variants.
//!
//! Derivatives thereby propagate through sections, loads, simulations, and functions of their results.

mod gather;
mod lift;
mod nonsmooth;
mod parameter_set;
mod policy;
mod variant_value;

pub use lift::{gathered, gathered_without, lift};
pub use nonsmooth::{
    NonsmoothCheck, Sides, at_cut, at_cut_of_vector, at_multiples, at_origin, at_whole_numbers,
    at_zero, at_zero_vector, corner_of, near_ends_of_logarithm, near_one, near_quarters, near_zero,
    near_zero_base, near_zero_divisor, where_equal, where_largest_changes, where_points_meet,
    where_rounded_differs, where_smallest_changes,
};
pub use parameter_set::{
    CurrentVariant, ParameterSet, RELATIVE_DISTANCE, know, lose, present, present_variant,
};
#[cfg(test)]
pub use policy::NAMED;
pub use policy::{Lifting, lifting_of};
pub use variant_value::VariantValue;
