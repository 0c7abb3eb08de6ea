//! What is rigid for a blow: how much of an impulse the elastic forces pass on within a step.
//!
//! A step of length `h` meets strains by the stiffness `h²/4 Bᵀ C B` beside the inertia `M`. What vibrates much faster than steps follow answers to an
//! impulse `Gᵀ` as if it were rigid, what vibrates more slowly as if it were free:
//!
//! ```text
//! (M + h²/4 Bᵀ C B) a = Gᵀ        n = h²/4 C B a        f = Gᵀ - Bᵀ n        a = M⁻¹ f
//! ```
//!
//! `f` is the impulse with what section forces pass on. These are unknowns of their own: what they take from one place they give to another whatever
//! rounding makes of them, so that momenta are kept.

use super::System;
use crate::elementary::square;
use crate::geometry::larger;
use crate::integrators::{Inertia, Mechanism};
use crate::linalg::{BandedLu, BandedMatrix};

/// The largest stiffness beside the inertia: what vibrates so much faster than steps are is rigid to five digits and more.
const MOST: f64 = 1e10;

/// How often a solution is corrected: each time its error falls by `MOST` rounding units.
const CORRECTIONS: usize = 4;

/// A strain, and how it resists.
struct StrainResistance {
    /// The degrees of freedom that strain.
    degrees: Vec<usize>,
    /// The strain by movements of these.
    strain: Vec<f64>,
    /// Its stiffness, times what it stands for.
    stiffness: f64,
}

impl StrainResistance {
    fn by(&self, movements: &[f64]) -> f64 {
        let of = |(at, by): (&usize, &f64)| movements.get(*at).copied().unwrap_or(0.0) * by;
        self.degrees.iter().zip(&self.strain).map(of).sum()
    }
}

/// How the present configuration answers to impulses in steps of some length.
pub(super) struct Rigidity {
    resistances: Vec<StrainResistance>,
    /// `h²/4`, or less where that is as good [time²].
    square: f64,
}

impl Rigidity {
    /// What is rigid for a blow on a model in steps of such a length [time].
    pub(super) fn of(model: &System, dt: f64) -> Self {
        let mut resistances = Vec::new();
        each_resisting(model, |degrees, row, stiffness| {
            let (degrees, strain) = (degrees.to_vec(), row.to_vec());
            resistances.push(StrainResistance { degrees, strain, stiffness });
        });
        let inertia = model.diagonal_of_inertia();
        let mut resistance = vec![0.0; inertia.len()];
        for StrainResistance { degrees, strain, stiffness } in &resistances {
            for (&at, by) in degrees.iter().zip(strain).filter(|(at, _)| **at < inertia.len()) {
                resistance[at] += stiffness * square(*by);
            }
        }
        let with_inertia = resistance.iter().zip(&inertia).filter(|(_, inertia)| **inertia > 0.0);
        let fastest = with_inertia.map(|(k, m)| k / m).fold(0.0, larger);
        let square = 0.25 * square(dt);
        Self { resistances, square: if square * fastest > MOST { MOST / fastest } else { square } }
    }

    /// The inertia of the model with what resists beside it, to be factorised.
    pub(super) fn matrix(&self, model: &System) -> BandedMatrix {
        let mut matrix = model.banded_inertia();
        let size = matrix.size();
        for StrainResistance { degrees, strain, stiffness } in &self.resistances {
            let entries = || degrees.iter().zip(strain).filter(|(at, _)| **at < size);
            for (&i, a) in entries() {
                let factor = self.square * stiffness * a;
                entries().for_each(|(&j, b)| matrix.add(i, j, factor * b));
            }
        }
        matrix
    }

    /// Makes of a unit impulse what acts with all that section forces pass on, by the factors of the [`matrix`](Self::matrix).
    ///
    /// Gives the impulses `n` of the section forces.
    pub(super) fn pass_on(
        &self,
        model: &mut System,
        factors: &BandedLu<'_>,
        impulse: &mut [f64],
    ) -> Vec<f64> {
        let movements = model.unknowns();
        let (mut passed, mut rates) = (vec![0.0; self.resistances.len()], vec![0.0; movements]);
        for _ in 0..CORRECTIONS {
            let mut left: Vec<f64> = impulse.iter().map(|force| -force).collect();
            model.add_inertia(1.0, &rates, &mut left);
            model.links.transmit(&model.bodies, &rates, &mut left);
            self.add_passed(&passed, 1.0, &mut left);
            left.iter_mut().for_each(|force| *force = -*force);
            model.links.set_velocity_violation(&model.bodies, &rates, -1.0, &mut left);
            let change = &mut left[..movements];
            factors.solve(change);
            rates.iter_mut().zip(&*change).for_each(|(rate, change)| *rate += change);
            for (passed, resistance) in passed.iter_mut().zip(&self.resistances) {
                *passed += self.square * resistance.stiffness * resistance.by(change);
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

/// Gives every strain that is resisted: the degrees of freedom that make it, by how much, and its stiffness.
fn each_resisting(model: &System, mut take: impl FnMut(&[usize], &[f64], f64)) {
    model.each_span(&mut |degrees, span| {
        let rows = span.stiffness.iter().zip(span.strains.chunks(degrees.len()));
        let resisting = rows.filter(|(stiffness, _)| **stiffness > 0.0);
        resisting.for_each(|(stiffness, row)| take(degrees, row, *stiffness));
    });
}

/// Adds what section forces passed on in a blow, `Bᵀ n`, with the numbers that movements have at present; nothing where nothing was rigid.
pub(super) fn add_passed_on(model: &System, passed: &[f64], out: &mut [f64]) {
    let mut passed = passed.iter();
    each_resisting(model, |degrees, row, _| {
        if let Some(passed) = passed.next() {
            degrees.iter().zip(row).for_each(|(at, by)| out[*at] += by * passed);
        }
    });
}
