use nalgebra::{DMatrix, DVector};

use super::*;
use crate::beams::Quadrature;
use crate::elementary;
use crate::geometry::{Basis, Curve, KnotVector, interpolate};

fn meshes() -> Vec<Mesh> {
    let mut meshes = Vec::new();
    for degree in 1..=7 {
        for continuity in 0..degree {
            for spans in [1, 2, 3, 7] {
                meshes.push(Mesh::bspline(spans, degree, continuity).unwrap());
            }
            let breaks = [0.0, 0.05, 0.15, 0.2, 0.5, 0.6, 0.9, 1.0];
            let inner = breaks[1..7].iter().flat_map(|xi| vec![*xi; degree - continuity]);
            let ends = |xi: f64| std::iter::repeat_n(xi, degree + 1);
            let knots = ends(0.0).chain(inner).chain(ends(1.0)).collect();
            meshes.push(Mesh::new(Basis::BSpline(KnotVector::new(degree, knots).unwrap())));
        }
        meshes.push(Mesh::bspline(6, degree, degree - 1).unwrap().with_breaks(&[0.4]).unwrap());
    }
    meshes.extend((1..=3).map(|degree| Mesh::lagrange(4, degree).unwrap()));
    meshes
}

fn line() -> Curve {
    Curve::line(Vec2::new(0.0, 0.0), Vec2::new(1.2, 0.9)).unwrap()
}

fn arc() -> Curve {
    Curve::arc(Vec2::new(0.0, 0.0), 1.0, 0.3, 2.2).unwrap()
}

fn dense(mesh: &Mesh, points: &[Vec2], places: &[f64]) -> Vec<f64> {
    let (basis, count) = (mesh.basis(), points.len());
    let mut stiffness = DMatrix::zeros(count, count);
    for quadrature in mesh.quadrature_spans().unwrap() {
        for (xi, weight) in quadrature.force_rule {
            let values = basis.evaluate_in(&quadrature.span, xi);
            let speed = values.combine(1, points).norm();
            for (a, left) in values.slopes().iter().enumerate() {
                for (b, right) in values.slopes().iter().enumerate() {
                    let entry = &mut stiffness[(values.first + a, values.first + b)];
                    *entry += weight / speed * left * right;
                }
            }
        }
    }
    let held = stiffness.remove_row(0).remove_column(0).cholesky().unwrap();
    let answer = |xi: f64| {
        let values = basis.evaluate(xi).unwrap();
        let mut load = DVector::zeros(count);
        values.values().iter().enumerate().for_each(|(a, value)| load[values.first + a] = *value);
        let load = load.remove_row(0);
        (held.solve(&load), load)
    };
    let at = |xi: &f64| {
        let (moved, load) = answer(*xi);
        moved[count - 2] - moved.dot(&load)
    };
    places.iter().map(at).collect()
}

fn places() -> Vec<f64> {
    (0..=80).map(|k| f64::from(k) / 80.0).collect()
}

fn value(mesh: &Mesh, kink: &PiecewisePolynomial, xi: f64) -> f64 {
    let spans = mesh.basis().spans();
    let span = spans.partition_point(|span| span.end < xi).min(spans.len() - 1);
    kink.in_span(span, xi)[0]
}

#[test]
fn kink_length_agrees_with_dense_algebra_on_every_mesh() {
    for axis in [line(), arc()] {
        for mesh in meshes() {
            let points = interpolate(&axis, mesh.basis()).unwrap();
            let kink = unresolved_kink(&mesh, &points).unwrap().expect("it is positive").length;
            for (xi, expected) in places().iter().zip(dense(&mesh, &points, &places())) {
                let found = value(&mesh, &kink, *xi);
                assert!(
                    (found - expected).abs() < 3e-12,
                    "{}: {found} {expected}",
                    mesh.describe()
                );
            }
        }
    }
}

#[test]
fn kink_length_of_a_straight_beam_is_its_missed_compliance() {
    for mesh in meshes().into_iter().filter(|mesh| mesh.basis().functions() > 2) {
        let (basis, length) = (mesh.basis(), line().length());
        let points = interpolate(&line(), basis).unwrap();
        let kink = unresolved_kink(&mesh, &points).unwrap().unwrap().length;
        let count = points.len();
        let mut stiffness = DMatrix::zeros(count, count);
        for quadrature in mesh.quadrature_spans().unwrap() {
            for (xi, weight) in quadrature.force_rule {
                let values = basis.evaluate_in(&quadrature.span, xi);
                let mut slopes = DVector::zeros(count);
                slopes
                    .rows_mut(values.first, values.slopes().len())
                    .copy_from_slice(values.slopes());
                stiffness += &slopes * slopes.transpose() * (weight / length);
            }
        }
        let inner = stiffness.view((1, 1), (count - 2, count - 2)).into_owned().cholesky().unwrap();
        for xi in places() {
            let values = basis.evaluate(xi).unwrap();
            let mut load = DVector::zeros(count);
            load.rows_mut(values.first, values.values().len()).copy_from_slice(values.values());
            let load = load.rows(1, count - 2).into_owned();
            let expected = length * xi * (1.0 - xi) - inner.solve(&load).dot(&load);
            let found = value(&mesh, &kink, xi);
            assert!((found - expected).abs() < 3e-12, "{}: {found} {expected}", mesh.describe());
        }
    }
}

