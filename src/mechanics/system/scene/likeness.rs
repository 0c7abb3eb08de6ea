//! Comparison of scenes.

use serde_json::Value;

use super::Scene;
use crate::system::Element;

/// Relative tolerance for equal numbers, which may come from different formulas.
const TOLERANCE: f64 = 1e-9;

impl Scene {
    /// Returns true if both scenes have equal beams, particles, rigid bodies, joints, tracks, sliders, masses, velocities and loads, in the same
    /// order. Names and observed stations are ignored. Script functions cannot be compared, so scenes that contain them are never equal.
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
        // The order between elements of different kinds is irrelevant.
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
