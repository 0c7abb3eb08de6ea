//! Section that is interpolated between quadrature points.

use crate::beams::Section;

/// Weighted sum of sections: the section at a position between quadrature points. The sum of the weights is one.
pub(in crate::beams) trait Interpolation: Default {
    fn add(&mut self, section: &Section, weight: f64);

    fn section<'a>(&'a self, uniform: &'a Section) -> &'a Section;
}

impl Interpolation for () {
    fn add(&mut self, _section: &Section, _share: f64) {}

    fn section<'a>(&'a self, uniform: &'a Section) -> &'a Section {
        uniform
    }
}

#[derive(Debug, Default)]
pub(in crate::beams) struct Interpolated(Section);

impl Interpolation for Interpolated {
    fn add(&mut self, section: &Section, weight: f64) {
        self.0 = self.0.plus(section, weight);
    }

    fn section<'a>(&'a self, _uniform: &'a Section) -> &'a Section {
        &self.0
    }
}
