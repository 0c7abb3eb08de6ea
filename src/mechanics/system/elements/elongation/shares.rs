//! Where the coordinates of an elongation stand among the degrees of freedom, by the functions at its terminals.

use super::{Elongation, ElongationEnd};
use crate::linalg::BandRows;
use crate::system::bodies::Body;

/// The part that a degree of freedom has in a coordinate: the value of its function at the terminal [-].
#[derive(Debug, Clone, Copy)]
pub struct CoordinateShare {
    pub degree: usize,
    pub coordinate: usize,
    pub share: f64,
}

impl Elongation {
    /// Finds where the coordinates stand, as the movements of the bodies are numbered.
    pub(super) fn locate(&mut self, bodies: &[Body]) {
        let components = self.components();
        let Self { terminals, shares, .. } = self;
        shares.clear();
        for (at, terminal) in terminals.iter().enumerate() {
            let ElongationEnd::Moving(place) = terminal else { continue };
            for (point, share) in place.weights() {
                let degrees = &bodies[place.body].degrees_of_freedom[point][components.clone()];
                let first = at * components.len();
                let own = (first..).zip(degrees);
                shares.extend(own.map(|(coordinate, &degree)| CoordinateShare {
                    degree,
                    coordinate,
                    share,
                }));
            }
        }
    }

    /// Takes the movements of the terminals from values of the unknowns; what is no unknown does not move.
    pub(super) fn gather(&mut self, values: &[f64]) {
        combine(&self.shares, values, &mut self.moved);
    }

    /// The product of a slope and a correction of the increments: a change of `q`, to first order [length, rad].
    pub fn along(&mut self, slope: &[f64], correction: &[f64]) -> f64 {
        let Self { shares, corrected, .. } = self;
        combine(shares, correction, corrected);
        slope.iter().zip(corrected).fold(0.0, |sum, (slope, by)| sum + slope * *by)
    }

    /// The parts of the degrees of freedom in the coordinates, where they were located last.
    pub fn shares(&self) -> &[CoordinateShare] {
        &self.shares
    }

    /// Adds a force along some direction of the coordinates.
    pub fn scatter(&self, direction: &[f64], force: f64, out: &mut [f64]) {
        for CoordinateShare { degree, coordinate, share } in &self.shares {
            out[*degree] += share * direction[*coordinate] * force;
        }
    }

    /// Adds the derivative of a force by the coordinates, row by row, as far as they belong to unknowns.
    pub fn scatter_tangent(&self, derivative: &[f64], unknowns: usize, rows: &mut BandRows<'_>) {
        let known = || self.shares.iter().filter(|share| share.degree < unknowns);
        let width = self.secant.len();
        for to in known() {
            let derivative = &derivative[to.coordinate * width..][..width];
            let mut row = rows.row(to.degree);
            for from in known() {
                row.add(from.degree, to.share * from.share * derivative[from.coordinate]);
            }
        }
    }
}

/// The coordinates that belong to values of the unknowns, none to what is no unknown.
fn combine(shares: &[CoordinateShare], values: &[f64], coordinates: &mut [f64]) {
    coordinates.fill(0.0);
    for CoordinateShare { degree, coordinate, share } in shares {
        coordinates[*coordinate] += share * values.get(*degree).copied().unwrap_or(0.0);
    }
}
