//! Parameters varied by a study.

use rhai::{Array, Dynamic, Map};

use super::labels;
use crate::integrators::Method;
use crate::output::significant;
use crate::script::bindings::accept::readable;
use crate::script::bindings::call::Call;
use crate::script::messages::error::{CallPart, ScriptError};
use crate::script::messages::numbers::{as_number, format_number};

const DIGITS: usize = 6;

#[derive(Clone, Debug)]
pub struct StudyParameter {
    pub name: String,
    pub values: Array,
    pub labels: Vec<String>,
}

impl StudyParameter {
    /// Reads the option `key`, a map with one name, such as `#{ dt: [0.1, 0.2] }`.
    pub fn read(call: &Call, key: &str, given: &Dynamic) -> Result<Self, ScriptError> {
        let wrong = |message: String| {
            call.error(message)
                .hint(format!("write {key}: #{{ dt: [0.1, 0.2] }}, a name and its values"))
                .at(CallPart::Key(key.to_owned()))
        };
        let got = call.describe(given);
        let given =
            given.clone().try_cast::<Map>().ok_or_else(|| wrong(format!("{key} is {got}")))?;
        let (1, Some((name, values))) = (given.len(), given.iter().next()) else {
            return Err(wrong(format!("{key} has {} names, but one is expected", given.len())));
        };
        let name = readable(key, name).map_err(|error| error.at(CallPart::Key(key.to_owned())))?;
        let values = values.clone().try_cast::<Array>().filter(|values| !values.is_empty());
        let values = values.ok_or_else(|| wrong(format!("{key}: '{name}' has no values")))?;
        let labels = values.iter().map(|value| label(call, value)).collect();
        Ok(Self { name, values, labels })
    }

    pub fn none() -> Self {
        Self { name: String::new(), values: vec![Dynamic::UNIT], labels: vec![String::new()] }
    }

    /// Value as text for other programs: a number with all digits, otherwise the label.
    pub fn exact(&self, index: usize) -> String {
        as_number(&self.values[index]).map_or_else(|| self.labels[index].clone(), format_number)
    }

    pub fn put(&self, index: usize, into: &mut Map) {
        if !self.name.is_empty() {
            into.insert(self.name.as_str().into(), self.values[index].clone());
        }
    }
}

pub fn label(call: &Call, value: &Dynamic) -> String {
    if let Some(number) = as_number(value) {
        let short = significant(number, DIGITS);
        return match short.parse::<f64>() {
            Ok(large) if large.abs() >= 1e4 => format!("{large:e}"),
            _ => short,
        };
    }
    if let Some(method) = value.clone().try_cast::<Method>() {
        return labels::method(&method);
    }
    let named = value.read_lock::<Map>().and_then(|map| map.get("name").cloned());
    match named.unwrap_or_else(|| value.clone()) {
        text if text.is_string() => text.to_string(),
        other => call.show(&other),
    }
}
