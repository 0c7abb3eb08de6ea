//! Search parameters: start values and bounds.

use rhai::{Array, Dynamic, Map};

use crate::fitting::SearchRange;
use crate::script::bindings::accept::readable;
use crate::script::bindings::call::Call;
use crate::script::messages::error::{CallPart, ScriptError};
use crate::script::messages::numbers::{as_number, format_number};
use crate::script::studies::plan::at_key;

pub struct Ranges {
    pub names: Vec<String>,
    pub ranges: Vec<SearchRange>,
}

const SHAPE: &str = "write EI: [10, 1, 100] with the initial, lowest and highest value, or EI: 10 without \
    bounds";

impl Ranges {
    pub fn read(call: &Call, given: &Dynamic) -> Result<Self, ScriptError> {
        let map = given.read_lock::<Map>().filter(|map| !map.is_empty());
        let Some(map) = map else {
            let message = "parameters must be a map with at least one name";
            return Err(at_key(call, "parameters", message, SHAPE));
        };
        let (mut names, mut ranges) = (Vec::new(), Vec::new());
        for (name, value) in map.iter() {
            let at = |error: ScriptError| error.at(CallPart::Key(name.to_string()));
            names.push(readable("parameters", name).map_err(at)?);
            ranges.push(range(call, name, value).map_err(at)?);
        }
        Ok(Self { names, ranges })
    }

    pub fn named(&self, values: &[f64]) -> Map {
        let pairs = self.names.iter().zip(values);
        pairs.map(|(name, value)| (name.as_str().into(), Dynamic::from(*value))).collect()
    }
}

fn range(call: &Call, name: &str, value: &Dynamic) -> Result<SearchRange, ScriptError> {
    let wrong = |message: String| call.error(message).hint(SHAPE);
    let finite = |value: &Dynamic| as_number(value).filter(|x| x.is_finite());
    if let Some(start) = finite(value) {
        return Ok(SearchRange { start, low: f64::NEG_INFINITY, high: f64::INFINITY });
    }
    let numbers = value
        .read_lock::<Array>()
        .and_then(|array| array.iter().map(finite).collect::<Option<Vec<f64>>>());
    match numbers.as_deref() {
        Some(&[start, low, high]) if low < high && (low..=high).contains(&start) => {
            Ok(SearchRange { start, low, high })
        }
        Some(&[start, low, high]) => {
            let [start, low, high] = [start, low, high].map(format_number);
            Err(wrong(format!(
                "'{name}' starts at {start}, outside of its bounds {low} and {high}"
            )))
        }
        Some(other) => Err(wrong(format!("'{name}' has {} numbers", other.len()))),
        None => Err(wrong(format!("'{name}' is {}", call.describe(value)))),
    }
}
