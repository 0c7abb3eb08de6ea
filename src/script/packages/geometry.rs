//! Geometry: knots and their basis functions, planar curves, Gauss rules.
//!
//! Another domain takes a curve as `object("axis", geometry::CURVE)` and reads it with
//! `call.get::<Rc<Curve>>("axis")`; knots are [`KNOTS`] and `Rc<KnotVector>`. Both never change once made.

pub mod curves;
pub mod knots;
pub mod quadrature;

use rhai::{Array, Dynamic};

use crate::geometry::{Basis, GeometryError, MAX_DEGREE, Vec2};
use crate::script::bindings::call::Call;
use crate::script::bindings::parameter::{Parameter, Presence, number, whole};
use crate::script::messages::error::{CallPart, ScriptError};
use crate::script::messages::numbers::format_number;

pub use curves::CURVE;
pub use knots::KNOTS;

/// A parameter ξ of knots or a curve.
const XI: Parameter = number("xi").doc("the parameter ξ, inside the domain");

/// How often to differentiate.
const ORDER: Parameter = whole("order")
    .between(0.0, MAX_DEGREE as f64)
    .doc("how often to differentiate by ξ; 0 for the value itself");

/// How often to insert a knot.
const TIMES: Parameter =
    whole("times").non_negative().doc("how often to insert it").or(Presence::Whole(1));

/// Coordinates smaller than this fraction of a vector print as 0.
const ROUNDING: f64 = 1e-14;

/// The derivatives of all functions of `basis` as the arguments `xi` and `order` of `call` ask for.
pub fn all_functions(basis: &Basis, call: &Call) -> Result<Dynamic, ScriptError> {
    let local = blame(0, basis.evaluate(call.number("xi")?))?;
    let mut row = vec![0.0; basis.functions()];
    let derivatives = local.derivatives(call.count("order")?);
    row[local.first..][..derivatives.len()].copy_from_slice(derivatives);
    Ok(numbers(row))
}

/// An array of numbers for the script.
fn numbers(values: impl IntoIterator<Item = f64>) -> Dynamic {
    values.into_iter().map(Dynamic::from).collect::<Array>().into()
}

/// An array of two numbers for the script.
fn pair((start, end): (f64, f64)) -> Dynamic {
    numbers([start, end])
}

/// A vector for the script.
fn vector(components: Vec2) -> Dynamic {
    Dynamic::from(components)
}

/// A number that counts something, for the script.
fn count(n: usize) -> Dynamic {
    Dynamic::from(n as i64)
}

/// Puts a refusal of the geometry at the argument that caused it.
fn blame<T>(argument: usize, result: Result<T, GeometryError>) -> Result<T, ScriptError> {
    result.map_err(|error| ScriptError::from(error).at(CallPart::Argument(argument)))
}

/// `x` to six digits, as it is printed inside a description.
fn brief(x: f64) -> String {
    format_number(format!("{x:.5e}").parse().unwrap_or(x))
}

/// `point` to six digits; a coordinate that is nothing but rounding beside the other one is 0.
fn brief_point(point: Vec2) -> String {
    let [x, y] = [point.x, point.y].map(|x| match x.abs() < ROUNDING * point.norm() {
        true => brief(0.0),
        false => brief(x),
    });
    format!("[{x}, {y}]")
}

/// `3 spans`, `1 span`.
fn plural(count: usize, noun: &str) -> String {
    format!("{count} {noun}{}", if count == 1 { "" } else { "s" })
}