#[test]
fn kink_length_is_positive_except_at_kinks_of_the_mesh() {
    for mesh in meshes() {
        let points = interpolate(&line(), mesh.basis()).unwrap();
        let kink = unresolved_kink(&mesh, &points).unwrap().unwrap().length;
        let spans = mesh.basis().spans();
        for (at, span) in spans.iter().enumerate() {
            let width = span.end - span.start;
            for k in 1..40 {
                let xi = span.start + width * f64::from(k) / 40.0;
                let relative = kink.in_span(at, xi)[0] / (width * line().length());
                assert!(relative > 1e-3 && relative < 0.6, "{}: {relative}", mesh.describe());
            }
            for (xi, is_node) in [
                (span.start, at == 0 || !mesh.is_smooth(&spans[at - 1], span)),
                (span.end, at + 1 == spans.len() || !mesh.is_smooth(span, &spans[at + 1])),
            ] {
                let length = kink.in_span(at, xi)[0];
                assert!(if is_node { length.abs() < 1e-12 } else { length > 1e-3 * width });
            }
        }
    }
}

#[test]
fn kink_length_inside_long_cubic_meshes_has_known_values() {
    for spans in [40, 4000] {
        let mesh = Mesh::bspline(spans, 3, 2).unwrap();
        let points = interpolate(&line(), mesh.basis()).unwrap();
        let kink = unresolved_kink(&mesh, &points).unwrap().unwrap().length;
        let (n, span) = (spans as f64, spans / 2);
        let part = |xi: f64| kink.in_span(span, xi / n)[0] * n / line().length();
        let (knot, middle) = (part(span as f64), part(span as f64 + 0.5));
        assert!(
            (knot - 0.10803).abs() < 1e-5 && (middle - 0.14563).abs() < 1e-5,
            "{knot} {middle}"
        );
    }
}

#[test]
fn mesh_with_too_few_quadrature_points_has_no_unresolved_kink() {
    let mesh = Mesh::bspline(4, 3, 1).unwrap().with_quadrature(Quadrature::Points(2)).unwrap();
    let points = interpolate(&line(), mesh.basis()).unwrap();
    assert!(unresolved_kink(&mesh, &points).unwrap().is_none());
}

fn fourier(degree: usize, is_exact: bool) -> f64 {
    let (tau, order) = (2.0 * std::f64::consts::PI, degree as i32 + 1);
    let hat = |k: f64| (elementary::sin(0.5 * k) / (0.5 * k)).powi(order);
    let (mut rest, mut motion, dk) = (0.0, 0.0, 2e-3);
    for step in 0..60_000 {
        let k = dk * (f64::from(step) + 0.5);
        let aliases = || (-20..=20).map(|m| (m, k + tau * f64::from(m)));
        let mass: f64 = aliases().map(|(_, q)| hat(q) * hat(q)).sum();
        let stiffness = if is_exact {
            aliases().map(|(_, q)| (q * hat(q)) * (q * hat(q))).sum()
        } else {
            let sum: f64 =
                aliases().map(|(m, q)| if m % 2 == 0 { q * hat(q) } else { -q * hat(q) }).sum();
            sum * sum
        };
        let own = hat(k) * hat(k);
        rest += dk * (1.0 / (k * k) - own / stiffness);
        motion += dk * (1.0 / (k * k) - own * k * k * mass / (stiffness * stiffness));
    }
    let beyond = 1.0 / (dk * 60_000.0);
    (motion + beyond) / (rest + beyond)
}

#[test]
fn kink_inertia_agrees_with_fourier_analysis() {
    for degree in 2..=6 {
        let mesh = Mesh::bspline(400, degree, degree - 1).unwrap();
        let points = interpolate(&line(), mesh.basis()).unwrap();
        let found = unresolved_kink(&mesh, &points).unwrap().unwrap().inertia;
        let rounding = if degree == 2 { 4e-3 } else { 2e-4 };
        assert!((found - fourier(degree, false)).abs() < rounding, "{degree}: {found}");
        let exact = mesh.with_quadrature(Quadrature::Points(degree + 1)).unwrap();
        let found = unresolved_kink(&exact, &points).unwrap().unwrap().inertia;
        let expected = fourier(degree, true);
        assert!((expected - 1.0).abs() < 1e-4 && (found - 1.0).abs() < 1e-4, "{degree}: {found}");
    }
    for mesh in meshes() {
        let points = interpolate(&arc(), mesh.basis()).unwrap();
        let found = unresolved_kink(&mesh, &points).unwrap().unwrap().inertia;
        println!("{} {found:.4}", mesh.describe());
        assert!(found > 0.5 && found < 2.0, "{}: {found}", mesh.describe());
    }
}
