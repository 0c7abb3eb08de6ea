//! Elementary functions with identical results on every machine.
//!
//! Results of the standard library, which calls the C library of the machine, may differ in the last bit between machines.
//! This module uses only additions, multiplications, divisions and square roots, which IEEE 754 defines exactly.
//! All other code uses the module `elementary`; `clippy.toml` rejects the functions of the standard library.

mod digits;
mod functions;
mod powers;

pub use digits::rounded_to;

pub use functions::{
    acos, acosh, asin, asinh, atan, atan2, atanh, cos, cosh, exp, hypot, ln, log, log2, log10, sin,
    sin_cos, sinh, tan, tanh,
};
pub use powers::{power, square, whole_power};
