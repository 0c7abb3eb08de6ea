//! Summaries of curves, knots, meshes and vectors.

use super::entries::{line, number, numbers, pair};
use crate::beams::{Mesh, PointCounts};
use crate::elementary::atan2;
use crate::geometry::{Basis, Curve, KnotVector, Vec2};
use crate::script::bindings::kind::Details;

pub fn of_vector(vector: &Vec2) -> Details {
    let angle = atan2(vector.y, vector.x);
    let angle = format!("{} rad = {}°", number(angle), number(angle.to_degrees()));
    vec![line("norm", number(vector.norm())), line("angle", angle)]
}

pub fn of_curve(curve: &Curve) -> Details {
    let (start, end) = curve.domain();
    let ends = |of: &dyn Fn(f64) -> Option<String>| Some(format!("{} … {}", of(start)?, of(end)?));
    let lines = [
        Some(line("length", number(curve.length()))),
        ends(&|xi| curve.point(xi).ok().map(pair)).map(|ends| line("ends", ends)),
        ends(&|xi| curve.tangent_angle(xi).ok().map(number)).map(|ends| line("angles [rad]", ends)),
        ends(&|xi| curve.curvature(xi).ok().map(number)).map(|ends| line("curvatures", ends)),
        Some(line("parameter", format!("{} … {}", number(start), number(end)))),
    ];
    let points = match curve {
        Curve::Spline(spline) => {
            Some(line("control points", spline.control_points().len().to_string()))
        }
        _ => None,
    };
    lines.into_iter().chain([points]).flatten().collect()
}

pub fn of_knots(knots: &KnotVector) -> Details {
    let (start, end) = knots.domain();
    let inner = Basis::BSpline(knots.clone()).continuity();
    let spans = knots.spans().len();
    let smooth = if spans > 1 { format!(", C{inner} where they meet") } else { String::new() };
    vec![
        line("degree", knots.degree().to_string()),
        line("spans", format!("{spans}{smooth}")),
        line("functions", knots.functions().to_string()),
        line("domain", format!("{} … {}", number(start), number(end))),
        line("breaks", numbers(&knots.breaks())),
    ]
}

pub fn of_mesh(mesh: &Mesh) -> Details {
    let PointCounts { force, moment, inertia } = mesh.point_counts();
    vec![
        line("functions", format!("{}, so many control points", mesh.basis().functions())),
        line("axial, shear", format!("{force} quadrature points")),
        line("bending", format!("{moment} quadrature points")),
        line("mass", format!("{inertia} quadrature points, once")),
    ]
}
