//! Quadrature errors of a mesh for a tapered beam.

use super::{BeamError, Mesh, Section, SectionVariation};
use crate::geometry::{GaussRule, larger};

/// Number of Gauss points between successive knots of the mesh, or between successive positions at which a taper is given.
/// These points serve for reference integrals.
const POINTS: usize = 8;

/// Relative errors of integrals along a beam that are computed by the quadrature of its mesh [-].
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct TaperQuadrature {
    /// Relative error of the mass `∫ ρA ds` of the beam.
    pub mass: f64,
    /// Relative error of `∫ 1/EA ds`, the axial compliance of the beam under end forces.
    pub stretching: f64,
    /// Relative error of `∫ 1/EI ds`, the rotation of the ends under unit moments.
    pub bending: f64,
}

impl TaperQuadrature {
    /// Smallest quadrature error of a mesh that counts as too coarse for the taper [-].
    pub const TOLERANCE: f64 = 5e-3;

    /// Computes the quadrature errors for the sections of a beam.
    /// Lengths along the beam are converted to parameters in proportion, which is exact for spans of equal length.
    ///
    /// # Errors
    /// Fails if the mesh has no quadrature.
    pub fn of(variation: &SectionVariation, mesh: &Mesh) -> Result<Self, BeamError> {
        let mut cuts = variation.places();
        if cuts.is_empty() {
            return Ok(Self::default());
        }
        let (first, last) = mesh.basis().domain();
        let part = |xi: f64| (xi - first) / (last - first);
        let (masses, fine) = (mesh.inertia_rule()?, GaussRule::new(POINTS)?);
        let mut seen = [0.0; 3];
        for quadrature in mesh.quadrature_spans()? {
            let (start, end) = (quadrature.span.start, quadrature.span.end);
            cuts.extend([part(start), part(end)]);
            let rules: [Vec<(f64, f64)>; 3] = [
                masses.iter_on(start, end).collect(),
                quadrature.force_rule.clone(),
                quadrature.moment_rule()?.iter_on(start, end).collect(),
            ];
            for (number, (sum, rule)) in seen.iter_mut().zip(rules).enumerate() {
                let values = rule.into_iter().map(|(xi, weight)| {
                    weight / (last - first) * integrands(&variation.at(part(xi)))[number]
                });
                *sum += values.sum::<f64>();
            }
        }
        cuts.sort_by(f64::total_cmp);
        let mut whole = [0.0; 3];
        for pair in cuts.windows(2) {
            for (place, weight) in fine.iter_on(pair[0], pair[1]) {
                let values = integrands(&variation.at(place));
                whole.iter_mut().zip(values).for_each(|(sum, value)| *sum += weight * value);
            }
        }
        let off = |number: usize| (seen[number] / whole[number] - 1.0).abs();
        Ok(Self { mass: off(0), stretching: off(1), bending: off(2) })
    }

    /// Returns true if one of the quadrature errors is too large.
    pub fn is_coarse(&self) -> bool {
        self.largest() >= Self::TOLERANCE
    }

    /// Largest of the three quadrature errors.
    pub fn largest(&self) -> f64 {
        larger(self.mass, larger(self.stretching, self.bending))
    }
}

fn integrands(section: &Section) -> [f64; 3] {
    [section.mass_per_length, 1.0 / section.axial_stiffness, 1.0 / section.bending_stiffness]
}

#[cfg(test)]
mod tests {
    use super::*;

    fn of(bending: f64, mass: f64) -> Section {
        Section {
            axial_stiffness: 12.0 * bending,
            shear_stiffness: 5.0 * bending,
            bending_stiffness: bending,
            mass_per_length: mass,
            rotary_inertia: 1e-3,
        }
    }

    #[test]
    fn taper_quadrature_error_is_large_only_for_narrow_flanges() {
        let smooth = SectionVariation::Numbers(vec![(0.0, of(3.0, 2.0)), (1.0, of(1.0, 1.0))]);
        let mesh = Mesh::bspline(16, 3, 2).unwrap();
        assert!(TaperQuadrature::of(&smooth, &mesh).unwrap().largest() < 1e-5);
        let (thin, thick) = (of(1.0, 1.0), of(1.0, 20.0));
        let flange = vec![(0.0, thin), (0.52, thin), (0.53, thick), (0.54, thin), (1.0, thin)];
        let seen = TaperQuadrature::of(&SectionVariation::Numbers(flange), &mesh).unwrap();
        assert!(seen.mass > 0.05 && seen.mass < 0.2, "{seen:?}");
        assert!(seen.bending < 1e-12 && seen.stretching < 1e-12, "{seen:?}");
        let uniform = SectionVariation::Uniform(thin);
        assert_eq!(TaperQuadrature::of(&uniform, &mesh).unwrap(), TaperQuadrature::default());
    }

    #[test]
    fn taper_quadrature_is_exact_for_section_steps_at_knots() {
        let places = |at: f64| {
            let (thick, thin) = (of(27.0, 3.0), of(1.0, 1.0));
            let all = vec![(0.0, thick), (at, thick), (at + 1e-9, thin), (1.0, thin)];
            SectionVariation::Numbers(all)
        };
        let mesh = Mesh::lagrange(10, 1).unwrap();
        assert!(TaperQuadrature::of(&places(0.4), &mesh).unwrap().largest() < 1e-6);
        assert!(TaperQuadrature::of(&places(0.43), &mesh).unwrap().bending > 0.01);
    }
}
