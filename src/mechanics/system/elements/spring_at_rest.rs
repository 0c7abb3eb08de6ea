//! Static stiffness of springs.

use super::elongation::Elongation;
use super::spring_law::SpringLaw;
use crate::beams::SpanStiffness;
use crate::system::bodies::Body;

/// Degrees of freedom and static stiffness of a spring.
pub fn static_law(
    law: &SpringLaw,
    elongation: &Elongation,
    bodies: &[Body],
) -> (Vec<usize>, SpanStiffness) {
    let mut elongation = elongation.clone();
    elongation.evaluate_at_start(bodies);
    let (value, mut degrees) = (elongation.grown(), Vec::new());
    let by_degree = |row: &[f64]| {
        let shares = elongation.shares().iter();
        shares.map(|of| (of.degree, of.share * row[of.coordinate])).collect::<Vec<_>>()
    };
    degrees.extend(by_degree(&elongation.slope).into_iter().map(|(degree, _)| degree));
    degrees.sort_unstable();
    degrees.dedup();
    let dense = |row: &[f64]| {
        let mut dense = vec![0.0; degrees.len()];
        for (degree, value) in by_degree(row) {
            if let Ok(at) = degrees.binary_search(&degree) {
                dense[at] += value;
            }
        }
        dense
    };
    let mut rows = SpanStiffness::default();
    let stiffness = law.slope(value);
    if stiffness != 0.0 {
        rows.strains.extend(dense(&elongation.slope));
        rows.stiffness.push(stiffness);
    }
    let force = law.force(value);
    for (length, row) in elongation.turned() {
        let normal = dense(&row);
        if stiffness != 0.0 {
            let half: Vec<f64> = normal.iter().map(|n| 0.5 / length * n).collect();
            rows.add_second_derivative(0, &half, &normal);
        }
        rows.twists.extend(normal.iter().map(|n| 0.5 * force / length * n));
        rows.twists.extend(normal);
        rows.rounding_fractions.push(0.0);
    }
    (degrees, rows)
}
