//! Missed compliance: part of the compliance of a beam under a transverse force and a couple at one point that a mesh does not represent.
//!
//! The missed compliance is the exact compliance of a straight beam minus the compliance of its mesh. Derivation: docs/theory.md, section 14.2.

use crate::beams::{BeamError, StraightBeam};
use crate::geometry::{PiecewisePolynomial, Span, larger};
use crate::linalg::{PreciseBand, SymmetricFactors, SymmetricSparse};

/// Smallest number of points per span at which the compliance is computed. The exact compliance has degree four.
const LEAST_POINTS: usize = 5;

/// Compliance of the axis under a transverse force and a couple at one point that a mesh does not represent, as functions of the position of the point.
#[derive(Debug, Clone)]
pub struct MissedCompliance {
    /// Missed displacement per transverse force [length/force].
    pub transverse: PiecewisePolynomial,
    /// Missed rotation per transverse force, equal to the missed displacement per couple [1/force].
    pub coupling: PiecewisePolynomial,
    /// Missed rotation per couple [1/(force·length)].
    pub rotation: PiecewisePolynomial,
}

impl MissedCompliance {
    /// Computes the compliance under a transverse force and a couple that a mesh does not represent.
    ///
    /// The missed compliance is positive except in small parts of the first and the last span, where reduced quadrature may make a mesh too soft.
    /// The result is `None` if the stiffness is singular or negative values are larger than positive ones: the mesh then has too few quadrature points.
    ///
    /// # Errors
    /// Fails if the mesh has no quadrature, or if the axis has a point without a tangent.
    pub fn of(beam: &StraightBeam<'_>) -> Result<Option<Self>, BeamError> {
        let Some(factors) = hinged_stiffness(beam)? else { return Ok(None) };
        let points = (2 * beam.degree() + 1).max(LEAST_POINTS);
        let mut samples = Vec::new();
        let [transverse, coupling, rotation] =
            PiecewisePolynomial::interpolation(beam.spans(), points, |at, span, xi| {
                let sample = missed(beam, &factors, (at, span), xi);
                samples.push(sample);
                sample
            });
        let extreme = |entry: usize, sign: f64| {
            samples.iter().map(|sample| sign * sample[entry]).fold(0.0, larger)
        };
        if [0, 2].iter().any(|entry| extreme(*entry, -1.0) > extreme(*entry, 1.0)) {
            return Ok(None);
        }
        Ok(Some(Self { transverse, coupling, rotation }))
    }
}

/// Factors of the stiffness of a beam with hinged ends; `None` if the stiffness is singular.
/// The displacements of the first and of the last control point are zero and have no rows.
fn hinged_stiffness(beam: &StraightBeam<'_>) -> Result<Option<SymmetricFactors>, BeamError> {
    let size = 2 * beam.control_points() - 2;
    let mut stiffness = PreciseBand::zeros(size, (2 * beam.degree() + 1).min(size - 1));
    beam.for_each_strain(&mut |first, modulus, row| {
        let unknowns: Vec<usize> = (first..).take(row.len()).map(|at| place(at, size)).collect();
        stiffness.add_square(&unknowns, modulus, row);
    })?;
    Ok(stiffness.factorise(0.0, &SymmetricSparse::new(size, |_| {})).ok())
}

/// Index of an unknown in the stiffness of the hinged beam with `size` unknowns.
/// The displacements of both ends are not unknowns. Their index is `size`, whose entries the matrix ignores.
fn place(unknown: usize, size: usize) -> usize {
    match unknown {
        0 => size,
        _ if unknown == size => size,
        _ if unknown > size => size - 1,
        _ => unknown - 1,
    }
}

/// Missed compliances at a point: displacement per force, rotation per force, and rotation per couple.
fn missed(
    beam: &StraightBeam<'_>,
    factors: &SymmetricFactors,
    (at, span): (usize, &Span),
    xi: f64,
) -> [f64; 3] {
    let size = 2 * beam.control_points() - 2;
    let values = beam.values(span, xi);
    let mut loads = vec![[0.0; 2]; size + 1];
    let mut first = size;
    for (point, value) in (values.first..).zip(values.values()) {
        for component in [0, 1] {
            let place = place(2 * point + component, size);
            loads[place][component] = *value;
            first = first.min(place);
        }
    }
    let mut found = [0.0; 3];
    for row in first..size {
        let (multipliers, inverse_pivot) = factors.column(row);
        let [force, couple] = loads[row];
        for (below, multiplier) in loads[row + 1..size].iter_mut().zip(multipliers) {
            below[0] -= multiplier * force;
            below[1] -= multiplier * couple;
        }
        let products = [force * force, force * couple, couple * couple];
        found.iter_mut().zip(products).for_each(|(sum, product)| *sum += inverse_pivot * product);
    }
    let exact = beam.hinged(at, xi);
    std::array::from_fn(|entry| exact[entry] - found[entry])
}

