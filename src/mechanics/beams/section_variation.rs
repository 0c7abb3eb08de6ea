//! Sections along a beam: uniform or tapered.

use serde::{Deserialize, Serialize};

use super::{BeamError, Section, Solid};
use crate::geometry::{GaussRule, larger};

const MOST_PLACES: usize = 10_000;

/// Number of Gauss points in each linear piece of a taper.
/// Three points integrate polynomials of degree five exactly, including the bending stiffness of a linearly varying height.
const POINTS: usize = 3;

/// Sections along the axis of a beam.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub enum SectionVariation {
    /// Uniform section.
    Uniform(Section),
    /// Stiffness and inertia that vary linearly between positions.
    /// Positions are fractions of the length of the beam [-] and increase from 0 to 1.
    Numbers(Vec<(f64, Section)>),
    /// Dimensions and material that vary linearly between positions, for solids with the same type of shape.
    Dimensions(Vec<(f64, Solid)>),
}

impl From<Section> for SectionVariation {
    fn from(section: Section) -> Self {
        Self::Uniform(section)
    }
}

impl SectionVariation {
    /// Checks the sections and their positions, and returns them.
    ///
    /// # Errors
    /// Fails if a number of a section is out of range, or if solids of a taper have different types of shape.
    /// Also fails if a taper has fewer than two or more than 10 000 positions, or if the positions do not increase from 0 to 1.
    pub fn validated(self) -> Result<Self, BeamError> {
        match &self {
            Self::Uniform(section) => return section.validated().map(Self::Uniform),
            Self::Numbers(all) => {
                all.iter().try_for_each(|(_, section)| section.validated().map(|_| ()))?;
            }
            Self::Dimensions(all) => {
                all.iter().try_for_each(|(_, solid)| Section::from_solid(*solid).map(|_| ()))?;
                let same = all.windows(2).all(|pair| pair[0].1.has_same_shape_as(&pair[1].1));
                if !same {
                    return Err(BeamError::TaperShapes);
                }
            }
        }
        let places = self.places();
        if places.len() < 2 || places.len() > MOST_PLACES {
            return Err(BeamError::TaperPlaces { count: places.len(), most: MOST_PLACES });
        }
        let rises = places.windows(2).all(|pair| pair[0] < pair[1]);
        if !rises || places[0] != 0.0 || places[places.len() - 1] != 1.0 {
            let pair = places.windows(2).find(|pair| pair[1].is_nan() || pair[0] >= pair[1]);
            let wrong = match pair {
                Some(pair) => pair[1],
                None if places[0] != 0.0 => places[0],
                None => places[places.len() - 1],
            };
            return Err(BeamError::TaperPlace { value: wrong });
        }
        Ok(self)
    }

    /// Section at a fraction of the length of the beam, from 0 to 1 [-].
    pub fn at(&self, part: f64) -> Section {
        match self {
            Self::Uniform(section) => *section,
            Self::Numbers(all) => {
                let (fraction, [before, after]) = between(all, part);
                before.mixed(&after, fraction)
            }
            Self::Dimensions(all) => {
                let (fraction, [before, after]) = between(all, part);
                let solid = before.mixed(&after, fraction);
                Section::from_solid(solid).unwrap_or_else(|_| Section::of_solid(solid))
            }
        }
    }

    /// Mean section over the length of the beam. The mean section of a uniform beam is its section.
    pub fn mean(&self) -> Section {
        if let Self::Uniform(section) = self {
            return *section;
        }
        let mut sum = Section::default();
        let Ok(rule) = GaussRule::new(POINTS) else { return self.at(0.5) };
        for pair in self.places().windows(2) {
            for (place, weight) in rule.iter_on(pair[0], pair[1]) {
                sum = sum.plus(&self.at(place), weight);
            }
        }
        sum
    }

    /// Section with the largest value of each property along the beam.
    pub fn largest(&self) -> Section {
        self.sections().into_iter().reduce(|a, b| a.each(&b, larger)).unwrap_or_default()
    }

