//! Response of beams to an impulse, with only selected deformations (docs/theory.md, section 10.2).
//!
//! The impulses of section forces are separate unknowns. The impulses of a section force on the control points of its beam have the sum zero.
//! Therefore the rounding errors of section forces do not affect the momenta.
//! Springs and dampers are ignored: their forces are bounded, so their impulse during an impact is zero.

use super::System;
use crate::beams::StrainKind;
use crate::elementary::square;
use crate::geometry::larger;
use crate::integrators::{Inertia, Mechanism};
use crate::linalg::{BandedLu, BandedMatrix};

/// Deformations are suppressed by a term that is added to the inertia matrix: their stiffness times the square of a time.
/// `MOST` is the largest ratio of the added term to the inertia of a degree of freedom [-].
const MOST: f64 = 1e10;

const CORRECTIONS: usize = 4;

/// Largest number of iterations in which the suppressed strains are reduced to zero.
const MOST_CORRECTIONS: usize = 60;

/// Largest energy of the suppressed strains that counts as zero, as a fraction of the energy of the impulse [-].
const NO_STRAIN: f64 = 1e-20;

#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum Deformation {
    All,
    /// All deformations except vibrations with periods much shorter than the given time [time].
    Resolved(f64),
    /// All deformations without axial strain, except vibrations with periods much shorter than the given time [time].
    Inextensible(f64),
}

struct StrainResistance {
    degrees: Vec<usize>,
    strain: Vec<f64>,
    weight: f64,
    is_rigid: bool,
}

impl StrainResistance {
    fn by(&self, movements: &[f64]) -> f64 {
        let of = |(at, by): (&usize, &f64)| movements.get(*at).copied().unwrap_or(0.0) * by;
        self.degrees.iter().zip(&self.strain).map(of).sum()
    }
}

pub(super) struct Rigidity {
    resistances: Vec<StrainResistance>,
}

impl Rigidity {
    pub(super) fn of(model: &System, deformation: Deformation) -> Self {
        let (length, rigid) = match deformation {
            Deformation::All => (0.0, None),
            Deformation::Resolved(length) => (length, None),
            Deformation::Inextensible(length) => (length, Some(StrainKind::Axial)),
        };
        let mut resistances = Vec::new();
        for_each_stiff_strain(model, |degrees, row, weight, kind| {
            let (degrees, strain) = (degrees.to_vec(), row.to_vec());
            resistances.push(StrainResistance {
                degrees,
                strain,
                weight,
                is_rigid: rigid == Some(kind),
            });
        });
        let inertia = model.diagonal_of_inertia();
        let most = MOST / fastest(&inertia, resistances.iter());
        let most_rigid = MOST / fastest(&inertia, resistances.iter().filter(|one| one.is_rigid));
        let square = most.min(0.25 * square(length));
        for one in &mut resistances {
            one.weight *= if one.is_rigid { most_rigid } else { square };
        }
        Self { resistances }
    }

    pub(super) fn matrix(&self, model: &System) -> BandedMatrix {
        let mut matrix = model.banded_inertia();
        let size = matrix.size();
        for StrainResistance { degrees, strain, weight, .. } in &self.resistances {
            let entries = || degrees.iter().zip(strain).filter(|(at, _)| **at < size);
            for (&i, a) in entries() {
                let factor = weight * a;
                entries().for_each(|(&j, b)| matrix.add(i, j, factor * b));
            }
        }
        matrix.weigh_rows();
        matrix
    }

    pub(super) fn transmit_unit_impulse(
        &self,
        model: &mut System,
        factors: &BandedLu<'_>,
        impulse: &mut [f64],
    ) -> Vec<f64> {
        let movements = model.unknowns();
        let (mut passed, mut rates) = (vec![0.0; self.resistances.len()], vec![0.0; movements]);
        let mut missing = passed.clone();
        for correction in 1..=MOST_CORRECTIONS {
            let mut left: Vec<f64> = impulse.iter().map(|force| -force).collect();
            model.add_inertia(1.0, &rates, &mut left);
            model.links.transmit(&model.bodies, &rates, &mut left);
            self.add_transmitted(&passed, 1.0, &mut left);
            self.add_transmitted(&missing, 1.0, &mut left);
            left.iter_mut().for_each(|force| *force = -*force);
            model.links.set_velocity_violation(&model.bodies, &rates, -1.0, &mut left);
            let change = &mut left[..movements];
            factors.solve(change);
            rates.iter_mut().zip(&*change).for_each(|(rate, change)| *rate += change);
            let mut strained = 0.0;
            let multipliers = passed.iter_mut().zip(&mut missing);
            for ((passed, missing), resistance) in multipliers.zip(&self.resistances) {
                *passed += *missing + resistance.weight * resistance.by(change);
                if resistance.is_rigid {
                    let strain = resistance.by(&rates);
                    *missing = resistance.weight * strain;
                    strained += *missing * strain;
                }
            }
            let all: f64 = rates.iter().zip(&*impulse).map(|(rate, force)| rate * force).sum();
            if correction >= CORRECTIONS && strained <= NO_STRAIN * all.abs() {
                break;
            }
        }
        self.add_transmitted(&passed, -1.0, impulse);
        passed
    }

    fn add_transmitted(&self, passed: &[f64], factor: f64, out: &mut [f64]) {
        for (passed, StrainResistance { degrees, strain, .. }) in
            passed.iter().zip(&self.resistances)
        {
            let passed = factor * passed;
            degrees.iter().zip(strain).for_each(|(at, by)| out[*at] += by * passed);
        }
    }
}

fn fastest<'r>(inertia: &[f64], resistances: impl Iterator<Item = &'r StrainResistance>) -> f64 {
    let mut resistance = vec![0.0; inertia.len()];
    for StrainResistance { degrees, strain, weight, .. } in resistances {
        for (&at, by) in degrees.iter().zip(strain).filter(|(at, _)| **at < inertia.len()) {
            resistance[at] += weight * square(*by);
        }
    }
    let with_inertia = resistance.iter().zip(inertia).filter(|(_, inertia)| **inertia > 0.0);
    with_inertia.map(|(k, m)| k / m).fold(0.0, larger)
}

fn for_each_stiff_strain(model: &System, mut take: impl FnMut(&[usize], &[f64], f64, StrainKind)) {
    model.each_span_of_bodies(&mut |degrees, span| {
        let rows = span.stiffness.iter().zip(&span.kinds).zip(span.strains.chunks(degrees.len()));
        let resisting = rows.filter(|((stiffness, _), _)| **stiffness > 0.0);
        resisting.for_each(|((stiffness, kind), row)| take(degrees, row, *stiffness, *kind));
    });
}

pub(super) fn add_transmitted_impulses(model: &System, passed: &[f64], out: &mut [f64]) {
    let mut passed = passed.iter();
    for_each_stiff_strain(model, |degrees, row, _, _| {
        if let Some(passed) = passed.next() {
            degrees.iter().zip(row).for_each(|(at, by)| out[*at] += by * passed);
        }
    });
}
