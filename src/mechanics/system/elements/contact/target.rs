//! Bodies in contact, and the contact points of beams.

use serde::{Deserialize, Serialize};

use crate::beams::{Mesh, Station};
use crate::geometry::Vec2;
use crate::system::elements::element::SceneChecks;

/// First three of the four points of a Gauss–Lobatto rule on `[-1, 1]`, with their weights (Abramowitz & Stegun 25.4.32).
/// A Gauss–Lobatto rule has points at both ends, so that the ends of a beam are contact points.
const LOBATTO: [(f64, f64); 3] = [
    (-1.0, 1.0 / 6.0),
    (-0.447_213_595_499_957_9, 5.0 / 6.0),
    (0.447_213_595_499_957_9, 5.0 / 6.0),
];

const LAST: f64 = 1.0 / 6.0;

/// Body, or point of a body, in contact.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub enum ContactTarget {
    /// A beam along its whole length, by its index.
    Beam(usize),
    /// A particle, or a station of a beam or a rigid body.
    Point(Station),
}

impl ContactTarget {
    /// Type and name of the body or point for messages.
    pub fn describe(&self, scene: &dyn SceneChecks) -> String {
        let described = scene.describe(&self.station());
        match self {
            Self::Beam(_) => described.trim_start_matches("the start of ").to_owned(),
            Self::Point(_) => described,
        }
    }

    /// Station of the body or point; for a beam, the station at its start.
    pub fn station(&self) -> Station {
        match self {
            Self::Beam(beam) => Station::on_beam(*beam, 0.0),
            Self::Point(station) => *station,
        }
    }
}

/// Parameters and quadrature weights [length] of the contact points of a beam.
pub fn contact_parameters(mesh: &Mesh, controls: &[Vec2]) -> Vec<(f64, f64)> {
    let basis = mesh.basis();
    let (mut points, mut at_end) = (Vec::new(), 0.0);
    let spans = basis.spans();
    for span in &spans {
        let (middle, half) = (0.5 * (span.start + span.end), 0.5 * (span.end - span.start));
        let speed = |xi: f64| basis.evaluate_in(span, xi).combine(1, controls).norm();
        for (at, (x, weight)) in LOBATTO.into_iter().enumerate() {
            let xi = if at == 0 { span.start } else { middle + half * x };
            let before = if at == 0 { at_end } else { 0.0 };
            points.push((xi, before + half * weight * speed(xi)));
        }
        at_end = half * LAST * speed(span.end);
    }
    points.extend(spans.last().map(|last| (last.end, at_end)));
    points
}
