//! Geometry: knots and basis functions, planar curves, Gauss rules.
//!
//! Other domains declare a curve parameter as `object("axis", geometry::CURVE)`, and read it by `call.get::<Rc<Curve>>("axis")`.
//! Knot vectors are declared in the same way, by [`KNOTS`], with the native type `Rc<KnotVector>`.

pub mod curves;
pub mod knots;
pub mod quadrature;

use rhai::{Array, Dynamic};

use crate::geometry::{Basis, GeometryError, MAX_DEGREE, Vec2};
use crate::output::significant;
use crate::script::bindings::call::Call;
use crate::script::bindings::parameter::{Parameter, Presence, integer, number};
use crate::script::messages::error::{CallPart, ScriptError};

pub use curves::CURVE;
pub use knots::KNOTS;

const XI: Parameter = number("xi").doc("parameter ξ, inside the domain");

const ORDER: Parameter = integer("order")
    .between(0.0, MAX_DEGREE as f64)
    .doc("order of the derivative by ξ; 0 for the value itself");

const TIMES: Parameter =
    integer("times").non_negative().doc("number of insertions").or(Presence::Integer(1));

/// Largest component of a vector that counts as rounding error and is printed as 0, as a fraction of the length of the vector.
const ROUNDING: f64 = 1e-14;

/// Derivatives of all functions of `basis`. Their order `order` and the parameter `xi` are arguments of `call`.
pub fn all_functions(basis: &Basis, call: &Call) -> Result<Dynamic, ScriptError> {
    let local = at_argument(0, basis.evaluate(call.number("xi")?))?;
    let mut row = vec![0.0; basis.functions()];
    let derivatives = local.derivatives(call.count("order")?);
    row[local.first..][..derivatives.len()].copy_from_slice(derivatives);
    Ok(numbers(row))
}

fn numbers(values: impl IntoIterator<Item = f64>) -> Dynamic {
    values.into_iter().map(Dynamic::from).collect::<Array>().into()
}

fn pair((start, end): (f64, f64)) -> Dynamic {
    numbers([start, end])
}

fn vector(components: Vec2) -> Dynamic {
    Dynamic::from(components)
}

fn count(n: usize) -> Dynamic {
    Dynamic::from(n as i64)
}

fn at_argument<T>(argument: usize, result: Result<T, GeometryError>) -> Result<T, ScriptError> {
    result.map_err(|error| ScriptError::from(error).at(CallPart::Argument(argument)))
}

fn brief(x: f64) -> String {
    significant(x, 6)
}

fn brief_point(point: Vec2) -> String {
    let [x, y] = [point.x, point.y].map(|x| match x.abs() < ROUNDING * point.norm() {
        true => brief(0.0),
        false => brief(x),
    });
    format!("[{x}, {y}]")
}

fn plural(count: usize, noun: &str) -> String {
    format!("{count} {noun}{}", if count == 1 { "" } else { "s" })
}
