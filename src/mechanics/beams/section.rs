//! Stiffness and inertia of a cross section.

use serde::{Deserialize, Serialize};

use std::f64::consts::PI;

use super::BeamError;
use crate::elementary::{square, whole_power};

/// Stiffnesses and inertias of a linear elastic, homogeneous cross section.
#[derive(Debug, Clone, Copy, PartialEq, Default, Serialize, Deserialize)]
pub struct Section {
    /// Axial stiffness `EA` [force].
    pub axial_stiffness: f64,
    /// Shear stiffness `GA`, including the shear correction factor [force].
    pub shear_stiffness: f64,
    /// Bending stiffness `EI` [force·length²].
    pub bending_stiffness: f64,
    /// Mass per length `ρA` [mass/length].
    pub mass_per_length: f64,
    /// Rotary inertia per length `ρI` [mass·length].
    pub rotary_inertia: f64,
}

/// Shape of a cross section. Bending is about the horizontal axis through the centroid.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub enum SectionShape {
    /// Solid rectangle.
    Rectangle {
        /// Width of the rectangle, out of the plane of motion [length].
        width: f64,
        /// Height of the rectangle, in the plane of motion [length].
        height: f64,
    },
    /// Solid circle.
    Circle {
        /// Radius of the circle [length].
        radius: f64,
    },
    /// Circular tube.
    Tube {
        /// Outer radius of the tube [length].
        outer: f64,
        /// Inner radius of the tube [length].
        inner: f64,
    },
}

/// Cross section of a homogeneous isotropic material.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct Solid {
    /// Young's modulus [force/length²].
    pub youngs_modulus: f64,
    /// Poisson's ratio of the material [-].
    pub poisson: f64,
    /// Density of the material [mass/length³].
    pub density: f64,
    /// Shape of the cross section.
    pub shape: SectionShape,
}

impl Section {
    /// Speed of axial waves, `√(EA/ρA)` [length/time].
    pub fn axial_wave_speed(&self) -> f64 {
        (self.axial_stiffness / self.mass_per_length).sqrt()
    }

    /// Speed of shear waves, `√(GA/ρA)` [length/time].
    pub fn shear_wave_speed(&self) -> f64 {
        (self.shear_stiffness / self.mass_per_length).sqrt()
    }

    /// Checks that every property is positive and finite, and returns the section.
    ///
    /// # Errors
    /// Fails for the first property that is not positive and finite.
    pub fn validated(self) -> Result<Self, BeamError> {
        const ROTARY: &str = "; without rotary inertia the mass matrix is singular: give the actual value, or a small one";
        let properties = [
            ("EA", self.axial_stiffness, "force", ""),
            ("GA", self.shear_stiffness, "force", ""),
            ("EI", self.bending_stiffness, "force·length²", ""),
            ("rho_A", self.mass_per_length, "mass/length", ""),
            ("rho_I", self.rotary_inertia, "mass·length", ROTARY),
        ];
        match properties.into_iter().find(|(_, value, ..)| !is_positive(*value)) {
            Some((name, value, dimension, advice)) => {
                Err(BeamError::SectionValue { name, value, dimension, hint: advice })
            }
            None => Ok(self),
        }
    }

    /// Returns the section of a solid. The shear correction factors are those of Cowper, J. Appl. Mech. 33 (1966) 335–340.
    ///
    /// # Errors
    /// Fails if a dimension or a material constant is out of range.
    pub fn from_solid(solid: Solid) -> Result<Self, BeamError> {
        let Solid { youngs_modulus: young, poisson, density, shape } = solid;
        let shape_values = match shape {
            SectionShape::Rectangle { width, height } => [("width", width), ("height", height)],
            SectionShape::Circle { radius } => [("radius", radius), ("radius", radius)],
            SectionShape::Tube { outer, inner } => [("outer", outer), ("inner", inner)],
        };
        for (name, value) in shape_values {
            if !is_positive(value) {
                return Err(BeamError::SectionValue { name, value, dimension: "length", hint: "" });
            }
        }
        for (name, value, dimension) in
            [("E", young, "force/length²"), ("density", density, "mass/length³")]
        {
            if !is_positive(value) {
                return Err(BeamError::SectionValue { name, value, dimension, hint: "" });
            }
        }
        if !(poisson > -1.0 && poisson <= 0.5) {
            return Err(BeamError::PoissonRatio { value: poisson });
        }
        if let SectionShape::Tube { outer, inner } = shape
            && inner >= outer
        {
            return Err(BeamError::Tube { inner, outer });
        }
        Self::of_solid(solid).validated()
    }

    pub(super) fn of_solid(
        Solid { youngs_modulus: young, poisson, density, shape }: Solid,
    ) -> Self {
        let (area, inertia) = (shape.area(), shape.second_moment());
        Self {
            axial_stiffness: young * area,
            shear_stiffness: shape.shear_correction(poisson) * young / (2.0 * (1.0 + poisson))
                * area,
            bending_stiffness: young * inertia,
            mass_per_length: density * area,
            rotary_inertia: density * inertia,
        }
    }

    pub(super) fn each(&self, other: &Self, of: impl Fn(f64, f64) -> f64) -> Self {
        Self {
            axial_stiffness: of(self.axial_stiffness, other.axial_stiffness),
            shear_stiffness: of(self.shear_stiffness, other.shear_stiffness),
            bending_stiffness: of(self.bending_stiffness, other.bending_stiffness),
            mass_per_length: of(self.mass_per_length, other.mass_per_length),
            rotary_inertia: of(self.rotary_inertia, other.rotary_inertia),
        }
    }

