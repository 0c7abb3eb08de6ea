//! Result of the function of a sweep for a row.

use std::sync::Arc;

use rhai::{Dynamic, Map};

use crate::script::bindings::parameter_variants::VariantValue;
use crate::script::studies::calls::calling::CallOutcome;

#[derive(Clone, Debug)]
pub enum RowOutcome {
    Computed(Arc<[String]>, Vec<f64>),
    /// The function failed in this row, or returned a number that is infinite or NaN. The field is the reason.
    Failed(String),
    Wrong(String),
}

impl RowOutcome {
    pub fn of(called: CallOutcome) -> Self {
        match called {
            CallOutcome::Returned(given) => found(&given),
            CallOutcome::Failed(reason) => Self::Failed(reason),
            CallOutcome::Wrong(reason) => Self::Wrong(reason),
        }
    }
}

pub fn found(given: &Dynamic) -> RowOutcome {
    let Some(map) = given.read_lock::<Map>() else {
        return RowOutcome::Wrong(
            "it does not return a map of numbers, such as #{ peak: peak }".into(),
        );
    };
    if map.is_empty() {
        return RowOutcome::Wrong("it returns an empty map".into());
    }
    let mut numbers = Vec::with_capacity(map.len());
    for (name, value) in map.iter() {
        let truth = || value.as_bool().ok().map(|truth| f64::from(u8::from(truth)));
        match VariantValue::number(value).or_else(truth) {
            Some(number) if number.is_finite() => numbers.push(number),
            Some(number) if number.is_nan() => {
                return RowOutcome::Failed(format!("'{name}' is not a number"));
            }
            Some(_) => return RowOutcome::Failed(format!("'{name}' is infinite")),
            None => {
                return RowOutcome::Wrong(format!(
                    "it returns '{name}', which is neither a number nor true or false"
                ));
            }
        }
    }
    RowOutcome::Computed(map.keys().map(ToString::to_string).collect(), numbers)
}