#[cfg(test)]
mod tests {
    use nalgebra::{DMatrix, DVector};

    use super::*;
    use crate::beams::{Mesh, Section};
    use crate::geometry::{Curve, Vec2, interpolate};

    const LENGTH: f64 = 1.5;

    fn points(mesh: &Mesh) -> Vec<Vec2> {
        let axis = Curve::line(Vec2::new(0.0, 0.0), Vec2::new(1.2, 0.9)).unwrap();
        interpolate(&axis, mesh.basis()).unwrap()
    }

    fn section(shear_stiffness: f64, bending_stiffness: f64) -> Section {
        Section { shear_stiffness, bending_stiffness, ..Section::default() }
    }

    fn values(beam: &StraightBeam<'_>, xi: f64) -> [f64; 3] {
        let found = MissedCompliance::of(beam).unwrap().unwrap();
        let span = beam.spans().partition_point(|span| span.end < xi);
        [&found.transverse, &found.coupling, &found.rotation].map(|of| of.in_span(span, xi)[0])
    }

    /// Exact compliances of a cantilever minus the compliances of its mesh, which are computed with dense matrices.
    fn missed_by_cantilever(beam: &StraightBeam<'_>, section: &Section, xi: f64) -> [f64; 3] {
        let size = 2 * beam.control_points();
        let mut stiffness = DMatrix::zeros(size, size);
        beam.for_each_strain(&mut |first, modulus, row| {
            let row = DVector::from_row_slice(row);
            let mut own = stiffness.view_mut((first, first), (row.len(), row.len()));
            own += &row * row.transpose() * modulus;
        })
        .unwrap();
        let held = stiffness.view((2, 2), (size - 2, size - 2)).into_owned().cholesky().unwrap();
        let span = beam.spans().partition_point(|span| span.end < xi);
        let values = beam.values(&beam.spans()[span], xi);
        let load = |component: usize| {
            let mut load = DVector::zeros(size);
            for (a, value) in values.values().iter().enumerate() {
                load[2 * (values.first + a) + component] = *value;
            }
            load.rows(2, size - 2).into_owned()
        };
        let [force, couple] = [load(0), load(1)];
        let [by_force, by_couple] = [held.solve(&force), held.solve(&couple)];
        let (a, bending) = (xi * LENGTH, section.bending_stiffness);
        let straight = a * a * a / (3.0 * bending) + a / section.shear_stiffness;
        [
            straight - force.dot(&by_force),
            a * a / (2.0 * bending) - couple.dot(&by_force),
            a / bending - couple.dot(&by_couple),
        ]
    }

    #[test]
    fn missed_compliances_do_not_depend_on_the_supports() {
        let section = section(50.0, 0.7);
        for degree in 3..=5 {
            let mesh = Mesh::bspline(24, degree, degree - 1).unwrap();
            let points = points(&mesh);
            let beam = StraightBeam::new(&mesh, &points, &section);
            for xi in [0.02, 0.3, 0.5, 0.52, 0.77] {
                let (found, expected) =
                    (values(&beam, xi), missed_by_cantilever(&beam, &section, xi));
                println!("{degree} {xi}: {found:?} {expected:?}");
                let scales = [found[0], (found[0] * found[2]).sqrt(), found[2]];
                for ((found, expected), scale) in found.iter().zip(expected).zip(scales) {
                    assert!((found - expected).abs() < 2e-3 * scale.abs());
                }
            }
        }
    }

    #[test]
    fn missed_compliances_of_slender_beams_are_free_of_rounding() {
        let mesh = Mesh::bspline(64, 5, 4).unwrap();
        let points = points(&mesh);
        let span = LENGTH / 64.0;
        let [soft, stiff] = [1e4, 1e9].map(|shear_stiffness| {
            let section = section(shear_stiffness, 1.0);
            let found = values(&StraightBeam::new(&mesh, &points, &section), 0.5);
            [found[0] / (span * span * span), found[1] / (span * span), found[2] / span]
        });
        println!("{soft:?} {stiff:?}");
        assert!((stiff[0] - 6.3326e-3).abs() < 1e-6 && stiff[1].abs() < 1e-9);
        assert!((stiff[2] - 8.60947e-2).abs() < 1e-6);
        // A couple causes no force, so shear stiffness has no effect on its rotation.
        assert!((soft[2] - stiff[2]).abs() < 1e-9);
    }
}
