//! The deformations that take part in an impact: how much of an impulse the section forces of beams pass on.
//!
//! An impulse `Gᵀ` on beams whose fast vibrations do not take part is answered by
//!
//! ```text
//! M a + Bᵀ n = Gᵀ        B a = n/(s C)        f = Gᵀ - Bᵀ n        a = M⁻¹ f
//! ```
//!
//! with `s = h²/4` for strains that steps of a length `h` follow, and `1/s = 0` for strains that do not occur at all. `f` is the impulse with
//! what section forces pass on. These are unknowns of their own: what they take from one place they give to another whatever rounding makes
//! of them, so that momenta are kept. Springs and dampers have no part of it: their forces are bounded, and their impulse in an instant is
//! zero.

use super::System;
use crate::beams::StrainKind;
use crate::elementary::square;
use crate::geometry::larger;
use crate::integrators::{Inertia, Mechanism};
use crate::linalg::{BandedLu, BandedMatrix};

/// The largest stiffness beside the inertia: what vibrates so much faster than steps are is rigid to five digits and more.
const MOST: f64 = 1e10;

/// How often a solution is corrected at least: each time its error falls by `MOST` rounding units.
const CORRECTIONS: usize = 4;

/// How often a solution is corrected at most, until strains that do not occur are zero.
const MOST_CORRECTIONS: usize = 60;

/// Strains that do not occur are zero where their part of the energy is less than this [-].
const NO_STRAIN: f64 = 1e-20;

/// The deformations that take part in an impact.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum Deformation {
    /// All of them: only inertia meets the impulse.
    All,
    /// Those that steps of a length follow [time].
    Slow(f64),
    /// Those that steps of a length follow [time], of beams that do not stretch.
    Inextensible(f64),
}

/// A strain, and how it resists.
struct StrainResistance {
    /// The degrees of freedom that strain.
    degrees: Vec<usize>,
    /// The strain by movements of these.
    strain: Vec<f64>,
    /// Its stiffness, times what it stands for and `s`, or, where it does not occur, what weighs it.
    weight: f64,
    is_rigid: bool,
}

impl StrainResistance {
    fn by(&self, movements: &[f64]) -> f64 {
        let of = |(at, by): (&usize, &f64)| movements.get(*at).copied().unwrap_or(0.0) * by;
        self.degrees.iter().zip(&self.strain).map(of).sum()
    }
}

/// How the present configuration answers to impulses with some deformations.
pub(super) struct Rigidity {
    resistances: Vec<StrainResistance>,
}

impl Rigidity {
    /// The rigidity of a model in an impact with such deformations.
    pub(super) fn of(model: &System, deformation: Deformation) -> Self {
        let (length, rigid) = match deformation {
            Deformation::All => (0.0, None),
            Deformation::Slow(length) => (length, None),
            Deformation::Inextensible(length) => (length, Some(StrainKind::Axial)),
        };
        let mut resistances = Vec::new();
        each_resisting(model, |degrees, row, weight, kind| {
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

    /// The inertia of the model with what resists beside it, to be factorised.
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
        matrix
    }

    /// Makes of a unit impulse what acts with all that section forces pass on, by the factors of the [`matrix`](Self::matrix).
    ///
    /// Strains that do not occur are brought to zero by the method of multipliers. Gives the impulses `n` of the section forces.
    pub(super) fn pass_on(
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
            self.add_passed(&passed, 1.0, &mut left);
            self.add_passed(&missing, 1.0, &mut left);
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
        self.add_passed(&passed, -1.0, impulse);
        passed
    }

    /// Adds a multiple of `Bᵀ n`.
    fn add_passed(&self, passed: &[f64], factor: f64, out: &mut [f64]) {
        for (passed, StrainResistance { degrees, strain, .. }) in
            passed.iter().zip(&self.resistances)
        {
            let passed = factor * passed;
            degrees.iter().zip(strain).for_each(|(at, by)| out[*at] += by * passed);
        }
    }
}

/// The largest quotient of what resistances with such weights make of the movement of a degree of freedom, and of its inertia.
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

/// Gives every strain of a beam that is resisted: the degrees of freedom that make it, by how much, its stiffness and its kind.
fn each_resisting(model: &System, mut take: impl FnMut(&[usize], &[f64], f64, StrainKind)) {
    model.each_span_of_bodies(&mut |degrees, span| {
        let rows = span.stiffness.iter().zip(&span.kinds).zip(span.strains.chunks(degrees.len()));
        let resisting = rows.filter(|((stiffness, _), _)| **stiffness > 0.0);
        resisting.for_each(|((stiffness, kind), row)| take(degrees, row, *stiffness, *kind));
    });
}

/// Adds what section forces passed on in a blow, `Bᵀ n`, with the numbers that movements have at present; nothing where nothing was rigid.
pub(super) fn add_passed_on(model: &System, passed: &[f64], out: &mut [f64]) {
    let mut passed = passed.iter();
    each_resisting(model, |degrees, row, _, _| {
        if let Some(passed) = passed.next() {
            degrees.iter().zip(row).for_each(|(at, by)| out[*at] += by * passed);
        }
    });
}
