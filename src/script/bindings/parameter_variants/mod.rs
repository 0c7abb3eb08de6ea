//! Evaluation of calls at the values of the parameters of a scene, and at perturbed values.
//!
//! Derivatives are computed from the differences between the results, for sections, loads, simulations, and functions of them.

mod gather;
mod lift;
mod nonsmooth;
mod parameter_set;
mod policy;
mod variant_value;

pub use lift::{combined, combined_without_derivatives, evaluate_variants};
pub use nonsmooth::{
    NonsmoothCheck, at_branch_cut, at_branch_cut_of_vector, at_coinciding_points, at_digit_changes,
    at_equality, at_integers, at_largest_change, at_multiples, at_origin, at_smallest_change,
    at_zero, at_zero_vector, corner_of, near_ends_of_logarithm, near_one, near_quarters, near_zero,
    near_zero_base, near_zero_divisor,
};
pub use parameter_set::{
    CurrentVariant, ParameterSet, RELATIVE_DISTANCE, present, present_variant, register_type,
    set_unavailable,
};
#[cfg(test)]
pub use policy::NAMED;
pub use policy::{Lifting, lifting_of};
pub use variant_value::VariantValue;
