//! Access to a mechanism through its public interface only.

use nalgebra::{DMatrix, DVector};
use withy::geometry::{Vec2, cross, perpendicular};
use withy::integrators::{Forces, Inertia, Interval, Mechanism, Solution, Stage};
use withy::linalg::BandedMatrix;
use withy::system::System;

pub const STEP: Interval = Interval::between(0.3, 0.35);

#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Unknown {
    X(Vec2),
    Y(Vec2),
    Rotation,
}

fn positions(model: &System) -> Vec<Vec2> {
    model.control_points().flatten().copied().collect()
}

/// Advances a model by increments of a stage, with unchanged rates.
pub fn advance(model: &mut System, stage: Stage, increments: &[f64]) {
    model.begin_step(STEP, &Stage::ALL).unwrap();
    let mut residual = vec![0.0; model.degrees_of_freedom()];
    model.add_forces(stage, increments, 1.0, &mut residual);
    let rates = model.rates().to_vec();
    let solution = Solution {
        increments,
        constraints: &[],
        rates: &rates,
        residual: &residual,
        balanced: &[],
    };
    model.advance(&solution);
}

/// Classifies the unknowns by the effect of moving each one alone.
pub fn unknowns(model: &mut System) -> Vec<Unknown> {
    let (state, before) = (model.state(), positions(model));
    let mut increments = vec![0.0; model.unknowns()];
    (0..increments.len())
        .map(|index| {
            increments[index] = 1.0;
            advance(model, Stage::End, &increments);
            increments[index] = 0.0;
            let after = positions(model);
            model.restore(&state);
            let moved = before.iter().zip(&after).find(|(old, new)| (*new - *old).norm() > 0.5);
            match moved {
                None => Unknown::Rotation,
                Some((old, new)) if (new - old).x > 0.5 => Unknown::X(*old),
                Some((old, _)) => Unknown::Y(*old),
            }
        })
        .collect()
}

/// Increments of a rotation about a point and a translation, in the convention of a stage.
pub fn rigid(model: &mut System, stage: Stage, angle: f64, about: Vec2, shift: Vec2) -> Vec<f64> {
    let omega = match stage {
        Stage::Midpoint | Stage::DampedMidpoint(_) => 2.0 * (0.5 * angle).tan(),
        Stage::Start | Stage::End => angle,
    };
    let moved = |point: Vec2| {
        let arm = point - about;
        arm * (angle.cos() - 1.0) + perpendicular(arm) * angle.sin() + shift
    };
    let increment = |unknown| match unknown {
        Unknown::X(point) => moved(point).x,
        Unknown::Y(point) => moved(point).y,
        Unknown::Rotation => omega,
    };
    unknowns(model).into_iter().map(increment).collect()
}

/// Forces of a stage with section forces that are consistent with the increments.
pub fn condensed(model: &mut System, stage: Stage, increments: &[f64]) -> Vec<f64> {
    let mut forces = vec![0.0; model.degrees_of_freedom()];
    let mut tangent = BandedMatrix::zeros(model.unknowns(), model.half_bandwidth());
    model.add_linearised_forces(stage, increments, 1.0, &mut forces, &mut tangent);
    forces
}

/// Makes the section forces consistent with the increments.
pub fn settle(model: &mut System, stage: Stage, increments: &[f64]) {
    condensed(model, stage, increments);
    model.correct_section_forces(&vec![0.0; increments.len()]);
}

pub fn tangent(model: &mut System, stage: Stage, increments: &[f64]) -> DMatrix<f64> {
    let mut forces = vec![0.0; model.degrees_of_freedom()];
    let mut tangent = BandedMatrix::zeros(model.unknowns(), model.half_bandwidth());
    model.add_linearised_forces(stage, increments, 1.0, &mut forces, &mut tangent);
    dense(&tangent)
}

pub fn inertia(model: &System) -> DMatrix<f64> {
    let mut matrix = BandedMatrix::zeros(model.unknowns(), model.half_bandwidth());
    model.add_inertia_tangent(1.0, &mut matrix);
    dense(&matrix)
}

fn dense(matrix: &BandedMatrix) -> DMatrix<f64> {
    DMatrix::from_fn(matrix.size(), matrix.size(), |i, j| matrix.get(i, j))
}

/// Jacobian by central differences of fourth order, `(8 (f(h) - f(-h)) - (f(2h) - f(-2h))) / 12 h`.
pub fn differences(point: &[f64], h: f64, f: &mut dyn FnMut(&[f64]) -> Vec<f64>) -> DMatrix<f64> {
    let columns = (0..point.len()).map(|column| {
        let mut at = |offset: f64| {
            let mut moved = point.to_vec();
            moved[column] += offset;
            DVector::from_vec(f(&moved))
        };
        ((at(h) - at(-h)) * 8.0 - (at(2.0 * h) - at(-2.0 * h))) / (12.0 * h)
    });
    DMatrix::from_columns(&columns.collect::<Vec<_>>())
}

/// Moment of generalised forces about the origin.
pub fn torque(model: &mut System, forces: &[f64]) -> f64 {
    let arm = |(unknown, force): (Unknown, &f64)| match unknown {
        Unknown::X(point) => cross(point, Vec2::new(*force, 0.0)),
        Unknown::Y(point) => cross(point, Vec2::new(0.0, *force)),
        Unknown::Rotation => *force,
    };
    unknowns(model).into_iter().zip(forces).map(arm).sum()
}
