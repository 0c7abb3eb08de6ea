//! Comparison of scenes.

use std::collections::BTreeMap;

use serde_json::Value;

use super::Scene;
use crate::geometry::larger;
use crate::system::Element;

/// Relative tolerance for equal numbers, which may have been computed by different formulas.
const TOLERANCE: f64 = 1e-9;

/// Absolute tolerance for equal numbers, as a fraction of the largest number of the same field in both scenes.
/// The absolute tolerance is needed for numbers that are zero except for rounding.
const ROUNDING: f64 = 64.0 * f64::EPSILON;

impl Scene {
    /// Returns true if all objects of both scenes are equal and have the same order. The order of elements of different types is ignored.
    /// The comparison of scenes ignores names, observed stations and outlines of rigid bodies.
    /// Scenes that contain script functions are never equal, because script functions cannot be compared.
    pub fn is_like(&self, other: &Self) -> bool {
        match (self.without_names(), other.without_names()) {
            (Ok(own), Ok(others)) => {
                let mut scales = FieldScales::new();
                for scene in [&own, &others] {
                    add_scales(scene, "", &mut scales);
                }
                is_near(&own, &others, "", &scales)
            }
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
        plain.elements.sort_by_key(Element::kind);
        serde_json::to_value(plain)
    }
}

type FieldScales<'v> = BTreeMap<&'v str, f64>;

fn add_scales<'v>(value: &'v Value, field: &'v str, scales: &mut FieldScales<'v>) {
    match value {
        Value::Number(number) => {
            let scale = scales.entry(field).or_default();
            *scale = larger(*scale, number.as_f64().map_or(0.0, f64::abs));
        }
        Value::Array(values) => values.iter().for_each(|value| add_scales(value, field, scales)),
        Value::Object(fields) => {
            fields.iter().for_each(|(field, value)| add_scales(value, field, scales));
        }
        _ => (),
    }
}

fn is_near(a: &Value, b: &Value, field: &str, scales: &FieldScales<'_>) -> bool {
    match (a, b) {
        (Value::Number(x), Value::Number(y)) => match (x.as_f64(), y.as_f64()) {
            (Some(x), Some(y)) => {
                let rounding = ROUNDING * scales.get(field).copied().unwrap_or(0.0);
                (x - y).abs() <= larger(TOLERANCE * larger(x.abs(), y.abs()), rounding)
            }
            _ => x == y,
        },
        (Value::Array(a), Value::Array(b)) => {
            a.len() == b.len() && a.iter().zip(b).all(|(a, b)| is_near(a, b, field, scales))
        }
        (Value::Object(a), Value::Object(b)) => {
            let is_there = |(key, value): (&String, &Value)| {
                b.get(key).is_some_and(|other| is_near(value, other, key, scales))
            };
            a.len() == b.len() && a.iter().all(is_there)
        }
        _ => a == b,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::Vec2;
    use crate::system::ParticleDefinition;

    fn pair(place: Vec2, mass: f64, (length, unit): (f64, f64)) -> Scene {
        let mut scene = Scene::new("pair");
        for (name, at, mass) in [("a", Vec2::new(0.0, 3.0), 1.0), ("b", place, mass)] {
            let bead = ParticleDefinition { name: name.into(), position: at * length };
            scene.add_particle(bead, mass * unit).unwrap();
        }
        scene
    }

    #[test]
    fn similarity_of_scenes_does_not_depend_on_units() {
        let (place, rounded) = (Vec2::new(1.0, 0.0), Vec2::new(1.0 + 1e-12, 2e-16));
        for units in [(1.0, 1.0), (1e-9, 1e-15), (1e9, 1e15)] {
            let scene = pair(place, 2.0, units);
            assert!(scene.is_like(&pair(rounded, 2.0 + 1e-12, units)), "{units:?}");
            assert!(!scene.is_like(&pair(Vec2::new(1.001, 0.0), 2.0, units)), "{units:?}");
            assert!(!scene.is_like(&pair(Vec2::new(1.0, 1e-3), 2.0, units)), "{units:?}");
            assert!(!scene.is_like(&pair(place, 2.001, units)), "{units:?}");
        }
    }
}
