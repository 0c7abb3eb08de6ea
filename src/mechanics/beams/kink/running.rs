//! Kinetic energy of a moving kink that a mesh does not represent.

use super::SplineString;
use crate::beams::Mesh;
use crate::geometry::{GaussRule, PiecewisePolynomial, Span, Vec2, lower_splines};

/// Largest number of spans over which the correction factor is averaged.
const SAMPLES: usize = 16;

impl SplineString {
    /// Correction factor `μ` of the inertia of a moving kink.
    /// The kinetic energy that the mesh misses is `½ μ ρA g |a|² v²` for a kink `a` that moves with the speed `v`.
    /// The factor is averaged over positions `ξ` of the kink in evenly spread spans.
    ///
    /// ```text
    /// correction factor:  μ = ∫ (L - s(ξ) - ∫ u² dX) ds/∫ g ds
    /// velocity ratio:     u = l(X)ᵀ M⁻¹ t(ξ)/|x_ξ|
    /// ```
    ///
    /// The length of the string is `L`, the arc length at the kink `s(ξ)`, and the derivative `ds/dξ` is `|x_ξ|`.
    /// The kink length `g`, the splines `t`, their integrals `l` and the matrix `M` are defined at [`unresolved_kink`](super::unresolved_kink).
    ///
    /// Consider a string whose start is held. The points in front of a moving unit kink have the velocity `v`, and the points behind it are at rest.
    /// On the mesh, the point at the arc length `X` has the velocity `u v` instead, where `u` is a function of `X` and `ξ`.
    /// Away from the kink `u` is exact, so only the spans around the kink contribute to the difference of the energies.
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
                            // In front of the kink, the mesh lacks a part of the motion. Behind the kink, the mesh has additional motion.
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

    /// Motion of the control points for a kink at a given position in a span, relative to the motion of the end of the string.
    /// The argument `lower` contains the values of the splines of lower degree at this position.
    /// The second value of each pair is the difference between the motion of the control point and the motion of the end.
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
