//! Quantities whose variation along beams can be drawn.

use crate::output::BeamSide;
use crate::system::BeamSample;

pub struct BeamQuantity {
    pub name: &'static str,
    pub words: &'static str,
    pub sign: &'static str,
    pub dimension: &'static str,
    pub of: fn(&BeamSample) -> f64,
    pub side: BeamSide,
}

const QUANTITIES: [BeamQuantity; 8] = [
    quantity("N", "axial force", "force", |at| at.forces.axial),
    quantity("Q", "shear force", "force", |at| at.forces.shear),
    BeamQuantity {
        side: BeamSide::Right,
        ..quantity("M", "bending moment", "force·length", |at| at.forces.moment)
    },
    quantity("axial_strain", "axial strain", "-", |at| at.forces.axial_strain),
    quantity("shear_strain", "shear strain", "-", |at| at.forces.shear_strain),
    BeamQuantity {
        side: BeamSide::Right,
        ..quantity("curvature", "change of curvature", "1/length", |at| at.forces.curvature)
    },
    quantity("strain_energy", "strain energy per length", "energy/length", |at| at.strain_energy),
    quantity("speed", "speed", "length/time", |at| at.velocity.norm()),
];

pub const NAMES: &[&str] =
    &["N", "Q", "M", "axial_strain", "shear_strain", "curvature", "strain_energy", "speed"];

const fn quantity(
    name: &'static str,
    words: &'static str,
    dimension: &'static str,
    of: fn(&BeamSample) -> f64,
) -> BeamQuantity {
    let sign = if name.len() == 1 { name } else { words };
    BeamQuantity { name, words, sign, dimension, of, side: BeamSide::Left }
}

impl BeamQuantity {
    pub fn named(name: &str) -> Option<&'static Self> {
        const ALL: &[BeamQuantity] = &QUANTITIES;
        ALL.iter().find(|quantity| quantity.name == name)
    }

    /// Axis label, such as `M [force·length]`.
    pub fn label(&self) -> String {
        format!("{} [{}]", self.sign, self.dimension)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn beam_quantity_names_agree_with_their_table() {
        let names: Vec<&str> = QUANTITIES.iter().map(|quantity| quantity.name).collect();
        assert_eq!(names, NAMES);
        assert_eq!(
            BeamQuantity::named("M").map(BeamQuantity::label),
            Some("M [force·length]".into())
        );
        assert!(BeamQuantity::named("m").is_none());
    }
}
