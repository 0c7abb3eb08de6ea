//! Hints for values of a wrong type.

use rhai::{Array, Dynamic, FnPtr, Map};

use super::kind::{Kind, NumberRange};
use crate::script::messages::numbers::{as_number, format_number};

/// Hint for a value of the type `given` in place of the type `kind`; `None` if the mistake is not known.
pub fn hint(kind: &Kind, value: &Dynamic, given: &str) -> Option<String> {
    match kind {
        Kind::Number(_) if is_infinite_or_nan(value) => {
            Some("an overflow or an undefined operation before this line caused this value".into())
        }
        Kind::Integer(NumberRange::Finite) if value.is_float() => {
            Some("floor(x) or round(x) returns a whole number".into())
        }
        Kind::Number(_) | Kind::Integer(_) | Kind::Numeric => of_number(value, given),
        Kind::Choice(allowed) => {
            let text = value.as_immutable_string_ref().ok()?;
            let near = crate::script::messages::suggest::nearest(&text, allowed.iter().copied())?;
            Some(format!("did you mean \"{near}\"?"))
        }
        Kind::Text | Kind::Name => {
            as_number(value).map(|_| "write x.to_string(), or `${x}`".into())
        }
        Kind::Boolean => as_number(value).map(|_| "write true or false, without quotes".into()),
        Kind::Point if value.is::<FnPtr>() => Some(
            "a function of time follows a constant direction: scene.force(rod.end, [1, 0], |t| sin(t))"
                .into(),
        ),
        Kind::Point => of_point(value, given),
        Kind::Array | Kind::Numbers => of_array(value),
        Kind::Points => of_points(value),
        Kind::Function if value.is::<Map>() => {
            Some("options come last: give the required value before them, such as |t| 1".into())
        }
        Kind::Function if !value.is::<FnPtr>() => Some(
            "write |t| and an expression, such as |t| sin(t); a named function f is |t| f(t)"
                .into(),
        ),
        Kind::Options(keys) => {
            let required = keys.iter().find(|key| key.is_required());
            let names = || keys.iter().map(|key| format!("{}: …", key.name));
            Some(match (required, keys.len()) {
                (Some(required), _) => format!("write #{{ {}: … }}", required.name),
                (None, 0) => return None,
                (None, 1..=4) => format!(
                    "write #{{ {} }}, or some of these",
                    names().collect::<Vec<_>>().join(", ")
                ),
                (None, _) => format!("write #{{ {} }}", names().next()?),
            })
        }
        Kind::Object(of) => of_object(of.name(), value, given).map(str::to_owned),
        Kind::Either(kinds) if as_number(value).is_some() && kinds.iter().any(is_number) => {
            kinds.iter().filter(|kind| is_number(kind)).find_map(|kind| hint(kind, value, given))
        }
        Kind::Either(kinds) => kinds.iter().find_map(|kind| hint(kind, value, given)),
        _ => None,
    }
}

fn is_number(kind: &Kind) -> bool {
    matches!(kind, Kind::Number(_))
}

fn of_number(value: &Dynamic, given: &str) -> Option<String> {
    if value.is_string() {
        return Some(
            "numbers are written without quotes; parse_float(text) converts a text to a number"
                .into(),
        );
    }
    match given {
        "vector" => Some("a component is v.x or v.y, the length norm(v)".into()),
        "function" => Some("call a function in a variable by f.call(x)".into()),
        "array" => {
            Some("an element is array[0]; array.map(|x| f(x)) calls f for each element".into())
        }
        "range" => Some("for i in 0..10 { … } loops over the numbers of a range".into()),
        _ => None,
    }
}

fn of_point(value: &Dynamic, given: &str) -> Option<String> {
    if as_number(value) == Some(0.0) {
        return Some("give both components: [0, 0]".into());
    }
    if let Some(x) = as_number(value).filter(|x| x.is_finite()) {
        let (plus, minus) = (format_number(x.abs()), format_number(-x.abs()));
        return Some(format!("give both components: [{plus}, 0], or downwards [0, {minus}]"));
    }
    if value.read_lock::<Array>().is_some_and(|array| array.len() > 2 && array.len() % 2 == 0) {
        return Some("+ joins arrays: write vec(1, 2) + [1, 0] to add points".into());
    }
    match given {
        "station" => Some("sim.position(station) is the position of a station".into()),
        "beam" => Some("sim.position(rod.end) is the position of the end of a beam".into()),
        "map" => Some("a point is written [x, y]".into()),
        _ => None,
    }
}

fn of_array(value: &Dynamic) -> Option<String> {
    if let Ok(text) = value.as_immutable_string_ref() {
        return Some(format!("write [\"{}\"]: an array, also for one value", text.as_str()));
    }
    if let Some(x) = as_number(value) {
        return Some(format!("write [{}]: an array, also for one value", format_number(x)));
    }
    value.is::<Map>().then(|| "map.keys() and map.values() are arrays".into())
}

fn of_points(value: &Dynamic) -> Option<String> {
    let array = value.read_lock::<Array>()?;
    let is_flat = array.iter().any(|element| as_number(element).is_some());
    is_flat.then(|| "write an array of points: [[0, 0], [1, 0]]".into())
}

fn of_object(wanted: &str, value: &Dynamic, given: &str) -> Option<&'static str> {
    let points = || value.read_lock::<Array>().is_some_and(|array| !array.is_empty());
    Some(match (wanted, given) {
        ("station", "beam") => "give a station of the beam: rod.start, rod.end or rod.at(s)",
        ("station", "vector" | "array") => {
            "a station is rod.start, rod.end or rod.at(s) of a beam, or a particle"
        }
        ("station", "number" | "whole number") => "write rod.at(s), with the beam before the dot",
        ("beam", "station") => "give the beam itself, without .start or .end",
        ("curve", "array") if points() => {
            "write line([0, 0], [1, 0]), arc(…), or through(points) for a curve through many points"
        }
        ("curve", "vector") => "a curve has two ends: line([0, 0], [1, 0])",
        ("section", "map") => "write section(#{ EA: … }) around the options",
        ("section", "number" | "whole number") => {
            "write section(#{ EA: …, GA: …, EI: …, rho_A: …, rho_I: … })"
        }
        ("integrator", "text") => "write it as a call, without quotes: energy_momentum()",
        ("integrator" | "sliding rule", "function") => {
            "call it with parentheses: energy_momentum()"
        }
        ("sliding rule", "text") => "write it as a call, without quotes: conserving()",
        ("schedule", "function") => "write schedule(|t| …) around the function",
        ("mesh" | "knots", "number" | "whole number") => "write bspline(16) for 16 spans",
        ("simulation", "scene") => {
            "let sim = scene.start(#{ dt: 0.1 }) creates a simulation of a scene"
        }
        ("scene", "simulation") => "sim.scene is the scene that a simulation was started from",
        ("history", "simulation") => "write sim.history",
        _ => return None,
    })
}

fn is_infinite_or_nan(value: &Dynamic) -> bool {
    as_number(value).is_some_and(|x| !x.is_finite())
}
