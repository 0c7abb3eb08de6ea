//! Whether two scenes describe the same mechanism.

use serde_json::Value;

use super::Scene;
use crate::system::Element;

/// Numbers that differ by no more than this part of them count as the same: they may have been computed by another formula.
const TOLERANCE: f64 = 1e-9;

impl Scene {
    /// Whether another scene has the same beams, particles, rigid bodies, joints, tracks, sliders, masses, velocities and loads, in the same order. Names do
    /// not count, nor do places that are only looked at. Functions from outside, as in schedules, cannot be compared: a scene
    /// with one of them is like no other.
    pub fn is_like(&self, other: &Self) -> bool {
        match (self.without_names(), other.without_names()) {
            (Ok(own), Ok(others)) => is_near(&own, &others),
            _ => false,
        }
    }

    fn without_names(&self) -> serde_json::Result<Value> {
        let mut plain = self.clone();
        plain.name.clear();
        plain.stations.clear();
        let names = (plain.beams.iter_mut().map(|beam| &mut beam.name))
            .chain(plain.particles.iter_mut().map(|particle| &mut particle.name))
            .chain(plain.rigid_bodies.iter_mut().map(|body| &mut body.name))
            .chain(plain.tracks.iter_mut().map(|track| &mut track.name))
            .chain(plain.sliders.iter_mut().map(|slider| &mut slider.name))
            .chain(plain.drives.iter_mut().map(|drive| &mut drive.name))
            .chain(plain.elements.iter_mut().filter_map(Element::name_mut));
        names.for_each(String::clear);
        plain.rigid_bodies.iter_mut().for_each(|body| body.outline.clear());
        // What stands in one list is of several kinds, between which the order is nobody's choice.
        plain.elements.sort_by_key(Element::kind);
        serde_json::to_value(plain)
    }
}

fn is_near(a: &Value, b: &Value) -> bool {
    match (a, b) {
        (Value::Number(x), Value::Number(y)) => match (x.as_f64(), y.as_f64()) {
            (Some(x), Some(y)) => (x - y).abs() <= TOLERANCE * x.abs().max(y.abs()).max(1.0),
            _ => x == y,
        },
        (Value::Array(a), Value::Array(b)) => {
            a.len() == b.len() && a.iter().zip(b).all(|(a, b)| is_near(a, b))
        }
        (Value::Object(a), Value::Object(b)) => {
            let is_there = |(key, value)| b.get(key).is_some_and(|other| is_near(value, other));
            a.len() == b.len() && a.iter().all(is_there)
        }
        _ => a == b,
    }
}
