//! Detection of schedules whose jump times depend on a parameter of a scene.

use rhai::{Array, Dynamic, Map};

use crate::loads::{LimitSide, Schedule};
use crate::script::bindings::parameter_variants::VariantValue;

pub(super) fn jumps_with_a_parameter(value: &Dynamic) -> bool {
    if let Some(array) = value.read_lock::<Array>() {
        return array.iter().any(jumps_with_a_parameter);
    }
    if let Some(map) = value.read_lock::<Map>() {
        return map.values().any(jumps_with_a_parameter);
    }
    let Some(varied) = value.read_lock::<VariantValue>() else { return false };
    let in_variant = |variant: usize| varied.at(variant).try_cast::<Schedule>();
    let Some(own) = in_variant(0) else { return false };
    let others = (1..varied.parameter_set().variants()).filter_map(in_variant);
    let own: Vec<f64> = jumps_of(&own);
    others.map(|other| jumps_of(&other)).any(|other| other != own)
}

fn jumps_of(schedule: &Schedule) -> Vec<f64> {
    let at = |time: f64, side: LimitSide| schedule.value(time, side).ok();
    let jumps = |time: &f64| at(*time, LimitSide::Before) != at(*time, LimitSide::After);
    schedule.breaks().into_iter().filter(jumps).collect()
}