    pub(super) fn mixed(&self, other: &Self, fraction: f64) -> Self {
        self.each(other, |a, b| a + fraction * (b - a))
    }

    pub(super) fn plus(&self, other: &Self, weight: f64) -> Self {
        self.each(other, |a, b| a + weight * b)
    }
}

impl Solid {
    /// Returns true if both solids have the same type of shape, so that intermediate shapes exist.
    pub fn has_same_shape_as(&self, other: &Self) -> bool {
        std::mem::discriminant(&self.shape) == std::mem::discriminant(&other.shape)
    }

    pub(super) fn mixed(&self, other: &Self, fraction: f64) -> Self {
        let mix = |a: f64, b: f64| a + fraction * (b - a);
        let shape = match (self.shape, other.shape) {
            (
                SectionShape::Rectangle { width: w, height: h },
                SectionShape::Rectangle { width, height },
            ) => SectionShape::Rectangle { width: mix(w, width), height: mix(h, height) },
            (SectionShape::Circle { radius: r }, SectionShape::Circle { radius }) => {
                SectionShape::Circle { radius: mix(r, radius) }
            }
            (SectionShape::Tube { outer: o, inner: i }, SectionShape::Tube { outer, inner }) => {
                SectionShape::Tube { outer: mix(o, outer), inner: mix(i, inner) }
            }
            (shape, _) => shape,
        };
        Self {
            youngs_modulus: mix(self.youngs_modulus, other.youngs_modulus),
            poisson: mix(self.poisson, other.poisson),
            density: mix(self.density, other.density),
            shape,
        }
    }
}

impl SectionShape {
    /// Area `A` [length²].
    pub fn area(&self) -> f64 {
        match *self {
            Self::Rectangle { width, height } => width * height,
            Self::Circle { radius } => PI * radius * radius,
            Self::Tube { outer, inner } => PI * (outer * outer - inner * inner),
        }
    }

    /// Second moment of area `I` about the horizontal centroidal axis [length⁴].
    pub fn second_moment(&self) -> f64 {
        match *self {
            Self::Rectangle { width, height } => width * whole_power(height, 3) / 12.0,
            Self::Circle { radius } => PI / 4.0 * whole_power(radius, 4),
            Self::Tube { outer, inner } => {
                PI / 4.0 * (whole_power(outer, 4) - whole_power(inner, 4))
            }
        }
    }

    /// Cowper's shear correction factor (1966, table 1) [-].
    pub(crate) fn shear_correction(&self, poisson: f64) -> f64 {
        let nu = poisson;
        match *self {
            Self::Rectangle { .. } => 10.0 * (1.0 + nu) / (12.0 + 11.0 * nu),
            Self::Circle { .. } => 6.0 * (1.0 + nu) / (7.0 + 6.0 * nu),
            Self::Tube { outer, inner } => {
                let m2 = square(inner / outer);
                let sum2 = square(1.0 + m2);
                6.0 * (1.0 + nu) * sum2 / ((7.0 + 6.0 * nu) * sum2 + (20.0 + 12.0 * nu) * m2)
            }
        }
    }
}

fn is_positive(value: f64) -> bool {
    value > 0.0 && value.is_finite()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn tube_without_a_hole_has_the_properties_of_a_circle() {
        let (circle, tube) =
            (SectionShape::Circle { radius: 2.0 }, SectionShape::Tube { outer: 2.0, inner: 1e-9 });
        assert!((circle.area() - tube.area()).abs() < 1e-12);
        assert!((circle.second_moment() - tube.second_moment()).abs() < 1e-12);
        assert!((circle.shear_correction(0.3) - tube.shear_correction(0.3)).abs() < 1e-12);
    }

    #[test]
    fn cowpers_factors_have_their_tabulated_values() {
        assert!(
            (SectionShape::Rectangle { width: 1.0, height: 1.0 }.shear_correction(0.3) - 0.850)
                .abs()
                < 5e-4
        );
        assert!((SectionShape::Circle { radius: 1.0 }.shear_correction(0.3) - 0.886).abs() < 5e-4);
    }

    #[test]
    fn invalid_section_properties_are_rejected_by_name() {
        let steel = Solid {
            youngs_modulus: 210e9,
            poisson: 0.3,
            density: 7850.0,
            shape: SectionShape::Rectangle { width: 0.02, height: 0.01 },
        };
        assert!(Section::from_solid(steel).is_ok());
        let bad = [
            Solid { youngs_modulus: -1.0, ..steel },
            Solid { poisson: 0.7, ..steel },
            Solid { density: f64::NAN, ..steel },
            Solid { shape: SectionShape::Tube { outer: 1.0, inner: 1.0 }, ..steel },
        ];
        let words = ["E is -1", "Poisson", "density is NaN", "inner radius"];
        for (solid, word) in bad.into_iter().zip(words) {
            let message = Section::from_solid(solid).unwrap_err().to_string();
            assert!(message.contains(word), "{message}");
        }
        let section = Section::from_solid(steel).unwrap();
        let message =
            Section { rotary_inertia: 0.0, ..section }.validated().unwrap_err().to_string();
        assert!(message.contains("rho_I is 0") && message.contains("singular"), "{message}");
    }
}
