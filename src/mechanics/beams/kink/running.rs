//! Factor of the kinetic energy of a moving kink, because the mesh represents this energy only approximately.

use super::SplineString;
use crate::beams::Mesh;
use crate::geometry::{GaussRule, PiecewisePolynomial, Span, Vec2, lower_splines};

/// Largest number of spans over which the factor [`inertia`](SplineString::inertia) of the kinetic energy of a moving kink is averaged.
const SAMPLES: usize = 16;

impl SplineString {
    /// Factor of the kinetic energy of a moving kink, a jump of the tangent of the axis [-].
    /// The factor accounts for kinetic energy that the mesh does not represent (docs/theory.md, section 10.1).
    pub fn inertia(
        &self,
        mesh: &Mesh,
        control_points: &[Vec2],
        length: &PiecewisePolynomial,
    ) -> f64 {
        let Ok(rule) = GaussRule::new(self.degree + 1) else { return 1.0 };
        let (basis, spans) = (mesh.basis(), mesh.basis().spans());
        let samples = SAMPLES.min(spans.len());
        let (mut missed, mut lengths) = (0.0, 0.0);
        for sample in 0..samples {
            let at = (2 * sample + 1) * spans.len() / (2 * samples);
            let span = &spans[at];
            for (xi, weight) in rule.iter_on(span.start, span.end) {
                let values = basis.evaluate_in(span, xi);
                let weight = weight * values.combine(1, control_points).norm();
                let motion = self.motion(span, &lower_splines(&values).collect::<Vec<f64>>());
                let squares: f64 = (spans.iter().enumerate())
                    .map(|(other, around)| {
                        let fields = rule.iter_on(around.start, around.end).map(|(x, weight)| {
                            let values = basis.evaluate_in(around, x);
                            let own = values.values().iter().enumerate();
                            // `there` is the velocity of the mesh. `missing` is `1 - there`, where 1 is the exact velocity beyond the kink.
                            // Before the kink, the exact velocity is zero. `square` is the squared exact velocity minus the squared mesh velocity.
                            let (there, missing) =
                                own.fold((0.0, 0.0), |(there, missing), (a, n)| {
                                    let [low, high] = motion[around.first + a];
                                    (there + n * low, missing + n * high)
                                });
                            let square =
                                if other > at { missing * (1.0 + there) } else { -there * there };
                            weight * values.combine(1, control_points).norm() * square
                        });
                        fields.sum::<f64>()
                    })
                    .sum();
                let rest: f64 = (rule.iter_on(xi, span.end))
                    .map(|(x, weight)| {
                        weight * basis.evaluate_in(span, x).combine(1, control_points).norm()
                    })
                    .sum();
                missed += weight * (rest + squares);
                lengths += weight * length.in_span(at, xi)[0];
            }
        }
        missed / lengths
    }

    fn motion(&self, span: &Span, lower: &[f64]) -> Vec<[f64; 2]> {
        let mut strains = vec![0.0; self.stretched.len()];
        strains[span.first..][..lower.len()].copy_from_slice(lower);
        self.factors.solve(&mut strains);
        let end: f64 = strains.iter().sum();
        let mut motion = vec![[0.0; 2]; strains.len() + 1];
        for (at, strain) in strains.iter().enumerate() {
            motion[at + 1][0] = motion[at][0] + strain / end;
        }
        for (at, strain) in strains.iter().enumerate().rev() {
            motion[at][1] = motion[at + 1][1] + strain / end;
        }
        motion
    }
}
