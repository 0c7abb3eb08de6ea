//! Elementary functions with identical results on every machine.
//!
//! Those of the standard library call the C library of the machine, or are evaluated at compile time by another one. Their last bit depends on the
//! library, its version and the processor. The functions here use additions, multiplications, divisions and square roots only, which IEEE 754 defines
//! exactly. All other code uses these; `clippy.toml` rejects the others.

mod functions;
mod powers;

pub use functions::{
    acos, acosh, asin, asinh, atan, atan2, atanh, cos, cosh, exp, hypot, ln, log, log2, log10, sin,
    sin_cos, sinh, tan, tanh,
};
pub use powers::{power, square, whole_power};
