//! Derivatives of the increments on which an elongation depends, with respect to the degrees of freedom.
//! The derivatives are the basis functions at the end points of the spring.

use super::{Elongation, ElongationEnd};
use crate::linalg::BandRows;
use crate::system::bodies::Body;

#[derive(Debug, Clone, Copy)]
pub struct CoordinateShare {
    pub degree: usize,
    pub coordinate: usize,
    pub share: f64,
}

impl Elongation {
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

    pub(super) fn gather(&mut self, values: &[f64]) {
        combine(&self.shares, values, &mut self.movements);
    }

    pub fn along(&mut self, slope: &[f64], correction: &[f64]) -> f64 {
        let Self { shares, corrected, .. } = self;
        combine(shares, correction, corrected);
        slope.iter().zip(corrected).fold(0.0, |sum, (slope, by)| sum + slope * *by)
    }

    pub fn shares(&self) -> &[CoordinateShare] {
        &self.shares
    }

    pub fn scatter(&self, direction: &[f64], force: f64, out: &mut [f64]) {
        for CoordinateShare { degree, coordinate, share } in &self.shares {
            out[*degree] += share * direction[*coordinate] * force;
        }
    }

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

fn combine(shares: &[CoordinateShare], values: &[f64], coordinates: &mut [f64]) {
    coordinates.fill(0.0);
    for CoordinateShare { degree, coordinate, share } in shares {
        coordinates[*coordinate] += share * values.get(*degree).copied().unwrap_or(0.0);
    }
}
