//! Elementary functions that give the same bits on every machine.
//!
//! Those of the standard library call the C library of the machine, or become constants at compile time by another one: their last bit
//! depends on the C library, on its version and on the instructions of the processor. Those of here are computed by additions,
//! multiplications, divisions and square roots, which IEEE 754 defines to the last bit. All other code uses these; `clippy.toml`
//! refuses the others.

mod functions;
mod powers;

pub use functions::{
    acos, acosh, asin, asinh, atan, atan2, atanh, cos, cosh, exp, hypot, ln, log, log2, log10, sin,
    sin_cos, sinh, tan, tanh,
};
pub use powers::{power, square, whole_power};