    /// Speed of the fastest axial wave, `√(EA/ρA)` [length/time].
    /// In a taper, the maximum over the given positions is used, because waves between these positions are not faster.
    pub fn axial_wave_speed(&self) -> f64 {
        self.sections().iter().map(Section::axial_wave_speed).fold(0.0, larger)
    }

    /// Positions at which a taper is defined, as fractions of the length of the beam [-]; empty for a uniform beam.
    pub fn places(&self) -> Vec<f64> {
        match self {
            Self::Uniform(_) => Vec::new(),
            Self::Numbers(all) => all.iter().map(|(place, _)| *place).collect(),
            Self::Dimensions(all) => all.iter().map(|(place, _)| *place).collect(),
        }
    }

    /// Sections at the positions of a taper, or the single section of a uniform beam.
    pub fn sections(&self) -> Vec<Section> {
        match self {
            Self::Uniform(section) => vec![*section],
            Self::Numbers(all) => all.iter().map(|(_, section)| *section).collect(),
            Self::Dimensions(all) => all.iter().map(|(place, _)| self.at(*place)).collect(),
        }
    }
}

fn between<T: Copy>(all: &[(f64, T)], part: f64) -> (f64, [T; 2]) {
    let beyond = all.partition_point(|(place, _)| *place <= part).clamp(1, all.len() - 1);
    let [(start, before), (end, after)] = [all[beyond - 1], all[beyond]];
    (((part - start) / (end - start)).clamp(0.0, 1.0), [before, after])
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::beams::SectionShape;

    fn thick() -> Section {
        Section {
            axial_stiffness: 4.0,
            shear_stiffness: 2.0,
            bending_stiffness: 8.0,
            mass_per_length: 3.0,
            rotary_inertia: 0.5,
        }
    }

    fn wedge() -> SectionVariation {
        let solid = |height: f64| Solid {
            youngs_modulus: 2.0,
            poisson: 0.3,
            density: 3.0,
            shape: SectionShape::Rectangle { width: 0.5, height },
        };
        SectionVariation::Dimensions(vec![(0.0, solid(1.0)), (0.25, solid(0.8)), (1.0, solid(0.2))])
    }

    #[test]
    fn section_numbers_and_heights_are_interpolated_linearly() {
        let thin = Section { bending_stiffness: 2.0, ..thick() };
        let variation = SectionVariation::Numbers(vec![(0.0, thick()), (0.5, thin), (1.0, thin)]);
        let bending = |part: f64| variation.at(part).bending_stiffness;
        assert_eq!([0.0, 0.25, 0.5, 0.7, 1.0].map(bending), [8.0, 5.0, 2.0, 2.0, 2.0]);
        assert!((wedge().at(0.625).bending_stiffness - 2.0 * 0.5 * 0.125 / 12.0).abs() < 1e-15);
    }

    #[test]
    fn section_means_equal_exact_integrals() {
        let mean = wedge().mean();
        assert!((mean.mass_per_length - 1.5 * (0.25 * 0.9 + 0.75 * 0.5)).abs() < 1e-14);
        let cubes = 0.25 * (1.0 - 0.8_f64.powi(4)) / (4.0 * 0.2)
            + 0.75 * (0.8_f64.powi(4) - 0.2_f64.powi(4)) / (4.0 * 0.6);
        assert!((mean.bending_stiffness - cubes / 12.0).abs() < 1e-14);
        assert_eq!(SectionVariation::from(thick()).mean(), thick());
    }

    #[test]
    fn section_places_must_increase_from_zero_to_one() {
        let of = |places: &[f64]| {
            SectionVariation::Numbers(places.iter().map(|place| (*place, thick())).collect())
                .validated()
        };
        assert!(of(&[0.0, 0.3, 1.0]).is_ok() && wedge().validated().is_ok());
        for (places, expected) in [
            (&[0.0][..], "1 place"),
            (&[0.0, 0.6, 0.4, 1.0], "0.4"),
            (&[0.0, 0.5], "0.5"),
            (&[0.1, 1.0], "0.1"),
            (&[0.0, f64::NAN, 1.0], "NaN"),
        ] {
            let message = of(places).unwrap_err().to_string();
            assert!(message.contains(expected), "{message}");
        }
    }
}
